"""Where a picture shows the sky: smooth and bright or blue, open to the upper edge, without depth."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.walk.rig import Image


@dataclass(frozen=True)
class SkyLimits:
    """contrast: spread of the light in the window (0..255) below which it is smooth. window_px: its
    side. light: least light of a clouded sky. blue: by how much blue exceeds red in a clear one.
    disparity_px: the sky has none beyond this.
    """

    contrast: float = 7.0
    window_px: int = 9
    light: float = 170.0
    blue: float = 12.0
    disparity_px: float = 3.0


def find_sky(
    image: Image, disparity_px: NDArray[np.float32], limits: SkyLimits = SkyLimits()
) -> NDArray[np.bool_]:
    """(h, w) True in the sky. disparity_px: NaN where none is sure."""
    grey = cv2.cvtColor(image, cv2.COLOR_RGB2GRAY).astype(np.float32)
    side = (limits.window_px, limits.window_px)
    mean = cv2.blur(grey, side)
    spread = np.sqrt(np.maximum(cv2.blur(grey * grey, side) - mean * mean, 0.0))
    colour = image.astype(np.float32)
    bright = mean > limits.light
    blue = (colour[..., 2] - colour[..., 0] > limits.blue) & (mean > 0.5 * limits.light)
    with np.errstate(invalid="ignore"):
        near = disparity_px > limits.disparity_px
    candidate = (spread < limits.contrast) & (bright | blue) & ~near
    count, numbers = cv2.connectedComponents(candidate.astype(np.uint8), connectivity=4)
    open_ones = np.unique(numbers[:2][candidate[:2]])
    sky = np.isin(numbers, open_ones[open_ones > 0]) & candidate
    if count <= 1 or not sky.any():
        return np.zeros(candidate.shape, dtype=np.bool_)
    # Twigs before the sky are not smooth; the window reached as far as its half from its edge.
    grown = cv2.dilate(sky.astype(np.uint8), np.ones((limits.window_px, limits.window_px), np.uint8))
    whole = (grown > 0) & (bright | blue) & (np.abs(grey - mean) < limits.contrast) & ~near
    return np.asarray(whole, dtype=np.bool_)
