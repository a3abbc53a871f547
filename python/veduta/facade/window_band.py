"""A row of windows on one surface: the rows that suit all stripes, and how each stands out."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from veduta.facade.appearance import Scores
from veduta.facade.evidence import Evidence
from veduta.facade.opening_rows import Span, Stripes, window_rows
from veduta.facade.window_sides import refine_sides

# In storeys: how far beside a window the surface is looked at.
_BESIDE = 0.15


@dataclass(frozen=True)
class Candidate:
    """A window that may be there: columns x to x + w, rows t to b from the band's first row down.

    `sure` is its mean log-odds, `stands_out` by how much that is above what is beside it.
    """

    x: int
    w: int
    t: int
    b: int
    sure: float
    stands_out: float


def band_of_windows(
    evidence: Evidence,
    stripes: Stripes,
    scores: Scores,
    rows: tuple[int, int],
    storey: float,
    heights: Span,
) -> list[Candidate]:
    """A candidate for each stripe, all in the same rows; none where no rows suit.

    `rows` are the band's in the evidence, `scores` those of these rows, `heights` (storeys) those
    that windows may have.
    """
    if not stripes:
        return []
    inside = np.zeros(evidence.width, bool)
    for x, w in stripes:
        inside[x : x + w] = True
    part = np.s_[rows[0] : rows[1]]
    edges = np.minimum(np.abs(evidence.gy[part]), 25)
    t, b = window_rows(scores.window, edges, inside, storey, heights)
    if b <= t:
        return []
    mask = np.zeros(rows[1] - rows[0], bool)
    mask[t:b] = True
    refined = refine_sides(stripes, scores.window, evidence.gx[part], [mask] * len(stripes), storey)
    band = scores.window[t:b].mean(0)
    reach = max(1, int(_BESIDE * storey))
    found = []
    for x, w in refined:
        sure = float(band[x : x + w].mean())
        beside = [v.mean() for v in (band[max(0, x - reach) : x], band[x + w :][:reach]) if v.size]
        found.append(Candidate(x, w, t, b, sure, sure - float(np.mean(beside or [sure]))))
    return found
