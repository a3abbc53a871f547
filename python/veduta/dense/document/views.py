"""Photos at the working size, without distortion: read when they are asked for."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable
from dataclasses import dataclass, field

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.cameras import Camera

MOST_KEPT_BYTES = 400_000_000
"""Of photos that are kept in memory, where nothing else is said."""


def camera_row(camera: Camera) -> NDArray[np.float64]:
    """(16,) focal lengths and principal point (px), rotation row by row, shift; for the core."""
    turn, shift = camera.cam_from_world[:, :3], camera.cam_from_world[:, 3]
    return np.concatenate([camera.focal_px, camera.centre_px, turn.ravel(), shift])


@dataclass(eq=False)
class Views:
    """The views of a set of photos.

    cameras: without distortion, at the working size. read: the (h, w, 3) uint8 sRGB pixels of one,
    and the (h, w) bool mask of where nothing is looked for (None without one). most_kept_bytes: of
    photos that stay in memory.
    """

    cameras: tuple[Camera, ...]
    read: Callable[[int], tuple[NDArray[np.uint8], NDArray[np.bool_] | None]]
    most_kept_bytes: float = MOST_KEPT_BYTES
    _kept: OrderedDict[int, tuple[NDArray[np.uint8], NDArray[np.bool_] | None]] = field(
        default_factory=OrderedDict
    )

    def __len__(self) -> int:
        return len(self.cameras)

    def pixels(self, view: int) -> NDArray[np.uint8]:
        """(h, w, 3) uint8 sRGB."""
        return self._of(view)[0]

    def hidden(self, view: int) -> NDArray[np.bool_] | None:
        """(h, w) bool, True where nothing is looked for; None where there is no mask."""
        return self._of(view)[1]

    def grey(self, view: int, scale: float = 1.0) -> NDArray[np.uint8]:
        """(h, w) uint8 at a share of the working size."""
        pixels = cv2.cvtColor(self.pixels(view), cv2.COLOR_RGB2GRAY)
        if scale != 1.0:
            size = scaled_size(self.cameras[view], scale)
            pixels = cv2.resize(pixels, size, interpolation=cv2.INTER_AREA)
        return np.ascontiguousarray(pixels, dtype=np.uint8)

    def _of(self, view: int) -> tuple[NDArray[np.uint8], NDArray[np.bool_] | None]:
        if view not in self._kept:
            self._kept[view] = self.read(view)
            while len(self._kept) > 1 and self._bytes() > self.most_kept_bytes:
                self._kept.popitem(last=False)
        self._kept.move_to_end(view)
        return self._kept[view]

    def _bytes(self) -> int:
        return sum(pixels.nbytes for pixels, _ in self._kept.values())


def scaled_size(camera: Camera, scale: float) -> tuple[int, int]:
    """Width and height (px) at a share of a camera's size."""
    return max(2, round(camera.width_px * scale)), max(2, round(camera.height_px * scale))


def scaled_row(camera: Camera, scale: float) -> NDArray[np.float64]:
    """`camera_row` at a share of the size, as its picture is really rounded."""
    width, height = scaled_size(camera, scale)
    row = camera_row(camera)
    row[[0, 2]] *= width / camera.width_px
    row[[1, 3]] *= height / camera.height_px
    return row
