"""Strokes apart from the house that make walls but no room with a name: letterheads, photos, keys.

What stands free of the house, beyond its bounds, and encloses nothing that is named is no part of
it, if the house itself has most of the names.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from shapely.geometry import Point

from veduta.plan.drawn import Drawn

FEWEST, MOST_OF = 4, 0.7
"""The house has so many names in rooms, and so large a part of all."""
NOTE = (
    "walls apart from the house that enclose no named room are left out: they may be a letterhead,"
    " a picture or a key"
)


def without_apart(drawn: Drawn, labels: Sequence[NDArray[np.float64]]) -> Drawn:
    """The drawing without walls that stand apart. `labels`: the middles (2,) px of names."""
    group = _groups(drawn)
    points = [Point(*one) for one in labels]
    walls_of = {one.id: one for one in drawn.walls}
    names: dict[int, int] = dict.fromkeys(group.values(), 0)
    for room in drawn.rooms:
        count = sum(room.polygon().contains(point) for point in points)
        for home in {group[walls_of[wall].start] for wall in room.walls if wall in walls_of}:
            names[home] += count
    if len(names) < 2:
        return drawn
    house = max(names, key=lambda one: names[one])
    if names[house] < max(FEWEST, MOST_OF * len(points)):
        return drawn
    places = {
        home: np.array([one.at_px for one in drawn.junctions if group[one.id] == home])
        for home in names
    }
    low, high = places[house].min(axis=0), places[house].max(axis=0)
    gone = {
        home
        for home, at in places.items()
        if names[home] == 0 and ((at.max(axis=0) < low) | (at.min(axis=0) > high)).any()
    }
    return _without(drawn, group, gone) if gone else drawn


def _groups(drawn: Drawn) -> dict[str, int]:
    """The connected piece of the graph of walls that each junction lies in."""
    home = {one.id: number for number, one in enumerate(drawn.junctions)}
    changed = True
    while changed:
        changed = False
        for wall in drawn.walls:
            first, last = home[wall.start], home[wall.end]
            if first != last:
                home[wall.start] = home[wall.end] = min(first, last)
                changed = True
    return home


def _without(drawn: Drawn, group: dict[str, int], gone: set[int]) -> Drawn:
    walls = tuple(one for one in drawn.walls if group[one.start] not in gone)
    kept = {one.id for one in walls}
    return replace(
        drawn,
        junctions=tuple(one for one in drawn.junctions if group[one.id] not in gone),
        walls=walls,
        openings=tuple(one for one in drawn.openings if one.wall in kept),
        rooms=tuple(one for one in drawn.rooms if not one.walls or set(one.walls) <= kept),
        notes=(*drawn.notes, NOTE),
    )
