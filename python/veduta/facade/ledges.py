"""Cornices and string courses that a depth map has measured, as boxes along the front."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from veduta.facade.cells import DECIMALS
from veduta.facade.document import FacadeDocument
from veduta.facade.rectangles import Rectangle


@dataclass(frozen=True)
class LedgeLimits:
    """least_m: what openings leave of a ledge is none below this height (m). said: the share of its
    height from which on it is told that a ledge lost it.
    """

    least_m: float = 0.05
    said: float = 0.1


@dataclass(frozen=True)
class PlannedLedge:
    """A box along the whole front, from `foot_m` to `top_m`, so far out (m)."""

    foot_m: float
    top_m: float
    out_m: float


def plan_ledges(
    document: FacadeDocument,
    openings: Sequence[Rectangle],
    eaves_m: float,
    notes: list[str],
    limits: LedgeLimits | None = None,
) -> tuple[PlannedLedge, ...]:
    """The ledges of a document where no opening is; the notes name those that have less room."""
    own = limits or LedgeLimits()
    if document.depths is None:
        return ()
    box, scale = document.facade, document.scale.metres_per_px
    foot_px = box.y_px + box.height_px
    found = []
    for number, ledge in enumerate(document.depths.ledges):
        top = min(eaves_m, (foot_px - ledge.y_px) * scale)
        low = max(0.0, (foot_px - ledge.y_px - ledge.height_px) * scale)
        high = top - low
        foot, top = _free(low, top, openings)
        if top - foot < own.least_m:
            notes.append(f"ledge (depths.ledges[{number}]): left out, openings are in its place")
            continue
        if top - foot < (1.0 - own.said) * high:
            lost = f"{high:.2f} m high as measured, {top - foot:.2f} m in the model"
            notes.append(f"ledge (depths.ledges[{number}]): {lost}, openings are in its place")
        foot, top = round(foot, DECIMALS), round(top, DECIMALS)
        found.append(PlannedLedge(foot, top, round(ledge.out_m, DECIMALS)))
    return tuple(found)


def _free(low: float, high: float, openings: Sequence[Rectangle]) -> tuple[float, float]:
    """The highest stretch between two heights that is at no opening's height."""
    spans = sorted((one.z0, one.z1) for one in openings if one.z1 > low and one.z0 < high)
    best, at = (low, low), low
    for foot, top in [*spans, (high, high)]:
        if min(foot, high) - at > best[1] - best[0]:
            best = (at, min(foot, high))
        at = max(at, top)
    return best
