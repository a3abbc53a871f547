"""Values of triangles' corners drawn into a picture, linear in between."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

_AT_ONCE = 3_000_000
"""Pixels of the triangles' boxes that are looked at together."""
_EDGE = 1e-3
Floats = NDArray[np.float32]


def draw_triangles(
    places: NDArray[np.float64], values: NDArray[np.floating], shape: tuple[int, int]
) -> tuple[Floats, NDArray[np.bool_]]:
    """(h, w, c) and where something was drawn: (t, 3, c) values of corners at (t, 3, 2) px.

    A pixel belongs to a triangle that has its middle; of several, to the last.
    """
    height, width = shape
    drawn = np.zeros((height, width, values.shape[2]), dtype=np.float32)
    covered = np.zeros((height, width), dtype=np.bool_)
    low = np.clip(np.floor(places.min(axis=1) - 0.5), 0, [width, height]).astype(np.int64)
    high = np.clip(np.ceil(places.max(axis=1) + 0.5), 0, [width, height]).astype(np.int64)
    sizes = (high - low).prod(axis=1)
    ends = np.cumsum(sizes)
    start = 0
    while start < len(places):
        done = ends[start - 1] if start else 0
        end = max(start + 1, int(np.searchsorted(ends, done + _AT_ONCE, side="right")))
        part = slice(start, end)
        _draw(places[part], values[part], low[part], high[part] - low[part], drawn, covered)
        start = end
    return drawn, covered


def _draw(
    places: NDArray[np.float64],
    values: NDArray[np.floating],
    low: NDArray[np.int64],
    size: NDArray[np.int64],
    drawn: Floats,
    covered: NDArray[np.bool_],
) -> None:
    counts = size.prod(axis=1)
    row = np.repeat(np.arange(len(places)), counts)
    within = np.arange(len(row)) - np.repeat(np.cumsum(counts) - counts, counts)
    x = low[row, 0] + within % np.maximum(size[row, 0], 1)
    y = low[row, 1] + within // np.maximum(size[row, 0], 1)
    a = places[:, 0]
    b, c = places[:, 1] - a, places[:, 2] - a
    double = b[:, 0] * c[:, 1] - b[:, 1] * c[:, 0]
    double = np.where(np.abs(double) < 1e-12, np.inf, double)
    px, py = x + 0.5 - a[row, 0], y + 0.5 - a[row, 1]
    second = (px * c[row, 1] - py * c[row, 0]) / double[row]
    third = (b[row, 0] * py - b[row, 1] * px) / double[row]
    first = 1.0 - second - third
    inside = (np.minimum(np.minimum(first, second), third) >= -_EDGE) & np.isfinite(double[row])
    row, x, y = row[inside], x[inside], y[inside]
    weights = np.stack([first[inside], second[inside], third[inside]], axis=1)
    drawn[y, x] = np.einsum("kc,kcd->kd", weights, values[row])
    covered[y, x] = True
