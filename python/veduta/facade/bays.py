"""How wide the bays of a facade are, before anything else is known of it.

Windows stand side by side at a regular distance, about as far as storeys are high. Rows alone do
not tell a storey of two metres from one of six: in a close view of two storeys, mouldings, sills
and signs repeat as well. The bay is found from the columns alone, and says which storey heights
the vertical split may believe.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from veduta.facade.dissimilarity import at_offsets, of_pairs
from veduta.facade.evidence import Float

# Bays that must be in the picture: two windows mirrored about the middle are no rhythm.
_LEAST_BAYS = 3.5
# Widest bay, as a share of the width; half-width of a minimum in grid columns.
_WIDEST = 0.7
_AROUND = 3
# How much likeness must rise at the bay after it fell, of that of columns far apart; and the part
# of the best rise from which on the narrowest bay is taken, not a multiple of it.
_RISE = 0.2
_OF_BEST = 0.5


def bay_width(channels: list[Float], step: int) -> int | None:
    """The distance in grid columns at which the facade repeats sideways, None where it does not.

    `channels` (n, w) are what columns are compared by, each with standard deviation 1; the grid has
    `step` pixels.
    """
    unlike = _unlike_at_offsets(channels, step)
    count = channels[0].shape[1] // step
    risen = np.maximum.accumulate(unlike) - unlike if len(unlike) else unlike
    found = [
        (k, float(risen[k]))
        for k in range(_AROUND, len(unlike) - _AROUND + 1)
        if risen[k] >= _RISE
        and count >= _LEAST_BAYS * k
        and unlike[k] == unlike[k - _AROUND : k + _AROUND + 1].min()
    ]
    best = max((rise for _, rise in found), default=0.0)
    return next((k for k, rise in found if rise >= _OF_BEST * best), None)


def _unlike_at_offsets(channels: list[Float], step: int) -> NDArray[np.float64]:
    """Mean squared difference (k,) of columns `k` grid columns apart, 1 for those far apart."""
    count = channels[0].shape[1] // step
    stacked = np.concatenate(channels)[:, : count * step]
    columns = stacked.reshape(len(stacked), count, step).mean(2).T
    unlike = at_offsets(of_pairs(columns), int(_WIDEST * count))
    far = unlike[int(0.04 * count) + 2 :]
    return unlike / max(float(np.median(far)), 1e-6) if len(far) else unlike[:0]
