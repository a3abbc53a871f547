"""Windows in the roof: dormers and skylights between the ridge and the eaves."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from veduta.facade.appearance import Scores, class_scores, wall_colour
from veduta.facade.boxes import Box, score
from veduta.facade.columns import Columns, split_columns
from veduta.facade.evidence import Evidence
from veduta.facade.extent import Skyline
from veduta.facade.floors import Floors
from veduta.facade.opening_rows import Stripes, window_rows
from veduta.facade.window_sides import refine_sides

# In storeys: the least roof that can hold a window, and the heights of a window in it.
_ROOF = 0.4
_WINDOW = (0.3, 0.75)
# Mean log-odds under which there is no window, and by how much they must be above those of the
# roof that is beside it, `_BESIDE` storeys wide.
_BLANK = -0.2
_STANDS_OUT = 0.6
_BESIDE = 0.15
# What each pixel column of a candidate counts beside its log-odds where two overlap.
_WIDE = 0.5


@dataclass(frozen=True)
class _Candidate:
    """A window that may be there: columns x to x + w, rows t to b from the ridge down."""

    x: int
    w: int
    t: int
    b: int
    sure: float


def find_roof_windows(
    evidence: Evidence, skyline: Skyline, floors: Floors, columns: Columns
) -> list[Box]:
    """The stripes and rows of windows in the roof, by the terms that find those of the floors.

    What the surface is there (slate, zinc) is taken from the roof itself. Dormers often stand over
    the windows below, but need not: stripes of the floors and of the roof alone are both tried, and
    where they overlap the better stays. Each window must stand out from the roof beside it.
    """
    top, bottom = skyline.level, floors.eaves
    storey = floors.mean_storey
    if bottom - top < _ROOF * storey:
        return []
    surface = wall_colour(evidence, top, bottom, storey)
    scores = class_scores(evidence, surface, top, bottom, storey)
    own = split_columns(evidence, top, bottom, storey, scores).stripes
    found = [
        c
        for stripes in (own, columns.stripes)
        for c in _candidates(evidence, stripes, scores, (top, bottom), storey)
        if (skyline.rows[c.x : c.x + c.w] < top + c.t).all()
    ]
    return [
        Box("window", c.x, top + c.t, c.w, c.b - c.t, None, k, score(c.sure))
        for k, c in enumerate(_apart(found))
    ]


def _candidates(
    evidence: Evidence, stripes: Stripes, scores: Scores, rows: tuple[int, int], storey: float
) -> list[_Candidate]:
    """What stands out in the stripes, all in the same rows."""
    if not stripes:
        return []
    inside = np.zeros(evidence.width, bool)
    for x, w in stripes:
        inside[x : x + w] = True
    part = np.s_[rows[0] : rows[1]]
    edges = np.minimum(np.abs(evidence.gy[part]), 25)
    t, b = window_rows(scores.window, edges, inside, storey, _WINDOW)
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
        if sure > _BLANK and sure - float(np.mean(beside or [sure])) > _STANDS_OUT:
            found.append(_Candidate(x, w, t, b, sure))
    return found


def _apart(candidates: list[_Candidate]) -> list[_Candidate]:
    """The candidates that no better one overlaps, from left to right."""
    kept: list[_Candidate] = []
    for c in sorted(candidates, key=lambda c: -(c.sure + _WIDE) * c.w):
        if all(c.x + c.w <= k.x or c.x >= k.x + k.w for k in kept):
            kept.append(c)
    return sorted(kept, key=lambda c: c.x)
