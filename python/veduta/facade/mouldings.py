"""Cornices and courses of the document as what is built: places on the front, in metres."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from veduta.facade.cells import snapped
from veduta.facade.document import FacadeDocument, Moulding
from veduta.facade.ledges import PlannedLedge
from veduta.facade.rectangles import Rectangle


@dataclass(frozen=True)
class MouldingLimits:
    """high_m, wide_m: lower or shorter mouldings are left out (m): nobody would see them."""

    high_m: float = 0.06
    wide_m: float = 0.5


@dataclass(frozen=True)
class PlannedMoulding:
    """Where a moulding lies on the front (m), its number in the document, and what that says."""

    number: int
    place: Rectangle
    moulding: Moulding


def plan_mouldings(
    document: FacadeDocument,
    width_m: float,
    ledges: Sequence[PlannedLedge] = (),
    limits: MouldingLimits | None = None,
) -> tuple[PlannedMoulding, ...]:
    """The mouldings of a document, clipped to the front; those that are too small are left out.

    Where a depth map has measured a ledge, that one is built.
    """
    own = limits or MouldingLimits()
    box, m = document.facade, document.scale.metres_per_px
    below = box.y_px + box.height_px
    found = []
    for number, each in enumerate(document.mouldings):
        left = max(0.0, (each.x_px - box.x_px) * m)
        right = min(width_m, (each.x_px + each.width_px - box.x_px) * m)
        foot = max(0.0, (below - each.y_px - each.height_px) * m)
        top = (below - each.y_px) * m
        if any(ledge.foot_m < top and ledge.top_m > foot for ledge in ledges):
            continue
        if right - left >= own.wide_m and top - foot >= own.high_m:
            place = snapped(Rectangle(left, foot, right, top))
            found.append(PlannedMoulding(number, place, each))
    return tuple(found)
