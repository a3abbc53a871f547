"""Rooms that are named but open to the outdoors, closed along the lines that are drawn round them.

What the walls of a bay, a bow or a corner full of windows show of solid strokes is too short to be
followed. But lines are drawn all around the room: paper is flooded from its name up to these lines
and the walls that are known (Soille 2003, section 9.2), and where the flood comes as near to the
outdoors as a wall is thick, with no known wall between, there is a wall.
"""

from __future__ import annotations

from collections.abc import Sequence

import cv2
import numpy as np
import shapely
from numpy.typing import NDArray
from shapely.geometry import LineString, Point

from veduta.geometry.arcs import Arc, bulge_through
from veduta.plan.document import WallDrawing
from veduta.plan.openings.lines import runs
from veduta.plan.rooms.levelled import between_stubs, levelled
from veduta.plan.rooms.paper import COUNTER, MARGIN, Raster, with_strips, with_sweeps
from veduta.plan.rooms.sweeps import Sweep, doors_in, without_sweeps
from veduta.plan.walls.axes import Axis
from veduta.plan.walls.bows import look
from veduta.plan.walls.find import Found
from veduta.plan.walls.pieces import Piece

THINNEST = 0.5
"""Missing walls are at least this part as thick as the thinnest that counts: no railings."""

THICKEST = 1.6
"""Missing walls are at most so many times as thick as the thickest common one."""

NEAR_LABEL = 2.0
"""So near to a name, in (thin) wall thicknesses, most of the paper is that of its room."""

BESIDE_WALL = 0.3
"""A known wall so near to a room's outline, in thicknesses of the thickest common one, is there."""

LEAST = 3.0
"""Missing walls are so many (thin) wall thicknesses long, at least."""

STRAY = 0.15
"""They stray from lines and arcs by this part of their thickness, or by STRAY_PX."""

STRAY_PX = 1.5

HOOK = 2.5
"""They end at a known wall that is no farther than so many of their thicknesses."""

BESIDE = 3.0
"""What lies beside their line counts so many times as far."""

SHORT = 0.8
"""Shorter straight parts of an outline, in thicknesses, are no sides of a wall."""

SLIGHT_TURN = 0.15
"""The sine of a turn; where a line turns less its sides meet between their ends ..."""

FARTHEST = 2.0
"""... and where they would meet so many thicknesses away."""

AS_THICK = 0.35
"""A wall is as thick as its nearest one where both differ by less than this, or by three pixels."""

STEP_RAD = np.radians(10.0)
"""Curved walls are followed in steps that turn so much."""

LINES = 0.5
"""Furniture is parted from its room by lines of this part of the thin walls' thickness, at most."""

DEEP = 0.9
"""It is farther from the outdoors than this part of the thickest common wall's thickness."""

OUTLINE = 0.6
"""What is drawn thinner than this part of thin walls is a line, and no two faces."""

HIDDEN = 0.7
"""Less than this part of a wall lies within others."""

MOST_TURN = 0.9
"""The bulge of an arc: nearly half a circle."""

SLIGHT = 0.06
"""What bulges less is straight."""

Mask = NDArray[np.bool_]
Points = NDArray[np.float64]


def drawn_walls(
    axes: Sequence[Axis], found: Found, raster: Raster, label: Points, door_px: float
) -> list[Axis]:
    """Walls around a label (2,) px that are drawn, but not among the axes; none if it is open.

    `raster` is that of the axes. What is as thick as lines alone is no wall. The thickness is that
    of the nearest wall, so that the walls are `inferred`. Doors about `door_px` wide are in them.
    """
    thin_px, outer_px = found.thin_px, found.thickness.most_px
    room = _room(raster, label, thin_px, outer_px)
    if room is None:
        return []
    room, doors = _straight(room, found, door_px)
    # Where walls are single lines, windows in them are broader.
    thickest = max(THICKEST * outer_px, thin_px)
    walls = []
    for run in _runs(room, raster, max(2.0, BESIDE_WALL * outer_px), thickest):
        face = run.astype(np.float64) + 0.5 - MARGIN
        deep = float(np.median(raster.outdoors[run[:, 1], run[:, 0]]))
        thick, drawing = _like_the_nearest(axes, LineString(face), deep)
        middle = _middle(face, room, thick)
        if middle is None or deep < THINNEST * found.thickness.least_px:
            continue
        level = levelled(middle, axes, thick)
        limits = (THINNEST * found.thickness.least_px, thickest)
        stubs = between_stubs(level, found.solid, limits, HOOK * found.thin_px)
        if stubs is not None:
            middle, thick = stubs
            level = levelled(middle, axes, thick)
        line = _laid(level, axes, thick)
        if min(LineString(one).length for one in (middle, line)) < LEAST * thin_px:
            continue
        walls += [
            Axis(one, doors_in(one, doors), "inferred", outline=deep < OUTLINE * thin_px)
            for one in _pieces(line, thick, drawing)
        ]
    return walls


def thin_outline(
    axes: Sequence[Axis], found: Found, raster: Raster, label: Points, door_px: float
) -> list[Axis]:
    """Walls all around a label (2,) px by the thin lines there: an outline beside party walls,
    glazing, the front of a flat. None if paper leads from it to the outdoors.

    They are as thick as thin walls, on the far side of the lines, and `inferred`. What a door that
    is about `door_px` wide sweeps belongs to the room, and the door is in the wall.
    """
    room = _room(raster, label, found.thin_px, found.thickness.most_px)
    if room is None:
        return []
    straight, doors = _straight(room, found, door_px)
    whole = with_strips(with_sweeps(straight, raster, door_px), raster, found.thin_px)
    walls = []
    beside = max(2.0, BESIDE_WALL * found.thickness.most_px)
    for run in _stretches(whole, raster.walls > beside):
        face = run.astype(np.float64) + 0.5 - MARGIN
        _, drawing = _like_the_nearest(axes, LineString(face), found.thin_px)
        middle = _middle(face, whole, found.thin_px)
        if middle is None:
            continue
        line = _laid(levelled(middle, axes, found.thin_px), axes, found.thin_px)
        if LineString(line).length >= LEAST * found.thin_px:
            walls += [
                Axis(one, doors_in(one, doors), "inferred", outline=True)
                for one in _pieces(line, found.thin_px, drawing)
                if not _is_within_wall(one, raster)
            ]
    return walls


def _straight(room: Mask, found: Found, door_px: float) -> tuple[Mask, list[Sweep]]:
    """A room whose outline passes doors straight, and these in pixels of the sheet."""
    straight, sweeps = without_sweeps(room, door_px, found.thickness.most_px)
    return straight, [one.moved(-MARGIN) for one in sweeps]


def _is_within_wall(piece: Piece, raster: Raster) -> bool:
    """Whether most of a piece lies within walls that are known, where a stretch hooked onto one."""
    line = LineString(piece.arc.points(STEP_RAD))
    places = shapely.line_interpolate_point(line, np.linspace(0.0, 1.0, 41), normalized=True)
    at = np.floor(shapely.get_coordinates(places)).astype(int) + MARGIN
    at = np.clip(at, 0, np.array(raster.walls.shape[::-1]) - 1)
    return bool((raster.walls[at[:, 1], at[:, 0]] == 0).mean() > HIDDEN)


def _room(raster: Raster, label: Points, thin_px: float, outer_px: float) -> Mask | None:
    """The paper around a label with the furniture in it; None where that is outdoors."""
    x, y = (int(value) + MARGIN for value in label)
    reach = max(3, int(NEAR_LABEL * thin_px))
    near = raster.free[max(0, y - reach) : y + reach + 1, max(0, x - reach) : x + reach + 1]
    shares = np.bincount(near.ravel(), minlength=raster.count)
    shares[0] = 0
    own = int(shares.argmax()) if shares.size else 0
    if not shares.any() or own == raster.outside:
        return None
    # What lies between the lines of a wall or a window is close to the outdoors: no furniture.
    # A counter before a window reaches as near, but is broader; a balcony is no counter.
    shallow = (raster.outdoors < DEEP * outer_px) & (raster.free > 0)
    size_px = np.bincount(raster.free.ravel(), minlength=raster.count)
    depth = np.bincount(raster.free.ravel(), raster.outdoors.ravel(), raster.count)
    inside = (depth >= DEEP * outer_px * size_px) & (size_px <= COUNTER * size_px[own])
    inside[np.setdiff1d(np.arange(raster.count), raster.free[shallow])] = True
    inside[[0, raster.outside]] = False
    inside[own] = True
    size = 2 * max(1, round(LINES * thin_px / 2)) + 1
    whole = cv2.morphologyEx(
        inside[raster.free].astype(np.uint8), cv2.MORPH_CLOSE, np.ones((size, size), np.uint8)
    )
    whole[raster.walls == 0] = 0
    _, labels = cv2.connectedComponents(whole, connectivity=4)
    number = labels[raster.free == own][0]
    outline, _ = cv2.findContours(
        (labels == number).astype(np.uint8), cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_NONE
    )
    filled = np.zeros(raster.free.shape, np.uint8)
    cv2.drawContours(filled, outline, -1, 1, cv2.FILLED)
    return np.asarray(filled, dtype=np.bool_)


def _runs(
    room: Mask, raster: Raster, beside_px: float, thickest_px: float
) -> list[NDArray[np.int64]]:
    """Stretches (n, 2) of a room's outline beside which it is outdoors, and no wall is known.

    None of an outline that is so all around: nothing says how thick its walls are.
    """
    return _stretches(room, (raster.outdoors <= thickest_px) & (raster.walls > beside_px))


def _stretches(room: Mask, where: Mask) -> list[NDArray[np.int64]]:
    """Stretches (n, 2) of a room's outline that lie where it is asked for; none if all does."""
    outlines, _ = cv2.findContours(room.astype(np.uint8), cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_NONE)
    found = []
    for outline in outlines:
        points = outline[:, 0].astype(np.int64)
        open_ = where[points[:, 1], points[:, 0]]
        if open_.all() or not open_.any():
            continue
        start = int(np.flatnonzero(~open_)[0])
        points, open_ = np.roll(points, -start, axis=0), np.roll(open_, -start)
        found += [points[low:high] for low, high in zip(*runs(open_), strict=True)]
    return [run for run in found if len(run) > 3]


def _middle(face: Points, room: Mask, thick_px: float) -> Points | None:
    """The centre line beside a stretch of outline, half a thickness away from the room."""
    corners = np.asarray(LineString(face).simplify(max(STRAY_PX, STRAY * thick_px)).coords)
    # At its ends a stretch goes around the end of a known wall, and blurred ink has steps.
    long = np.hypot(*np.diff(corners, axis=0).T) >= SHORT * thick_px
    if not long.any():
        return None
    first, last = corners[:-1][long], corners[1:][long]
    run = last - first
    run /= np.maximum(np.hypot(*run.T), 1e-9)[:, None]
    right = np.column_stack([-run[:, 1], run[:, 0]])
    middles = (first + last) / 2
    beside = thick_px * right
    sides = np.stack([middles + beside, middles - beside]) + MARGIN
    right_of, left_of = look(room, sides, 0.0).sum(axis=1)
    out = (-0.5 if right_of > left_of else 0.5) * beside
    before, after = first + out, last + out
    points = [before[0]]
    for index in range(1, len(run)):
        between = (after[index - 1] + before[index]) / 2
        met = _meeting(after[index - 1], run[index - 1], before[index], run[index])
        far = met is None or np.hypot(*(met - between)) > FARTHEST * thick_px
        points.append(between if met is None or far else met)
    return np.array([*points, after[-1]])


def _meeting(one: Points, way: Points, other: Points, its_way: Points) -> Points | None:
    """Where two lines meet; None where they nearly run along each other."""
    cross = float(way[0] * its_way[1] - way[1] * its_way[0])
    apart = other - one
    if abs(cross) < SLIGHT_TURN:
        return None
    along = float(apart[0] * its_way[1] - apart[1] * its_way[0]) / cross
    return np.asarray(one + along * way)


def _like_the_nearest(
    axes: Sequence[Axis], face: LineString, deep_px: float
) -> tuple[float, WallDrawing]:
    """Thickness and drawing of the nearest wall; the thickness that is seen where they differ."""
    nearest = min(
        (axis.line for axis in axes),
        key=lambda one: face.distance(LineString(one.arc.points(STEP_RAD))),
    )
    alike = abs(nearest.thickness_px - deep_px) <= AS_THICK * nearest.thickness_px + 3.0
    return (nearest.thickness_px if alike else deep_px), nearest.drawing


def _laid(level: Points, axes: Sequence[Axis], thick_px: float) -> Points:
    """A levelled line with its ends on known walls, upright where it nearly is."""
    return levelled(_hooked(level, axes, thick_px), axes, thick_px)


def _hooked(points: Points, axes: Sequence[Axis], thick_px: float) -> Points:
    """The line with both ends on centre lines of known walls ahead of it, where these are near.

    How far they are counts from their faces: a thick wall's middle is far behind.
    """
    lines = [LineString(axis.line.arc.points(STEP_RAD)) for axis in axes]
    reach = HOOK * thick_px + np.array([axis.line.thickness_px / 2 for axis in axes])
    ends = np.array([end for axis in axes for end in (axis.line.start, axis.line.end)])
    done = points.copy()
    for end, ahead in ((0, 1), (-1, -2)):
        way = points[end] - points[ahead]
        way = way / max(float(np.hypot(*way)), 1e-9)
        foot = points[end] - 0.5 * thick_px * way
        crossings = [
            np.array([one.x, one.y])
            for line, far in zip(lines, reach, strict=True)
            for each in [LineString([foot, points[end] + far * way]).intersection(line)]
            for one in getattr(each, "geoms", [each])
            if isinstance(one, Point)
        ]
        near = np.hypot(*(ends - points[end]).T) <= np.repeat(reach, 2)
        spots = np.array([*crossings, *ends[near]])
        if len(spots) == 0:
            continue
        apart = spots - points[end]
        beside = np.abs(apart @ np.array([-way[1], way[0]]))
        cost = np.hypot(*apart.T) + BESIDE * beside
        cost[apart @ way < -thick_px] = np.inf
        if np.isfinite(cost).any():
            done[end] = spots[int(np.argmin(cost))]
    return done


def _pieces(points: Points, thick_px: float, drawing: WallDrawing) -> list[Piece]:
    """Straight pieces of a line, or one arc where it bows evenly."""
    stray = max(STRAY_PX, STRAY * thick_px)
    line = LineString(points)
    # With both ends, the middle and what lies between.
    places = shapely.get_coordinates(
        shapely.line_interpolate_point(line, np.linspace(0.0, 1.0, 41), normalized=True)
    )
    bulge = bulge_through(points[0], places[20], points[-1])
    if SLIGHT < abs(bulge) < MOST_TURN and len(points) > 4:
        across = np.abs(Arc(points[0], points[-1], bulge).place(places)[1])
        if float(across.max()) <= stray:
            return [Piece(points[0], points[-1], thick_px, drawing, bulge)]
    corners = np.asarray(line.simplify(stray).coords)
    return [
        Piece(one, two, thick_px, drawing) for one, two in zip(corners, corners[1:], strict=False)
    ]
