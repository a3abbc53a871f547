"""The light of the photos where they show cells of the model: what their gains are found from."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from veduta.photos.levelling import photo_gains
from veduta.photos.texture.cells import Sights

MOST_CELLS = 400_000
"""Of all faces together; of many faces each gives fewer, evenly spread."""
_LEAST_SHARE = 0.6


class LightSamples:
    """Cells that two photos and more show well, face by face."""

    def __init__(self, photos: int, faces: int) -> None:
        self._photos = photos
        self._per_face = max(1, MOST_CELLS // max(1, faces))
        self._photo: list[NDArray[np.int64]] = []
        self._cell: list[NDArray[np.int64]] = []
        self._light: list[NDArray[np.float32]] = []
        self._cells = 0

    def add(self, sights: Sights, kept: NDArray[np.bool_] | None = None) -> None:
        """Take a face's cells; kept: (k, rows, columns), False where a view shows another thing."""
        grid = sights.grid
        step = math.ceil(math.sqrt(grid.rows * grid.columns / self._per_face))
        light = sights.light()
        usable = ~np.isnan(light).any(axis=-1) & (sights.share() >= _LEAST_SHARE)
        if kept is not None:
            usable &= kept
        usable &= usable.sum(axis=0) >= 2
        spread = np.zeros(usable.shape[1:], dtype=np.bool_)
        first = (min(step // 2, (grid.rows - 1) // 2), min(step // 2, (grid.columns - 1) // 2))
        spread[first[0] :: step, first[1] :: step] = True
        k, row, column = np.nonzero(usable & spread)
        self._photo.append(sights.views[k])
        self._cell.append(row * grid.columns + column + self._cells)
        self._light.append(light[k, row, column])
        self._cells += grid.rows * grid.columns

    def gains(self) -> NDArray[np.float64]:
        """(photos, 3) by `photo_gains`."""
        if not self._photo:
            return np.ones((self._photos, 3))
        light, photo = np.concatenate(self._light), np.concatenate(self._photo)
        return photo_gains(light, photo, np.concatenate(self._cell), self._photos)
