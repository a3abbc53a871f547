"""Lamps at a ceiling: rows along one of the room's walls.

AV3D (Placement of Light Sources): the room is turned by the angle of each of its walls; rows lie as
far apart as a lamp's diameter of illumination allows, and lamps stand in them at equal distances.
There, the rows of all angles are laid over each other, and a lamp is left out where another is
nearer than its radius. Here each angle is tried by itself, what it leaves dark gets lamps of its
own, and the angle that needs the fewest lamps is taken. Where no rows light all by themselves and
places by sight alone need fewer lamps, these are taken.
"""

from __future__ import annotations

import math

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely.affinity import rotate
from shapely.geometry import LineString, Polygon

from veduta.plan.lights.sight import GRID_M, Field, filled_up

_ALIKE_RAD = math.radians(2.0)
_SHORTEST_WALL_M = 0.3
"""A shorter one does not turn the rows."""
_SHORTEST_ROW_M = 0.4
"""In a shorter piece of a row there is no lamp: the rest of the room lights it, or it is filled."""
_MOST_ANGLES = 8
"""A curved wall has many; the longest pieces are tried."""
_FROM_WALL_M = 0.35
_MOST_SITES = 300
_CLOSER = 0.9
_OBLONG = 1.5
_ROUNDS = 40


def ceiling_lamps(region: Polygon, reach_m: float, least: int = 1) -> NDArray[np.float64]:
    """(k, 2) where lamps hang, so that each point of the room is lit by one of them.

    region: the room's floor (m). reach_m: the radius of illumination. least: how many it takes for
    the room to be bright enough; rows come closer until they have as many.
    """
    field = Field(region)
    sites = _sites(region)
    rows = [_rows(region, angle, reach_m, least) for angle in wall_angles(region)]
    found = [filled_up(field, lamps, sites, reach_m) for lamps in rows]
    fewest = min(len(lamps) for lamps in found)
    if all(len(lamps) != fewest for lamps in rows):  # a niche has cost a lamp
        # Most of it is found with a quarter of the points, and what that leaves dark with all.
        coarse = filled_up(Field(region, 2.0 * GRID_M), np.zeros((0, 2)), sites, reach_m)
        covered = filled_up(field, coarse, sites, reach_m)
        found += [covered] if least <= len(covered) < fewest else []
    return min(found, key=lambda lamps: (len(lamps), _unevenness(field, lamps)))


def wall_angles(region: Polygon) -> list[float]:
    """The directions of a room's walls, modulo a quarter turn, the longest first (rad)."""
    length: dict[float, float] = {}
    for ring in (region.exterior, *region.interiors):
        corners = np.array(ring.coords)
        for way in np.diff(corners, axis=0):
            size = float(np.hypot(*way))
            if size < _SHORTEST_WALL_M:
                continue
            angle = math.atan2(way[1], way[0]) % (math.pi / 2.0)
            known = [one for one in length if _apart(one, angle) < _ALIKE_RAD]
            kept = known[0] if known else angle
            length[kept] = length.get(kept, 0.0) + size
    ordered = sorted(length, key=lambda angle: (-length[angle], angle))[:_MOST_ANGLES]
    # Rows along a wall and across it.
    return [turn for angle in ordered or [0.0] for turn in (angle, angle + math.pi / 2.0)]


def _apart(first: float, second: float) -> float:
    """Between two directions modulo a quarter turn."""
    away = abs(first - second) % (math.pi / 2.0)
    return min(away, math.pi / 2.0 - away)


def _rows(region: Polygon, angle: float, reach_m: float, least: int) -> NDArray[np.float64]:
    """(k, 2) lamps in rows of one direction, as many as are asked for where there is room."""
    about = (0.0, 0.0)
    turned = rotate(region, -angle, origin=about, use_radians=True)
    depth = turned.bounds[3] - turned.bounds[1]
    # AV3D: rows as far apart as the diameter of illumination at most.
    rows = max(1, math.ceil(depth / (2.0 * reach_m) - 1e-9))
    along = 2.0 * reach_m
    lamps = _turned_rows(turned, rows, along)
    for _ in range(_ROUNDS):
        if len(lamps) >= least:
            break
        # Brighter: another row where rows are further apart than the lamps in them.
        if depth / rows > _OBLONG * along:
            rows += 1
        else:
            along *= _CLOSER
        lamps = _turned_rows(turned, rows, along)
    cos, sin = math.cos(angle), math.sin(angle)
    turned_back = lamps @ np.array([[cos, sin], [-sin, cos]])
    return _thinned(Field(region), turned_back, min(along, depth / rows) / 2.0)


def _turned_rows(region: Polygon, rows: int, along_m: float) -> NDArray[np.float64]:
    """(k, 2) lamps in level rows, in each at most so far apart: AV3D's calculations."""
    left, bottom, right, top = region.bounds
    spacing = (top - bottom) / rows
    lamps = []
    for row in range(rows):
        y = bottom + spacing * (row + 0.5)
        line = LineString([(left - 1.0, y), (right + 1.0, y)])
        for start, end in _segments(line.intersection(region)):
            count = max(1, math.ceil((end - start) / along_m - 1e-9))
            along = start + (end - start) * (np.arange(count) + 0.5) / count
            lamps += [(x, y) for x in along]
    return np.array(lamps, dtype=np.float64).reshape(-1, 2)


def _segments(cut: shapely.Geometry) -> list[tuple[float, float]]:
    """From where to where a level line lies in the room."""
    pieces = [piece for piece in getattr(cut, "geoms", [cut]) if isinstance(piece, LineString)]
    ends = sorted((float(piece.bounds[0]), float(piece.bounds[2])) for piece in pieces)
    return [(start, end) for start, end in ends if end - start >= _SHORTEST_ROW_M]


def _thinned(field: Field, lamps: NDArray[np.float64], reach_m: float) -> NDArray[np.float64]:
    """Without those that another one before them is near to, and sees."""
    kept: list[NDArray[np.float64]] = []
    for lamp in lamps:
        near = np.array([one for one in kept if np.hypot(*(one - lamp)) < reach_m - 1e-9])
        if not len(near) or not field.sees(lamp, near).any():
            kept.append(lamp)
    return np.array(kept).reshape(-1, 2)


def _sites(region: Polygon) -> NDArray[np.float64]:
    """(m, 2) where further lamps may hang: away from the walls where there is room."""
    for away in (_FROM_WALL_M, 0.1, 0.02):
        inner = region.buffer(-away, join_style="mitre")
        if not inner.is_empty:
            break
    points = Field(region).points
    step = -(-len(points) // _MOST_SITES)
    inside = points[shapely.covers(inner, shapely.points(points))][::step]
    middle = np.array(inner.representative_point().coords)
    return np.concatenate([inside, middle])


def _unevenness(field: Field, lamps: NDArray[np.float64]) -> float:
    """Mean distance to the nearest lamp (m)."""
    away = np.linalg.norm(field.points[:, None] - lamps[None], axis=2).min(axis=1)
    return round(float(away.mean()), 6)
