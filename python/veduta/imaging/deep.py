"""Photos whose 16-bit files hold fewer bits, as cameras' sensors give: 12 bits are black otherwise.

The upper eight of 16 bits are what a picture is made of elsewhere; of 12-bit values these are the
lowest sixteen greys. Where no value of a file reaches the bits above what a sensor has, the values
are stretched by a power of two: that is the same for all photos of a camera, whatever they show.
"""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray
from PIL import Image, TiffImagePlugin

DEPTHS = (10, 12, 14)
"""Bits of sensors that are stored in 16."""
STRAY_SHARE = 1e-5
"""Share of the values that may lie above: broken pixels."""
_PNG_DEPTH_AT = 24
_BITS_PER_SAMPLE = 258


def stretched(image: Image.Image, data: bytes) -> tuple[Image.Image, tuple[str, ...]]:
    """A loaded image of these bytes with 8 bits that show it, and a note; else as it is.

    Orientation is not touched.
    """
    values = _values(image, data)
    if values is None or not values.any():
        return image, ()
    bits = _bits(values)
    if bits == 16:
        return image, ()
    narrow = np.minimum(values >> (bits - 8), 255).astype(np.uint8)
    found = Image.fromarray(narrow)
    found.info = image.info
    note = f"its 16-bit values use {bits} bits at most: stretched, else the photo is nearly black"
    return found, (note,)


def _bits(values: NDArray[np.uint16]) -> int:
    for bits in DEPTHS:
        if np.count_nonzero(values >= 1 << bits) <= STRAY_SHARE * values.size:
            return bits
    return 16


def _values(image: Image.Image, data: bytes) -> NDArray[np.uint16] | None:
    """(h, w) or (h, w, 3) 16-bit values; None where the file has others."""
    if image.mode.startswith("I;16"):
        return np.asarray(image).astype(np.uint16)
    if image.mode != "RGB" or not _is_deep(image, data):
        return None
    read = cv2.imdecode(np.frombuffer(data, np.uint8), cv2.IMREAD_UNCHANGED)
    width, height = image.size
    if read is None or read.dtype != np.uint16 or read.shape != (height, width, 3):
        return None
    return np.asarray(read[:, :, ::-1], dtype=np.uint16)


def _is_deep(image: Image.Image, data: bytes) -> bool:
    if isinstance(image, TiffImagePlugin.TiffImageFile):
        bits = image.tag_v2.get(_BITS_PER_SAMPLE, ())
        return 16 in (bits if isinstance(bits, tuple) else (bits,))
    return image.format == "PNG" and len(data) > _PNG_DEPTH_AT and data[_PNG_DEPTH_AT] == 16
