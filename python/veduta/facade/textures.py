"""The texture of a facade: one atlas with two layers of the rectified photo.

The first layer is the photo as it is. In the second, what stands before the wall and the roof
(balconies, chimneys, sky beside the roof) is replaced by synthesised pixels and marked as
invented: a railing is shown once, on the railing, and not again on the wall behind it.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil, floor

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.facade.document import FacadeDocument
from veduta.facade.photo_masks import (
    Mask,
    PixelBox,
    element_mask,
    extent_mask,
    pixels_of,
    seen_mask,
)
from veduta.place.builder import UvMap
from veduta.place.material import Colour, Texture

# Longest edge of the atlas (px).
LONGEST_PX = 4096
# A balcony's pixels spread beyond its rectangle by this share of its height (shadow, handrail).
BALCONY_SPREAD = 0.08

# Colours where the photo shows none of a class.
_STONE: Colour = (0.78, 0.73, 0.65)
_SLATE: Colour = (0.30, 0.33, 0.37)
_IRON: Colour = (0.12, 0.12, 0.13)
_BRICK: Colour = (0.55, 0.36, 0.29)

Pixels = NDArray[np.uint8]


@dataclass(frozen=True)
class Colours:
    """The typical (median) colour of each class in the photo, sRGB 0..1."""

    wall: Colour
    roof: Colour
    balcony: Colour
    chimney: Colour


@dataclass(frozen=True)
class Atlas:
    """The texture, and where metres of the facade lie in it."""

    texture: Texture
    photo_uv: UvMap
    surface_uv: UvMap
    colours: Colours


def make_atlas(document: FacadeDocument, photo: Pixels, top_m: float) -> Atlas:
    """Cut the facade up to `top_m` above the ground out of the photo and lay out both layers.

    photo: (h, w, 3) uint8 sRGB, the rectified photo of the document.
    """
    box = _crop_box(document, photo, top_m)
    crop = photo[box.y0 : box.y1, box.x0 : box.x1].copy()
    unseen = ~seen_mask(document, box)
    colours = _colours(document, crop, box, ~unseen)
    _fill_unseen(document, crop, box, unseen, colours)
    surface, invented = _surface_layer(document, crop, box, colours.roof)
    side_by_side = box.size[1] > box.size[0]
    axis = 1 if side_by_side else 0
    pixels = np.concatenate([crop, surface], axis=axis)
    mask = np.concatenate([unseen, invented | unseen], axis=axis)
    step = (0.5, 0.0) if side_by_side else (0.0, 0.5)
    return Atlas(
        texture=_shrunk(pixels, mask),
        photo_uv=_uv_map(document, box, (0.0, 0.0), side_by_side),
        surface_uv=_uv_map(document, box, step, side_by_side),
        colours=colours,
    )


def _crop_box(document: FacadeDocument, photo: Pixels, top_m: float) -> PixelBox:
    facade = document.facade
    scale = document.scale.metres_per_px
    height, width = photo.shape[:2]
    bottom = facade.y_px + facade.height_px
    x0 = min(max(floor(facade.x_px), 0), width - 1)
    y0 = min(max(floor(bottom - top_m / scale), 0), height - 1)
    x1 = min(max(ceil(facade.x_px + facade.width_px), x0 + 1), width)
    y1 = min(max(ceil(bottom), y0 + 1), height)
    return PixelBox(x0, y0, x1, y1)


def _uv_map(
    document: FacadeDocument, box: PixelBox, start: tuple[float, float], side_by_side: bool
) -> UvMap:
    """Metres (x, any y, z) to UV of one layer; what lies outside of it takes its border."""
    scale = document.scale.metres_per_px
    facade = document.facade
    width, height = box.size
    share = np.array([0.5, 1.0] if side_by_side else [1.0, 0.5])

    def to_uv(points_m: NDArray[np.float64]) -> NDArray[np.float64]:
        x_px = facade.x_px + points_m[:, 0] / scale - box.x0
        y_px = facade.y_px + facade.height_px - points_m[:, 2] / scale - box.y0
        u = np.clip(x_px, 0.5, width - 0.5) / width
        v = np.clip(y_px, 0.5, height - 0.5) / height
        uv: NDArray[np.float64] = np.stack([u, v], axis=1) * share + np.array(start)
        return uv

    return to_uv


def _colours(document: FacadeDocument, crop: Pixels, box: PixelBox, seen: Mask) -> Colours:
    return Colours(
        wall=_typical(crop, extent_mask(document, box, "wall") & seen, _STONE),
        roof=_typical(crop, extent_mask(document, box, "roof") & seen, _SLATE),
        balcony=_typical(crop, element_mask(document, box, "balcony") & seen, _IRON),
        chimney=_typical(crop, element_mask(document, box, "chimney") & seen, _BRICK),
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


def _surface_layer(
    document: FacadeDocument, crop: Pixels, box: PixelBox, roof: Colour
) -> tuple[Pixels, Mask]:
    """The photo without what stands before wall and roof, and the mask of invented pixels."""
    surface = crop.copy()
    invented = extent_mask(document, box, "sky") | element_mask(document, box, "chimney")
    surface[invented] = np.round(np.array(roof) * 255.0).astype(np.uint8)
    balconies = [element for element in document.elements if element.class_ == "balcony"]
    for element in sorted(balconies, key=lambda balcony: balcony.y_px):
        rows, columns = pixels_of(element, box, BALCONY_SPREAD * element.height_px)
        _mirror_into(surface, rows, columns)
        invented[rows, columns] = True
    return surface, invented


def _mirror_into(surface: Pixels, rows: slice, columns: slice) -> None:
    """Fill rows by those above them, mirrored at their upper edge (below, at the image's top)."""
    count = rows.stop - rows.start
    above, below = rows.start, surface.shape[0] - rows.stop
    if count <= 0 or max(above, below) == 0:
        return
    offsets = np.arange(count)
    if above >= min(count, below):
        source = rows.start - 1 - np.minimum(offsets, above - 1)
    else:
        source = rows.stop + np.minimum(offsets[::-1], below - 1)
    surface[rows, columns] = surface[source, columns]


def _shrunk(pixels: Pixels, mask: Mask) -> Texture:
    """At most `LONGEST_PX` on the long edge."""
    height, width = mask.shape
    factor = min(1.0, LONGEST_PX / max(height, width))
    if factor == 1.0:
        return Texture(pixels=pixels, invented=mask)
    size = (max(1, round(width * factor)), max(1, round(height * factor)))
    small = cv2.resize(pixels, size, interpolation=cv2.INTER_AREA)
    part = cv2.resize(mask.astype(np.uint8) * 255, size, interpolation=cv2.INTER_AREA)
    return Texture(pixels=np.asarray(small, dtype=np.uint8), invented=part > 0)
