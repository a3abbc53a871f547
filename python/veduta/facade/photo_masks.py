"""Where in the photo things are: boxes and masks of the crop that textures the building."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.facade.document import Element, FacadeDocument, Moulding, Shutter
from veduta.imaging.padding import inside_photo

Mask = NDArray[np.bool_]
# Pixels this close to the source photo's border are mixed with what is beyond it (px).
BORDER_PX = 1.5


@dataclass(frozen=True)
class PixelBox:
    """A box of whole pixels in the rectified photo."""

    x0: int
    y0: int
    x1: int
    y1: int

    @property
    def size(self) -> tuple[int, int]:
        """Width and height."""
        return self.x1 - self.x0, self.y1 - self.y0


def element_mask(document: FacadeDocument, box: PixelBox, wanted: str) -> Mask:
    """The rectangles of all elements of one class."""
    width, height = box.size
    mask = np.zeros((height, width), dtype=np.bool_)
    for element in document.elements:
        if element.class_ == wanted:
            mask[pixels_of(element, box)] = True
    return mask


def extent_mask(document: FacadeDocument, box: PixelBox, wanted: str) -> Mask:
    """Where the extents of one class show and no element stands before them."""
    width, height = box.size
    mask = np.zeros((height, width), dtype=np.uint8)
    for extent in document.extents:
        corners = np.array(extent.polygon_px, dtype=np.float64) - (box.x0, box.y0)
        if len(corners) >= 3:
            painted = 255 if extent.class_ == wanted else 0
            cv2.fillPoly(mask, [np.round(corners).astype(np.int32)], painted)
    for element in document.elements:
        mask[pixels_of(element, box)] = 0
    return mask > 0


def pixels_of(element: Element, box: PixelBox, spread_px: float = 0.0) -> tuple[slice, slice]:
    """Rows and columns of the element in the crop, grown by `spread_px` on each side."""
    width, height = box.size
    x0 = min(max(round(element.x_px - spread_px) - box.x0, 0), width)
    x1 = min(max(round(element.x_px + element.width_px + spread_px) - box.x0, x0), width)
    y0 = min(max(round(element.y_px - spread_px) - box.y0, 0), height)
    y1 = min(max(round(element.y_px + element.height_px + spread_px) - box.y0, y0), height)
    return slice(y0, y1), slice(x0, x1)


def strip_mask(strip: Moulding | Shutter, box: PixelBox, spread_px: int = 0) -> Mask:
    """Where a moulding or a shutter lies in the crop, grown by `spread_px` on each side."""
    mask = np.zeros((box.size[1], box.size[0]), dtype=np.bool_)
    x, y = strip.x_px - box.x0, strip.y_px - box.y0
    x0, y0 = (max(0, round(start) - spread_px) for start in (x, y))
    x1 = max(0, round(x + strip.width_px) + spread_px)
    y1 = max(0, round(y + strip.height_px) + spread_px)
    mask[y0:y1, x0:x1] = True
    return mask


def seen_mask(document: FacadeDocument, box: PixelBox, photo: NDArray[np.uint8]) -> Mask:
    """Where the source photo shows something: rectifying leaves corners that it does not.

    photo: (h, w, 3) uint8 sRGB, the rectified photo; one that came so has the corners in it.
    """
    rectification, source = document.rectification, document.source
    if rectification.method == "rectified":
        return inside_photo(photo)[box.y0 : box.y1, box.x0 : box.x1]
    source_from_rectified = np.linalg.inv(np.array(rectification.rectified_from_source))
    x_px, y_px = np.meshgrid(np.arange(box.x0, box.x1) + 0.5, np.arange(box.y0, box.y1) + 0.5)
    a, b, w = np.einsum(
        "ij,jyx->iyx", source_from_rectified, np.stack([x_px, y_px, np.ones_like(x_px)])
    )
    with np.errstate(divide="ignore", invalid="ignore"):
        x, y = a / w, b / w
    inside: Mask = (x >= BORDER_PX) & (x <= source.width_px - BORDER_PX)
    inside &= (y >= BORDER_PX) & (y <= source.height_px - BORDER_PX)
    # One side of the horizon: the side on which the facade's middle is.
    middle = w[w.shape[0] // 2, w.shape[1] // 2]
    inside &= w * middle > 0.0
    return inside
