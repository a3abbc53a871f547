"""What must be true of a furnished house, checked from its document alone.

Things are boxes; a person is a disc. Nothing of the code that furnishes is used.
"""

from __future__ import annotations

import itertools

import cv2
import numpy as np
from numpy.typing import NDArray
from shapely.affinity import rotate, translate
from shapely.geometry import Polygon, box
from shapely.geometry.base import BaseGeometry

from veduta.plan.document import Furniture, Storey
from veduta.plan.house.hole import Hole
from veduta.plan.house.space import Space, pieces_of, space_of

CELL_M, RADIUS_M = 0.02, 0.25
HEIGHT_M = 2.55
FLAT_M, HEAD_M = 0.05, 1.95
TOUCH_M2 = 1e-4
BEFORE_M = (0.3, 0.4, 0.5)
"""How far from a wall's face one may stand to be before its door."""


def outline(thing: Furniture) -> Polygon:
    """What a thing covers."""
    width, depth, _ = thing.size_m
    shape = rotate(box(-width / 2, -depth / 2, width / 2, depth / 2), thing.turn_rad,
                   origin=(0.0, 0.0), use_radians=True)  # fmt: skip
    return translate(shape, *thing.at_m)


def overlaps(storey: Storey) -> list[tuple[str, str]]:
    """Pairs of things whose boxes overlap, and things that stand in a wall ('wall')."""
    things = [(thing, outline(thing)) for thing in storey.furniture or ()]
    found = [
        (a.id, b.id)
        for (a, first), (b, second) in itertools.combinations(things, 2)
        if a.above_m < b.above_m + b.size_m[2] - 1e-6
        and b.above_m < a.above_m + a.size_m[2] - 1e-6
        and first.intersection(second).area > TOUCH_M2
    ]
    walls = space_of(storey, HEIGHT_M).walls
    found += [(a.id, "wall") for a, shape in things if shape.intersection(walls).area > TOUCH_M2]
    return found


def doors_shut(storey: Storey) -> list[str]:
    """Doors that can be reached in the empty storey, and cannot in the furnished one."""
    space = space_of(storey, HEIGHT_M)
    doors = [hole for hole in space.holes if hole.opening.kind != "window" and hole.reaches_floor]
    things = [
        outline(thing)
        for thing in storey.furniture or ()
        if thing.above_m < HEAD_M and thing.above_m + thing.size_m[2] > FLAT_M
    ]
    empty, full = _reached(space, doors, []), _reached(space, doors, things)
    return sorted(empty - full)


def _reached(space: Space, doors: list[Hole], things: list[Polygon]) -> set[str]:
    """The sides of doors that are in the largest connected part of the floor."""
    left, bottom, right, top = space.slab.bounds
    margin = 1.0
    origin = np.array([left - margin, bottom - margin])
    size = np.array([top - bottom, right - left]) + 2.0 * margin
    shape = (int(size[0] / CELL_M) + 1, int(size[1] / CELL_M) + 1)
    free = np.zeros(shape, dtype=np.uint8)
    _paint(free, space.slab, origin, 1)
    _paint(free, space.walls, origin, 0)
    for hole in doors:
        _paint(free, hole.outline, origin, 1)
    for thing in things:
        _paint(free, thing, origin, 0)
    away = cv2.distanceTransform(free, cv2.DIST_L2, cv2.DIST_MASK_PRECISE) * CELL_M
    count, labels = cv2.connectedComponents((away > RADIUS_M).astype(np.uint8), connectivity=4)
    if count < 2:
        return set()
    largest = 1 + int(np.bincount(labels.ravel())[1:].argmax())
    found = set()
    for hole in doors:
        for side in (1.0, -1.0):
            if any(labels[_cell(hole, side, out, origin)] == largest for out in BEFORE_M):
                found.add(f"{hole.opening.id}{'+' if side > 0 else '-'}")
    return found


def _cell(hole: Hole, side: float, out: float, origin: NDArray[np.float64]) -> tuple[int, int]:
    at = hole.middle + side * (hole.line.half_m + out) * hole.leftward
    column, row = np.floor((at - origin) / CELL_M).astype(int)
    return int(row), int(column)


def _paint(
    grid: NDArray[np.uint8], region: BaseGeometry, origin: NDArray[np.float64], value: int
) -> None:
    """Fill a region; OpenCV also fills the cells of its outline."""
    for piece in pieces_of(region):
        rings = [
            np.round((np.array(ring.coords)[:-1] - origin) / CELL_M - 0.5).astype(np.int32)
            for ring in (piece.exterior, *piece.interiors)
        ]
        cv2.fillPoly(grid, rings, value)
