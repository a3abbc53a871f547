"""The rig of two cameras side by side, and the pairs of pictures that it took."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

Image = NDArray[np.uint8]
"""(h, w, 3) sRGB."""
SLACK = 0.01
"""KITTI calls rectified what is this share of the baseline off its row in millimetres."""


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
class RigCalibration:
    """A rig as it was calibrated, before rectification.

    size_px: width and height that the calibration is for; None: whatever the pictures have.
    left, right: (3, 3) camera matrices, pixel centres at (0.5, 0.5). distortion_left, _right:
    OpenCV's k1 k2 p1 p2 k3 ..., empty for none. right_from_left: (3, 4), metres; source: the file.
    """

    source: Path
    left: NDArray[np.float64]
    right: NDArray[np.float64]
    right_from_left: NDArray[np.float64]
    distortion_left: tuple[float, ...] = ()
    distortion_right: tuple[float, ...] = ()
    size_px: tuple[int, int] | None = None

    @property
    def is_rectified(self) -> bool:
        """Whether pictures of this rig are rectified already."""
        turn, move = self.right_from_left[:, :3], self.right_from_left[:, 3]
        straight = np.abs(turn - np.eye(3)).max() < 1e-9 and np.abs(move[1:]).max() < SLACK * abs(
            move[0]
        )
        same = np.abs((self.left - self.right)[:, [0, 1]]).max() < 1e-6
        level = abs(self.left[1, 2] - self.right[1, 2]) < 1e-6
        undistorted = not any((*self.distortion_left, *self.distortion_right))
        return bool(straight and same and level and undistorted and move[0] < 0.0)


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
