"""A photo with its camera and the silhouette of the object: what carving starts from."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Literal

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.cameras import Camera

Floats = NDArray[np.float64]
Pixels = NDArray[np.uint8]
Mask = NDArray[np.bool_]
Source = Literal["mask", "background"]


@dataclass(frozen=True, eq=False)
class View:
    """camera: without distortion. pixels: (h, w, 3) uint8 sRGB. mask: (h, w) true on the object."""

    camera: Camera
    pixels: Pixels
    mask: Mask
    source: Source

    @property
    def name(self) -> str:
        """The photo's name."""
        return self.camera.name

    @cached_property
    def box_px(self) -> tuple[float, float, float, float]:
        """Left, top, right, lower border of the silhouette (px); all 0 where it is empty."""
        rows, columns = np.flatnonzero(self.mask.any(axis=1)), np.flatnonzero(self.mask.any(axis=0))
        if not len(rows):
            return 0.0, 0.0, 0.0, 0.0
        return float(columns[0]), float(rows[0]), float(columns[-1] + 1), float(rows[-1] + 1)

    @cached_property
    def share(self) -> float:
        """Of the photo, how much the silhouette covers."""
        return float(self.mask.mean())

    def scaled(self, factor: float) -> View:
        """The view at another size; a pixel is on the object where most of it is."""
        camera = self.camera.scaled(factor)
        size = (camera.width_px, camera.height_px)
        pixels = cv2.resize(self.pixels, size, interpolation=cv2.INTER_AREA)
        mask = cv2.resize(self.mask.astype(np.float32), size, interpolation=cv2.INTER_AREA) > 0.5
        return replace(self, camera=camera, pixels=np.asarray(pixels, np.uint8), mask=mask)


def camera_rows(cameras: Sequence[Camera]) -> Floats:
    """(n, 16) what the Rust core takes of cameras: P row by row, focal length (px), centre (m)."""
    return np.array(
        [
            [*camera.projection().ravel(), max(camera.focal_px), *camera.centre()]
            for camera in cameras
        ]
    )
