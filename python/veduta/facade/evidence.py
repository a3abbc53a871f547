"""What the steps look at: colours and gradients of the rectified image, at analysis resolution."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

Float = NDArray[np.float32]

# Windows of a ten-storey facade still have ten pixels at this height, and the chains stay fast.
LONG_EDGE_PX = 720


@dataclass(frozen=True)
class Evidence:
    """The rectified image at analysis resolution, in the pixel frame of the document.

    `lab` (h, w, 3) is CIE Lab in OpenCV's 0..255 scaling, `gx` and `gy` (h, w) are the derivatives
    of its lightness per pixel, `valid` (h, w) is false where the rectified image has no photo.
    """

    px_per_rectified: float
    lab: Float
    gx: Float
    gy: Float
    valid: NDArray[np.bool_]

    @property
    def height(self) -> int:
        """Rows at analysis resolution."""
        return int(self.lab.shape[0])

    @property
    def width(self) -> int:
        """Columns at analysis resolution."""
        return int(self.lab.shape[1])


def gather(pixels: NDArray[np.uint8], valid: NDArray[np.bool_]) -> Evidence:
    """Bring (h, w, 3) uint8 sRGB pixels to analysis resolution and take their derivatives."""
    scale = min(1.0, LONG_EDGE_PX / max(pixels.shape[:2]))
    if scale < 1.0:
        size = (round(pixels.shape[1] * scale), round(pixels.shape[0] * scale))
        pixels = cv2.resize(pixels, size, interpolation=cv2.INTER_AREA).astype(np.uint8)
        small = cv2.resize(valid.astype(np.uint8), size, interpolation=cv2.INTER_NEAREST)
        valid = small.astype(bool)
    lab = cv2.cvtColor(pixels, cv2.COLOR_RGB2LAB).astype(np.float32)
    lightness = cv2.GaussianBlur(lab[:, :, 0], (0, 0), 0.8)
    inner = cv2.erode(valid.astype(np.uint8), np.ones((5, 5), np.uint8), borderValue=1)
    gx, gy = (
        (cv2.Sobel(lightness, cv2.CV_32F, dx, 1 - dx, ksize=3) / 8 * inner).astype(np.float32)
        for dx in (1, 0)
    )
    return Evidence(scale, lab, gx, gy, valid)


def blur(image: NDArray[np.floating], sigma_x: float, sigma_y: float) -> Float:
    """Gaussian blur with a spread per axis (pixels); zero leaves that axis as it is."""
    return cv2.GaussianBlur(
        np.asarray(image, np.float32), (0, 0), sigmaX=max(sigma_x, 1e-3), sigmaY=max(sigma_y, 1e-3)
    ).astype(np.float32)


def blur_line(values: NDArray[np.floating], sigma: float) -> Float:
    """Gaussian blur of a profile (n,)."""
    return blur(np.asarray(values, np.float32).reshape(1, -1), sigma, 0.0).ravel()


def two_class_threshold(values: NDArray[np.floating]) -> float:
    """The value that parts `values` (n,) best into low and high (Otsu 1979)."""
    low_end, high_end = float(values.min()), float(values.max())
    if high_end - low_end < 1e-6:
        return high_end
    counts, edges = np.histogram(values, 64, (low_end, high_end))
    centres = (edges[1:] + edges[:-1]) / 2
    low = np.cumsum(counts)
    mass = np.cumsum(counts * centres)
    spread = (mass[-1] * low / low[-1] - mass) ** 2 / np.maximum(low * (low[-1] - low), 1e-9)
    return float(centres[int(np.argmax(spread))])
