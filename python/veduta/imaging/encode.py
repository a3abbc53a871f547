"""Pixels as the bytes of a file."""

from __future__ import annotations

import io

import numpy as np
from numpy.typing import NDArray
from PIL import Image

Pixels = Image.Image | NDArray[np.uint8]
"""An image, or (h, w) grey or (h, w, 3) sRGB values."""


def jpeg_bytes(
    pixels: Pixels, quality: int, *, optimize: bool = False, subsampling: int = -1
) -> bytes:
    """A JPEG file. subsampling: 0 keeps the colour of each pixel; -1 is as the encoder has it."""
    file = io.BytesIO()
    image = _image(pixels)
    image.save(file, "JPEG", quality=quality, optimize=optimize, subsampling=subsampling)
    return file.getvalue()


def png_bytes(pixels: Pixels, *, optimize: bool = False, compress_level: int = -1) -> bytes:
    """A PNG file. compress_level: 0 to 9; -1 is as the encoder has it."""
    file = io.BytesIO()
    _image(pixels).save(file, "PNG", optimize=optimize, compress_level=compress_level)
    return file.getvalue()


def mask_bytes(white: NDArray[np.bool_]) -> bytes:
    """A PNG file of a bit per pixel: (h, w) True is white."""
    return png_bytes(Image.fromarray(white.astype(np.uint8) * 255).convert("1"))


def _image(pixels: Pixels) -> Image.Image:
    return pixels if isinstance(pixels, Image.Image) else Image.fromarray(pixels)
