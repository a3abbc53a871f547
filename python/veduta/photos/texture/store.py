"""The pictures that are in use, so many at a time."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from veduta.photos.bounded import Bounded
from veduta.photos.texture.halves import Halves, halves_of
from veduta.photos.texture.sky import sky_on_model
from veduta.photos.texture.views import Blockers, Nearness, PlaneView, View, seen_at

MOST_BYTES = 512 * 1024**2
"""Of pictures; of what hides things from them, and of what they show, a quarter each."""
COARSE_PX = 1600
"""Longest side of pictures in which views are compared with each other."""


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
        self.sky: Bounded[int, NDArray[np.bool_]] = Bounded(
            lambda row: sky_on_model(views[row], self.levels(row), self.nearness(row)),
            _mask_size,
            MOST_BYTES // 4,
        )
        """`sky_on_model` of a view."""
        self._views = views

    def seen(
        self, row: int, plane: PlaneView, shape: tuple[int, int], pitch_m: float
    ) -> NDArray[np.bool_]:
        """`seen_at` of a view."""
        hides = (self.nearness(row), self.valid(row), self.sky(row))
        return seen_at(self._views[row], plane, *hides, shape, pitch_m)


def _valid(view: View) -> NDArray[np.bool_] | None:
    return None if view.valid is None else view.valid()


def _size(halves: Halves) -> int:
    return halves.nbytes


def _nearness_size(nearness: Nearness) -> int:
    return nearness.nbytes


def _mask_size(mask: NDArray[np.bool_] | None) -> int:
    return 0 if mask is None else mask.nbytes
