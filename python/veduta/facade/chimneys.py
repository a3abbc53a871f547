"""Chimneys: boxes that stand in the roof; how far back is not seen in the photo."""

from __future__ import annotations

from collections.abc import Sequence

from veduta.facade.adjusted import left_out
from veduta.facade.layout import SMALLEST_M, Opening
from veduta.facade.paint import Finish, Paint, photo_rect
from veduta.facade.rectangles import Rectangle
from veduta.facade.roof import Mansard
from veduta.facade.solids import Box, add_box
from veduta.place.builder import PartBuilder
from veduta.place.semantics import Provenance, SemanticClass

# Depth of a chimney, and how far behind the front's break or wall it stands (m).
DEPTH_M, BEHIND_M = 0.8, 0.6
# How far it reaches into the roof below it (m).
FOOT_M = 0.3


def add_chimneys(
    builder: PartBuilder,
    chimneys: Sequence[Opening],
    footprint_m: tuple[float, float, float],
    mansard: Mansard | None,
    paint: Paint,
) -> None:
    """Add each as a closed solid.

    footprint_m: width, depth and height of the building up to the eaves.
    """
    width, depth, eaves = footprint_m
    inset = 0.0 if mansard is None else mansard.inset_m
    foot = eaves if mansard is None else mansard.break_m
    near = min(inset + BEHIND_M, 0.4 * depth)
    far = min(near + DEPTH_M, 0.6 * depth)
    for number, chimney in enumerate(chimneys):
        allowed = Rectangle(inset, foot, width - inset, 2.0 * chimney.rectangle.z1 + foot)
        place = chimney.rectangle.common(allowed)
        if place.width < SMALLEST_M or place.height < SMALLEST_M:
            reason = "it does not rise over the roof"
            builder.notes.append(left_out(chimney.element, chimney.number, reason))
            continue
        shell = builder.new_shell()
        front = builder.feature(
            SemanticClass.CHIMNEY,
            Provenance.INFERRED,
            f"chimney {number + 1}",
            shell=shell,
            size_m=(place.width, place.height),
            photo_px=photo_rect(chimney.element),
        )
        rest = builder.feature(
            SemanticClass.CHIMNEY,
            Provenance.INVENTED,
            f"sides and back of chimney {number + 1}",
            parent=front,
            shell=shell,
        )
        box = Box(place.x0, place.x1, near, far, foot - FOOT_M, place.z1)
        add_box(builder, box, paint.seen(front), Finish(rest, paint.chimney))
