"""What stands in a front that rules derive to, as seen from straight ahead: boxes with classes.

The frame is that of facades: metres, x right along the wall, z up from the ground, the wall's plane
at y = 0, what stands before it at y < 0.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta import _core
from veduta.grammar.assets.asset import Asset


@dataclass(frozen=True)
class ElevationParameters:
    """on_wall_m: what is so near to the lot's first edge lies in the plane of the wall. deepest_m:
    what lies further behind the wall is another wall's: arcades are the deepest recesses.
    """

    on_wall_m: float = 0.05
    deepest_m: float = 2.0


_OWN = ElevationParameters()


@dataclass(frozen=True)
class Elevation:
    """`classes` and `said` (n) name class and provenance of each box; `boxes` (n, 4) are x0, z0,
    x1, z1 in metres; `near` (n) is the y of what is nearest to the viewer. `roofs` are the outlines
    (k, 2) of all surfaces of roofs, wherever they are; `eaves_m` is how high the walls at the
    street go.
    """

    classes: tuple[str, ...]
    said: tuple[str, ...]
    boxes: NDArray[np.float64]
    near: NDArray[np.float64]
    roofs: tuple[NDArray[np.float64], ...]
    eaves_m: float

    def of(self, *names: str) -> NDArray[np.float64]:
        """The boxes (k, 4) of these classes, from left to right and from below."""
        rows = np.array([name in names for name in self.classes], dtype=np.bool_)
        found = self.boxes[rows]
        return found[np.lexsort((found[:, 1], found[:, 0]))]


def elevation(derived: _core.DerivedLot, assets: Sequence[Asset]) -> Elevation:
    """The boxes of all surfaces that belong to the wall along the lot's first edge."""
    classes, said = derived.feature_class, derived.feature_provenance
    count = len(classes)
    low, high = np.full((count, 3), np.inf), np.full((count, 3), -np.inf)
    starts = derived.ring_offsets[derived.polygon_offsets[:-1]]
    if len(starts):
        feature = derived.polygon_feature
        np.minimum.at(low, feature, np.minimum.reduceat(derived.positions_m, starts))
        np.maximum.at(high, feature, np.maximum.reduceat(derived.positions_m, starts))
    if len(derived.instance_feature):
        bottom, top = instance_boxes(derived, assets)
        np.minimum.at(low, derived.instance_feature, bottom)
        np.maximum.at(high, derived.instance_feature, top)
    front = np.isfinite(low[:, 0]) & (high[:, 1] < _OWN.deepest_m)
    rows = np.flatnonzero(front)
    return Elevation(
        classes=tuple(classes[row] for row in rows.tolist()),
        said=tuple(said[row] for row in rows.tolist()),
        boxes=np.column_stack([low[rows][:, [0, 2]], high[rows][:, [0, 2]]]),
        near=low[rows, 1],
        roofs=_roofs(derived, classes),
        eaves_m=_eaves_m(derived, classes, starts),
    )


def _eaves_m(derived: _core.DerivedLot, classes: list[str], starts: NDArray[np.int64]) -> float:
    """The highest point of the walls' polygons, as these may be one feature around the corner."""
    is_wall = np.array([name == "wall" for name in classes], dtype=np.bool_)
    if not len(starts):
        return 0.0
    low = np.minimum.reduceat(derived.positions_m, starts)
    high = np.maximum.reduceat(derived.positions_m, starts)
    front = is_wall[derived.polygon_feature] & (np.abs(low[:, 1]) < _OWN.on_wall_m)
    front &= np.abs(high[:, 1]) < _OWN.on_wall_m
    return float(max([0.0, *high[front, 2].tolist()]))


def _roofs(derived: _core.DerivedLot, classes: list[str]) -> tuple[NDArray[np.float64], ...]:
    is_roof = np.array([name == "roof" for name in classes], dtype=np.bool_)
    if not len(classes):
        return ()
    rows = np.flatnonzero(is_roof[derived.polygon_feature])
    starts = derived.polygon_offsets[rows]
    firsts, ends = derived.ring_offsets[starts], derived.ring_offsets[starts + 1]
    flat = derived.positions_m[:, [0, 2]]
    return tuple(flat[a:b] for a, b in zip(firsts.tolist(), ends.tolist(), strict=True))


def instance_boxes(
    derived: _core.DerivedLot, assets: Sequence[Asset]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """The lower and upper corner (i, 3) of each instance."""
    boxes = np.array([asset.box_m for asset in assets])  # (a, 2, 3)
    middles, halves = boxes.mean(axis=1), 0.5 * np.diff(boxes, axis=1)[:, 0]  # y up
    middles = np.column_stack([middles[:, 0], -middles[:, 2], middles[:, 1]])
    halves = halves[:, [0, 2, 1]]
    place = derived.instance_transform.reshape(-1, 3, 4)
    turn, own = place[:, :, :3], derived.instance_asset
    middle = np.matmul(turn, middles[own][:, :, None])[..., 0] + place[:, :, 3]
    half = np.matmul(np.abs(turn), halves[own][:, :, None])[..., 0]
    return middle - half, middle + half
