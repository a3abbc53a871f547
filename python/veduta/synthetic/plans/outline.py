"""What makes an outline more than a rectangle: bays, bows and corners cut off."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from shapely import unary_union
from shapely.geometry import LineString, Polygon

from veduta.synthetic.plans.dissect import Cell
from veduta.synthetic.plans.house import Point

BAY_SIDE_M = 3.0
CUT_SIDE_M = 2.6


def with_features(
    rng: np.random.Generator, cells: Sequence[Cell], shares: dict[str, float]
) -> list[Cell]:
    """The cells with a bay, a bow or a cut corner, each with its probability in `shares`.

    Only sides that lie wholly outdoors change, so no neighbour has to follow.
    """
    changed = list(cells)
    for feature, change in (("corner", _cut_corner), ("bay", _bay), ("bow", _bow)):
        if rng.random() >= shares.get(feature, 0.0):
            continue
        whole = unary_union([Polygon(cell.corners) for cell in cells])
        if not isinstance(whole, Polygon):
            return changed
        outside = LineString(whole.exterior.coords)
        places = [
            (index, side)
            for index, cell in enumerate(changed)
            if cell.use not in ("stairs", "wardrobe", "corridor", "garage")
            and len(cell.corners) == 4
            for side in range(4)
            if _is_outdoors(cell, side, outside)
        ]
        fits = [(index, change(changed[index], side, outside)) for index, side in places]
        good = [(index, made) for index, made in fits if made is not None]
        if good:
            index, made = good[int(rng.integers(len(good)))]
            changed[index] = made
    return changed


def _side(cell: Cell, side: int) -> tuple[Point, Point]:
    return cell.corners[side], cell.corners[(side + 1) % len(cell.corners)]


def _is_outdoors(cell: Cell, side: int, outside: LineString) -> bool:
    return cell.bulges[side] == 0.0 and outside.buffer(1e-6).contains(LineString(_side(cell, side)))


def _along(start: Point, end: Point, metres: float, out: float = 0.0) -> Point:
    """A point so far along a side, and so far out of it (the right of a ring that runs ccw)."""
    size = math.dist(start, end)
    dx, dy = (end[0] - start[0]) / size, (end[1] - start[1]) / size
    return (
        round(start[0] + metres * dx + out * dy, 3),
        round(start[1] + metres * dy - out * dx, 3),
    )


def _insert(cell: Cell, side: int, points: Sequence[Point], bulges: Sequence[float]) -> Cell:
    """New corners in a side; `bulges` are those of the pieces that begin at each."""
    corners = (*cell.corners[: side + 1], *points, *cell.corners[side + 1 :])
    bends = (*cell.bulges[: side + 1], *bulges, *cell.bulges[side + 1 :])
    return replace(cell, corners=corners, bulges=bends)


def _bay(cell: Cell, side: int, _: LineString) -> Cell | None:
    start, end = _side(cell, side)
    size = math.dist(start, end)
    if size < BAY_SIDE_M:
        return None
    wide = min(2.8, size - 1.0)
    low = (size - wide) / 2
    points = [
        _along(start, end, low), _along(start, end, low + 0.6, 0.8),
        _along(start, end, low + wide - 0.6, 0.8), _along(start, end, low + wide),
    ]  # fmt: skip
    return _insert(cell, side, points, [0.0] * 4)


def _bow(cell: Cell, side: int, _: LineString) -> Cell | None:
    start, end = _side(cell, side)
    size = math.dist(start, end)
    if size < BAY_SIDE_M:
        return None
    points = [_along(start, end, 0.5), _along(start, end, size - 0.5)]
    return _insert(cell, side, points, [0.4, 0.0])


def _cut_corner(cell: Cell, side: int, outside: LineString) -> Cell | None:
    """Cut the corner between this side and the next, where both are outdoors."""
    if not _is_outdoors(cell, (side + 1) % 4, outside):
        return None
    start, corner = _side(cell, side)
    _, end = _side(cell, (side + 1) % 4)
    first, second = math.dist(start, corner), math.dist(corner, end)
    if min(first, second) < CUT_SIDE_M:
        return None
    points = [_along(start, corner, 0.6 * first), _along(corner, end, 0.4 * second)]
    at = (side + 1) % 4
    corners = [*cell.corners[:at], *points, *cell.corners[at + 1 :]]
    return replace(cell, corners=tuple(corners), bulges=(0.0,) * len(corners))
