"""Smooth random fields, the raw material of all textures."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

Field = NDArray[np.float32]


def value_noise(
    rng: np.random.Generator, shape: tuple[int, int], cell_px: tuple[float, float]
) -> Field:
    """A field (h, w) in -1..1 whose features are about `cell_px` (down, right) pixels large.

    Random values on a coarse grid, interpolated cubically. The field wraps at its edges.
    """
    rows = max(2, round(shape[0] / cell_px[0]))
    columns = max(2, round(shape[1] / cell_px[1]))
    grid = rng.uniform(-1.0, 1.0, (rows, columns)).astype(np.float32)
    margin = 3
    wrapped = np.pad(grid, margin, mode="wrap")
    y, x = np.indices(shape, dtype=np.float32)
    x = (x + 0.5) * (columns / shape[1]) - 0.5 + margin
    y = (y + 0.5) * (rows / shape[0]) - 0.5 + margin
    field = cv2.remap(wrapped, x, y, cv2.INTER_CUBIC)
    return np.clip(field, -1.0, 1.0).astype(np.float32)


def fractal_noise(
    rng: np.random.Generator, shape: tuple[int, int], cell_px: float, octaves: int = 4
) -> Field:
    """Octaves of `value_noise`, each half as large and half as strong as the one before."""
    total = np.zeros(shape, np.float32)
    weight = 0.0
    for octave in range(octaves):
        cell = cell_px / 2**octave
        if cell < 1.0:
            break
        strength = 0.5**octave
        total += strength * value_noise(rng, shape, (cell, cell))
        weight += strength
    return total / np.float32(max(weight, 1e-6))


def grain(rng: np.random.Generator, shape: tuple[int, int]) -> Field:
    """Uncorrelated values of unit deviation, one per pixel."""
    return rng.standard_normal(shape, dtype=np.float32)
