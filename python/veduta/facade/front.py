"""The front wall: its openings are cut in, set back, and closed by panes and leaves."""

from __future__ import annotations

import numpy as np

from veduta.facade.document import FacadeDocument
from veduta.facade.layout import Layout, Opening
from veduta.facade.paint import Finish, Paint, photo_rect
from veduta.facade.recess import Panel, add_panel
from veduta.facade.rectangles import Rectangle
from veduta.place.builder import PartBuilder
from veduta.place.semantics import Provenance, SemanticClass

# A window's frame is this wide; its glass lies behind it by this share of the setback (m).
FRAME_M = 0.06
GLASS_SHARE = 0.25
# A door or window of a shop lies behind the shop's front by this share of the setback.
INNER_SHARE = 0.5
# Windows smaller than this in either direction get no frame (m).
LEAST_FRAMED_M = 0.5


def add_front(
    builder: PartBuilder,
    document: FacadeDocument,
    layout: Layout,
    setback_m: float,
    paint: Paint,
) -> int:
    """Add the wall and all that is cut into it; returns the wall's feature."""
    facade = document.facade
    wall = Rectangle(0.0, 0.0, facade.width_m, facade.height_m)
    feature = builder.feature(
        SemanticClass.WALL,
        Provenance.MEASURED,
        "front wall",
        size_m=(wall.width, wall.height),
        photo_px=(facade.x_px, facade.y_px, facade.width_px, facade.height_px),
    )
    panels = [
        opening_panel(builder, opening, setback_m, paint, feature) for opening in layout.openings
    ]
    add_panel(builder, wall.corners(), 0.0, paint.surface(feature), panels)
    return feature


def opening_panel(
    builder: PartBuilder, opening: Opening, setback_m: float, paint: Paint, parent: int
) -> Panel:
    """The recess of one opening: reveals, its pane or leaf, and what is set into that."""
    rectangle, element = opening.rectangle, opening.element
    semantic = SemanticClass(element.class_)
    name = f"{element.class_} {builder.count(semantic) + 1}"
    seen_m = opening.seen_height_m
    feature = builder.feature(
        semantic,
        _provenance(opening),
        name,
        parent=parent,
        size_m=(rectangle.width, rectangle.height),
        photo_px=photo_rect(element),
        seen_height_m=np.nan if seen_m is None else seen_m,
    )
    face = paint.surface(feature)
    if setback_m <= 0.0:
        lining = face
    else:
        reveal = builder.feature(
            SemanticClass.WALL,
            Provenance.INFERRED,
            f"reveal of {name}",
            parent=parent,
            size_m=(setback_m, rectangle.height),
        )
        lining = Finish(reveal, paint.reveal)
    inner = [
        opening_panel(builder, child, INNER_SHARE * setback_m, paint, feature)
        for child in opening.children
    ]
    smaller = min(rectangle.width, rectangle.height)
    if semantic is SemanticClass.WINDOW and setback_m > 0.0 and smaller >= LEAST_FRAMED_M:
        glass = rectangle.grown(-FRAME_M)
        inner.append(Panel(glass, GLASS_SHARE * setback_m, face, lining))
    return Panel(rectangle, setback_m, face, lining, tuple(inner))


def _provenance(opening: Opening) -> Provenance:
    """That of the element; a size that a rule has added to is inferred, not measured."""
    said = Provenance(opening.element.provenance)
    extended = opening.seen_height_m is not None
    return Provenance.INFERRED if extended and said is Provenance.MEASURED else said
