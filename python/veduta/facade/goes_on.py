"""Whether the storeys end, or go on to the edges of the picture as a pattern does.

A page of words, waves and tiles are rows that are alike from the upper edge to the lower one. A
facade ends: in a sky above, or below in a ground floor that is not like the floors above it.
"""

from __future__ import annotations

import numpy as np

from veduta.facade.floors import Floors
from veduta.facade.rows import Rows

# Dissimilarity of the lowest floor and what is below it up to which that is another such floor. Of
# 85 facades of Paris, Art Deco and CMP the least is 0.58 (the median 1.0); pages, waves and tiles
# have up to 0.44.
_LIKE_FLOORS = 0.5
# Grid rows (of 300) up to which the building begins at the picture's upper edge.
_NO_SKY = 3
# In storeys: how far floors that are alike may be off, and the least that is compared.
_SHIFT, _LEAST = 0.1, 0.6


def goes_on(rows: Rows, floors: Floors) -> bool:
    """Whether no sky is above the storeys and what is below the lowest one is like it."""
    if rows.ridge > _NO_SKY:
        return False
    unlike = unlike_below(rows, floors)
    return unlike is not None and unlike < _LIKE_FLOORS


def unlike_below(rows: Rows, floors: Floors) -> float | None:
    """Dissimilarity (1: of any two rows) of the lowest floor and as much below it, best aligned.

    None where the picture ends too soon below it.
    """
    storey = round(floors.mean_storey / rows.step)
    ground = floors.ground_top // rows.step
    reach = max(1, round(_SHIFT * storey))
    found = []
    for offset in range(storey - reach, storey + reach + 1):
        upper = np.arange(max(0, ground - storey), ground)
        lower = upper + offset
        inside = (lower >= ground) & (lower < len(rows.distance))
        if inside.sum() >= _LEAST * storey:
            found.append(float(rows.distance[upper[inside], lower[inside]].mean()))
    return min(found, default=None)
