"""Where the windows of a stripe begin and end sideways.

The stripes are found on all rows of the floors, where jambs, shutters and mouldings count too.
Here each side is moved to the best place nearby, on the rows of the stripe's windows alone: the
sum of the window log-odds between the sides plus the vertical edges at them.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from veduta.facade.evidence import Float
from veduta.facade.opening_rows import Stripes

# In storeys: how far a side may move, and the narrowest window.
_REACH = 0.12
_NARROW = 0.15
# Weight of the vertical edges at the two sides against the pixel scores.
_EDGE = 0.05


def refine_sides(
    stripes: Stripes, window: Float, gx: Float, rows: list[NDArray[np.bool_]], storey: float
) -> Stripes:
    """The stripes with both sides moved; one that would reach into its neighbour stays.

    `window` and `gx` (n, w) are log-odds and derivative, `rows` the mask (n,) per stripe of where
    its windows are.
    """
    moved = [
        _best_sides(stripe, window[mask], gx[mask], storey) if mask.any() else stripe
        for stripe, mask in zip(stripes, rows, strict=True)
    ]
    for i in range(len(moved) - 1):
        if sum(moved[i]) > moved[i + 1][0]:
            moved[i], moved[i + 1] = stripes[i], stripes[i + 1]
    return moved


def _best_sides(
    stripe: tuple[int, int], window: Float, gx: Float, storey: float
) -> tuple[int, int]:
    x, w = stripe
    width = window.shape[1]
    reach = max(1, round(_REACH * storey))
    summed = np.concatenate([[0.0], np.cumsum(window.mean(0), dtype=np.float64)]) / storey
    edge = side_gains(gx, x, x + w, storey)
    left = np.arange(max(0, x - reach), min(x + reach, x + w // 2) + 1)
    right = np.arange(max(x + w - reach, x + w // 2 + 1), min(width, x + w + reach) + 1)
    gain = (edge - summed)[left][:, None] + (edge + summed)[right][None, :]
    gain[right[None, :] - left[:, None] < _NARROW * storey] = -np.inf
    a, b = np.unravel_index(int(np.argmax(gain)), gain.shape)
    if not np.isfinite(gain[a, b]):
        return stripe
    return int(left[a]), int(right[b] - left[a])


def side_gains(gx: Float, x: int, end: int, storey: float) -> NDArray[np.float64]:
    """Gain (w + 1,) of a side at each pixel boundary, relative to the edges about `x` to `end`."""
    strength = np.minimum(np.abs(gx), 25).mean(0)
    edge = np.zeros(len(strength) + 1)
    edge[1:-1] = np.maximum(strength[:-1], strength[1:])
    reach = 2 * max(1, round(_REACH * storey))
    near = edge[max(0, x - reach) : min(len(strength), end + reach) + 1]
    return np.asarray(_EDGE * np.clip((edge - near.mean()) / (float(near.std()) + 1e-6), -1, 3))
