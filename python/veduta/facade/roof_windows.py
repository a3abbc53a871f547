"""Windows in the roof: dormers and skylights between the ridge and the eaves."""

from __future__ import annotations

from dataclasses import replace

import cv2
import numpy as np

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
# Part of the columns that must reach above the ridge for dormers to do so, not chimneys, and how
# far above it they are looked for (storeys).
_DORMERS = 0.15
_ABOVE_RIDGE = 0.5
# In storeys: how far a dormer's roof is above the ridge at least, and from those of the others.
_JUTS, _SAME_ROOF = 0.1, 0.05
# Pixels beside the sky that are part sky.
_BLENDED = 2
# Mean log-odds under which there is no window, and by how much they must be above those of the
# roof that is beside it.
_BLANK = -0.2
_STANDS_OUT = 0.5
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
    bottom, storey = floors.eaves, floors.mean_storey
    top = _top(skyline, storey)
    if bottom - top < _ROOF * storey:
        return []
    evidence = without_sky(evidence, skyline, bottom)
    surface = wall_colour(evidence, top, bottom, storey)
    scores = class_scores(evidence, surface, top, bottom, storey)
    own = split_columns(evidence, top, bottom, storey, scores).stripes
    possible = [
        c
        for stripes in (own, columns.stripes)
        for c in band_of_windows(evidence, stripes, scores, (top, bottom), storey, _WINDOW)
        if (skyline.rows[c.x : c.x + c.w] < top + c.t).all()
    ]
    found = _apart([c for c in possible if c.sure > _BLANK and c.stands_out > _STANDS_OUT])
    found = _apart(found + _in_like_dormers(possible, found, skyline, storey))
    return [
        Box("window", c.x, top + c.t, c.w, c.b - c.t, None, k, score(c.sure))
        for k, c in enumerate(found)
    ]


def _top(skyline: Skyline, storey: float) -> int:
    """The row at which windows may begin: dormers reach above the ridge, on many a mansard."""
    dormers = int(np.percentile(skyline.rows, 100 * _DORMERS))
    return max(dormers, skyline.level - round(_ABOVE_RIDGE * storey), 0)


def _in_like_dormers(
    possible: list[Candidate], found: list[Candidate], skyline: Skyline, storey: float
) -> list[Candidate]:
    """Candidates whose roofs reach as far above the ridge as those of two windows found.

    What has the outline of a dormer is one, also where its panes are as grey as slate. Chimneys
    seldom end at the dormers' height.
    """

    def roof(c: Candidate) -> float:
        return float(skyline.level - np.median(skyline.rows[c.x : c.x + c.w]))

    roofs = [r for r in map(roof, found) if r > _JUTS * storey]
    if len(roofs) < 2:
        return []
    usual = float(np.median(roofs))
    free = [c for c in possible if all(c.x + c.w <= k.x or c.x >= k.x + k.w for k in found)]
    return [c for c in free if abs(roof(c) - usual) < _SAME_ROOF * storey]


def without_sky(evidence: Evidence, skyline: Skyline, eaves: int) -> Evidence:
    """The evidence with sky of the roof's colour and no edge against it, as if no photo showed it.

    What is beside a dormer is often sky, and no edge of a photo is as strong as the roof's outline.
    """
    sky = np.arange(evidence.height)[:, None] < skyline.rows
    roof = (~sky & evidence.valid)[:eaves]
    if not roof.any():
        return evidence
    near = cv2.dilate(sky.astype(np.uint8), np.ones((3, 2 * _BLENDED + 1))) > 0
    lab, gx, gy = evidence.lab.copy(), evidence.gx.copy(), evidence.gy.copy()
    lab[near] = np.median(lab[:eaves][roof], axis=0)
    gx[near] = gy[near] = 0.0
    return replace(evidence, lab=lab, gx=gx, gy=gy, valid=evidence.valid & ~near)


def _apart(candidates: list[Candidate]) -> list[Candidate]:
    """The candidates that no better one overlaps, from left to right."""
    kept: list[Candidate] = []
    for c in sorted(candidates, key=lambda c: -(c.sure + _WIDE) * c.w):
        if all(c.x + c.w <= k.x or c.x >= k.x + k.w for k in kept):
            kept.append(c)
    return sorted(kept, key=lambda c: c.x)
