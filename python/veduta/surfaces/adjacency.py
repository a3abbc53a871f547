"""Which triangles lie beside which."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

NOBODY = -1


def neighbours(triangles: NDArray[np.integer]) -> NDArray[np.int32]:
    """(m, 3) the triangle across the edge from corner k to the next; -1 where there is none.

    Of an edge with more than two triangles, the first two are neighbours.
    """
    count = len(triangles)
    start = np.asarray(triangles, dtype=np.int64)
    end = np.roll(start, -1, axis=1)
    low, high = np.minimum(start, end).ravel(), np.maximum(start, end).ravel()
    order = np.lexsort((high, low))
    same = (low[order][1:] == low[order][:-1]) & (high[order][1:] == high[order][:-1])
    # Where three have one edge, two matches follow each other: the first one counts.
    first = same & ~np.concatenate([[False], same[:-1]])
    left, right = order[:-1][first], order[1:][first]
    found = np.full(3 * count, NOBODY, dtype=np.int32)
    found[left], found[right] = right // 3, left // 3
    return found.reshape(count, 3)
