"""How far the slab over stairs is open, so that nobody hits his head."""

from __future__ import annotations

import math

HEADROOM_M = 2.0
"""Between a tread and what is over it."""


def first_in_well(rise_m: float, riser_m: float, treads: int, slab_m: float) -> int:
    """The number of the lowest tread, from 0, over which the slab is open.

    It is the one before the first whose head room would be less: a head is over both.
    """
    steps = math.floor((rise_m - slab_m - HEADROOM_M) / riser_m)
    return min(max(0, steps - 1), treads - 1)
