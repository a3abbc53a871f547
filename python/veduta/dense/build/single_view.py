"""The mesh of one view: its depth map, triangulated in the picture (thesis, section 3.4).

Moslah (2011): "2D Delaunay triangulation of a selected depth map followed by a inverse projective
transformation". The thesis does not say which points are taken, nor what becomes of steps in depth.
Here squares of pixels are quartered until the inverse depths in each are a plane (planes in space
are planes in inverse depth); their middles are the points. Triangles that bridge a step or a hole
are left out. Depths have noise, and single ones are missing: gaps are closed and noise is calmed
before, else the mesh is full of pinholes.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import Delaunay, QhullError

from veduta.cameras import Camera
from veduta.dense.build.depth_gaps import GapParameters, calmed, closed_gaps
from veduta.dense.build.surface import part_sizes
from veduta.run.errors import NotFoundError
from veduta.surfaces import compact

Floats = NDArray[np.float64]
Faces = NDArray[np.int64]
COARSER = 1.6
REMEDY = "Choose another --single-view, or --agree 1."


@dataclass(frozen=True)
class SingleViewParameters:
    """largest_px: side of the largest square, a power of two. within: by which share the depths of
    a square may leave its plane, as root of the mean square; one alone by `outlier` times that.
    steepest_deg: between the direction of sight and a triangle's normal: what is steeper bridges a
    step. gaps: what is done to the depths before. hidden: share of a triangle's pixels of which no depth may be known. least_triangles:
    loose parts of fewer are left out.
    """

    largest_px: int = 32
    within: float = 0.004
    outlier: float = 4.0
    steepest_deg: float = 84.0
    gaps: GapParameters = field(default_factory=GapParameters)
    hidden: float = 0.3
    least_triangles: int = 50


@dataclass(frozen=True, eq=False)
class SingleView:
    """points_m: (v, 3) in the cameras' frame. triangles: (m, 3) uint32, counter-clockwise seen from
    the camera. pixels: (v, 2) where the vertices lie in the picture. cut: triangles that bridged a
    step or a hole; dropped: those of loose parts. covered: share of the known depths where there is
    a triangle. within: by which share these depths leave it, 95 of 100 of them. filled: share of
    the picture where a small gap was closed.
    """

    points_m: Floats
    triangles: NDArray[np.uint32]
    pixels: Floats
    cut: int
    dropped: int
    covered: float
    within: float
    filled: float

    def within_box(self, box: tuple[float, ...]) -> SingleView:
        """The triangles wholly in a box: xmin ymin zmin xmax ymax zmax (m). NotFoundError if none is."""
        between = (self.points_m >= box[:3]) & (self.points_m <= box[3:])
        inside = np.asarray(between.all(axis=1))
        kept = self.triangles[inside[self.triangles].all(axis=1)].astype(np.int64)
        if not len(kept):
            raise NotFoundError("a surface", "none lies in the box", "Give a larger --box.")
        both, triangles = compact(np.column_stack([self.points_m, self.pixels]), kept)
        return replace(self, points_m=both[:, :3], pixels=both[:, 3:], triangles=triangles)


def single_view(
    depths_m: NDArray[np.float32], camera: Camera, most: int, parameters: SingleViewParameters
) -> SingleView:
    """The mesh of (h, w) depths along the camera's z, NaN where unknown, of `most` triangles at most.

    Where they would need more, squares may be less plane. NotFoundError where there is no surface.
    """
    within, size, given_m = parameters.within, parameters.largest_px, depths_m
    closed = closed_gaps(given_m, parameters.gaps)
    filled = float((np.isfinite(closed) & ~np.isfinite(given_m)).mean())
    depths_m = calmed(closed, parameters.gaps)
    pixels, inverse = chosen_points(depths_m, within, parameters)
    # Of points in a plane come less than twice as many triangles.
    while 2 * len(pixels) > most and within < 1.0:
        within *= COARSER
        pixels, inverse = chosen_points(depths_m, within, parameters)
    if len(pixels) < 3:
        raise NotFoundError("a surface", f"the photo has {len(pixels)} depths", REMEDY)
    try:
        net = Delaunay(pixels)
    except QhullError as error:
        raise NotFoundError("a surface", "the photo's depths lie in a line", REMEDY) from error
    # The picture's y points down: the other way round is counter-clockwise seen from the camera.
    faces = np.asarray(net.simplices[:, ::-1], dtype=np.int64)
    points = _lifted(pixels, inverse, camera)
    covering = _Covering.of(net, inverse, depths_m, size)
    kept = _in_sight(points, faces, camera, parameters.steepest_deg)
    kept &= covering.whole(pixels[faces], parameters.hidden)
    cut = int((~kept).sum())
    if not kept.any():
        raise NotFoundError("a surface", "no neighbouring depths lie on one", REMEDY)
    sizes = part_sizes(faces[kept], len(points))
    least = min(parameters.least_triangles, int(sizes.max()))
    dropped = int((sizes < least).sum())
    kept[np.flatnonzero(kept)[sizes < least]] = False
    both, triangles = compact(np.column_stack([points, pixels]), faces[kept])
    covered, off = covering.fit(kept, given_m)
    return SingleView(both[:, :3], triangles, both[:, 3:], cut, dropped, covered, off, filled)


def chosen_points(
    depths_m: NDArray[np.float32], within: float, parameters: SingleViewParameters
) -> tuple[Floats, Floats]:
    """Where the points lie, (n, 2) px, and their inverse depths (n,): the mean of their squares.

    A square is one where all depths are known and lie in a plane; else its quarters are looked at,
    down to single pixels. What lies beyond the picture counts as unknown, so that squares grow small
    towards its frame as towards holes, and the mesh reaches to them.
    """
    size = parameters.largest_px
    height, width = depths_m.shape
    # At least one unknown pixel all around.
    inverse = np.full([size * -(-(side + 2) // size) for side in (height, width)], np.nan)
    inverse[1 : height + 1, 1 : width + 1] = 1.0 / depths_m.astype(np.float64)
    wanted = np.ones([side // size for side in inverse.shape], dtype=bool)
    places, values = [], []
    while True:
        means, plane = _planes(inverse, size, within, parameters.outlier)
        taken = wanted & plane
        rows, columns = np.nonzero(taken)
        places.append(np.column_stack([columns, rows]) * size + (size / 2.0 - 1.0))
        values.append(means[taken])
        if size == 1:
            return np.concatenate(places), np.concatenate(values)
        size //= 2
        wanted = np.repeat(np.repeat(wanted & ~plane, 2, axis=0), 2, axis=1)


def _planes(
    inverse: Floats, size: int, within: float, outlier: float
) -> tuple[Floats, NDArray[np.bool_]]:
    """The mean of each square, and whether it is known wholly and its values lie in a plane."""
    rows, columns = (side // size for side in inverse.shape)
    squares = inverse.reshape(rows, size, columns, size).transpose(0, 2, 1, 3)
    means = squares.mean(axis=(2, 3))
    if size == 1:
        return means, np.isfinite(means)
    along = np.arange(size) - (size - 1) / 2.0
    spread = size * float((along**2).sum())
    across = np.einsum("rcyx,x->rc", squares, along) / spread
    down = np.einsum("rcyx,y->rc", squares, along) / spread
    flat = means[..., None, None] + across[..., None, None] * along
    off = np.abs(squares - flat - down[..., None, None] * along[:, None]) / means[..., None, None]
    with np.errstate(invalid="ignore"):
        near = np.sqrt((off**2).mean(axis=(2, 3))) <= within
        return means, near & (off.max(axis=(2, 3)) <= outlier * within)


def _lifted(pixels: Floats, inverse: Floats, camera: Camera) -> Floats:
    """(n, 3) where pixels of known inverse depth lie in the cameras' frame."""
    origin, directions = camera.rays(pixels)
    ahead = directions @ camera.cam_from_world[2, :3]
    found: Floats = origin + directions / (ahead * inverse)[:, None]
    return found


def _in_sight(
    points: Floats, faces: Faces, camera: Camera, steepest_deg: float
) -> NDArray[np.bool_]:
    """Which triangles are not so steep to the direction of sight that they bridge a step."""
    a, b, c = (points[faces[:, corner]] for corner in range(3))
    normals = np.cross(b - a, c - a)
    sight = camera.centre() - (a + b + c) / 3.0
    lengths = np.linalg.norm(normals, axis=1) * np.linalg.norm(sight, axis=1)
    facing = np.einsum("ij,ij->i", normals, sight)
    return np.asarray(facing > np.cos(np.radians(steepest_deg)) * lengths)


@dataclass(frozen=True, eq=False)
class _Covering:
    """What the triangles cover. owner: (p,) that of each pixel, -1 for none. known: (p,). inverse:
    (p,) that of the triangle there. shape: rows and columns.
    """

    owner: NDArray[np.int32]
    known: NDArray[np.bool_]
    inverse: Floats
    shape: tuple[int, int]

    @staticmethod
    def of(
        net: Delaunay, inverse: Floats, depths_m: NDArray[np.float32], strip: int
    ) -> _Covering:
        height, width = depths_m.shape
        owner = np.full((height, width), -1, dtype=np.int32)
        there = np.zeros((height, width))
        across = np.arange(width) + 0.5
        for top in range(0, height, strip):
            down = np.arange(top, min(top + strip, height)) + 0.5
            spots = np.stack(np.meshgrid(across, down), axis=-1)
            own = net.find_simplex(spots)
            owner[top : top + strip] = own
            turn, last = net.transform[own, :2], net.transform[own, 2]
            first = np.einsum("yxij,yxj->yxi", turn, spots - last)
            shares = np.concatenate([first, 1.0 - first.sum(axis=-1, keepdims=True)], axis=-1)
            there[top : top + strip] = (shares * inverse[net.simplices[own]]).sum(axis=-1)
        known = np.isfinite(depths_m).ravel()
        return _Covering(owner.ravel(), known, there.ravel(), (height, width))

    def whole(self, corners: Floats, hidden: float) -> NDArray[np.bool_]:
        """(m,) which triangles lie over no hole. corners: (m, 3, 2) px.

        Of the pixels within, a share of `hidden` may have no depth, and of the middles of the three
        sides one: slivers that reach over a hole between pixels are told by that.
        """
        count, inside = len(corners), self.owner >= 0
        every = np.bincount(self.owner[inside], minlength=count)
        unknown = np.bincount(self.owner[inside & ~self.known], minlength=count)
        column, row = ((corners + corners[:, [1, 2, 0]]) / 2.0).astype(np.intp).transpose(2, 0, 1)
        sides = self.known.reshape(self.shape)[row, column].sum(axis=1)
        return np.asarray((unknown <= hidden * every) & (sides >= 2))

    def fit(
        self, kept: NDArray[np.bool_], depths_m: NDArray[np.float32]
    ) -> tuple[float, float]:
        """The share of the given depths under kept triangles, and how near 95 % of these are."""
        given = depths_m.ravel()
        known = np.isfinite(given)
        under = known & (self.owner >= 0) & kept[self.owner]
        if not under.any():
            return 0.0, 0.0
        off = np.abs(given[under] * self.inverse[under] - 1.0)
        return float(under.sum() / max(1, known.sum())), float(np.nanquantile(off, 0.95))
