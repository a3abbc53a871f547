"""What a sheet shows of neighbours' walls around a flat is left out: nobody walks in there."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray
from shapely import STRtree
from shapely.geometry import LineString, Point, Polygon
from shapely.geometry.base import BaseGeometry
from shapely.ops import unary_union

from veduta.plan.document import Junction, PlanDocument, Storey, Text, Wall
from veduta.plan.flats import with_flat
from veduta.plan.names.vocabulary import meanings
from veduta.plan.options import HouseOptions
from veduta.plan.walls.graph import junction_type

BESIDE_M = 0.15
"""A room that a wall borders begins so near behind its face."""

ALONG = (0.1, 0.3, 0.5, 0.7, 0.9)
"""Places along a wall, as parts of its length, at one of which it borders a room."""

NAMED_M = 3.0
"""Walls so near a name that lies in no room may be those of a room that was not closed."""

BROKEN_M = 1.0
"""What walls enclose but for gaps so wide may be a room of the flat that was not closed."""

ON_LINE_M = 0.05
BOUNDS_M = 0.3
"""A wall bounds it that lies along it for so far, or for half its own length."""


def as_flat(document: PlanDocument, options: HouseOptions, *, drawn: bool) -> PlanDocument:
    """The document as one of a flat, where it is one, without walls of neighbours.

    drawn: it was read from a drawing. Of one that somebody wrote all walls stay.
    """
    flat = with_flat(document, options, by_text=drawn)
    if document.flat or not flat.flat or not drawn:
        return flat
    return flat.model_copy(update={"storeys": [without_neighbours(one) for one in flat.storeys]})


def without_neighbours(storey: Storey) -> Storey:
    """A storey of a flat without the walls that border none of its rooms, which is said.

    Walls inside a room, as piers and screens, border it. Curved ones, those near the name of a room
    that was not found, and those around a space that is no room stay. What bears nothing
    else goes with them: openings and junctions.
    """
    at = {one.id: np.array(one.at_m) for one in storey.junctions}
    gone = _neighbours(storey, at)
    if not gone or len(gone) == len(storey.walls):
        return storey
    walls = [one for one in storey.walls if one.id not in gone]
    lost = [one for one in storey.walls if one.id in gone]
    touched = {name for one in lost for name in (one.start, one.end)}
    ends = {name for one in walls for name in (one.start, one.end)}
    length = sum(float(np.hypot(*(at[one.end] - at[one.start]))) for one in lost)
    doubt = (
        f"{length:.1f} m of wall that border no room that was found are left out,"
        " as neighbours' walls"
    )
    return storey.model_copy(
        update={
            "walls": walls,
            "openings": [one for one in storey.openings if one.wall not in gone],
            "junctions": [
                _as_it_is(one, walls, at) if one.id in touched else one
                for one in storey.junctions
                if one.id in ends or one.id not in touched
            ],
            "doubts": [*storey.doubts, doubt],
        }
    )


def _neighbours(storey: Storey, at: Mapping[str, NDArray[np.float64]]) -> set[str]:
    """Ids of the walls that border no room."""
    rooms = [Polygon(one.outline_m) for one in storey.rooms if len(one.outline_m) >= 3]
    if not rooms:
        return set()
    named = {name for room in storey.rooms for name in room.walls}
    tree = STRtree(rooms)
    homeless = _homeless(storey, rooms)
    lines = {one.id: LineString([at[one.start], at[one.end]]) for one in storey.walls}
    spaces = _spaces(list(lines.values()), rooms)
    return {
        wall.id
        for wall in storey.walls
        if wall.id not in named
        and not wall.bulge
        and not _borders(at[wall.start], at[wall.end], wall.thickness_m, tree)
        and not any(lines[wall.id].distance(one) <= NAMED_M for one in homeless)
        and not _bounds(lines[wall.id], spaces)
    }


def _spaces(lines: Sequence[LineString], rooms: Sequence[Polygon]) -> BaseGeometry:
    """What walls enclose, with gaps, and is no room; up to the walls' centre lines."""
    around = unary_union([one.buffer(0.5 * BROKEN_M) for one in lines])
    holes = [
        Polygon(ring) for part in getattr(around, "geoms", [around]) for ring in part.interiors
    ]
    free = [hole for hole in holes if not any(room.intersects(hole) for room in rooms)]
    return unary_union([hole.buffer(0.5 * BROKEN_M + ON_LINE_M) for hole in free])


def _bounds(line: LineString, spaces: BaseGeometry) -> bool:
    return bool(line.intersection(spaces).length >= min(BOUNDS_M, 0.5 * line.length))


def _borders(
    start: NDArray[np.float64], end: NDArray[np.float64], thickness_m: float, rooms: STRtree
) -> bool:
    way = end - start
    length = float(np.hypot(*way))
    if length == 0.0:
        return True
    across = np.array([-way[1], way[0]]) / length * (0.5 * thickness_m + BESIDE_M)
    beside = [
        Point(*(start + share * way + side * across)) for share in ALONG for side in (-1.0, 1.0)
    ]
    return bool(len(rooms.query(beside, predicate="within")[0]))


def _homeless(storey: Storey, rooms: Sequence[Polygon]) -> list[Point]:
    """The places in metres of names that lie in no room."""
    places = [_place(storey, text) for text in storey.texts if meanings(text.text)]
    return [one for one in places if not any(room.contains(one) for room in rooms)]


def _place(storey: Storey, text: Text) -> Point:
    """The middle of a text, in the storey's frame. Texts are in pixels of the cleaned sheet."""
    x, y = np.mean(text.box_px, axis=0)
    left, top = storey.sheet.origin_px
    scale = storey.sheet.metres_per_px
    return Point(scale * (x - left), scale * (top - y))


def _as_it_is(
    junction: Junction, walls: Sequence[Wall], at: Mapping[str, NDArray[np.float64]]
) -> Junction:
    """A junction with the type that the walls left at it make."""
    here = at[junction.id]
    ways = [
        at[one.end if one.start == junction.id else one.start] - here
        for one in walls
        if junction.id in (one.start, one.end)
    ]
    kind = junction_type([way / max(float(np.hypot(*way)), 1e-9) for way in ways])
    return junction.model_copy(update={"type": kind})
