"""Cells become walls between junctions, and rooms between walls."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from shapely import contains_xy, unary_union
from shapely.geometry import LineString, Polygon
from shapely.geometry.base import BaseGeometry
from shapely.geometry.polygon import orient

from veduta.synthetic.plans import curves
from veduta.synthetic.plans.bodies import whole_walls
from veduta.synthetic.plans.dissect import Cell
from veduta.synthetic.plans.house import Point, Room, Use, Wall

GRID_M = 1e-3


@dataclass(frozen=True)
class Thickness:
    """Of the walls of a house, in metres."""

    outer_m: float
    inner_m: float


def cell_area(cell: Cell) -> Polygon:
    """The cell with its arcs as fine polylines."""
    points: list[np.ndarray] = []
    count = len(cell.corners)
    for index in range(count):
        start, end = cell.corners[index], cell.corners[(index + 1) % count]
        wall = Wall("", start, end, cell.bulges[index], 0.0, None, None)
        points.append(curves.line(wall)[:-1])
    return Polygon(np.vstack(points))


def walls_of(cells: Sequence[Cell], ids: Sequence[str], thickness: Thickness) -> tuple[Wall, ...]:
    """The walls between the cells, each with one room (or outdoors) on each side."""
    straight: list[LineString] = []
    arcs: dict[frozenset[Point], tuple[Point, Point, float]] = {}
    for cell in cells:
        count = len(cell.corners)
        for index in range(count):
            start, end = cell.corners[index], cell.corners[(index + 1) % count]
            if cell.bulges[index]:
                arcs.setdefault(frozenset((start, end)), (start, end, cell.bulges[index]))
            else:
                straight.append(LineString([start, end]))
    pieces = [(*piece, 0.0) for piece in _noded(straight)]
    areas = [cell_area(cell) for cell in cells]
    walls = []
    for number, (start, end, bulge) in enumerate([*pieces, *arcs.values()]):
        left, right = _sides(start, end, bulge, areas, ids)
        thick = thickness.outer_m if left is None or right is None else thickness.inner_m
        walls.append(Wall(f"w{number}", start, end, bulge, thick, left, right))
    return tuple(walls)


def _noded(lines: Sequence[LineString]) -> list[tuple[Point, Point]]:
    """Straight pieces between junctions: parted where lines meet, each once."""
    union = unary_union(lines, grid_size=GRID_M)
    parts = union.geoms if hasattr(union, "geoms") else [union]
    pieces = {
        tuple(sorted(((round(a[0], 3), round(a[1], 3)), (round(b[0], 3), round(b[1], 3)))))
        for part in parts
        for a, b in pairwise(part.coords)
    }
    return sorted((first, second) for first, second in pieces)


def _sides(
    start: Point, end: Point, bulge: float, areas: Sequence[Polygon], ids: Sequence[str]
) -> tuple[str | None, str | None]:
    middle = np.array([0.5])
    found: list[str | None] = []
    for offset in (0.01, -0.01):
        x, y = curves.at(start, end, bulge, middle, offset)[0]
        inside = np.flatnonzero(contains_xy(np.array(areas, object), x, y))
        found.append(ids[int(inside[0])] if inside.size else None)
    return found[0], found[1]


def room_areas(cells: Sequence[Cell], walls: tuple[Wall, ...]) -> list[Polygon]:
    """What is left of each cell between its walls, counter-clockwise."""
    bodies: BaseGeometry = whole_walls(walls)
    rooms = []
    for cell in cells:
        free = cell_area(cell).difference(bodies)
        every = [free] if isinstance(free, Polygon) else list(getattr(free, "geoms", []))
        parts = [part for part in every if isinstance(part, Polygon)]
        largest = max(parts, key=lambda part: part.area)
        smooth = LineString(largest.exterior.coords).simplify(1e-4)
        rooms.append(orient(Polygon(smooth.coords)))
    return rooms


def room_of(name: str, use: Use, area: Polygon) -> Room:
    """The room of an area that lies between walls."""
    ring = tuple((round(x, 4), round(y, 4)) for x, y in area.exterior.coords[:-1])
    return Room(name, use, ring, round(area.area, 4))


def is_sound(cells: Sequence[Cell]) -> bool:
    """Whether the cells are proper polygons that do not overlap and leave no slivers."""
    areas = [cell_area(cell) for cell in cells]
    if not all(area.is_valid and area.area > 0.9 for area in areas):
        return False
    whole = unary_union(areas)
    total = sum(area.area for area in areas)
    return isinstance(whole, Polygon) and math.isclose(whole.area, total, rel_tol=1e-3)
