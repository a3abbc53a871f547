"""What the score of an opening says: how many of those drawn like it are right.

An opening is right that overlaps a true one by half along its wall and is a door, window or gap as
that is. The shares were counted on 24 development sheets of `synthetic.plans` (three of each of
eight styles, seeds 0 to 22), with one right and one wrong one added to each count (Laplace's rule
of succession). `benchmarks/plan/plan_openings.py` counts them on other sheets.
"""

from __future__ import annotations

from veduta.plan.document import OpeningType
from veduta.plan.openings.classify import Judged

BY_TYPE: dict[OpeningType, float] = {
    "sliding": 0.96, "pocket": 0.88, "garage": 0.86, "folding": 0.88, "double": 0.68,
    "french": 0.83, "plain": 0.23, "unknown": 0.40,
}  # fmt: skip
"""Doors and gaps, (right + 1) / (found + 2): 25 of 25, 6 of 6, 5 of 5, 6 of 6, 9 of 14, 4 of 4,
6 of 31, 23 of 61."""

FAINT_TRACE = 0.65
SINGLE_LEAF = (0.83, 0.99)
"""Of a leaf with a faint trace (9 of 10), and with a clear one (173 of 173)."""

FAINT_LINES = 0.65
WINDOW = (0.81, 0.97)
"""Of a window with few lines (21 of 25), and of others (200 of 207)."""

GUESSED = 0.6
"""What nothing is drawn of, but a room behind it speaks for, is right less often: a guess."""


def likely(judged: Judged) -> float:
    """The share of openings drawn like this one that are right, 0 to 1."""
    if judged.seen is None:
        return min(judged.score, GUESSED * BY_TYPE.get(judged.type, 1.0))
    if judged.kind == "window":
        return WINDOW[judged.score >= FAINT_LINES]
    if judged.type == "swing":
        return SINGLE_LEAF[judged.score >= FAINT_TRACE]
    return BY_TYPE.get(judged.type, judged.score)
