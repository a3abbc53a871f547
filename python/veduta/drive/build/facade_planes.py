"""The planes of facades along a segment, and each as a metric orthophoto."""

from __future__ import annotations

from dataclasses import dataclass, replace

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.drive.build.layers import PointClass
from veduta.drive.build.segment import Textured

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class PlaneParameters:
    """off_m: columns of a plane lie so near to it. narrowest_m, lowest_m: smaller ones are none.
    step_m: from one column to the next a wall goes on where its depth changes by less.
    least_seen: share of texels that images show, below which no orthophoto is made.
    glass: share of points behind the wall, seen through it, above which it is a glass front.
    back_m: a neighbour that stands so much farther back or forth makes a stepped front.
    across: share of columns with a wall across the path that is named. open: the same of an arcade.
    """

    off_m: float = 0.25
    narrowest_m: float = 4.0
    lowest_m: float = 2.0
    step_m: float = 0.4
    least_seen: float = 0.15
    glass: float = 0.3
    back_m: float = 0.5
    across: float = 0.2
    open: float = 0.2


@dataclass(frozen=True, eq=False)
class FacadePlane:
    """A wall from column `first` up to `last` of a segment. left, right: (3,) its lower corners as
    seen from the street (m, world); height_m: over them. named: what the paper's section 8.4 finds
    hard: "glass front", "stepped", "porch", "arcade", "wall across the path".
    """

    first: int
    last: int
    left: Floats
    right: Floats
    height_m: float
    named: tuple[str, ...] = ()

    @property
    def width_m(self) -> float:
        """Between its corners."""
        return float(np.linalg.norm(self.right - self.left))


@dataclass(frozen=True, eq=False)
class Orthophoto:
    """pixels: (h, w, 3) uint8, top row first. invented: (h, w) bool, what no image shows.

    metres_per_px: along both axes; the lower left corner of the picture is the plane's.
    """

    plane: FacadePlane
    pixels: NDArray[np.uint8]
    invented: NDArray[np.bool_]
    metres_per_px: float


def facade_planes(textured: Textured, parameters: PlaneParameters | None = None) -> list[FacadePlane]:
    """Straight pieces of the main depth, each a vertical plane by its median height."""
    chosen = parameters or PlaneParameters()
    frame, background = textured.geometry.frame, textured.background
    main = background.main
    places = frame.origins[:, :2] + main[:, None] * frame.outward
    found = []
    for first, last in _runs(main, chosen.step_m):
        for begin, end in _straight(places, first, last, chosen.off_m):
            plane = _plane(textured, places, begin, end)
            if plane.width_m >= chosen.narrowest_m and plane.height_m >= chosen.lowest_m:
                found.append(replace(plane, named=_names(textured, plane, main, chosen)))
    return found


def _names(
    textured: Textured, plane: FacadePlane, main: Floats, chosen: PlaneParameters
) -> tuple[str, ...]:
    layers = textured.geometry.layers
    here = (layers.points.column >= plane.first) & (layers.points.column < plane.last)
    glass = int((layers.kind[here] == PointClass.GLASS).sum())
    wall = int((layers.kind[here] == PointClass.BUILDING).sum())
    found = []
    if glass > chosen.glass * max(glass + wall, 1):
        found.append("glass front")
    own = float(np.median(main[plane.first : plane.last]))
    beside = [main[max(plane.first - 5, 0) : plane.first], main[plane.last : plane.last + 5]]
    steps = [abs(float(np.nanmedian(one)) - own) for one in beside if np.isfinite(one).any()]
    if any(step > chosen.back_m for step in steps):
        found.append("stepped")
    depths = layers.depths
    across = depths.across[plane.first : plane.last] & ~depths.porch[plane.first : plane.last]
    if depths.porch[max(plane.first - 5, 0) : plane.last + 5].any():
        found.append("porch")
    if np.isfinite(layers.behind.arcades.depth[plane.first : plane.last]).mean() > chosen.open:
        found.append("arcade")
    if across.mean() > chosen.across:
        found.append("wall across the path")
    return tuple(found)


def _runs(main: Floats, step_m: float) -> list[tuple[int, int]]:
    """First and one past the last column of walls without a gap and without a step."""
    with np.errstate(invalid="ignore"):
        goes_on = np.abs(np.diff(main)) < step_m
    cuts = np.flatnonzero(~goes_on) + 1
    ends = np.concatenate([[0], cuts, [len(main)]])
    pairs = zip(ends[:-1].tolist(), ends[1:].tolist(), strict=True)
    return [(a, b) for a, b in pairs if b - a > 2 and np.isfinite(main[a])]


def _straight(places: Floats, first: int, last: int, off_m: float) -> list[tuple[int, int]]:
    """Pieces of a line of columns that lie on straight lines (Douglas and Peucker 1973)."""
    piece = places[first:last]
    chord = piece[-1] - piece[0]
    length = float(np.linalg.norm(chord))
    if last - first < 4 or length < 1e-6:
        return [(first, last)]
    normal = np.array([-chord[1], chord[0]]) / length
    off = np.abs((piece - piece[0]) @ normal)
    worst = int(np.argmax(off))
    if off[worst] <= 2.0 * off_m or worst in (0, len(piece) - 1):
        return [(first, last)]
    cut = first + worst
    return _straight(places, first, cut, off_m) + _straight(places, cut, last, off_m)


def _plane(textured: Textured, places: Floats, first: int, last: int) -> FacadePlane:
    frame, background = textured.geometry.frame, textured.background
    columns = slice(first, last)
    middle = places[columns].mean(axis=0)
    axis = np.linalg.svd(places[columns] - middle, full_matrices=False)[2][0]
    axis = axis * np.sign(axis @ (places[last - 1] - places[first]))
    along = (places[columns] - middle) @ axis
    ends = middle + np.outer([along.min(), along.max()], axis)
    if frame.side == "right":  # as one looks at it, columns run from right to left
        ends = ends[::-1]
    height = frame.vertices(background.depth)[:, columns, 2]
    wall = background.wall[:, columns]
    seen = np.where(wall, height, np.nan)
    some = wall.any(axis=0)
    low = float(np.median(np.nanmin(seen[:, some], axis=0))) if some.any() else 0.0
    top = float(np.quantile(np.nanmax(seen[:, some], axis=0), 0.9)) if some.any() else 0.0
    corners = np.column_stack([ends, [low, low]])
    return FacadePlane(first, last, corners[0], corners[1], max(top - low, 0.0))


def orthophoto(
    textured: Textured, plane: FacadePlane, texel_m: float, parameters: PlaneParameters | None = None
) -> Orthophoto | None:
    """The atlas looked at straight on; None where images show too little of the plane."""
    chosen = parameters or PlaneParameters()
    frame, atlas = textured.geometry.frame, textured.atlas
    size = max(int(plane.width_m / texel_m), 1), max(int(plane.height_m / texel_m), 1)
    across = (np.arange(size[0]) + 0.5) * texel_m
    up = plane.height_m - (np.arange(size[1]) + 0.5) * texel_m
    axis = (plane.right - plane.left) / plane.width_m
    ground = plane.left[:2] + across[:, None] * axis[:2]
    middle = frame.origins[plane.first : plane.last, :2]
    column = plane.first + np.argmin(
        np.abs(((ground[:, None] - middle) * frame.along[plane.first : plane.last]).sum(axis=2)), axis=1
    )
    depth = ((ground - frame.origins[column, :2]) * frame.outward[column]).sum(axis=1)
    rise = plane.left[2] + up[:, None] - frame.origins[column, 2]
    step = float(frame.angles_rad[1] - frame.angles_rad[0])
    row = (np.arctan2(rise, np.maximum(depth, 0.1)) - frame.angles_rad[0]) / step
    pixel = np.stack([row, np.broadcast_to(column, row.shape)], axis=2).reshape(-1, 2)
    shape = atlas.seen.shape
    at = (atlas.uv(pixel) * [shape[1], shape[0]] - 0.5).astype(np.float32).reshape(*row.shape, 2)
    maps = (np.ascontiguousarray(at[..., 0]), np.ascontiguousarray(at[..., 1]))
    pixels = cv2.remap(textured.pixels, *maps, cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE)
    shown = cv2.remap(atlas.seen.astype(np.uint8), *maps, cv2.INTER_NEAREST) > 0
    if shown.mean() < chosen.least_seen:
        return None
    return Orthophoto(plane, np.asarray(pixels, dtype=np.uint8), ~shown, texel_m)
