"""Sequences side by side along a wall: basin, bidet and toilet; the units of a kitchen; coats.

AV3D, "Objects' positions": priority has the wall on which the whole sequence fits, its lengths and
the spacing between its objects added; the sink is nearest to the door.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from veduta.plan.furnish.arrangement import Arrangement, Piece, Spot, Variant, alone
from veduta.plan.furnish.catalogue.entry import Entry, Size
from veduta.plan.furnish.choice import Choice
from veduta.plan.furnish.room import RoomSpace

BIDET_M2, DOUBLE_M2 = 5.5, 8.0
KITCHENS: tuple[tuple[str, ...], ...] = (
    ("fridge", "kitchen-unit", "kitchen-drawers", "kitchen-sink", "dishwasher", "kitchen-unit",
     "kitchen-hob", "kitchen-unit"),
    ("fridge", "kitchen-unit", "kitchen-sink", "dishwasher", "kitchen-drawers", "kitchen-hob",
     "kitchen-unit"),
    ("fridge", "kitchen-unit", "kitchen-sink", "dishwasher", "kitchen-hob", "kitchen-unit"),
    ("fridge", "kitchen-sink", "kitchen-unit", "kitchen-hob", "kitchen-unit"),
    ("fridge", "kitchen-sink", "kitchen-unit", "kitchen-hob"),
    ("kitchen-unit", "kitchen-sink", "kitchen-unit", "kitchen-hob"),
    ("kitchen-sink", "kitchen-unit", "kitchen-hob"),
    ("kitchen-sink", "kitchen-hob"),
)  # fmt: skip
"""The units of a kitchen's main wall, the longest row first."""
_OVER = {"kitchen-hob": "hood"}
_NARROW = {"kitchen-unit": 0.4, "kitchen-sink": 0.6}


def wash_row(choice: Choice, space: RoomSpace) -> list[Variant]:
    """Basin, bidet and toilet side by side, the basin nearest to the door; then without bidet."""
    area, seed = space.floor.area, choice.seed
    rows: list[tuple[str, ...]] = []
    if area >= DOUBLE_M2 and space.room.use == "bathroom":
        rows.append(("basin-double", "bidet", "toilet"))
    if area >= BIDET_M2 and seed % 2 == 0:
        rows.append(("basin", "bidet", "toilet"))
    if space.room.use == "bathroom" or area > 2.2:
        rows.append(("basin", "toilet"))
    return [_row(choice, [(choice.entry(kind), None) for kind in row], "near") for row in rows]


def kitchen_run(choice: Choice, space: RoomSpace) -> list[Variant]:
    """The longest row of units that a wall has space for, cupboards and a hood above."""
    found = []
    for kinds in KITCHENS:
        entries = [(choice.entry(kind), None) for kind in kinds]
        found.append(_row(choice, entries, "any", over=True))
        if len(kinds) <= 5:
            narrow = [(choice.entry(kind), _NARROW.get(kind)) for kind in kinds]
            found.append(_row(choice, narrow, "any", over=True))
    return found


def coats(choice: Choice, space: RoomSpace) -> list[Variant]:
    """Coats on the wall near the door, a bench or a cupboard for shoes below."""
    rack = choice.entry("coat-rack")
    below = choice.entry("bench" if choice.seed % 2 else "shoe-cabinet")
    found = []
    for width in (rack.size_m[0], 0.6):
        pieces = [alone(rack, rack.sized(width))]
        if below.size_m[2] <= rack.above_m:
            pieces.append(alone(below, below.sized(width), needed=False))
        made = Arrangement(tuple(pieces))
        found.append(Variant(width, lambda _, made=made: [made], "near", "middle"))  # type: ignore[misc]
    shoes = choice.entry("shoe-cabinet")
    found.append(
        Variant(0.6, lambda _: [Arrangement((alone(shoes, shoes.sized(0.6)),))], "near", "middle")
    )
    return found


def _row(
    choice: Choice, entries: Sequence[tuple[Entry, float | None]], order: str, *, over: bool = False
) -> Variant:
    sizes = [entry.sized(width) for entry, width in entries]
    gaps = [
        0.0 if over else max(first.side_m, second.side_m)
        for (first, _), (second, _) in zip(entries, entries[1:], strict=False)
    ]
    total = sum(size[0] for size in sizes) + sum(gaps)

    def make(spot: Spot) -> list[Arrangement]:
        way = spot.space.door_way - spot.at
        towards = np.cos(spot.turn) * way[0] + np.sin(spot.turn) * way[1]
        signs = (1.0, -1.0) if towards >= 0.0 else (-1.0, 1.0)
        made = [
            Arrangement(tuple(_side_by_side(choice, entries, sizes, gaps, total, sign, over)))
            for sign in signs
        ]
        return made if over else made[:1]

    outer = entries[0][0].walls & entries[-1][0].walls
    side = 0.01 if over else max(entries[0][0].side_m, entries[-1][0].side_m)
    return Variant(total, make, order, "ends", outer, side)  # type: ignore[arg-type]


def _side_by_side(
    choice: Choice, entries: Sequence[tuple[Entry, float | None]], sizes: Sequence[Size],
    gaps: Sequence[float], total: float, sign: float, over: bool,
) -> list[Piece]:  # fmt: skip
    """The row from its first to its last; sign: whether it begins at the right or at the left."""
    at, pieces, above = total / 2.0, [], []
    for (entry, _), size, gap in zip(entries, sizes, [*gaps, 0.0], strict=True):
        x = sign * (at - size[0] / 2.0)
        pieces.append(alone(entry, size, x=x))
        if entry.type.startswith("basin"):
            mirror = choice.entry("mirror")
            own = mirror.sized(min(size[0], 1.1))
            above.append(alone(mirror, own, needed=False, x=x))
        if over and size[2] < 1.3:
            upper = choice.entry(_OVER.get(entry.type, "kitchen-wall"))
            above.append(alone(upper, upper.sized(size[0]), needed=False, x=x))
        at -= size[0] + gap
    return [*pieces, *above]
