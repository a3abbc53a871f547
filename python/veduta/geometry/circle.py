"""A circle through points: an algebraic fit, refined by distances."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

ROUNDS = 8


@dataclass(frozen=True)
class Circle:
    """`centre` (2,) and radius, in pixels."""

    centre: NDArray[np.float64]
    radius_px: float

    def away(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """(n,) distances of points (n, 2) from its line, positive outside."""
        out = points - self.centre
        return np.asarray(np.hypot(out[:, 0], out[:, 1]) - self.radius_px)

    def turns(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """(n,) angles of points about its centre, -pi to pi, from x towards y."""
        out = points - self.centre
        return np.asarray(np.arctan2(out[:, 1], out[:, 0]))

    def at(self, turn: NDArray[np.float64] | float) -> NDArray[np.float64]:
        """(..., 2) the point at an angle."""
        turn = np.asarray(turn, float)
        way = np.stack([np.cos(turn), np.sin(turn)], axis=-1)
        return np.asarray(self.centre + self.radius_px * way)


def fit_circle(points: NDArray[np.float64]) -> Circle | None:
    """The circle with least squared distances to points (n, 2); None where they lie on a line.

    Taubin's algebraic fit (Taubin 1991, in the form of Chernov 2010, section 5.9), which is nearly
    without bias on short arcs, then Gauss and Newton on the distances.
    """
    if len(points) < 3:
        return None
    middle = points.mean(axis=0)
    own = points - middle
    size = float(np.sqrt((own**2).sum(axis=1).mean()))
    if size < 1e-9:
        return None
    own = own / size
    squares = (own**2).sum(axis=1)
    mean = float(squares.mean())
    table = np.column_stack([(squares - mean) / (2.0 * np.sqrt(mean)), own])
    _, _, rows = np.linalg.svd(table, full_matrices=False)
    first, across = rows[-1][0] / (2.0 * np.sqrt(mean)), rows[-1][1:]
    if abs(first) < 1e-9:
        return None
    last = -mean * first
    centre = -across / (2.0 * first)
    radius = float(np.sqrt(max((across**2).sum() - 4.0 * first * last, 0.0)) / (2.0 * abs(first)))
    for _ in range(ROUNDS):
        out = own - centre
        away = np.hypot(out[:, 0], out[:, 1])
        slopes = np.column_stack([-out / np.maximum(away, 1e-9)[:, None], -np.ones(len(own))])
        step = np.linalg.lstsq(slopes, radius - away, rcond=None)[0]
        centre, radius = centre + step[:2], radius + float(step[2])
        if float(np.abs(step).max()) < 1e-7:
            break
    if not np.isfinite(radius) or radius <= 0.0 or radius > 1e4:
        return None
    return Circle(middle + size * centre, size * radius)
