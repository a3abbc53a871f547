"""The image plane of a local model: which ray each of its pixels is, and where a point lies on it."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from veduta.walk.rig import Rig

Points = NDArray[np.float64]


@dataclass(frozen=True)
class Screen:
    """A plane before the camera. Camera frame: x right, y down, z forward; pixel centres at .5.

    focal_px: along x and y. centre_px: principal point.
    """

    width_px: int
    height_px: int
    focal_px: tuple[float, float]
    centre_px: tuple[float, float]

    @staticmethod
    def of(rig: Rig) -> Screen:
        """The left camera's."""
        return Screen(rig.width_px, rig.height_px, rig.focal_px, rig.centre_px)

    @property
    def matrix(self) -> NDArray[np.float64]:
        """(3, 3) camera matrix."""
        (fx, fy), (cx, cy) = self.focal_px, self.centre_px
        return np.array([[fx, 0.0, cx], [0.0, fy, cy], [0.0, 0.0, 1.0]])

    @cached_property
    def pixels(self) -> NDArray[np.float32]:
        """(h, w, 2) the centre of each pixel."""
        x, y = np.meshgrid(np.arange(self.width_px) + 0.5, np.arange(self.height_px) + 0.5)
        return np.stack([x, y], axis=-1).astype(np.float32)

    def points(self, pixels: NDArray[np.floating], depth_m: NDArray[np.floating]) -> Points:
        """(..., 3) in the camera's frame, of (..., 2) pixels at a depth along z."""
        x = (pixels[..., 0] - self.centre_px[0]) / self.focal_px[0]
        y = (pixels[..., 1] - self.centre_px[1]) / self.focal_px[1]
        depth = np.asarray(depth_m, dtype=np.float64)
        return np.stack([x * depth, y * depth, depth], axis=-1)

    def project(self, points: Points) -> tuple[Points, NDArray[np.float64]]:
        """(..., 2) pixels and (...) depth of points in the camera's frame; NaN behind it."""
        depth = points[..., 2]
        ahead = np.where(depth > 1e-6, depth, np.nan)
        x = points[..., 0] / ahead * self.focal_px[0] + self.centre_px[0]
        y = points[..., 1] / ahead * self.focal_px[1] + self.centre_px[1]
        return np.stack([x, y], axis=-1), depth
