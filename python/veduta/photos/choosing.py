"""Which photo a cell of a surface is taken from: for the pictures of walls, and for textures.

What stands before a wall (trees, cars, people) is in no model. Seen from several places it is over
different parts of the wall: where three or more photos show a cell, one that differs from their
median is outvoted. Of the others the one that costs least, with few seams, and those where photos
agree (a grid labelled by `veduta-texture`).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from veduta import _core

DIFFERS = 0.08
"""Difference from the median at which a view shows something else: of sRGB (0..1), the root of the
mean square over a cell."""
DIFFERS_TIMES = 2.5
"""... and it is so many times that of the view in the middle."""
FEWEST = 3
OUTVOTED_COST = 3.0
"""Beside costs of views that are believed, of 0 to about 2."""
_UNSEEN_COST = 100.0
SEAM_BASE, SEAM_SLOPE, SEAM_MOST = 0.08, 1.5, 1.0
ROUNDS = 12


def median_of(values: NDArray[np.floating]) -> NDArray[np.float32]:
    """Over the first axis, NaN left out; of two in the middle the mean; NaN where all are."""
    ordered = np.sort(values, axis=0)
    count = (~np.isnan(ordered)).sum(axis=0)[None]
    low = np.take_along_axis(ordered, np.maximum((count - 1) // 2, 0), axis=0)[0]
    high = np.take_along_axis(ordered, np.maximum(count // 2, 0).clip(max=len(values) - 1), axis=0)
    return np.asarray((low + high[0]) / 2, dtype=np.float32)


def outvoted(distance: NDArray[np.floating]) -> NDArray[np.bool_]:
    """(k, rows, columns) which views show another thing than most.

    distance: (k, rows, columns) of each view from the median of all, NaN where it shows nothing.
    Where fewer than `FEWEST` views show a cell nothing can be said.
    """
    many = (~np.isnan(distance)).sum(axis=0) >= FEWEST
    usual = median_of(distance)
    with np.errstate(invalid="ignore"):
        differs = distance > np.maximum(DIFFERS, DIFFERS_TIMES * usual)
    return np.asarray(differs & many)


def cheapest(
    cost: NDArray[np.floating], seen: NDArray[np.bool_], colours: NDArray[np.floating]
) -> NDArray[np.int64]:
    """(rows, columns) the view of each cell, -1 where none shows it.

    cost: (k, rows, columns), about 0 to 2, and `OUTVOTED_COST` more. seen: (k, rows, columns).
    colours: (k, rows, columns, 3) levelled sRGB (0..1), NaN where unseen: where the two differ a
    seam costs more.
    """
    shape = cost.shape[1:]
    cells = shape[0] * shape[1]
    # Cells that nobody sees are free: they take the view of their neighbours.
    nobody = ~seen.any(axis=0)
    told = np.where(nobody, 0.0, np.where(seen, cost, _UNSEEN_COST)).astype(np.float32)
    label = _core.label_cells(
        np.ascontiguousarray(np.moveaxis(told, 0, -1).reshape(cells, -1)),
        np.ascontiguousarray(np.moveaxis(colours, 0, 2).reshape(cells, -1), dtype=np.float32),
        shape,
        base=SEAM_BASE,
        slope=SEAM_SLOPE,
        most=SEAM_MOST,
        rounds=ROUNDS,
    ).astype(np.int64)
    return np.where(nobody, -1, label.reshape(shape))
