"""Features of a picture: found once, however many others it is matched with."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class FeatureSettings:
    """most: of each picture. contrast: below it a feature is none (OpenCV's SIFT, Lowe 2004)."""

    most: int = 4000
    contrast: float = 0.02


@dataclass(frozen=True, eq=False)
class Features:
    """pixels: (n, 2) px. described: (n, 128) float32 unit vectors (RootSIFT, Arandjelovic 2012)."""

    pixels: NDArray[np.float64]
    described: NDArray[np.float32]


def find_features(
    grey: NDArray[np.float32], sky: NDArray[np.bool_], settings: FeatureSettings = FeatureSettings()
) -> Features:
    """Those of a picture (h, w), 0..255, outside of its sky; their detector has its own scales."""
    detector = cv2.SIFT.create(settings.most, contrastThreshold=settings.contrast)
    mask = (~sky).astype(np.uint8) * 255
    found, described = detector.detectAndCompute(grey.astype(np.uint8), mask)
    pixels = np.array([one.pt for one in found], dtype=np.float64).reshape(-1, 2) + 0.5
    if not len(found):
        return Features(pixels, np.zeros((0, 128), dtype=np.float32))
    whole = np.maximum(described.sum(axis=1, keepdims=True), 1e-6)
    return Features(pixels, np.sqrt(described / whole))
