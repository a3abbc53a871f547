"""From whatever a file stores to 8-bit sRGB on white."""

from __future__ import annotations

import io
from concurrent.futures import ThreadPoolExecutor

import cv2
import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageCms

DIRECT_MODES = frozenset({"1", "L", "P", "PA", "LA", "La", "RGB", "RGBA", "RGBa", "RGBX"})
DEEP_MODES = frozenset({"I;16", "I;16L", "I;16B", "I;16N"})
"""16-bit grey. Pillow hands 16-bit colour over as the upper eight bits already."""
OTHER_MODES = frozenset({"CMYK", "YCbCr", "LAB"})
READABLE_MODES = DIRECT_MODES | DEEP_MODES | OTHER_MODES

STRIP_PX = 1 << 21
"""Pixels that are turned at once: each step in between would copy a drawing of 100 megapixels."""
STRIPS_AT_ONCE = 2
"""Pillow, OpenCV and numpy let other threads go on while they turn a strip."""


def srgb_on_white(image: Image.Image) -> tuple[NDArray[np.uint8], tuple[str, ...]]:
    """(h, w, 3) uint8 sRGB of a loaded image in one of READABLE_MODES, and notes.

    An embedded colour profile is applied; where it is broken the note says so and the values are
    taken as sRGB.
    """
    width, height = image.size
    rows = max(1, STRIP_PX // width)
    pixels = np.empty((height, width, 3), dtype=np.uint8)

    def turn(top: int) -> tuple[str, ...]:
        bottom = min(top + rows, height)
        pixels[top:bottom], notes = _turned(image.crop((0, top, width, bottom)))
        return notes

    with ThreadPoolExecutor(STRIPS_AT_ONCE) as threads:
        notes = [*threads.map(turn, range(0, height, rows))]
    return pixels, notes[-1] if notes else ()


def _turned(image: Image.Image) -> tuple[NDArray[np.uint8], tuple[str, ...]]:
    """As `srgb_on_white`, of a strip; the notes on a profile are the same for each strip."""
    if image.mode in DEEP_MODES:
        grey = (np.asarray(image).astype(np.uint16) >> 8).astype(np.uint8)
        return np.repeat(grey[:, :, None], 3, axis=2), ()
    image, alpha = _split_alpha(image)
    image, notes = _apply_profile(image)
    pixels = np.array(image if image.mode == "RGB" else image.convert("RGB"), dtype=np.uint8)
    if alpha is not None:
        pixels = _composite_on_white(pixels, alpha)
    return pixels, notes


def _split_alpha(image: Image.Image) -> tuple[Image.Image, NDArray[np.uint8] | None]:
    """The colours without alpha, and the alpha channel where the image has transparency."""
    profile = image.info.get("icc_profile")
    alpha: NDArray[np.uint8] | None = None
    if image.mode in {"RGBa", "La"}:
        image = image.convert(image.mode.upper())
    if image.mode not in OTHER_MODES and image.has_transparency_data:
        image = image if image.mode == "RGBA" else image.convert("RGBA")
        alpha = np.array(image.getchannel("A"), dtype=np.uint8)
    if image.mode not in OTHER_MODES | {"L", "RGB"}:
        image = image.convert("RGB")
    if profile is not None:
        image.info["icc_profile"] = profile
    return image, alpha


def _apply_profile(image: Image.Image) -> tuple[Image.Image, tuple[str, ...]]:
    """The image in sRGB by its embedded ICC profile; unchanged where there is none."""
    data = image.info.get("icc_profile")
    if not data:
        return image, ()
    try:
        profile = ImageCms.ImageCmsProfile(io.BytesIO(data))
        if "sRGB" in ImageCms.getProfileDescription(profile):
            return image, ()
        srgb = ImageCms.createProfile("sRGB")
        converted = ImageCms.profileToProfile(image, profile, srgb, outputMode="RGB")
    except (ImageCms.PyCMSError, OSError, ValueError, TypeError):
        return image, ("the embedded colour profile cannot be used: colours taken as sRGB",)
    return (image if converted is None else converted), ()


def _composite_on_white(pixels: NDArray[np.uint8], alpha: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """In place. What is neither clear nor opaque alone is mixed: drawings have 100 megapixels."""
    clear = (alpha == 0) * np.uint8(255)
    cv2.bitwise_or(pixels, cv2.merge((clear, clear, clear)), pixels)
    partly = (alpha - np.uint8(1)) < 254  # zero wraps round to 255
    weight = alpha[partly].astype(np.uint16)[:, None]
    pixels[partly] = (pixels[partly] * weight + 255 * (255 - weight) + 127) // 255
    return pixels
