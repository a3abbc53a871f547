"""Chimneys: boxes that stand in the roof; how far back is not seen in the photo."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from veduta.facade.adjusted import left_out
from veduta.facade.cells import snapped
from veduta.facade.document import Element
from veduta.facade.layout import SMALLEST_M, Opening
from veduta.facade.rectangles import Rectangle
from veduta.facade.roof import Mansard

# Depth of a chimney, and how far behind the front's break or wall it stands (m).
DEPTH_M, BEHIND_M = 0.8, 0.6
# How far it reaches into the roof below it (m).
FOOT_M = 0.3


@dataclass(frozen=True)
class Chimney:
    """Its front over the roof, and from where to where it stands behind the facade's plane (m)."""

    front: Rectangle
    near_m: float
    far_m: float
    element: Element


def plan_chimneys(
    chimneys: Sequence[Opening],
    footprint_m: tuple[float, float, float],
    mansard: Mansard | None,
    notes: list[str],
) -> tuple[Chimney, ...]:
    """Where each stands; the notes name those that do not rise over the roof.

    footprint_m: width, depth and height of the building up to the eaves.
    """
    width, depth, eaves = footprint_m
    inset = 0.0 if mansard is None else mansard.inset_m
    foot = eaves if mansard is None else mansard.break_m
    near = min(inset + BEHIND_M, 0.4 * depth)
    far = min(near + DEPTH_M, 0.6 * depth)
    found = []
    for chimney in chimneys:
        allowed = Rectangle(inset, foot, width - inset, 2.0 * chimney.rectangle.z1 + foot)
        place = chimney.rectangle.common(allowed)
        if place.width < SMALLEST_M or place.height < SMALLEST_M:
            reason = "it does not rise over the roof"
            notes.append(left_out(chimney.element, chimney.number, reason))
            continue
        found.append(Chimney(snapped(place), near, far, chimney.element))
    return tuple(found)
