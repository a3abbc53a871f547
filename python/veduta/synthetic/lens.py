"""How a lens bends: radial and tangential terms (Brown, 1966), as OpenCV and COLMAP have them.

Coordinates are those of the plane one unit in front of the camera: x / z and y / z.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

Points = NDArray[np.float64]
_UNTIL = (cv2.TERM_CRITERIA_COUNT | cv2.TERM_CRITERIA_EPS, 40, 1e-12)


@dataclass(frozen=True)
class Distortion:
    """Radial terms k1 and k2, tangential p1 and p2; all zero is a pinhole.

    aspect: height of a pixel's focal length over its width's, fy / fx.
    """

    k1: float = 0.0
    k2: float = 0.0
    p1: float = 0.0
    p2: float = 0.0
    aspect: float = 1.0

    @property
    def is_none(self) -> bool:
        """Whether straight lines stay straight."""
        return not (self.k1 or self.k2 or self.p1 or self.p2)

    def bent(self, straight: Points) -> Points:
        """(n, 2) where a lens shows what a pinhole would show at (n, 2)."""
        return straight + self._shift(straight)

    def straight(self, bent: Points) -> Points:
        """(n, 2) the inverse of `bent`, by a fixed point, within 1e-10 for lenses of cameras."""
        if self.is_none or len(bent) == 0:
            return bent
        terms = np.array([self.k1, self.k2, self.p1, self.p2])
        found = cv2.undistortPoints(bent[:, None], np.eye(3), terms, criteria=_UNTIL)
        return np.asarray(found[:, 0], np.float64)

    def _shift(self, at: Points) -> Points:
        x, y = at[..., 0], at[..., 1]
        r2 = x * x + y * y
        radial = self.k1 * r2 + self.k2 * r2 * r2
        return np.stack(
            [
                x * radial + 2 * self.p1 * x * y + self.p2 * (r2 + 2 * x * x),
                y * radial + 2 * self.p2 * x * y + self.p1 * (r2 + 2 * y * y),
            ],
            axis=-1,
        )


NO_DISTORTION = Distortion()
