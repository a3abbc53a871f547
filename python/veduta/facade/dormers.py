"""Windows that lie in the roof stand in dormers on the front's lower slope.

A dormer's front is upright at the foot of its window; two cheeks and a flat lid run back to the
slope, which is cut open along their edges, so that the body stays closed.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from veduta.facade.adjusted import clipped, left_out
from veduta.facade.cells import snapped
from veduta.facade.layout import SMALLEST_M, Opening
from veduta.facade.rectangles import Rectangle, carve
from veduta.facade.roof import Mansard

# The frame of a dormer around its window (m): left and right, below, above.
CHEEK_M, SILL_M, LINTEL_M = 0.14, 0.10, 0.16
# Least roof between two dormers, and around all of them (m).
GAP_M = 0.15
# The lid juts out by this to the front and to the sides, and is this thick (m).
LID_OUT_M, LID_SIDE_M, LID_M = 0.10, 0.05, 0.08


@dataclass(frozen=True)
class Dormer:
    """Its front on the street side, as x and z, and the window in it."""

    front: Rectangle
    window: Opening


def reach_m(windows: Sequence[Opening], eaves_m: float) -> float:
    """How high above the eaves the slope must reach to carry these windows."""
    tops = [window.rectangle.z1 for window in windows]
    return max(tops, default=eaves_m) + LINTEL_M + 2 * GAP_M - eaves_m


def plan_dormers(
    windows: Sequence[Opening], mansard: Mansard | None, notes: list[str]
) -> list[Dormer]:
    """Clip the dormers clear of each other and of the slope's edges; note what is left out."""
    if mansard is None:
        notes.extend(left_out(w.element, w.number, "there is no roof to carry it") for w in windows)
        return []
    found: list[Dormer] = []
    for window in windows:
        want = window.rectangle
        around = Rectangle(
            want.x0 - CHEEK_M, want.z0 - SILL_M, want.x1 + CHEEK_M, want.z1 + LINTEL_M
        )
        inside = around.common(_allowed(mansard, around.z1))
        front = snapped(carve(inside, [other.front for other in found], GAP_M))
        inner = Rectangle(
            front.x0 + CHEEK_M, front.z0 + SILL_M, front.x1 - CHEEK_M, front.z1 - LINTEL_M
        )
        if inner.width < SMALLEST_M or inner.height < SMALLEST_M:
            notes.append(left_out(window.element, window.number, "no room on the slope"))
            continue
        if inner.area < 0.95 * want.area:
            notes.append(clipped(window.element, window.number, "to the slope"))
        found.append(Dormer(front, Opening(inner, window.element, window.number)))
    return found


def _allowed(mansard: Mansard, top_m: float) -> Rectangle:
    """Where a dormer of this height may stand: the slope narrows towards its upper edge."""
    aside = mansard.front_y_m(min(max(top_m, mansard.eaves_m), mansard.break_m))
    return Rectangle(aside, mansard.eaves_m, mansard.width_m - aside, mansard.break_m).grown(-GAP_M)
