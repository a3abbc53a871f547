"""Whether the windows of neighbouring floors stand one above another.

Floors are found by their rows alone, so whatever repeats down the picture can be taken for them:
shelves, the rails of a fence, lines of writing, mouldings. In a facade the floors are also alike
from side to side: what is window and what is pier goes on from floor to floor. What all rows share
(a pier, a board of a fence) and what all columns share (a ledge, a rail) says nothing, and is taken
away before floors are compared.
"""

from __future__ import annotations

from itertools import pairwise

import cv2
import numpy as np

from veduta.facade.evidence import Float
from veduta.facade.floors import Floors

# Rows and at most columns of a floor when it is compared.
_ROWS, _COLUMNS = 24, 240


def likeness_of_columns(window: Float, floors: Floors) -> float | None:
    """Median correlation (-1..1) of neighbouring floors' window scores; None for a single floor.

    `window` (n, w) are log-odds from the eaves to the ground floor. Means of rows and of columns
    are taken away first, as for the interaction in a two-way table.
    """
    rows = [row - floors.eaves for row in floors.boundaries]
    columns = min(window.shape[1], _COLUMNS)
    bands = np.stack(
        [
            cv2.resize(window[a:b], (columns, _ROWS), interpolation=cv2.INTER_AREA)
            for a, b in pairwise(rows)
        ]
    ).astype(np.float64)
    if len(bands) < 2:
        return None
    bands -= bands.mean(axis=2, keepdims=True)
    bands -= bands.mean(axis=(0, 1), keepdims=True)
    shared = [
        float((a * b).sum() / np.sqrt(max(float((a * a).sum() * (b * b).sum()), 1e-12)))
        for a, b in pairwise(bands)
    ]
    return float(np.median(shared))
