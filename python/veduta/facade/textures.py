"""The textures of a facade: the rectified photo twice, from the ground to the top of the building.

The first is the photo as it is. In the second, what stands before the wall and the roof
(balconies, chimneys, sky beside the roof) is replaced by synthesised pixels and marked as
invented: a railing is shown once, on the railing, and not again on the wall behind it.
"""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass, field
from math import ceil, floor
from typing import Literal

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.facade.cleared import Cleared, clear_surface
from veduta.facade.document import FacadeDocument
from veduta.facade.photo_masks import (
    Mask,
    PixelBox,
    element_mask,
    extent_mask,
    pixels_of,
    seen_mask,
    strip_mask,
)
from veduta.facade.side_wall import side_of
from veduta.facade.sky_fringe import sky_with_fringe, without_sky
from veduta.place.material import Colour, Texture

Pixels = NDArray[np.uint8]
RailingKind = Literal["iron", "stone"]


@dataclass(frozen=True)
class TextureParameters:
    """longest_px: the longest edge of a texture. stone, slate, iron, wood, brick: sRGB 0..1 of what
    the photo shows none of. stone_share: railings with this share of the wall's lightness are of
    stone, if their tint is no further from the wall's than stone_tint (OpenCV's a and b): half of
    62 light railings of Paris are further, which is of iron, of ten light ones of CMP none.
    sky_tint: between the bars of a balustrade is sky where its tint is further than this from the
    wall's: nine of stone lie within 12, three of iron beyond 20 (CMP; these were held out).
    sky_below: how far below the eaves sky shows at most, as a share of the front: between gables,
    and over a lower house beside it.
    """

    longest_px: int = 4096
    stone: Colour = (0.78, 0.73, 0.65)
    slate: Colour = (0.30, 0.33, 0.37)
    iron: Colour = (0.12, 0.12, 0.13)
    wood: Colour = (0.29, 0.23, 0.17)
    brick: Colour = (0.55, 0.36, 0.29)
    stone_share: float = 0.72
    stone_tint: float = 8.0
    sky_tint: float = 16.0
    sky_below: float = 0.25


USUAL = TextureParameters()


@dataclass(frozen=True)
class Colours:
    """The typical (median) colour of each class in the photo, sRGB 0..1.

    balconies: that of each railing, by the number of its element; balustrades: the same of those
    that stand on the roof's edge, with what is between their bars.
    """

    wall: Colour
    roof: Colour
    balcony: Colour
    chimney: Colour
    door: Colour = (0.29, 0.23, 0.17)
    mouldings: tuple[Colour, ...] = ()
    shutters: tuple[Colour, ...] = ()
    balconies: dict[int, Colour] = field(default_factory=dict)
    balustrades: dict[int, Colour] = field(default_factory=dict)

    @property
    def railing_kind(self) -> RailingKind:
        """What most railings are of."""
        return self._kind_of(self.balcony)

    def own_railing(self, number: int) -> tuple[RailingKind, Colour] | None:
        """Kind and colour of the railing of an element, where it is of other stuff than most."""
        own = self.balconies.get(number)
        if own is None or self._kind_of(own) == self.railing_kind:
            return None
        return self._kind_of(own), own

    def balustrade(self, number: int) -> tuple[RailingKind, Colour]:
        """Kind and colour of the rail of an element on the roof's edge: of stone as the wall is."""
        seen = self.balustrades.get(number, self.wall)
        if _apart(seen, self.wall) <= USUAL.sky_tint:
            return "stone", self.wall
        return "iron", self.balconies.get(number, USUAL.iron)

    def _kind_of(self, balcony: Colour) -> RailingKind:
        """Railings about as light as the wall and of its tint are of stone."""
        is_light = sum(balcony) > USUAL.stone_share * sum(self.wall)
        return "stone" if is_light and _apart(balcony, self.wall) <= USUAL.stone_tint else "iron"


def _apart(one: Colour, other: Colour) -> float:
    """How far the tints of two colours are apart, in steps of OpenCV's a and b."""
    both = np.array([[one, other]], np.float32)
    lab = cv2.cvtColor(both, cv2.COLOR_RGB2LAB)
    return float(np.hypot(*(lab[0, 0, 1:] - lab[0, 1, 1:])))


@dataclass(frozen=True)
class FacadeTextures:
    """The textures, and where they lie on the facade.

    side: the wall as it is at each height, for the other sides of the building. The two others
    cover the metres from `left_m` and `foot_m` (at most a pixel below 0) by `width_m` and
    `height_m`. What the photo does not reach is filled from its border, and marked as invented.
    """

    front: Texture
    wall: Texture
    side: Texture
    left_m: float
    foot_m: float
    width_m: float
    height_m: float
    colours: Colours
    cleared: Cleared


def make_textures(
    document: FacadeDocument,
    photo: Pixels,
    top_m: float,
    before: NDArray[np.uint8] | None = None,
    shutters: Collection[int] | None = None,
) -> FacadeTextures:
    """Cut the facade up to `top_m` above the ground out of the photo, and make both textures.

    photo: (h, w, 3) uint8 sRGB, the rectified photo of the document. before: (h, w) what
    stands before the front, places in `cleared.KINDS`; nothing but balconies where it is not given.
    shutters: numbers of those that are built, where not all are; others stay as in the photo.
    """
    facade, scale = document.facade, document.scale.metres_per_px
    bottom = facade.y_px + facade.height_px
    whole = PixelBox(
        floor(facade.x_px),
        floor(bottom - top_m / scale),
        ceil(facade.x_px + facade.width_px),
        ceil(bottom),
    )
    box = _in_photo(whole, photo)
    crop = photo[box.y0 : box.y1, box.x0 : box.x1].copy()
    unseen = ~seen_mask(document, box, photo)
    hidden = np.zeros(crop.shape[:2], dtype=np.uint8)
    if before is not None:
        hidden = before[box.y0 : box.y1, box.x0 : box.x1]
    colours = _colours(document, crop, box, ~unseen & (hidden == 0))
    _fill_unseen(document, crop, box, unseen, colours)
    built = document
    if shutters is not None:
        kept = [each for number, each in enumerate(document.shutters) if number in shutters]
        built = document.model_copy(update={"shutters": kept})
    cleared, invented = _surface_layer(built, crop, box, colours, hidden, unseen)
    return FacadeTextures(
        front=_fitted(crop, unseen, box, whole),
        wall=_fitted(cleared.pixels, invented | unseen, box, whole),
        side=_fitted_side(document, cleared.pixels, box, whole, colours.wall),
        left_m=(whole.x0 - facade.x_px) * scale,
        foot_m=(bottom - whole.y1) * scale,
        width_m=(whole.x1 - whole.x0) * scale,
        height_m=(whole.y1 - whole.y0) * scale,
        colours=colours,
        cleared=cleared,
    )


def _in_photo(whole: PixelBox, photo: Pixels) -> PixelBox:
    """What of the box the photo has; at least one pixel of its border."""
    height, width = photo.shape[:2]
    x0 = min(max(whole.x0, 0), width - 1)
    y0 = min(max(whole.y0, 0), height - 1)
    return PixelBox(x0, y0, min(max(whole.x1, x0 + 1), width), min(max(whole.y1, y0 + 1), height))


def _colours(document: FacadeDocument, crop: Pixels, box: PixelBox, seen: Mask) -> Colours:
    return Colours(
        wall=_typical(crop, extent_mask(document, box, "wall") & seen, USUAL.stone),
        roof=_typical(crop, extent_mask(document, box, "roof") & seen, USUAL.slate),
        balcony=_darker(crop, element_mask(document, box, "balcony") & seen, USUAL.iron),
        door=_typical(crop, element_mask(document, box, "door") & seen, USUAL.wood),
        mouldings=tuple(
            _typical(crop, strip_mask(each, box) & seen, USUAL.stone) for each in document.mouldings
        ),
        shutters=tuple(
            _typical(crop, strip_mask(each, box) & seen, USUAL.wood) for each in document.shutters
        ),
        balconies={
            number: _darker(crop[own], seen[own], USUAL.iron)
            for number, element in enumerate(document.elements)
            if element.class_ == "balcony" and seen[own := pixels_of(element, box)].any()
        },
        balustrades={
            number: _typical(crop[own], seen[own], USUAL.stone)
            for number, element in enumerate(document.elements)
            if element.balustrade and seen[own := pixels_of(element, box)].any()
        },
        chimney=_typical(crop, element_mask(document, box, "chimney") & seen, USUAL.brick),
    )


def _fill_unseen(
    document: FacadeDocument, crop: Pixels, box: PixelBox, unseen: Mask, colours: Colours
) -> None:
    """Paint what the photo does not show: roof above the eaves, wall below them."""
    eaves = min(max(round(document.facade.y_px) - box.y0, 0), crop.shape[0])
    for rows, colour in ((slice(0, eaves), colours.roof), (slice(eaves, None), colours.wall)):
        crop[rows][unseen[rows]] = np.round(np.array(colour) * 255.0).astype(np.uint8)


def _typical(pixels: Pixels, mask: Mask, otherwise: Colour) -> Colour:
    """Median colour under the mask, 0..1; `otherwise` where the mask is empty."""
    if not mask.any():
        return otherwise
    median = np.median(pixels[mask], axis=0) / 255.0
    return float(median[0]), float(median[1]), float(median[2])


def _darker(pixels: Pixels, mask: Mask, otherwise: Colour) -> Colour:
    """Median colour of the darkest third under the mask: bars, and not what is between them."""
    if not mask.any():
        return otherwise
    found = pixels[mask]
    light = found.sum(axis=1)
    median = np.median(found[light <= np.quantile(light, 1.0 / 3.0)], axis=0) / 255.0
    return float(median[0]), float(median[1]), float(median[2])


def _surface_layer(
    document: FacadeDocument,
    crop: Pixels,
    box: PixelBox,
    colours: Colours,
    before: NDArray[np.uint8],
    unseen: Mask,
) -> tuple[Cleared, Mask]:
    """The photo without what stands before wall and roof, and the mask of invented pixels."""
    sky = extent_mask(document, box, "sky")
    rows = np.arange(len(crop))[:, None] + box.y0
    above = rows < document.facade.y_px + USUAL.sky_below * document.facade.height_px
    invented = (sky_with_fringe(crop, sky) & above) | element_mask(document, box, "chimney")
    surface = without_sky(crop, invented, colours.roof)
    # Below the eaves it is the wall that goes on where a lower house beside it leaves sky.
    below = rows[:, 0] >= document.facade.y_px
    if invented[below].any():
        surface[below] = without_sky(crop, invented, colours.wall)[below]
    cleared = clear_surface(document, surface, box, before, unseen)
    return cleared, invented | cleared.filled


def _fitted_side(
    document: FacadeDocument, pixels: Pixels, box: PixelBox, whole: PixelBox, wall: Colour
) -> Texture:
    """The side's texture as high as the others; all of it is invented."""
    openings = np.zeros(pixels.shape[:2], dtype=np.bool_)
    for class_ in ("window", "door", "shop", "balcony"):
        openings |= element_mask(document, box, class_)
    eaves = min(max(round(document.facade.y_px) - box.y0, 0), len(pixels))
    side = side_of(pixels, ~openings, slice(eaves, len(pixels)), wall)
    return _fitted(side, np.ones(side.shape[:2], np.bool_), box, whole)


def _fitted(pixels: Pixels, mask: Mask, box: PixelBox, whole: PixelBox) -> Texture:
    """At most `longest_px` on the long edge, and filled up to the whole from its border."""
    factor = min(1.0, USUAL.longest_px / max(whole.size))
    if factor < 1.0:
        size = (max(1, round(box.size[0] * factor)), max(1, round(box.size[1] * factor)))
        pixels = np.asarray(cv2.resize(pixels, size, interpolation=cv2.INTER_AREA), dtype=np.uint8)
        part = cv2.resize(mask.astype(np.uint8) * 255, size, interpolation=cv2.INTER_AREA)
        mask = part > 0
    height, width = mask.shape
    above, left = round((box.y0 - whole.y0) * factor), round((box.x0 - whole.x0) * factor)
    below = max(0, round(whole.size[1] * factor) - height - max(above, 0))
    right = max(0, round(whole.size[0] * factor) - width - max(left, 0))
    rows, columns = (max(above, 0), below), (max(left, 0), right)
    return Texture(
        pixels=np.pad(pixels, (rows, columns, (0, 0)), mode="edge"),
        invented=np.pad(mask, (rows, columns), constant_values=True),
    )
