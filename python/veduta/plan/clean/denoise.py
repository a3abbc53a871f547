"""Specks and noise of scanners and cameras taken out of a drawing, before it is looked at.

A drawing repeats itself: paper, strokes and corners look alike all over it. Non-local means
(Buades, Coll and Morel 2005) averages over what looks alike, so that noise goes and thin lines
stay.
"""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

NOISY = 0.03
"""Standard deviation of the noise, as a share of the sheet's range of greys, that counts."""

PATCH_PX, SEARCH_PX = 5, 11
"""Patches of this side are compared, in windows of that side."""

STRENGTH = 2.0
"""How far patches that are averaged may differ, in standard deviations of the noise as measured on
paper: on white paper half of it is cut off, in grey walls it is not."""

MANY_PX = 12_000_000
"""Larger sheets stay as they are: it would take long, and their lines are broad."""


SPECK, SPECK_PX = 60, 2
"""So many grey levels off what is around it, and of so many pixels at most, is a speck ..."""

SPECKLED, TILES = 0.003, 8
"""... where most tiles (so many a side) have this share of them: dots in walls are a drawing."""


def noise_of(pixels: NDArray[np.uint8]) -> float:
    """The standard deviation of the noise of (h, w, 3) sRGB pixels, in grey levels.

    That of the noisiest channel (Immerkaer 1996), by the median, as lines are no noise.
    """
    kernel = np.array([[1, -2, 1], [-2, 4, -2], [1, -2, 1]], dtype=np.float32)
    bent = np.abs(cv2.filter2D(pixels, cv2.CV_32F, kernel))
    return max(float(np.median(bent[..., channel])) for channel in range(3)) / (6 * 0.6745)


def denoised(pixels: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """(h, w, 3) sRGB pixels without specks and noise; the same where few are, or where many are."""
    if pixels.shape[0] * pixels.shape[1] > MANY_PX:
        return pixels
    pixels = _despeckled(pixels)
    noise = noise_of(pixels)
    low, high = np.percentile(pixels[::3, ::3], (1, 99))
    if noise <= NOISY * max(1.0, high - low):
        return pixels
    strength = STRENGTH * noise
    return np.asarray(
        cv2.fastNlMeansDenoising(pixels, None, strength, PATCH_PX, SEARCH_PX), np.uint8
    )


def _despeckled(pixels: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """Black specks on paper and white ones in ink get the median of what is around them."""
    grey = cv2.cvtColor(pixels, cv2.COLOR_RGB2GRAY)
    odd = (cv2.absdiff(grey, cv2.medianBlur(grey, 3)) > SPECK).view(np.uint8)
    _, labels, stats, _ = cv2.connectedComponentsWithStats(odd, connectivity=8)
    small = stats[:, cv2.CC_STAT_AREA] <= SPECK_PX
    small[0] = False
    specks = small[labels]
    shares = cv2.resize(specks.astype(np.float32), (TILES, TILES), interpolation=cv2.INTER_AREA)
    if np.median(shares) < SPECKLED:
        return pixels
    return np.where(specks[..., None], cv2.medianBlur(pixels, 3), pixels)
