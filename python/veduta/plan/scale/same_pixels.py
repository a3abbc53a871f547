"""Which drawings of a house have pixels of one size, so that what they say of it is said together.

Storeys that stand over each other are as wide or as deep as each other; pictures that were saved
or scanned alike show that in their pixels.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.plan.scale.estimate import DrawnSizes, estimate_scale


@dataclass(frozen=True)
class SameRule:
    """When two storeys are as large on their sheets as in the house.

    extent: one side of all rooms together differs by so little (natural logarithm).
    scale: and what each says of the size of a pixel by itself. fewest: rooms of each.
    """

    extent: float = 0.012
    scale: float = 0.1
    fewest: int = 2


RULE = SameRule()


def of_same_pixels(
    own: int, sizes: Sequence[DrawnSizes], rule: SameRule = RULE
) -> list[DrawnSizes]:
    """The others of these drawings whose pixels are as large as those of the own one."""
    found = []
    for index, other in enumerate(sizes):
        if index != own and _alike(sizes[own], other, rule):
            found.append(other)
    return found


def _alike(first: DrawnSizes, second: DrawnSizes, rule: SameRule) -> bool:
    if min(len(first.rooms), len(second.rooms)) < rule.fewest:
        return False
    apart = np.abs(np.log(_extent(first) / _extent(second)))
    if apart.min() > rule.extent:
        return False
    told = [estimate_scale(one).metres_per_px for one in (first, second)]
    return abs(math.log(told[0] / told[1])) <= rule.scale


def _extent(sizes: DrawnSizes) -> NDArray[np.float64]:
    """(2,) how wide and deep all rooms are together, px."""
    extent: NDArray[np.float64] = np.ptp(np.concatenate([*sizes.rooms]), axis=0)
    return np.maximum(extent, 1.0)
