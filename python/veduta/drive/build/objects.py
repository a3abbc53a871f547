"""The foreground as objects, by region growing in its depth image (section 6.2)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components


@dataclass(frozen=True)
class ObjectParameters:
    """step_m: neighbours whose depths differ less are of one object. reach: in pixels, over which
    neighbours are looked for: merged scans leave beams empty. fewest: smaller ones are dust.
    """

    step_m: float = 0.5
    reach: int = 3
    fewest: int = 12


def find_objects(
    foreground: NDArray[np.float32], parameters: ObjectParameters | None = None
) -> tuple[NDArray[np.int32], int]:
    """(r, c) the object of each pixel from 1 on, 0 where there is none, and how many they are."""
    chosen = parameters or ObjectParameters()
    filled = np.isfinite(foreground)
    number = np.cumsum(filled).reshape(filled.shape) - 1
    pairs = []
    for down in range(chosen.reach + 1):
        for right in range(-chosen.reach, chosen.reach + 1):
            if (down, right) > (0, 0):
                pairs.append(_joined(foreground, number, down, right, chosen.step_m))
    count = int(filled.sum())
    if not count:
        return np.zeros(filled.shape, dtype=np.int32), 0
    first, second = np.concatenate(pairs, axis=1)
    links = coo_matrix((np.ones(len(first), dtype=bool), (first, second)), shape=(count, count))
    _, label = connected_components(links, directed=False)
    size = np.bincount(label)
    kept = np.flatnonzero(size >= chosen.fewest)
    renamed = np.zeros(len(size), dtype=np.int32)
    renamed[kept] = np.arange(1, len(kept) + 1)
    objects = np.zeros(filled.shape, dtype=np.int32)
    objects[filled] = renamed[label]
    return objects, len(kept)


def _joined(
    depth: NDArray[np.float32], number: NDArray[np.int64], down: int, right: int, step_m: float
) -> NDArray[np.int64]:
    """(2, k) pixels `down` and `right` of each other whose depths are alike."""
    rows, columns = depth.shape
    left, to = max(-right, 0), columns - max(right, 0)
    one = (slice(0, rows - down), slice(left, to))
    other = (slice(down, rows), slice(left + right, to + right))
    with np.errstate(invalid="ignore"):
        alike = np.abs(depth[one] - depth[other]) < step_m
    return np.stack([number[one][alike], number[other][alike]])
