"""Concavities: voxels on whose colour the photos disagree are carved (4.3.2)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from veduta import _core
from veduta.carve.build.hull import Hull, Root, carve_hull, outline_distances
from veduta.carve.options import ColourOptions
from veduta.carve.views import Pixels, View, camera_rows
from veduta.run.card import Engine

Cube = NDArray[np.bool_]
# cameras, photos, distances, corners, solid, low_m, side_m
SweepInputs = tuple[
    NDArray[np.float64],
    list[Pixels],
    list[NDArray[np.float32]],
    NDArray[np.float64],
    Cube,
    tuple[float, float, float],
    float,
]


@dataclass(frozen=True)
class ConsistencyRule:
    """When colours disagree.

    voxel_px: a voxel of the sweep covers so many pixels, so that noise and small errors of the
    cameras do not count. least_levels, most_levels: of the sweep's own cube. above: a voxel is carved
    where its spread is above the hull's median by so many deviations of the hull's lower half, and
    above least_spread (grey levels): the hull is right in most places. least_views, most_views:
    that see a voxel. least_cosine: of the angle under which they do. rim_voxels: as near to an outline
    nothing is carved, so that the silhouettes stay. sweeps: at most, one voxel deep each. piece:
    carved pieces of fewer voxels are noise. smooth: deviation (voxels) by which a carved surface is
    smoothed.
    """

    voxel_px: float = 3.0
    least_levels: int = 5
    most_levels: int = 7
    above: float = 5.0
    least_spread: float = 12.0
    least_views: int = 3
    most_views: int = 6
    least_cosine: float = 0.35
    rim_voxels: float = 1.5
    sweeps: int = 80
    piece: int = 30
    smooth: float = 0.8


@dataclass(frozen=True, eq=False)
class Consistency:
    """hull: with what was carved taken. carved_by_sweep: voxels. spread: grey levels above which they
    went. voxel_m: their side. carved: (n, n, n) bool of that size.
    """

    hull: Hull
    carved: Cube
    root: Root
    carved_by_sweep: tuple[int, ...]
    spread: float
    typical: float

    @property
    def volume_m3(self) -> float:
        """What was carved."""
        return float(self.carved.sum()) * self.root.voxel_m**3


def carve_by_colour(
    hull: Hull,
    views: Sequence[View],
    options: ColourOptions | None = None,
    rule: ConsistencyRule | None = None,
    engine: Engine | None = None,
) -> Consistency:
    """Take from the hull what the photos' colours contradict. engine: the processor if not given."""
    rule, options = rule or ConsistencyRule(), options or ColourOptions()
    root = _sweep_root(hull.root, views, rule)
    own = hull if root.levels == hull.root.levels else carve_hull(views, root)
    given = sweep_inputs(views, own)
    solid = given[4]

    def swept(spread: float, sweeps: int) -> tuple[Cube, list[int], NDArray[np.float32]]:
        when = _core.SweepRule(
            spread=spread, least_views=rule.least_views, most_views=rule.most_views,
            least_cosine=rule.least_cosine, rim_voxels=rule.rim_voxels, sweeps=sweeps,
        )  # fmt: skip
        # A voxel on the threshold may fall on either side: the same call is to give the same bytes,
        # whatever card there is, so that a card is taken only where it was asked for.
        if engine is None or engine.device != "gpu":
            return _core.sweep_colours(*given, when)
        return engine.run(
            lambda card: card.sweep_colours(*given, when),
            lambda: _core.sweep_colours(*given, when),
        )

    spreads = swept(255.0, 0)[2]
    typical = float(np.median(spreads)) if len(spreads) else 0.0
    spread = options.spread or _too_much(spreads, rule)
    left, by_sweep, _ = swept(spread, rule.sweeps)
    carved = _without_specks(solid & ~left, rule)
    if not carved.any():
        return Consistency(hull, carved, root, tuple(by_sweep), spread, typical)
    volume = hull.volume.deepened(_field(solid, carved, root, rule))
    return Consistency(Hull(hull.root, volume), carved, root, tuple(by_sweep), spread, typical)


def sweep_inputs(views: Sequence[View], hull: Hull) -> SweepInputs:
    """What `_core.sweep_colours` takes besides its rule, for the voxels of a hull."""
    fields = [outline_distances(view.mask) for view in views]
    return (
        camera_rows([view.camera for view in views]),
        [_at_voxels(view, hull.root) for view in views],
        [distances for distances, _ in fields],
        np.array([corner for _, corner in fields], dtype=np.float64),
        hull.volume.solid(),
        (float(hull.root.low_m[0]), float(hull.root.low_m[1]), float(hull.root.low_m[2])),
        hull.root.side_m,
    )


def _sweep_root(root: Root, views: Sequence[View], rule: ConsistencyRule) -> Root:
    """The same cube with voxels of some pixels each."""
    middle = root.low_m + root.side_m / 2.0
    pixels = []
    for view in views:
        depth = float(view.camera.project(middle)[1][0])
        pixels.append(max(view.camera.focal_px) * root.side_m / max(depth, 1e-9))
    levels = int(np.floor(np.log2(float(np.median(pixels)) / rule.voxel_px)))
    levels = max(rule.least_levels, min(levels, rule.most_levels, root.levels))
    return Root(root.low_m, root.side_m, levels)


def _at_voxels(view: View, root: Root) -> Pixels:
    """The photo, each pixel the mean over a voxel's picture."""
    middle = root.low_m + root.side_m / 2.0
    depth = float(view.camera.project(middle)[1][0])
    sigma = 0.4 * max(view.camera.focal_px) * root.voxel_m / max(depth, 1e-9)
    smooth = cv2.GaussianBlur(view.pixels, (0, 0), max(sigma, 0.5))
    return np.ascontiguousarray(smooth, dtype=np.uint8)


def _too_much(spreads: NDArray[np.float32], rule: ConsistencyRule) -> float:
    if not len(spreads):
        return 255.0
    middle = float(np.median(spreads))
    below = middle - float(np.quantile(spreads, 0.159))
    return max(rule.least_spread, middle + rule.above * below)


def _without_specks(carved: Cube, rule: ConsistencyRule) -> Cube:
    labels, count = ndimage.label(carved, ndimage.generate_binary_structure(3, 2))
    sizes = np.bincount(labels.ravel(), minlength=count + 1)
    sizes[0] = 0
    return np.asarray((sizes >= rule.piece)[labels], dtype=bool)


def _field(
    solid: Cube, carved: Cube, root: Root, rule: ConsistencyRule
) -> NDArray[np.float32]:
    """Signed distance (m) to what is left, more than zero in what was carved, and only near that."""
    left = solid & ~carved
    signed = ndimage.distance_transform_edt(~left) - ndimage.distance_transform_edt(left)
    signed -= 0.5 * np.sign(signed)
    smooth = ndimage.gaussian_filter(signed, rule.smooth).astype(np.float32)
    near = ndimage.binary_dilation(carved, iterations=2)
    return np.ascontiguousarray(np.where(near, smooth, -4.0) * root.voxel_m, dtype=np.float32)
