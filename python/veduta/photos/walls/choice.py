"""Which photo a cell of a wall is taken from: sharp, straight on, and of the others' opinion."""

from __future__ import annotations

from collections.abc import Sequence

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.photos.walls.views import WallView

AGREE = 0.12
"""Difference in sRGB (0 to 1) from the middle of all photos that is still the same thing."""
OUTVOTED = 0.05
"""What the quality of a photo is worth where it shows another thing than most of them."""
SMOOTH_CELLS = 2.0
"""Over so many cells qualities are averaged, that one photo gets a piece and not a cell."""
VOTERS = 3
"""Photos that have to see a cell for a vote."""


def chosen_photos(views: Sequence[WallView], colours: NDArray[np.float64]) -> NDArray[np.int64]:
    """(r, c) row of `views` that each cell is taken from, -1 where none sees it.

    colours: (v, r, c, 3) sRGB 0 to 1 of the cells in each view, levelled.
    """
    quality = np.stack([view.quality for view in views])
    seen = quality > 0.0
    hidden = np.where(seen[..., None], colours, np.nan)
    voters = seen.sum(axis=0)
    middle = np.zeros(colours.shape[1:])
    voted = voters >= VOTERS
    middle[voted] = np.nanmedian(hidden[:, voted], axis=0)
    apart = np.abs(colours - middle).max(axis=-1)
    agrees = (apart <= AGREE) | ~voted
    worth = quality * np.where(agrees, 1.0, OUTVOTED)
    smooth = np.stack([_averaged(layer, own) for layer, own in zip(worth, seen, strict=True)])
    # Outvoted cells stay outvoted, whatever their neighbours are worth.
    smooth = np.where(seen, smooth * np.where(agrees, 1.0, OUTVOTED), -1.0)
    found: NDArray[np.int64] = np.where(voters > 0, smooth.argmax(axis=0), -1)
    return found


def _averaged(layer: NDArray[np.float64], seen: NDArray[np.bool_]) -> NDArray[np.float64]:
    """Mean over the neighbouring cells that are seen."""
    sums, counts = (
        cv2.GaussianBlur(values, (0, 0), SMOOTH_CELLS, borderType=cv2.BORDER_CONSTANT)
        for values in (layer, seen.astype(np.float64))
    )
    found: NDArray[np.float64] = sums / np.maximum(counts, 1e-9)
    return found
