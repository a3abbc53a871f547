"""The rig of two cameras side by side, and the pairs of pictures that it took."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

Image = NDArray[np.uint8]
"""(h, w, 3) sRGB."""


@dataclass(frozen=True)
class Rig:
    """Two cameras as they are after rectification: parallel, side by side, of one focal length.

    focal_px: along x and y. centre_px: principal point of the left camera, and centre_right_px the
    x of the right one's; pixel centres are at (0.5, 0.5). baseline_m: from the left to the right.
    """

    width_px: int
    height_px: int
    focal_px: tuple[float, float]
    centre_px: tuple[float, float]
    baseline_m: float
    centre_right_px: float | None = None

    @property
    def matrix(self) -> NDArray[np.float64]:
        """(3, 3) of the left camera."""
        (fx, fy), (cx, cy) = self.focal_px, self.centre_px
        return np.array([[fx, 0.0, cx], [0.0, fy, cy], [0.0, 0.0, 1.0]])

    @property
    def shift_px(self) -> float:
        """What the disparity of a point at infinity is."""
        right = self.centre_px[0] if self.centre_right_px is None else self.centre_right_px
        return self.centre_px[0] - right

    def depth_m(self, disparity_px: NDArray[np.floating]) -> NDArray[np.float64]:
        """Depth of disparities (left x minus right x); NaN where there is none."""
        seen = disparity_px - self.shift_px
        with np.errstate(divide="ignore", invalid="ignore"):
            depth = self.focal_px[0] * self.baseline_m / seen
        return np.where(seen > 0.0, depth, np.nan)


@dataclass(frozen=True)
class PairFiles:
    """The two pictures of a view. key: the position where it was taken; view: which one there."""

    key: str
    view: str
    left: Path
    right: Path


@dataclass(frozen=True, eq=False)
class StereoPair:
    """A rectified pair. left, right: (h, w, 3) uint8 sRGB, of the rig's size."""

    key: str
    view: str
    left: Image
    right: Image
