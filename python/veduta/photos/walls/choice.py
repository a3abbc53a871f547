"""Which photo a cell of a wall is taken from: sharp, straight on, and of the others' opinion."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from veduta.photos.choosing import OUTVOTED_COST, cheapest, median_of, outvoted
from veduta.photos.walls.views import WallView


def chosen_photos(views: Sequence[WallView], colours: NDArray[np.float64]) -> NDArray[np.int64]:
    """(r, c) row of `views` that each cell is taken from, -1 where none sees it.

    colours: (v, r, c, 3) sRGB 0 to 1 of the cells in each view, levelled.
    """
    quality = np.stack([view.quality for view in views])
    seen = quality > 0.0
    shown = np.where(seen[..., None], colours, np.nan)
    distance = np.sqrt(((shown - median_of(shown)) ** 2).mean(axis=-1))
    cost = 1.0 - quality / np.maximum(quality.max(axis=0), 1e-300)
    return cheapest(cost + OUTVOTED_COST * outvoted(distance), seen, shown)
