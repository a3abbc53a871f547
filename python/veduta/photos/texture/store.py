"""The pictures that are in use, so many at a time."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.photos.bounded import Bounded
from veduta.photos.texture.views import Blockers, Nearness, View

MOST_BYTES = 512 * 1024**2
"""Of pictures; of what hides things from them, and of what they show, a quarter each."""
COARSE_PX = 1600
"""Longest side of pictures in which views are compared with each other."""
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


class PictureStore:
    """Pictures with their halves, and what hides things from them; by rows of the views.

    longest_px: finer halves are not kept, so that more pictures are.
    """

    def __init__(
        self, views: Sequence[View], blockers: Blockers, longest_px: int | None = None
    ) -> None:
        self.levels: Bounded[int, Halves] = Bounded(
            lambda row: halves_of(views[row].pixels(), longest_px), _size, MOST_BYTES
        )
        """The picture of a view and its halves."""
        self.nearness: Bounded[int, Nearness] = Bounded(
            lambda row: blockers.nearness(views[row]), _nearness_size, MOST_BYTES // 4
        )
        """`Blockers.nearness` of a view."""
        self.valid: Bounded[int, NDArray[np.bool_] | None] = Bounded(
            lambda row: _valid(views[row]), _mask_size, MOST_BYTES // 4
        )
        """Where a view's picture shows anything; None for all of it."""


def _valid(view: View) -> NDArray[np.bool_] | None:
    return None if view.valid is None else view.valid()


def _size(halves: Halves) -> int:
    return halves.nbytes


def _nearness_size(nearness: Nearness) -> int:
    return nearness.nbytes


def _mask_size(mask: NDArray[np.bool_] | None) -> int:
    return 0 if mask is None else mask.nbytes
