"""The pictures that are in use, so many at a time."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.photos.texture.cells import LEVELS
from veduta.photos.texture.views import Blockers, Nearness, View, pyramid

MOST_BYTES = 1024**3


@dataclass(frozen=True)
class _Held:
    levels: list[NDArray[np.uint8]]
    nearness: Nearness
    valid: NDArray[np.bool_] | None

    @property
    def size(self) -> int:
        """Bytes."""
        extra = 0 if self.valid is None else self.valid.nbytes
        return sum(level.nbytes for level in self.levels) + self.nearness.nbytes + extra


class PictureStore:
    """Pictures with their halves and what hides things from them; the oldest in use goes first."""

    def __init__(self, views: Sequence[View], blockers: Blockers) -> None:
        self._views, self._blockers = views, blockers
        self._held: OrderedDict[int, _Held] = OrderedDict()
        self._bytes = 0

    def levels(self, row: int) -> list[NDArray[np.uint8]]:
        """The picture of a view and its halves."""
        return self._get(row).levels

    def nearness(self, row: int) -> Nearness:
        """`Blockers.nearness` of a view."""
        return self._get(row).nearness

    def valid(self, row: int) -> NDArray[np.bool_] | None:
        """Where a view's picture shows anything; None for all of it."""
        return self._get(row).valid

    def _get(self, row: int) -> _Held:
        if row in self._held:
            self._held.move_to_end(row)
            return self._held[row]
        view = self._views[row]
        valid = None if view.valid is None else view.valid()
        held = _Held(pyramid(view.pixels(), LEVELS), self._blockers.nearness(view), valid)
        self._held[row] = held
        self._bytes += held.size
        while self._bytes > MOST_BYTES and len(self._held) > 1:
            _, gone = self._held.popitem(last=False)
            self._bytes -= gone.size
        return held
