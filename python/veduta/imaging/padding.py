"""What a picture shows of no photo: the flat corners that an earlier rectification left.

A photo that was warped to the plane of its facade is a convex quadrilateral; software fills the
rest of the rectangle with black or one grey. Taken for sky, wall or window, such a corner has the
strongest edges of the whole picture.
"""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

# Steps of each channel that JPEG leaves in a filled corner, and those in the middle of it, where
# it leaves none; the part of a corner that must be of one colour there.
_NEAR = 8
_SAME = 1
_FLAT = 0.9
# Steps between the channels of the colour, which is black or a grey.
_GREY = 1
# Pixels of a JPEG block: as far as the edge of the photo can be seen inside the corner.
_BLOCK = 8
# Lightest colour that corners are filled with: lighter ones are those of a sky that is burnt out.
_LIGHTEST = 240
# Least corner, as a share of the picture; the part of the corners that may be in the convex hull of
# the photo.
_LEAST = 0.001
_DENTED = 0.05
# Depth of the strips along the picture's sides that the photo's tips must reach, as a share.
_TIP = 0.05
# Pixels by which the photo is cut at such a corner, where both are mixed.
_MIXED = 3


def inside_photo(pixels: NDArray[np.uint8]) -> NDArray[np.bool_]:
    """True (h, w) where (h, w, 3) sRGB pixels are of a photo, False in the corners around it.

    Corners are flat, and what they leave is convex and as large as the picture. A sky or a shadow
    is hardly ever the first; the outline of roofs under it is not the second, or not the third.
    """
    everywhere = np.ones(pixels.shape[:2], np.bool_)
    filled = np.zeros(pixels.shape[:2], np.uint8)
    for y in (0, -1):
        for x in (0, -1):
            if not filled[y, x]:
                filled |= _flat_corner(pixels, y, x)
    # JPEG leaves specks of other colours beside the edge of the photo.
    filled = np.pad(filled, _BLOCK, mode="edge")
    closed = cv2.morphologyEx(filled, cv2.MORPH_CLOSE, _square(_BLOCK)) > 0
    closed = closed[_BLOCK:-_BLOCK, _BLOCK:-_BLOCK]
    if not closed.any() or not _fits(~closed):
        return everywhere
    return np.asarray(cv2.dilate(closed.astype(np.uint8), _square(_MIXED)) == 0)


def _flat_corner(pixels: NDArray[np.uint8], y: int, x: int) -> NDArray[np.uint8]:
    """1 where pixels are joined to the corner (y, x) by its colour, 0 everywhere if not flat."""
    nothing = np.zeros(pixels.shape[:2], np.uint8)
    if pixels[y, x].min() >= _LIGHTEST:
        return nothing
    off = cv2.absdiff(pixels, np.full_like(pixels, pixels[y, x])).max(-1)
    _, regions = cv2.connectedComponents((off <= _NEAR).astype(np.uint8), connectivity=4)
    region = (regions == regions[y, x]).astype(np.uint8)
    inner = cv2.erode(region, _square(_BLOCK), borderValue=1) > 0
    if region.sum() < _LEAST * region.size or not inner.any():
        return nothing
    colours = pixels[inner]
    middle = np.median(colours, axis=0)
    same = np.abs(colours - middle).max(-1) <= _SAME
    return region if np.ptp(middle) <= _GREY and same.mean() >= _FLAT else nothing


def _fits(photo: NDArray[np.bool_]) -> bool:
    """Whether a mask (h, w) is convex and reaches all four sides of the picture.

    Next to nothing of what it leaves may be in the convex hull of its pixels, and not beside it.
    """
    if not all(side.any() for side in _sides(photo)):
        return False
    outline = cv2.convexHull(cv2.findNonZero(photo.astype(np.uint8)))
    hull = cv2.fillConvexPoly(np.zeros(photo.shape, np.uint8), outline, (1,)) > 0
    outside = cv2.erode((~photo).astype(np.uint8), _square(_BLOCK), borderValue=1) > 0
    return bool((hull & outside).sum() <= _DENTED * (~photo).sum())


def _sides(photo: NDArray[np.bool_]) -> list[NDArray[np.bool_]]:
    """Strips along the upper, lower, left and right side."""
    high, wide = (max(2 * _BLOCK, round(_TIP * side)) for side in photo.shape)
    return [photo[:high], photo[-high:], photo[:, :wide], photo[:, -wide:]]


def _square(reach: int) -> NDArray[np.uint8]:
    return np.ones((2 * reach + 1, 2 * reach + 1), np.uint8)
