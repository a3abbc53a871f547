"""The depths of a view, and how far they can be trusted."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True, eq=False)
class DepthMap:
    """What a view shows, pixel by pixel.

    depths_m: (h, w) float32, along the camera's z, NaN where unknown. normals: (h * w, 3) float32,
    unit, towards the camera, in its frame. confidence: (h, w) float32, 0 to 1. agree: (h, w) uint8,
    how many other views show the same depth.
    """

    depths_m: NDArray[np.float32]
    normals: NDArray[np.float32]
    confidence: NDArray[np.float32]
    agree: NDArray[np.uint8]

    @property
    def known(self) -> NDArray[np.bool_]:
        """(h, w) where a depth is known."""
        return np.isfinite(self.depths_m)
