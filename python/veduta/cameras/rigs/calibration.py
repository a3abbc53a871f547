"""The calibration of two cameras side by side, as it was measured."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

SLACK = 0.01
"""KITTI calls rectified what is this share of the baseline off its row in millimetres."""


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
