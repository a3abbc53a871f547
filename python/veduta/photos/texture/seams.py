"""What is left of seams after the gains: an offset per cell, smooth within a photo's patch.

Where two photos meet, their patches get offsets that make them agree there, and that vary as
little as they can elsewhere (Waechter et al. 2014, section 4.3, on cells instead of vertices).
"""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array, eye_array
from scipy.sparse.linalg import splu

from veduta.photos.texture.choice import Choice

MOST = 0.25
"""Of sRGB (0..1): photos that differ by more show different things."""
_PULL = 0.003
"""Towards no offset, beside neighbours of one photo that pull to each other with 1."""


def offsets_of(colours: NDArray[np.float32], choice: Choice) -> NDArray[np.float32]:
    """(rows, columns, 3) what is added to the chosen view of each cell.

    colours: (k, rows, columns, 3) levelled sRGB of the cells, NaN where unseen. A cell beside one
    that a view shows disturbed tells nothing: a part of what disturbs may be in it.
    """
    around = np.ones((3, 3), dtype=np.uint8)
    clear = np.stack([cv2.erode(one.astype(np.uint8), around) > 0 for one in choice.usable])
    colours = np.where(clear[..., None], colours, np.nan)
    rows, columns = choice.label.shape
    count = rows * columns
    number = np.arange(count).reshape(rows, columns)
    first = np.concatenate([number[:, :-1].ravel(), number[:-1].ravel()])
    second = np.concatenate([number[:, 1:].ravel(), number[1:].ravel()])
    label = choice.label.ravel()
    known = (label[first] >= 0) & (label[second] >= 0)
    first, second = first[known], second[known]
    wanted = _wanted(colours.reshape(len(colours), count, 3), label, first, second)
    told = ~np.isnan(wanted).any(axis=1)
    first, second, wanted = first[told], second[told], wanted[told]
    rows_of = np.arange(len(first))
    ones = np.ones(len(first))
    edge = coo_array(
        (
            np.concatenate([ones, -ones]),
            (np.concatenate([rows_of, rows_of]), np.concatenate([first, second])),
        ),
        shape=(len(first), count),
    ).tocsc()
    normal = (edge.T @ edge + _PULL * eye_array(count)).tocsc()
    found = splu(normal).solve(edge.T @ wanted.astype(np.float64))
    return np.asarray(found.reshape(rows, columns, 3), dtype=np.float32)


def _wanted(
    colours: NDArray[np.float32],
    label: NDArray[np.int64],
    first: NDArray[np.int64],
    second: NDArray[np.int64],
) -> NDArray[np.float32]:
    """(n, 3) how much more the first cell's offset should be; NaN where nothing tells.

    Both views are compared in both cells, as far as they show them undisturbed.
    """
    one, other = label[first], label[second]
    at_first = colours[other, first] - colours[one, first]
    at_second = colours[other, second] - colours[one, second]
    blind_first, blind_second = np.isnan(at_first), np.isnan(at_second)
    mean = np.where(blind_first, at_second, np.where(blind_second, at_first, 0.0))
    both = ~blind_first & ~blind_second
    mean[both] = 0.5 * (at_first[both] + at_second[both])
    mean[one == other] = 0.0
    return np.asarray(np.clip(mean, -MOST, MOST), dtype=np.float32)
