"""A picture and its halves."""

from __future__ import annotations

import math
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

_SMALLEST_PX = 16


@dataclass(frozen=True)
class Halves:
    """A picture halved `first` times, and the halves of that.

    A pixel of each lies on every second of the one before.
    """

    first: int
    levels: tuple[NDArray[np.uint8], ...]

    def at(self, level: int) -> tuple[int, NDArray[np.uint8]]:
        """The picture halved so many times, or as nearly as there is; and how many times it is."""
        near = min(max(level, self.first), self.first + len(self.levels) - 1)
        return near, self.levels[near - self.first]

    @property
    def nbytes(self) -> int:
        """Of all."""
        return sum(level.nbytes for level in self.levels)


def halves_of(pixels: NDArray[np.uint8], longest_px: int | None = None) -> Halves:
    """The picture and its halves; without those that are longer than this."""
    first, levels = 0, [pixels]
    while min(levels[-1].shape[:2]) >= _SMALLEST_PX:
        if longest_px is not None and max(levels[-1].shape[:2]) > longest_px:
            first += 1
            levels.pop()
        levels.append(np.asarray(cv2.pyrDown(pixels), dtype=np.uint8))
        pixels = levels[-1]
    return Halves(first, tuple(levels))


def level_of(density_px_m2: float, pitch_m: float) -> int:
    """How often a picture is halved for its pixels to be about as far apart as the samples."""
    per_sample = math.sqrt(max(density_px_m2, 1e-9)) * pitch_m
    return max(0, round(math.log2(max(per_sample, 1.0))))
