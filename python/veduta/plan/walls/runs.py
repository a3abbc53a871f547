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
