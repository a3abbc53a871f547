"""Vertical scans at equal distances: section 2 of Frueh et al. 2005; a stop leaves one."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray


def equally_spaced(path: NDArray[np.float64], spacing_m: float) -> NDArray[np.int64]:
    """Rows of a path (s, 3) at least so far from the one that was kept before; the first is kept.

    Driving back over the same place keeps scans again: it is told apart later, as another pass.
    """
    if spacing_m <= 0.0 or len(path) < 2:
        return np.arange(len(path))
    kept = [0]
    row = 0
    reach = 64
    while True:
        # The next row that is far enough, looked for in growing pieces.
        ahead = path[row + 1 : row + 1 + reach, :2] - path[row, :2]
        if not len(ahead):
            return np.array(kept, dtype=np.int64)
        far = np.flatnonzero((ahead**2).sum(axis=1) >= (spacing_m * 0.999) ** 2)
        if len(far):
            row = row + 1 + int(far[0])
            kept.append(row)
            reach = 64
        elif row + 1 + reach >= len(path):
            return np.array(kept, dtype=np.int64)
        else:
            reach *= 4
