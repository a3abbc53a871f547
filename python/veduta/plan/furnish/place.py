"""Putting arrangements into a room: the first variant that fits at its best spot.

AV3D, "Objects' positions": what does not fit is tried elsewhere, gives way to something smaller,
or is left out; where something critical does not fit, what came before it gives way.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from veduta.plan.furnish.arrangement import Arrangement, Spot, Variant
from veduta.plan.furnish.layout import Layout, Stood
from veduta.plan.furnish.spots import spots_of

LOOK_AT = 4
"""So many spots that fit are compared by how much of the arrangement fits there."""


def place_first(
    variants: Sequence[Variant], layout: Layout, rng: np.random.Generator, group: int
) -> bool:
    """Place the first variant that fits; whether one did."""
    return any(place(variant, layout, rng, group) for variant in variants)


def place(variant: Variant, layout: Layout, rng: np.random.Generator, group: int) -> bool:
    """Place a variant where most of it fits, among its best spots; whether it fits at all."""
    best: tuple[int, list[Stood], list] | None = None  # type: ignore[type-arg]
    fitting = 0
    for spot in spots_of(variant, layout, rng):
        for arrangement in variant.make(spot):
            found = _try(arrangement, spot, layout, group)
            if found is None:
                continue
            things, zones = found
            fitting += 1
            if best is None or len(things) > best[0]:
                best = (len(things), things, zones)
            whole = len(things) == len(arrangement.pieces)
            if whole or fitting >= LOOK_AT:
                layout.add(best[1], best[2])
                return True
            break
    if best is not None:
        layout.add(best[1], best[2])
    return best is not None


def _try(
    arrangement: Arrangement, spot: Spot, layout: Layout, group: int
) -> tuple[list[Stood], list] | None:  # type: ignore[type-arg]
    """What of an arrangement fits at a spot; None where it does not stand there."""
    placed: dict[int, Stood] = {}
    order = sorted(range(len(arrangement.pieces)), key=lambda k: not arrangement.pieces[k].needed)
    zones = [(spot.zone(x, y), group) for x, y in arrangement.zones]
    walked = False
    for number in order:
        piece = arrangement.pieces[number]
        if not piece.needed and not walked:
            # All that is needed stands: can one still walk?
            if not _is_sound(list(placed.values()), zones, layout):
                return None
            walked = True
        if piece.on is not None and piece.on not in placed:
            continue
        on = None if piece.on is None else placed[piece.on]
        thing = spot.place(piece, group, on)
        others = list(placed.values())
        allowed = layout.allows(thing, others)
        if allowed and not piece.needed and thing.is_in_the_way and not thing.is_upon:
            allowed = layout.can_walk([*others, thing])
        if allowed:
            placed[number] = thing
        elif piece.needed:
            return None
    things = [placed[number] for number in sorted(placed)]
    if not walked and not _is_sound(things, zones, layout):
        return None
    return things, zones


def _is_sound(things: list[Stood], zones: list, layout: Layout) -> bool:  # type: ignore[type-arg]
    free = all(layout.zone_is_free(zone, group, things) for zone, group in zones)
    return free and layout.can_walk(things)
