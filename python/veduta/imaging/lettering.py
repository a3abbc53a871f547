"""Text on pictures, in OpenCV's own font: Pillow's has no letters with accents."""

from __future__ import annotations

from typing import Literal

import cv2
import numpy as np
from PIL import Image, ImageDraw

Rgb = tuple[int, int, int]
Anchor = Literal["middle", "left"]

_CAPITALS = 0.72
"""Height of capital letters, as a part of the font's size."""


def text_width(text: str, size_px: int) -> float:
    """How wide a line of text is, in pixels."""
    face = cv2.FontFace("sans")
    return float(cv2.getTextSize((0, 0), text, (0, 0), face, size_px, 400)[2])


def write(
    pen: ImageDraw.ImageDraw,
    at: tuple[float, float],
    text: str,
    size_px: int,
    colour: Rgb,
    *,
    anchor: Anchor = "middle",
    halo: Rgb | None = None,
    halo_px: int = 3,
) -> None:
    """Write a line of text about a place, or from a place at its upper left on.

    halo: the colour of a rim that keeps it legible on any drawing.
    """
    if not text:
        return
    pad = size_px
    width = round(text_width(text, size_px)) + 2 * pad
    mask = np.zeros((3 * size_px, width, 3), np.uint8)
    face = cv2.FontFace("sans")
    cv2.putText(mask, text, (pad, 2 * size_px), (255, 255, 255), face, size_px, 400)
    letters = np.ascontiguousarray(mask[..., 0])
    left = at[0] - (width / 2 if anchor == "middle" else pad)
    middle = 2 * size_px - _CAPITALS * size_px / 2
    top = at[1] - middle + (size_px / 2 if anchor == "left" else 0.0)
    place = (round(left), round(top))
    if halo is not None:
        reach = 2 * halo_px + 1
        disc = cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (reach, reach))
        pen.bitmap(place, Image.fromarray(cv2.dilate(letters, disc)), fill=halo)
    pen.bitmap(place, Image.fromarray(letters), fill=colour)
