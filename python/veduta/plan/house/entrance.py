"""The ways into a house, and the one by which a visitor comes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from shapely.geometry import LineString, Point

from veduta.plan.document import RoomUse
from veduta.plan.house.hanging import WAYS
from veduta.plan.house.hole import Hole
from veduta.plan.house.space import Space

AWAY_M = (5.0, 4.0, 3.0, 2.0)
"""From the front door to the visitor: the first from which nothing is in the way."""
OF_TERRACES = frozenset({"sliding", "french", "folding"})
"""Types of doors that lead out of a house rather than in."""
_ENTERED: dict[RoomUse, int] = {"living": 2, "dining": 2, "garage": 0, "storage": 0}
"""How likely a visitor is led into a room; others are 1."""
_BEYOND_M = 0.1


@dataclass(frozen=True)
class Entrance:
    """A way in. middle, out: (2,) the opening's middle, and the unit vector that leads outside."""

    hole: Hole
    middle: NDArray[np.float64]
    out: NDArray[np.float64]

    def before(self, away_m: float) -> NDArray[np.float64]:
        """(2,) the place before it, outside, at a distance from the wall's centre line."""
        place: NDArray[np.float64] = self.middle + away_m * self.out
        return place


def entrances(space: Space) -> list[Entrance]:
    """Doors and gaps between inside and outdoors, the most inviting first."""
    ways = [hole for hole in space.holes if hole.opening.kind != "window" and _side(hole, space)]
    return [_entrance(hole, space) for hole in sorted(ways, key=_inviting, reverse=True)]


def free_before(entrance: Entrance, space: Space) -> NDArray[np.float64]:
    """(2,) where a visitor stands: outside, with nothing of the house between."""
    near = entrance.before(entrance.hole.line.half_m + _BEYOND_M)
    free = [
        entrance.before(away)
        for away in AWAY_M
        if not space.covered.intersects(LineString([near, entrance.before(away)]))
    ]
    return free[0] if free else entrance.before(AWAY_M[-1])


def _entrance(hole: Hole, space: Space) -> Entrance:
    return Entrance(hole, hole.middle, _side(hole, space) * hole.leftward)


def _inviting(hole: Hole) -> tuple[bool, bool, bool, bool, int, float]:
    """Doors before gaps, garages last of doors; those of a hall, and not those of a terrace, first.

    Of what is alike then, the door whose room a visitor would enter, and the surest.
    """
    opening = hole.opening
    uses = {room.use for room in (hole.left, hole.right) if room is not None and not room.outdoors}
    return (
        opening.kind == "door",
        hole.type != "garage",
        not uses.isdisjoint(WAYS),
        hole.type not in OF_TERRACES,
        max((_ENTERED.get(use, 1) for use in uses), default=0),
        opening.score,
    )


def _side(hole: Hole, space: Space) -> int:
    """+1 where the left of an opening is outdoors and its right is not, -1 the other way, or 0."""
    left = hole.leftward * (hole.line.half_m + _BEYOND_M)
    on_left, on_right = (
        not space.covered.covers(Point(hole.middle + side * left)) for side in (1.0, -1.0)
    )
    return int(on_left) - int(on_right)
