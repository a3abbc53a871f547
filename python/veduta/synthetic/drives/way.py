"""The line along which a street goes: straight along y, or swinging to both sides."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
_FINE_M = 0.05
_BEFORE_M = 60.0
"""Houses stand before the start, too."""


@dataclass(frozen=True)
class Way:
    """From the origin, where it goes along y. radius_m: of its tightest bends, inf where it is
    straight. period_m: after which it has bent to the left and to the right.
    """

    radius_m: float = float("inf")
    period_m: float = 120.0

    def at(self, along_m: Floats) -> tuple[Floats, Floats]:
        """(n, 2) places and (n,) headings (rad, from x) at (n,) distances from its start (m)."""
        heading = np.pi / 2 + self._turned(np.asarray(along_m, dtype=np.float64))
        if not np.isfinite(self.radius_m):
            return np.column_stack([np.zeros(len(heading)), along_m]), heading
        end = float(np.max(along_m, initial=0.0)) + _BEFORE_M
        steps = np.arange(-_BEFORE_M, end, _FINE_M)
        middle = np.pi / 2 + self._turned(steps + _FINE_M / 2)
        moves = _FINE_M * np.stack([np.cos(middle), np.sin(middle)], axis=1)
        line = np.concatenate([np.zeros((1, 2)), np.cumsum(moves, axis=0)])
        line -= line[round(_BEFORE_M / _FINE_M)]
        known = np.append(steps, steps[-1] + _FINE_M)
        return np.stack([np.interp(along_m, known, line[:, k]) for k in (0, 1)], axis=1), heading

    def frames(self, along_m: Floats) -> Floats:
        """(n, 3, 4) world_from_way: x ahead, y to the left, z up."""
        places, heading = self.at(along_m)
        found = np.zeros((len(heading), 3, 4))
        # Straight ahead must be exactly along y.
        cosine, sine = self._cosine(heading), np.sin(heading)
        found[:, 0, 0], found[:, 1, 0] = cosine, sine
        found[:, 0, 1], found[:, 1, 1] = -sine, cosine
        found[:, 2, 2] = 1.0
        found[:, :2, 3] = places
        return found

    def _turned(self, along_m: Floats) -> Floats:
        """The heading over that of the start: the curvature is a wave of the period."""
        if not np.isfinite(self.radius_m):
            return np.zeros(len(along_m))
        wave = 2 * np.pi / self.period_m
        return np.asarray((1.0 - np.cos(wave * along_m)) / (wave * self.radius_m))

    def _cosine(self, heading: Floats) -> Floats:
        return np.where(np.abs(heading - np.pi / 2) < 1e-12, 0.0, np.cos(heading))
