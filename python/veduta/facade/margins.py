"""Slivers of neighbours and sky beyond the outermost windows of a front: cut off, or doubted.

Two houses that both have windows are parted by `houses.py`. A photo's margins are narrower than a
house: they have no windows to compare, but walls, lines, the outline and what the eyes see.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from veduta.facade.document import FacadeDocument
from veduta.facade.evidence import Evidence
from veduta.facade.eyes import Seen, SeenElement
from veduta.facade.houses import HouseParameters, storey_of
from veduta.facade.party_signs import Fronts, edge_signs, fronts_of
from veduta.facade.sides import Sides

WIDTH_DOUBTED = "width: may be"
"""How the note begins that says so."""


@dataclass(frozen=True)
class MarginParameters:
    """When a front ends between its outermost windows and the picture's border; in storeys.

    sure: the least sum of the signs, each cut off at `most`. surer, further: that of another end
    further in, at least so far, where the first parts a side wall or sky from what is beyond.
    same: walls whose colours are no further apart, in tens of steps of Lab, are one. beside: how
    far from a window a border is at least. seen: windows with this score count. outliers: per cent
    of them at each end that do not. doubt: how far the front may go on beyond its windows until
    that is doubted.
    Seen on 120 pictures of CMP in which borders were marked: 14 of 20 ends are found, 1 is wrong.
    """

    most: float = 1.5
    sure: float = 4.2
    surer: float = 4.5
    further: float = 0.3
    same: float = 0.2
    beside: float = 0.12
    seen: float = 0.4
    outliers: float = 3.0
    doubt: float = 1.0


def without_margins(
    sides: Sides,
    evidence: Evidence,
    seen: Seen,
    elements: Sequence[SeenElement],
    parameters: MarginParameters | None = None,
) -> Sides:
    """The sides, moved in to where the front ends before them.

    elements: in pixels of the evidence.
    """
    p = parameters or MarginParameters()
    sure = [e for e in elements if e.kind == "window" and e.score > p.seen]
    windows = [e for e in sure if sides.left < 0.5 * (e.x0 + e.x1) < sides.right]
    if len(windows) < HouseParameters().windows:
        return sides
    fronts = fronts_of(evidence, seen, windows, storey_of(windows))
    first, last = outermost(windows, p)
    left = end_of(fronts, (sides.left, first), p)
    right = end_of(fronts, (sides.right, last), p)
    if left is None and right is None:
        return sides
    moved = sides.left if left is None else left, sides.right if right is None else right
    share = 100 * (moved[1] - moved[0]) / evidence.width
    reason = (
        f"sides: the building takes {share:.0f} % of the picture's width; what is left and right of"
        " it was not read"
    )
    kept = [one for one in sides.reasons if not one.startswith("sides:")]
    return replace(sides, left=moved[0], right=moved[1], reasons=(*kept, reason))


def outermost(windows: Sequence[SeenElement], p: MarginParameters) -> tuple[float, float]:
    """The columns at which the windows of a front begin and end, but for outliers."""
    first = float(np.percentile([e.x0 for e in windows], p.outliers))
    return first, float(np.percentile([e.x1 for e in windows], 100.0 - p.outliers))


def end_of(
    fronts: Fronts, margin: tuple[float, float], parameters: MarginParameters | None = None
) -> int | None:
    """The column at which a front ends in a margin, from its border to the outermost window."""
    p = parameters or MarginParameters()
    border, window = margin
    inwards = 1 if window > border else -1
    last = window - inwards * p.beside * fronts.storey
    columns = np.arange(border + 3 * inwards, last, 2 * inwards).round().astype(int)
    sums = np.array([_sum_of(fronts, x, inwards > 0, p) for x in columns.tolist()])
    reach = max(1, round(0.5 * p.further * fronts.storey))
    peaks = np.array([sums[max(0, k - reach) : k + reach + 1].max() for k in range(len(sums))])
    found, least = None, p.sure
    left = np.ones(len(sums), np.bool_)
    while left.any() and float(sums[left].max()) >= least:
        found = int(columns[left][int(sums[left].argmax())])
        further = inwards * (columns - found) >= p.further * fronts.storey
        left, least = left & further & (sums >= peaks), p.surer
    return found


def _sum_of(fronts: Fronts, x: int, is_left: bool, p: MarginParameters) -> float:
    signs = edge_signs(fronts, x, is_left=is_left)
    goes_on = signs is not None and 0.0 < signs[0] < p.same  # exactly 0: no wall on one side
    return 0.0 if signs is None or goes_on else float(np.clip(signs, 0.0, p.most).sum())


def width_doubt(document: FacadeDocument, parameters: MarginParameters | None = None) -> str:
    """What is said where a front goes on far beyond its windows; empty where it does not."""
    p = parameters or MarginParameters()
    windows = [one for one in document.elements if one.class_ == "window" and not one.is_doubtful]
    if not windows or document.storeys < 2:
        return ""
    box, per_px = document.facade, document.scale.metres_per_px
    storey_m = box.height_m / document.storeys
    first = min(one.x_px for one in windows) - box.x_px
    last = box.x_px + box.width_px - max(one.x_px + one.width_px for one in windows)
    margins = (("left", first * per_px), ("right", last * per_px))
    wide = {side: far for side, far in margins if far > p.doubt * storey_m}
    if not wide:
        return ""
    usual = 0.4 * storey_m
    less = sum(far - usual for far in wide.values())
    told = " and ".join(f"{far:.1f} m on the {side}" for side, far in wide.items())
    return (
        f"{WIDTH_DOUBTED} up to {less:.1f} m less: beyond the outermost windows lie {told}."
        " --corners, or a crop, ends the front where you know it does"
    )
