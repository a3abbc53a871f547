"""Windows in the roof: dormers and skylights between the ridge and the eaves."""

from __future__ import annotations

from veduta.facade.appearance import class_scores, wall_colour
from veduta.facade.boxes import Box, score
from veduta.facade.columns import Columns, split_columns
from veduta.facade.evidence import Evidence
from veduta.facade.extent import Skyline
from veduta.facade.floors import Floors
from veduta.facade.window_band import Candidate, band_of_windows

# In storeys: the least roof that can hold a window, and the heights of a window in it.
_ROOF = 0.4
_WINDOW = (0.3, 0.75)
# Mean log-odds under which there is no window, and by how much they must be above those of the
# roof that is beside it.
_BLANK = -0.2
_STANDS_OUT = 0.6
# What each pixel column of a candidate counts beside its log-odds where two overlap.
_WIDE = 0.5


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
        for c in band_of_windows(evidence, stripes, scores, (top, bottom), storey, _WINDOW)
        if c.sure > _BLANK
        and c.stands_out > _STANDS_OUT
        and (skyline.rows[c.x : c.x + c.w] < top + c.t).all()
    ]
    return [
        Box("window", c.x, top + c.t, c.w, c.b - c.t, None, k, score(c.sure))
        for k, c in enumerate(_apart(found))
    ]


def _apart(candidates: list[Candidate]) -> list[Candidate]:
    """The candidates that no better one overlaps, from left to right."""
    kept: list[Candidate] = []
    for c in sorted(candidates, key=lambda c: -(c.sure + _WIDE) * c.w):
        if all(c.x + c.w <= k.x or c.x >= k.x + k.w for k in kept):
            kept.append(c)
    return sorted(kept, key=lambda c: c.x)
