"""Tables with chairs around them, indoors and outdoors, and desks."""

from __future__ import annotations

import math

from veduta.plan.furnish.arrangement import (
    OFF_WALL_M,
    Arrangement,
    Piece,
    Variant,
    alone,
    widths_of,
)
from veduta.plan.furnish.catalogue.entry import Entry, Size
from veduta.plan.furnish.choice import Choice
from veduta.plan.furnish.room import RoomSpace

GAP_M = 0.03
"""Between a table and its chairs, which stand a little off it."""
SEAT_M = 0.6
"""The length of a table's side that a person has."""
ROUND_SHARE = 3
LARGE_M2, MIDDLE_M2 = 16.0, 10.0


def dining(choice: Choice, space: RoomSpace) -> list[Variant]:
    """A table in the room with chairs, as large as the room allows; else one at a wall."""
    chair, area = choice.entry("chair"), space.floor.area
    found: list[Variant] = []
    table = choice.entry("dining-table")
    if choice.seed % ROUND_SHARE == 0 and area < LARGE_M2:
        found.append(_round(choice.entry("round-table"), chair))
    sizes = [(1.9, 0.9, True)] if area >= LARGE_M2 else []
    sizes += [(1.6, 0.9, False)] if area >= MIDDLE_M2 else []
    sizes += [(1.25, 0.8, False), (0.8, 0.75, False)]
    found += [
        _around(table, table.sized(width, depth), chair, ends=ends) for width, depth, ends in sizes
    ]
    found.append(_round(choice.entry("round-table"), chair, least=True))
    found += [_at_wall(table, table.sized(width, 0.7), chair) for width in (1.2, 0.8)]
    return found


def garden_seats(choice: Choice, space: RoomSpace) -> list[Variant]:
    """A garden table with chairs; on a narrow balcony at its wall."""
    table, chair = choice.entry("garden-table"), choice.entry("garden-chair")
    found = []
    if space.floor.area > 9.0:
        found.append(_around(table, table.sized(1.4, 0.8), chair, ends=False))
    found.append(_around(table, table.sized(0.7, 0.7), chair, ends=False))
    found.append(_pair(table, table.sized(0.6, 0.6), chair))
    found.append(Variant(chair.size_m[0], lambda _: [Arrangement((alone(chair, chair.sized()),))]))
    return found


def desk(choice: Choice, space: RoomSpace) -> list[Variant]:
    """A desk at a wall with its chair."""
    entry, chair = choice.entry("desk"), choice.entry("office-chair")
    found = []
    for width in widths_of(entry, 1.0, 0.5, 0.0):
        size, seat = entry.sized(width), chair.sized()
        y = -OFF_WALL_M - size[1] - GAP_M - seat[1] / 2.0
        pieces = (alone(entry, size), Piece(chair, seat, 0.0, y, math.pi))
        made = Arrangement(pieces)
        found.append(
            Variant(size[0], lambda _, made=made: [made], "any", "window", entry.walls)  # type: ignore[misc]
        )
    return found


def _around(table: Entry, size: Size, chair: Entry, *, ends: bool) -> Variant:
    """Chairs along both long sides, and at the ends if asked."""
    seat = chair.sized()
    count = max(1, int((size[0] - 0.05) / SEAT_M))
    pieces = [Piece(table, size, 0.0, 0.0)]
    out = size[1] / 2.0 + GAP_M + seat[1] / 2.0
    for side, turn in ((1.0, 0.0), (-1.0, math.pi)):
        for k in range(count):
            x = (k - (count - 1) / 2.0) * size[0] / count
            pieces.append(Piece(chair, seat, x, side * out, turn, needed=k == 0))
    if ends:
        out = size[0] / 2.0 + GAP_M + seat[1] / 2.0
        for side in (1.0, -1.0):
            pieces.append(Piece(chair, seat, side * out, 0.0, -side * math.pi / 2.0, needed=False))
    made = Arrangement(tuple(pieces))
    return Variant(size[0], lambda _: [made], free=True)


def _round(table: Entry, chair: Entry, *, least: bool = False) -> Variant:
    side = table.widths_m[0] if least else table.size_m[0]
    size, seat = table.sized(side, side), chair.sized()
    out = side / 2.0 + GAP_M + seat[1] / 2.0
    pieces = [Piece(table, size, 0.0, 0.0)]
    for k in range(4):
        angle = k * math.pi / 2.0
        pieces.append(
            Piece(
                chair,
                seat,
                -math.sin(angle) * out,
                math.cos(angle) * out,
                angle,
                needed=k % 2 == 0 or not least,
            )
        )
    made = Arrangement(tuple(pieces))
    return Variant(side, lambda _: [made], free=True)


def _at_wall(table: Entry, size: Size, chair: Entry) -> Variant:
    """The table's long side at a wall: chairs before it and at its ends."""
    seat = chair.sized()
    count = max(1, int((size[0] - 0.05) / SEAT_M))
    pieces = [alone(table, size)]
    y = -OFF_WALL_M - size[1] - GAP_M - seat[1] / 2.0
    for k in range(count):
        x = (k - (count - 1) / 2.0) * size[0] / count
        pieces.append(Piece(chair, seat, x, y, math.pi, needed=k == 0))
    out = size[0] / 2.0 + GAP_M + seat[1] / 2.0
    for side in (1.0, -1.0):
        pieces.append(
            Piece(chair, seat, side * out, pieces[0].y, -side * math.pi / 2.0, needed=False)
        )
    made = Arrangement(tuple(pieces))
    return Variant(size[0], lambda _: [made], "any", "window")


def _pair(table: Entry, size: Size, chair: Entry) -> Variant:
    """A small table at the wall between two chairs."""
    seat = chair.sized()
    out = size[0] / 2.0 + GAP_M + seat[0] / 2.0
    pieces = [alone(table, size)]
    for side in (1.0, -1.0):
        pieces.append(Piece(chair, seat, side * out, -OFF_WALL_M - seat[1] / 2.0, needed=side > 0))
    made = Arrangement(tuple(pieces))
    return Variant(size[0], lambda _: [made], "far", "middle")
