"""Building lots that nobody surveyed: two rows of them along a street."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.synthetic.seeds import stream

STREET_M = 15.0
"""From one row of fronts to the other."""


@dataclass(frozen=True)
class StreetLots:
    """Lots whose first edge lies along the street.

    outlines_m: (4, 2) each, counter-clockwise. names: one for each. length_m: of the longer row.
    """

    outlines_m: list[NDArray[np.float64]]
    names: list[str]
    length_m: float


def street_of_lots(count: int, seed: int) -> StreetLots:
    """`count` lots on both sides of a street that runs from west to east, in turn."""
    rng = stream(seed, "lots")
    widths = np.round(rng.uniform(11.0, 18.0, count), 1)
    depths = np.round(rng.uniform(11.0, 14.0, count), 1)
    outlines, names = [], []
    ends = {"north": 0.0, "south": 0.0}
    for number, (width, depth) in enumerate(zip(widths, depths, strict=True)):
        side = "south" if number % 2 else "north"
        left = ends[side]
        ends[side] = right = left + float(width)
        outlines.append(_lot(left, right, float(depth), side))
        names.append(f"{side}-{number // 2 + 1}")
    return StreetLots(outlines, names, max(ends.values()))


def _lot(left: float, right: float, depth: float, side: str) -> NDArray[np.float64]:
    """The street is 0 <= y <= STREET_M."""
    if side == "north":
        y = STREET_M
        return np.array([[left, y], [right, y], [right, y + depth], [left, y + depth]])
    return np.array([[right, 0.0], [left, 0.0], [left, -depth], [right, -depth]])
