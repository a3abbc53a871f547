"""Runs of ink along rows and columns: how long and how thick each stroke is, at each pixel."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray


def run_lengths(mask: NDArray[np.bool_]) -> NDArray[np.int32]:
    """(h, w) length of the horizontal run of True that each pixel lies in; 0 where False."""
    height, width = mask.shape
    padded = np.zeros((height, width + 1), dtype=np.bool_)
    padded[:, :width] = mask
    flat = padded.ravel()
    changes = np.flatnonzero(flat[1:] != flat[:-1]) + 1
    bounds = np.concatenate([[0], changes, [flat.size]])
    lengths = np.diff(bounds).astype(np.int32)
    values = np.where(flat[bounds[:-1]], lengths, 0).astype(np.int32)
    return np.repeat(values, lengths).reshape(height, width + 1)[:, :width]


def run_lengths_down(mask: NDArray[np.bool_]) -> NDArray[np.int32]:
    """(h, w) length of the vertical run of True that each pixel lies in; 0 where False."""
    return np.ascontiguousarray(run_lengths(np.ascontiguousarray(mask.T)).T)


def run_sums(values: NDArray[np.float32], mask: NDArray[np.bool_]) -> NDArray[np.float32]:
    """(h, w) the sum of values over the horizontal run of True that each pixel lies in."""
    edges = np.diff(np.pad(mask.astype(np.int8), ((0, 0), (1, 1))), axis=1)
    row, start = np.nonzero(edges == 1)
    end = np.nonzero(edges == -1)[1]
    total = np.pad(np.cumsum(values, axis=1, dtype=np.float64), ((0, 0), (1, 0)))
    found = np.zeros(mask.shape, np.float32)
    found[mask] = np.repeat(total[row, end] - total[row, start], end - start)
    return found
