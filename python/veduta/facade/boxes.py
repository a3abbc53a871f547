"""A rectangle that was found, and how sure it is."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

# Log-odds of pixels are not independent: how much their mean counts in a box's score.
_CERTAINTY = 2.0


@dataclass(frozen=True)
class Box:
    """A rectangle in analysis pixels, with what says that it is there (0..1).

    outline: its shape where that is no rectangle, corners in order. is_inferred: nothing of it is
    seen, but others say that it is there. is_passage: of a door, that it leads through the house.
    is_balustrade: of a balcony, that it stands on the edge of the roof.
    """

    kind: str
    x: int
    y: int
    width: int
    height: int
    floor: int | None
    column: int | None
    score: float
    outline: tuple[tuple[float, float], ...] = ()
    is_inferred: bool = False
    is_passage: bool = False
    is_balustrade: bool = False

    def part(self, top: int = 0) -> tuple[slice, slice]:
        """Rows and columns of the box in an image whose first row is `top`."""
        return np.s_[
            self.y - top : self.y - top + self.height,
            self.x : self.x + self.width,
        ]


def score(sure: float) -> float:
    """A box's score (0..1) from the mean log-odds of its pixels."""
    return float(1 / (1 + np.exp(-_CERTAINTY * sure)))
