"""A television with seats before it. Where no wall is at the right distance, a false one is used.

AV3D, "Objects' positions": the sofa stands at a real wall that is neither too far from nor too near
to the television, else at an edge of a box within the room that is.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from shapely.geometry import LineString

from veduta.plan.furnish.arrangement import (
    OFF_WALL_M,
    Arrangement,
    Piece,
    Spot,
    Variant,
    alone,
    widths_of,
)
from veduta.plan.furnish.catalogue.entry import Entry, Size
from veduta.plan.furnish.choice import Choice
from veduta.plan.furnish.room import RoomSpace

NEAREST_M, FURTHEST_M = 2.3, 4.3
"""From the wall of the television to the back of the sofa."""
FALSE_WALLS_M = (3.2, 2.9, 3.6, 2.6)
BEHIND_M = 0.75
"""Between a false wall and a real one, to walk there."""
CORNER_M2 = 24.0
_TABLE_GAP_M = 0.35


def lounge(choice: Choice, space: RoomSpace) -> list[Variant]:
    """Television and sofa with all that goes with it; then less; then a seat alone."""
    bench = choice.entry("tv-bench")
    sofa = choice.entry("sofa")
    seats: list[tuple[Entry, Size]] = [
        (sofa, sofa.sized(width)) for width in widths_of(sofa, 1.0, 0.5, 0.0)
    ]
    if space.floor.area >= CORNER_M2 and choice.seed % 3 == 0:
        corner = choice.entry("corner-sofa")
        seats.insert(0, (corner, corner.sized()))
    chair = choice.entry("armchair")
    seats.append((chair, chair.sized()))
    found = [
        _before_screen(choice, (bench, bench.sized(width)), seat)
        for seat in seats
        for width in widths_of(bench, 1.0, 0.0)
    ]
    for entry, size in seats[-4:]:
        variant = Variant(
            size[0], _seat_alone(choice, entry, size), "far", "middle", entry.walls, entry.side_m
        )
        found.append(variant)
    return found


def _before_screen(choice: Choice, bench: tuple[Entry, Size], seat: tuple[Entry, Size]) -> Variant:
    def make(spot: Spot) -> Iterator[Arrangement]:
        for back in _backs(spot):
            yield Arrangement(tuple(_pieces(choice, bench, seat, back)))

    return Variant(bench[1][0], make, "far", "middle", bench[0].walls, 0.1)


def _backs(spot: Spot) -> list[float]:
    """Distances of the sofa's back from the wall of the television, the best first."""
    if spot.stretch is None:  # a television stands at a wall
        return []
    start = spot.at + 0.05 * spot.stretch.inward
    ray = LineString([start, start + 30.0 * spot.stretch.inward])
    met = ray.intersection(spot.space.floor.boundary)
    reach = 0.05 + LineString([start, start]).distance(met) if not met.is_empty else 30.0
    real = [reach - OFF_WALL_M] if NEAREST_M <= reach <= FURTHEST_M else []
    return real + [back for back in FALSE_WALLS_M if back + BEHIND_M <= reach]


def _pieces(
    choice: Choice, bench: tuple[Entry, Size], seat: tuple[Entry, Size], back: float
) -> list[Piece]:
    (low, low_size), (sofa, size) = bench, seat
    screen = choice.entry("tv")
    wide = min(screen.size_m[0], low_size[0] - 0.05)
    screen_size = screen.sized(wide)
    first = alone(low, low_size)
    pieces = [
        first,
        Piece(sofa, size, 0.0, -back + size[1] / 2.0, math.pi),
        Piece(screen, screen_size, 0.0, first.y + 0.02, above_m=low_size[2], on=0),
    ]
    front = -back + size[1]
    free = -(front + low_size[1] + OFF_WALL_M)
    table = choice.entry("coffee-table")
    table_size = table.sized()
    if free > _TABLE_GAP_M + table_size[1] + 0.45:
        pieces += _table_on_rug(choice, front, free, (table, table_size), size[0])
    side = choice.entry("side-table")
    side_size = side.sized()
    for sign in (-1.0, 1.0):
        x = sign * (size[0] / 2.0 + 0.06 + side_size[0] / 2.0)
        pieces.append(
            Piece(side, side_size, x, -back + side_size[1] / 2.0 + 0.02, math.pi, needed=False)
        )
    return pieces


def _table_on_rug(
    choice: Choice, front: float, free: float, table: tuple[Entry, Size], sofa_m: float
) -> list[Piece]:
    """A low table before the sofa, a rug below it, and armchairs beside it."""
    rug, chair = choice.entry("rug"), choice.entry("armchair")
    entry, size = table
    y = front + _TABLE_GAP_M + size[1] / 2.0
    deep = min(2.0 * (_TABLE_GAP_M + size[1] / 2.0 - 0.08), free - 0.3)
    wide = max(size[0] + 0.5, min(sofa_m, 2.2))
    rug_size = rug.sized(wide, deep)
    fits = rug_size[1] <= free - 0.1 and rug_size[1] >= size[1] + 0.1
    found = []
    if fits:
        # The rug is the fourth piece of the arrangement, after bench, sofa and screen.
        found.append(Piece(rug, rug_size, 0.0, y, needed=False))
        found.append(Piece(entry, size, 0.0, y, above_m=rug_size[2], needed=False, on=3))
    else:
        found.append(Piece(entry, size, 0.0, y, needed=False))
    beside = (rug_size[0] if fits else size[0]) / 2.0 + 0.08
    width, depth, _ = chair.sized()
    for sign in (1.0, -1.0):
        x = sign * (beside + depth / 2.0)
        at = max(y, front + width / 2.0 + 0.05)
        found.append(Piece(chair, chair.sized(), x, at, -sign * math.pi / 2.0, needed=False))
    return found


def _seat_alone(choice: Choice, entry: Entry, size: Size):  # type: ignore[no-untyped-def]
    table = choice.entry("coffee-table")
    own = table.sized()
    pieces = (
        alone(entry, size),
        Piece(table, own, 0.0, -size[1] - OFF_WALL_M - _TABLE_GAP_M - own[1] / 2.0, needed=False),
    )
    return lambda _: [Arrangement(pieces)]
