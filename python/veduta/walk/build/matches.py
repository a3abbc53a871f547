"""Matches between the left pictures of two key positions, across the scales of a looming camera."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.walk.build.local_model import LocalModel


@dataclass(frozen=True)
class MatchSettings:
    """ratio: how much nearer the best candidate must be than the second (Lowe 2004). far: a match
    lies no further away, in shares of the width.
    """

    ratio: float = 0.8
    far: float = 0.6


@dataclass(frozen=True, eq=False)
class Matches:
    """first, second: (n, 2) px in the left picture of each key position."""

    first: NDArray[np.float64]
    second: NDArray[np.float64]

    def __len__(self) -> int:
        return len(self.first)

    def only(self, chosen: NDArray[np.bool_]) -> Matches:
        """Some of them."""
        return Matches(self.first[chosen], self.second[chosen])


def match_features(
    first: LocalModel, second: LocalModel, settings: MatchSettings = MatchSettings()
) -> Matches:
    """Features that are each other's best match."""
    one, other = first.features, second.features
    if min(len(one.described), len(other.described)) < 2:
        return Matches(np.zeros((0, 2)), np.zeros((0, 2)))
    forth = _best(one.described, other.described, settings.ratio)
    back = _best(other.described, one.described, 1.0)
    own = np.flatnonzero(forth >= 0)
    own = own[back[forth[own]] == own]
    matches = Matches(one.pixels[own], other.pixels[forth[own]])
    apart = np.linalg.norm(matches.first - matches.second, axis=1)
    return matches.only(apart < settings.far * first.screen.width_px)


def _best(one: NDArray[np.float32], other: NDArray[np.float32], ratio: float) -> NDArray[np.int64]:
    """For each row the nearest of the others; -1 where the second is nearly as near."""
    along = one @ other.T
    best = along.argmax(axis=1)
    rows = np.arange(len(one))
    near = np.sqrt(np.maximum(2.0 - 2.0 * along[rows, best], 0.0))
    along[rows, best] = -1.0
    second = np.sqrt(np.maximum(2.0 - 2.0 * along.max(axis=1), 0.0))
    return np.where(near <= ratio * second, best, -1)
