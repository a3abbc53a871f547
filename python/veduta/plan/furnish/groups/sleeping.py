"""Beds with what stands beside them."""

from __future__ import annotations

from veduta.plan.furnish.arrangement import (
    OFF_WALL_M,
    Arrangement,
    Piece,
    Prefer,
    Spot,
    Variant,
    alone,
    widths_of,
)
from veduta.plan.furnish.choice import Choice
from veduta.plan.furnish.room import RoomSpace

DOUBLE_M2 = 10.0
_SIDE_M, _NARROW_M = 0.55, 0.4
_HEAD_M = 0.55
"""Beside this much of a bed one need not walk."""


def sleeping(choice: Choice, space: RoomSpace) -> list[Variant]:
    """A double bed in rooms that are large enough, else a single one."""
    found: list[Variant] = []
    if space.floor.area >= DOUBLE_M2:
        entry = choice.entry("bed-double")
        found += [
            _bed(choice, "bed-double", width, sides, needed)
            for needed in (True, False)
            for sides in ((-1, 1), (-1,), (1,))
            for width in widths_of(entry, 1.0, 0.5, 0.0)
            if needed or len(sides) == 1
        ]
    entry = choice.entry("bed-single")
    found += [
        _bed(choice, "bed-single", width, (side,), needed)
        for needed in (True, False)
        for width in widths_of(entry, 1.0, 0.4)
        for side in (-1, 1)
    ]
    # Rooms as narrow as a corridor: a bed for a mattress of 70 cm, and one that is shorter, too.
    found += [
        _bed(choice, "bed-single", entry.widths_m[0], (side,), False, depth)
        for depth in (None, entry.depths_m[0])
        for side in (-1, 1)
    ]
    return found


def _bed(
    choice: Choice, kind: str, width: float, sides: tuple[int, ...], needed: bool,
    depth: float | None = None,
) -> Variant:  # fmt: skip
    """A bed with nightstands at its free sides, if there is space for them or they are needed."""
    entry, stand = choice.entry(kind), choice.entry("nightstand")
    size, beside = entry.sized(width, depth), stand.sized()
    x = size[0] / 2.0
    pieces = [alone(entry, size)]
    zones = []
    for side in sides:
        wide = _SIDE_M if needed else _NARROW_M
        span = (x, x + wide) if side > 0 else (-x - wide, -x)
        zones.append((span, (-size[1] - OFF_WALL_M, -_HEAD_M)))
        pieces.append(
            Piece(
                stand, beside, side * (x + 0.03 + beside[0] / 2.0),
                -OFF_WALL_M - beside[1] / 2.0, needed=needed,
            )
        )  # fmt: skip
    made = Arrangement(tuple(pieces), tuple(zones))

    def make(_: Spot) -> list[Arrangement]:
        return [made]

    prefer: Prefer = "middle" if len(sides) == 2 else "ends"
    # The stands reach beyond the bed: spots are those of the bed alone, and all is checked there.
    return Variant(size[0], make, "far", prefer, entry.walls, entry.side_m)
