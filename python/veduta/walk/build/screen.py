"""The image surface of a local model: which ray each of its pixels is, and where a point lies on it."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from veduta.walk.rig import Rig

Points = NDArray[np.float64]
BESIDE_RAD = 0.6
"""How far beyond the edge of a cylinder's picture a point still has a place on it."""

BEHIND_RAD = 3.12
"""Beyond it a point is behind, however wide the picture is."""


@dataclass(frozen=True)
class Screen:
    """A plane before the camera, or a cylinder around it (its axis is the camera's y).

    Camera frame: x right, y down, z forward; pixel centres at .5. focal_px: along x and y.
    centre_px: principal point; on a cylinder the x of the direction z. Depth is along z on a plane,
    and the distance from the axis on a cylinder.
    """

    width_px: int
    height_px: int
    focal_px: tuple[float, float]
    centre_px: tuple[float, float]
    round: bool = False

    @staticmethod
    def of(rig: Rig) -> Screen:
        """The left camera's."""
        return Screen(rig.width_px, rig.height_px, rig.focal_px, rig.centre_px)

    @property
    def matrix(self) -> NDArray[np.float64]:
        """(3, 3) camera matrix of a plane."""
        (fx, fy), (cx, cy) = self.focal_px, self.centre_px
        return np.array([[fx, 0.0, cx], [0.0, fy, cy], [0.0, 0.0, 1.0]])

    @cached_property
    def pixels(self) -> NDArray[np.float32]:
        """(h, w, 2) the centre of each pixel."""
        x, y = np.meshgrid(np.arange(self.width_px) + 0.5, np.arange(self.height_px) + 0.5)
        return np.stack([x, y], axis=-1).astype(np.float32)

    def points(self, pixels: NDArray[np.floating], depth_m: NDArray[np.floating]) -> Points:
        """(..., 3) in the camera's frame, of (..., 2) pixels at a depth."""
        x = (pixels[..., 0] - self.centre_px[0]) / self.focal_px[0]
        y = (pixels[..., 1] - self.centre_px[1]) / self.focal_px[1]
        depth = np.asarray(depth_m, dtype=np.float64)
        if self.round:
            return np.stack([np.sin(x) * depth, y * depth, np.cos(x) * depth], axis=-1)
        return np.stack([x * depth, y * depth, depth], axis=-1)

    def project(self, points: Points) -> tuple[Points, NDArray[np.float64]]:
        """(..., 2) pixels and (...) depth of points in the camera's frame; NaN behind it."""
        if self.round:
            across, depth = self._around(points)
        else:
            depth = points[..., 2]
            across = points[..., 0] / np.where(depth > 1e-6, depth, np.nan)
        ahead = np.where(depth > 1e-6, depth, np.nan)
        x = across * self.focal_px[0] + self.centre_px[0]
        y = points[..., 1] / ahead * self.focal_px[1] + self.centre_px[1]
        return np.stack([x, y], axis=-1), depth

    def _around(self, points: Points) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Angle about the axis and distance from it; negative far beside the picture, so that no
        triangle reaches around behind the camera."""
        angle = np.arctan2(points[..., 0], points[..., 2])
        depth = np.hypot(points[..., 0], points[..., 2])
        left = -self.centre_px[0] / self.focal_px[0]
        right = (self.width_px - self.centre_px[0]) / self.focal_px[0]
        first, last = max(left - BESIDE_RAD, -BEHIND_RAD), min(right + BESIDE_RAD, BEHIND_RAD)
        beside = (angle < first) | (angle > last)
        return angle, np.where(beside, -1.0, depth)
