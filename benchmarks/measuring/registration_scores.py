"""When a street is laid into a city model rightly, and a row of how often it is."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from record import Row

MOST_M, MOST_DEG = 0.3, 0.5
WANTED = 0.95
"""Share of the streets of a model that must be laid into it rightly."""


@dataclass(frozen=True, kw_only=True)
class Tried:
    """One street in one model.

    error_m: mean distance of the photos; error_deg: of the rotation. NaN without a fit.
    """

    accepted: bool
    seconds: float
    error_m: float = float("nan")
    error_deg: float = float("nan")

    @property
    def is_right(self) -> bool:
        """Accepted, and within the bounds."""
        return self.accepted and self.error_m <= MOST_M and self.error_deg <= MOST_DEG


def row_of(in_model: bool, gps: bool, found: Sequence[Tried]) -> Row:
    """How many streets were laid rightly, wrongly and not at all, and whether that is enough."""
    accepted = [one for one in found if one.accepted]
    right = sum(one.is_right for one in found)
    wanted = right >= WANTED * len(found) if in_model else not accepted
    return {
        "in the model": "yes" if in_model else "no",
        "GPS": "5 m wrong" if gps else "none",
        "streets": len(found),
        "right": right,
        "wrong": len(accepted) - right,
        "refused": len(found) - len(accepted),
        "met": "yes" if wanted and right == len(accepted) else "**missed**",
        "median m": float(np.median([one.error_m for one in accepted])) if accepted else None,
        "largest m": max((one.error_m for one in accepted), default=None),
        "largest degrees": max((one.error_deg for one in accepted), default=None),
        "s": float(np.mean([one.seconds for one in found])),
    }
