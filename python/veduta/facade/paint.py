"""The materials of a facade's part, and what a polygon is given of them."""

from __future__ import annotations

from dataclasses import dataclass

from veduta.facade.document import Element
from veduta.facade.textures import Atlas
from veduta.place.builder import PartBuilder, Rect, UvMap
from veduta.place.material import Colour, Material

# What lies in the shade of the wall is this much darker than the wall.
REVEAL_SHADE = 0.9


@dataclass(frozen=True)
class Finish:
    """What a polygon is given: its feature, its material and where its texture lies."""

    feature: int
    material: int
    uv: UvMap | None = None


@dataclass(frozen=True)
class Paint:
    """Numbers of the part's materials, and the atlas that one of them shows."""

    photo: int
    wall: int
    reveal: int
    roof: int
    railing: int
    chimney: int
    atlas: Atlas

    def surface(self, feature: int) -> Finish:
        """The photo without what stands before the wall."""
        return Finish(feature, self.photo, self.atlas.surface_uv)

    def seen(self, feature: int) -> Finish:
        """The photo as it is."""
        return Finish(feature, self.photo, self.atlas.photo_uv)


def make_paint(builder: PartBuilder, atlas: Atlas) -> Paint:
    """Register the materials with the builder."""

    def plain(name: str, colour: Colour, roughness: float = 0.9) -> int:
        return builder.material(Material(name, colour, roughness))

    red, green, blue = (REVEAL_SHADE * channel for channel in atlas.colours.wall)
    return Paint(
        photo=builder.material(Material("photo", texture=atlas.texture)),
        wall=plain("wall", atlas.colours.wall),
        reveal=plain("reveal", (red, green, blue)),
        roof=plain("roof", atlas.colours.roof, 0.7),
        railing=plain("railing", atlas.colours.balcony, 0.6),
        chimney=plain("chimney", atlas.colours.chimney),
        atlas=atlas,
    )


def photo_rect(element: Element) -> Rect:
    """Where the element lies in the rectified photo: x, y, width, height (px)."""
    return (element.x_px, element.y_px, element.width_px, element.height_px)
