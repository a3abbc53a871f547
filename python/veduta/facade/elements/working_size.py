"""Pictures at the size that the detectors were made for."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

LEAST_PX = 16


@dataclass(frozen=True)
class Small:
    """pixels (h, w, 3) uint8, and boxes (n, 4) between them and the picture that they show."""

    pixels: NDArray[np.uint8]
    across: float
    down: float

    @property
    def size(self) -> tuple[int, int]:
        """Width and height."""
        return self.pixels.shape[1], self.pixels.shape[0]

    def in_picture(self, boxes: NDArray[np.float64]) -> NDArray[np.float64]:
        """Boxes of the small pixels in those of the picture."""
        return boxes * (self.across, self.down, self.across, self.down)


def at_working_size(pixels: NDArray[np.uint8], long_px: int) -> Small:
    """(h, w, 3) uint8 sRGB pixels with a longer side of `long_px`."""
    scale = long_px / max(pixels.shape[:2])
    size = tuple(max(LEAST_PX, round(side * scale)) for side in pixels.shape[1::-1])
    way = cv2.INTER_AREA if scale < 1.0 else cv2.INTER_CUBIC
    small = np.asarray(cv2.resize(pixels, size, interpolation=way), np.uint8)
    return Small(small, pixels.shape[1] / size[0], pixels.shape[0] / size[1])


def segments_of(
    small: NDArray[np.uint8], sigma_px: float, segment_k: float, least_px: int
) -> NDArray[np.intp]:
    """(h, w) the number of the segment of each of (h, w, 3) uint8 sRGB pixels.

    Felzenszwalb and Huttenlocher 2004: how far it is smoothed, the preference for large segments,
    and the smallest area.
    """
    cut = cv2.ximgproc.segmentation.createGraphSegmentation(sigma_px, segment_k, least_px)
    return np.asarray(cut.processImage(small[..., ::-1].copy()), np.intp)
