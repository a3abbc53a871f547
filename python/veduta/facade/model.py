"""The building of one facade document: walls with openings, a mansard, plain sides and back."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.facade.document import Element, FacadeDocument
from veduta.facade.layout import Layout, Opening, lay_out
from veduta.facade.options import ModelOptions
from veduta.facade.recess import Finish, Panel, add_panel
from veduta.facade.rectangles import Rectangle
from veduta.facade.roof import Mansard, plan_mansard
from veduta.facade.textures import Atlas, make_atlas
from veduta.place.builder import PartBuilder, Rect
from veduta.place.material import Material
from veduta.place.part import Part
from veduta.place.semantics import Provenance, SemanticClass
from veduta.run.errors import InputError

# Recesses together may take this share of the building's depth.
DEEPEST_SHARE = 0.4
# A window's frame: its width, the depth of the glass behind it as a share of the setback (m).
FRAME_M = 0.06
GLASS_SHARE = 0.25
# Windows smaller than this in either direction get no frame (m).
LEAST_FRAMED_M = 0.5


@dataclass(frozen=True)
class Paint:
    """Numbers of the part's materials, and the atlas that two of them show."""

    photo: int
    wall: int
    reveal: int
    roof: int
    iron: int
    atlas: Atlas


def build_part(
    document: FacadeDocument,
    rectified: NDArray[np.uint8],
    options: ModelOptions,
    part_id: str,
) -> Part:
    """Build the part of one document.

    rectified: (h, w, 3) uint8 sRGB, the rectified photo that the document describes.
    The part's frame: x right along the wall, z up, facade plane y = 0, body at y >= 0.
    """
    _check(document, rectified)
    builder = PartBuilder(part_id)
    layout = lay_out(document)
    builder.notes.extend(layout.notes)
    facade = document.facade
    mansard = plan_mansard(
        facade.width_m, options.depth_m, facade.height_m, document.rules.roof_height_m
    )
    top_m = facade.height_m if mansard is None else mansard.top_m
    paint = _make_paint(builder, make_atlas(document, rectified, top_m))
    _add_front(builder, document, layout, options, paint)
    _add_plain_walls(builder, document, options, paint)
    _add_roof(builder, document, mansard, options, paint)
    return builder.build()


def _check(document: FacadeDocument, rectified: NDArray[np.uint8]) -> None:
    facade = document.facade
    if not (facade.width_m > 0.0 and facade.height_m > 0.0 and document.scale.metres_per_px > 0.0):
        raise InputError(
            document.source.image,
            f"the facade is {facade.width_m} x {facade.height_m} m",
            "Give the facade a width, a height and a scale above zero in facade.json.",
        )
    expected = (document.rectification.height_px, document.rectification.width_px, 3)
    if rectified.shape != expected:
        raise InputError(
            document.source.image,
            f"the rectified photo is {rectified.shape}, the document says {expected}",
            "Use the rectified.jpg that was written with this facade.json.",
        )


def _make_paint(builder: PartBuilder, atlas: Atlas) -> Paint:
    red, green, blue = atlas.wall_colour
    return Paint(
        photo=builder.material(Material("photo", texture=atlas.texture)),
        wall=builder.material(Material("wall", (red, green, blue))),
        reveal=builder.material(Material("reveal", (0.9 * red, 0.9 * green, 0.9 * blue))),
        roof=builder.material(Material("roof", atlas.roof_colour, roughness=0.7)),
        iron=builder.material(Material("iron", (0.09, 0.09, 0.10), roughness=0.5)),
        atlas=atlas,
    )


def _photo_rect(element: Element) -> Rect:
    return (element.x_px, element.y_px, element.width_px, element.height_px)


def _add_front(
    builder: PartBuilder,
    document: FacadeDocument,
    layout: Layout,
    options: ModelOptions,
    paint: Paint,
) -> None:
    facade = document.facade
    wall = Rectangle(0.0, 0.0, facade.width_m, facade.height_m)
    feature = builder.feature(
        SemanticClass.WALL,
        Provenance.MEASURED,
        "front wall",
        size_m=(wall.width, wall.height),
        photo_px=(facade.x_px, facade.y_px, facade.width_px, facade.height_px),
    )
    setback = min(options.setback_m, DEEPEST_SHARE * options.depth_m)
    panels = [
        opening_panel(builder, opening, setback, paint, feature) for opening in layout.openings
    ]
    face = Finish(feature, paint.photo, paint.atlas.surface_uv)
    add_panel(builder, wall.corners(), 0.0, face, panels)


def opening_panel(
    builder: PartBuilder, opening: Opening, setback: float, paint: Paint, parent: int
) -> Panel:
    """The recess of one opening: reveals, its pane or leaf, and what is set into that."""
    rectangle, element = opening.rectangle, opening.element
    semantic = SemanticClass(element.class_)
    name = f"{element.class_} {builder.count(semantic) + 1}"
    feature = builder.feature(
        semantic,
        Provenance(element.provenance),
        name,
        parent=parent,
        size_m=(rectangle.width, rectangle.height),
        photo_px=_photo_rect(element),
    )
    reveal = builder.feature(
        SemanticClass.WALL,
        Provenance.INFERRED,
        f"reveal of {name}",
        parent=parent,
        size_m=(setback, rectangle.height),
    )
    face = Finish(feature, paint.photo, paint.atlas.surface_uv)
    lining = Finish(reveal, paint.reveal)
    if opening.children:
        inner = tuple(
            opening_panel(builder, child, 0.5 * setback, paint, feature)
            for child in opening.children
        )
    else:
        inner = _glass(rectangle, semantic, setback, face, lining)
    return Panel(rectangle, setback, face, lining, inner)


def _glass(
    rectangle: Rectangle, semantic: SemanticClass, setback: float, face: Finish, lining: Finish
) -> tuple[Panel, ...]:
    """The glass lies a little behind the frame that holds it."""
    if semantic is not SemanticClass.WINDOW or min(rectangle.width, rectangle.height) < LEAST_FRAMED_M:
        return ()
    return (Panel(rectangle.grown(-FRAME_M), GLASS_SHARE * setback, face, lining),)


def _add_plain_walls(
    builder: PartBuilder, document: FacadeDocument, options: ModelOptions, paint: Paint
) -> None:
    """Right, back and left wall and the ground: no photo shows them."""
    x1, y1, z1 = document.facade.width_m, options.depth_m, document.facade.height_m
    walls = {
        "right wall": [(x1, 0.0, 0.0), (x1, y1, 0.0), (x1, y1, z1), (x1, 0.0, z1)],
        "back wall": [(x1, y1, 0.0), (0.0, y1, 0.0), (0.0, y1, z1), (x1, y1, z1)],
        "left wall": [(0.0, y1, 0.0), (0.0, 0.0, 0.0), (0.0, 0.0, z1), (0.0, y1, z1)],
    }
    for name, corners in walls.items():
        width = x1 if name == "back wall" else y1
        feature = builder.feature(
            SemanticClass.WALL, Provenance.INVENTED, name, size_m=(width, z1)
        )
        builder.polygon([corners], feature, paint.wall)
    ground = builder.feature(
        SemanticClass.GROUND, Provenance.INVENTED, "footprint", size_m=(x1, y1)
    )
    corners = [(0.0, 0.0, 0.0), (0.0, y1, 0.0), (x1, y1, 0.0), (x1, 0.0, 0.0)]
    builder.polygon([corners], ground, paint.wall)


def _add_roof(
    builder: PartBuilder,
    document: FacadeDocument,
    mansard: Mansard | None,
    options: ModelOptions,
    paint: Paint,
) -> None:
    facade = document.facade
    x1, y1, z1 = facade.width_m, options.depth_m, facade.height_m
    if mansard is None:
        flat = builder.feature(
            SemanticClass.ROOF, Provenance.INVENTED, "flat roof", size_m=(x1, y1)
        )
        corners = [(0.0, 0.0, z1), (x1, 0.0, z1), (x1, y1, z1), (0.0, y1, z1)]
        builder.polygon([corners], flat, paint.roof)
        return
    for name, corners in mansard.lower_slopes().items():
        seen = name == "front"
        feature = builder.feature(
            SemanticClass.ROOF,
            Provenance.MEASURED if seen else Provenance.INVENTED,
            f"{name} lower slope",
        )
        if seen:
            builder.polygon([corners], feature, paint.photo, paint.atlas.surface_uv)
        else:
            builder.polygon([corners], feature, paint.roof)
    for name, corners in mansard.upper_slopes().items():
        feature = builder.feature(
            SemanticClass.ROOF, Provenance.INVENTED, f"{name} upper slope"
        )
        builder.polygon([corners], feature, paint.roof)
