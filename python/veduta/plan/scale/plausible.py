"""Scales by which a drawing would be no house: doors, walls and the whole say how small and large.

A lone number that is read or understood wrong can outvote all else by agreeing with itself. What it
would make of doors, of walls and of the plan as a whole speaks against it before the vote.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from veduta.plan.scale.evidence import Voter

if TYPE_CHECKING:
    from veduta.plan.scale.estimate import DrawnSizes


@dataclass(frozen=True)
class HouseSizes:
    """What sizes things of a house have, least and most (m). Wide: only what is absurd is out."""

    door_m: tuple[float, float] = (0.3, 3.2)
    """The median of at least `few` doors: 0.7 to 1.0 m, by a third and by three: what was
    taken for doors on a hard sheet may be none."""
    wall_m: tuple[float, float] = (0.015, 1.6)
    """The median wall, of at least `few`: a line of a pen to that of a castle."""
    rooms_m2: tuple[float, float] = (4.0, 60_000.0)
    """All rooms of a storey: the smallest flats have 9 m2."""
    room_m2: float = 3.0
    """The mean of at least `several` rooms, without those of less than `cupboard` of all."""
    few: int = 3
    several: int = 5
    cupboard: float = 0.02


USUAL = HouseSizes()


def limits_of(sizes: DrawnSizes, house: HouseSizes = USUAL) -> tuple[float, float]:
    """The least and the largest size of a pixel (m) by which the drawing can be of a house.

    Where what is drawn contradicts itself, doors go before walls, and these before the whole.
    """
    bounds = []
    for found, allowed in ((sizes.doors, house.door_m), (sizes.walls, house.wall_m)):
        if len(found) >= house.few:
            usual = float(np.median(found))
            bounds.append((allowed[0] / usual, allowed[1] / usual))
    areas = [_area(one) for one in sizes.rooms]
    area_px2 = sum(areas)
    if area_px2 > 0.0:
        least, most = house.rooms_m2
        large = sum(one >= house.cupboard * area_px2 for one in areas)
        if large >= house.several:
            least = max(least, house.room_m2 * large)
        bounds.append((math.sqrt(least / area_px2), math.sqrt(most / area_px2)))
    low, high = 0.0, math.inf
    for lower, upper in bounds:
        if max(low, lower) < min(high, upper):
            low, high = max(low, lower), min(high, upper)
    return low, high


def plausible(voters: Sequence[Voter], limits: tuple[float, float]) -> list[Voter]:
    """The voters without their readings that are outside of limits (m); none without a reading."""
    kept = []
    for voter in voters:
        readings = tuple(
            one for one in voter.hypotheses if limits[0] <= math.exp(one.log_mpp) <= limits[1]
        )
        if readings:
            kept.append(replace(voter, hypotheses=readings))
    return kept


def _area(outline: NDArray[np.float64]) -> float:
    """Of a room, in square pixels, by the shoelace formula."""
    x, y = np.asarray(outline, dtype=np.float64).T
    return 0.5 * abs(float(x @ np.roll(y, 1) - y @ np.roll(x, 1)))
