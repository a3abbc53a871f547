"""Rooms follow their walls: who moves a junction in `plan.json` moves the rooms that hang on it.

The outline of a room is written in the document beside the walls that bound it. Where the two no
longer agree, the walls count, since a house is built of them; a space that several rooms share, and
a room that walls do not close, keep what is written.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from shapely.geometry import Polygon

from veduta.plan.document import PlanDocument, Point, Room, Storey
from veduta.plan.house.lines import footprint, wall_lines
from veduta.plan.house.space import filled, pieces_of, room_polygon


@dataclass(frozen=True)
class Following:
    """When an outline no longer fits its walls.

    apart_m2, apart: what lies in one of both alone, at least, and as a part of the room: outlines
    that were just found differ by less from their walls. shared: a room with so much of itself in
    a space has a part in it. own: a space that is a room's has so much of it, or it of the space.
    least_m2: smaller spaces are none. slit_m: walls that come so near to each other meet, where a
    junction was moved without all that it touched.
    """

    apart_m2: float = 0.15
    apart: float = 0.03
    shared: float = 0.2
    own: float = 0.6
    least_m2: float = 0.1
    slit_m: float = 0.12


FOLLOWING = Following()


def with_rooms_on_walls(
    document: PlanDocument, rule: Following = FOLLOWING
) -> tuple[PlanDocument, list[str]]:
    """The document with outlines and areas by its walls, and what was changed."""
    storeys, notes = [], []
    for storey in document.storeys:
        spaces = _spaces(storey, rule)
        rooms = [_followed(room, storey.rooms, spaces, rule) for room in storey.rooms]
        for old, new in zip(storey.rooms, rooms, strict=True):
            if new is not old:
                called = f"{old.name} ({old.id})" if old.name else old.id
                notes.append(
                    f"{called} of {storey.name} follows its walls: {old.area_m2:.1f} m² became"
                    f" {new.area_m2:.1f} m²"
                )
        storeys.append(storey.model_copy(update={"rooms": rooms}))
    return (document.model_copy(update={"storeys": storeys}) if notes else document), notes


def _spaces(storey: Storey, rule: Following) -> list[Polygon]:
    """What walls close; and what they do but for slits between them."""
    walls = footprint(wall_lines(storey).values())
    half = rule.slit_m / 2.0
    shut = walls.buffer(half, join_style="mitre")
    cores = pieces_of(filled(shut).difference(shut))
    closed = pieces_of(filled(walls).difference(walls))
    spaces = [
        piece
        for core in cores
        for piece in pieces_of(core.buffer(half, join_style="mitre").difference(walls))
    ]
    return [piece for piece in [*closed, *spaces] if piece.area >= rule.least_m2]


def _followed(
    room: Room, rooms: Sequence[Room], spaces: Sequence[Polygon], rule: Following
) -> Room:
    shape = room_polygon(room)
    space = min(spaces, key=lambda one: one.symmetric_difference(shape).area, default=None)
    if space is None or shape.is_empty:
        return room
    common = space.intersection(shape).area
    if common < rule.own * min(space.area, shape.area):
        return room
    others = (room_polygon(one) for one in rooms if one is not room)
    if any(one.intersection(space).area >= rule.shared * one.area for one in others):
        return room
    apart = space.symmetric_difference(shape).area
    if apart < max(rule.apart_m2, rule.apart * shape.area):
        return room
    return room.model_copy(
        update={
            "outline_m": _ring(space.exterior.coords),
            "holes_m": [_ring(hole.coords) for hole in space.interiors],
            "area_m2": round(space.area, 3),
        }
    )


def _ring(coords: Iterable[tuple[float, ...]]) -> list[Point]:
    """The points of a closed ring, the first one once."""
    return [(round(x, 5), round(y, 5)) for x, y in list(coords)[:-1]]
