"""What a sheet shows of neighbours' walls around a flat is left out: nobody walks in there."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray
from shapely import STRtree
from shapely.geometry import LineString, Point, Polygon

from veduta.plan.document import Junction, JunctionType, PlanDocument, Storey, Text, Wall
from veduta.plan.names.vocabulary import meanings

BESIDE_M = 0.15
"""A room that a wall borders begins so near behind its face."""

ALONG = (0.1, 0.3, 0.5, 0.7, 0.9)
"""Places along a wall, as parts of its length, at one of which it borders a room."""

NAMED_M = 3.0
"""Walls so near a name that lies in no room may be those of a room that was not closed."""

STRAIGHT = 0.996
"""Two walls are straight on from this cosine of their bend on (5 degrees)."""


def left_alone(document: PlanDocument, before: PlanDocument) -> PlanDocument:
    """A document that has become a flat without walls of neighbours; others as they are."""
    if before.flat or not document.flat:
        return document
    storeys = [without_neighbours(one) for one in document.storeys]
    return document.model_copy(update={"storeys": storeys})


def without_neighbours(storey: Storey) -> Storey:
    """A storey of a flat without the walls that border none of its rooms, which is said.

    Walls inside a room, as piers and screens, border it. Curved ones, and those near the name of a
    room that was not found, stay. What bears nothing else goes with them: openings and junctions.
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
        f"{length:.1f} m of wall that border no room of the flat are left out, as neighbours' walls"
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
    return {
        wall.id
        for wall in storey.walls
        if wall.id not in named
        and not wall.bulge
        and not _borders(at[wall.start], at[wall.end], wall.thickness_m, tree)
        and not any(
            LineString([at[wall.start], at[wall.end]]).distance(one) <= NAMED_M for one in homeless
        )
    }


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
    unit = [way / max(float(np.hypot(*way)), 1e-9) for way in ways]
    kind: JunctionType = "end"
    if len(unit) == 2:
        kind = "straight" if float(-(unit[0] @ unit[1])) >= STRAIGHT else "L"
    elif len(unit) > 2:
        kind = "T" if len(unit) == 3 else "X"
    return junction.model_copy(update={"type": kind})
