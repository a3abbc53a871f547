"""The energy of a set of windows (6.4), and the gradient descent that aligns them.

    E = sum over pairs of Al(w1, w2) + sum over windows of Pr(w)

`Al` falls exponentially with how far two windows of the same row, or column, are out of line, and
is 0 for others. Summed over all pairs it grows with the square of their number, so that more and
smaller windows always win; here each window has the mean over its own row and column, at most 1
each. `Pr` falls exponentially with how far the size is from what the style draws.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Boxes = NDArray[np.float64]


@dataclass(frozen=True)
class EnergyParameters:
    """Shares are of the median window's width and height, so that no metres are needed.

    out_of_line: by which the pair's term has fallen to 1 / e. same_row: two windows are of a row
    (column) where they overlap by so much of the lesser height (width). aspect, aspect_spread:
    height by width of windows, and the ratio by which their term has fallen to 1 / e: the mean and
    deviation of the windows that the styles of `veduta grammar` draw. unlike: how much larger or
    smaller than the median window one may be, until its term has fallen to 1 / e. rate, steps: of
    the gradient descent.
    """

    out_of_line: float = 0.15
    same_row: float = 0.5
    aspect: float = 1.9
    aspect_spread: float = 0.5
    unlike: float = 0.3
    rate: float = 0.5
    steps: int = 20


def grid_energy(boxes: Boxes, own: EnergyParameters) -> float:
    """E of (n, 4) boxes: at most 3 for each, of which 1 is that of its size."""
    return float(_aligned_terms(boxes, own).sum() + size_terms(boxes, own).sum())


def size_terms(boxes: Boxes, own: EnergyParameters) -> Boxes:
    """(n,) Pr of each window."""
    wide, high = (boxes[:, 2:] - boxes[:, :2]).T
    shape = np.abs(np.log(high / wide / own.aspect)) / own.aspect_spread
    areas = np.log(wide * high)
    alike = np.abs(areas - np.median(areas)) / own.unlike
    return np.asarray(np.exp(-0.5 * (shape + alike)), np.float64)


def _aligned_terms(boxes: Boxes, own: EnergyParameters) -> Boxes:
    """(n,) how well each window is in line with its row and its column, 0 to 2."""
    total = np.zeros(len(boxes))
    for axis in (0, 1):
        together = _together(boxes, axis, own.same_row)
        np.fill_diagonal(together, False)
        size = float(np.median(boxes[:, 2 + axis] - boxes[:, axis]))
        ends = boxes[:, [axis, 2 + axis]]
        out = np.abs(ends[:, None] - ends).mean(axis=2) / (own.out_of_line * size)
        counts = together.sum(axis=1)
        total += np.where(together, np.exp(-out), 0.0).sum(axis=1) / np.maximum(counts, 1)
    return total


def _together(boxes: Boxes, axis: int, least: float) -> NDArray[np.bool_]:
    """(n, n) which windows overlap along an axis: 0 for those of a column, 1 for those of a row."""
    low = np.maximum(boxes[:, None, axis], boxes[:, axis])
    high = np.minimum(boxes[:, None, 2 + axis], boxes[:, 2 + axis])
    sizes = boxes[:, 2 + axis] - boxes[:, axis]
    lesser = np.minimum(sizes[:, None], sizes)
    return np.asarray(high - low >= least * lesser, np.bool_)


def aligned(boxes: Boxes, own: EnergyParameters) -> Boxes:
    """Boxes of which each step brings the borders nearer to the mean of their row or column.

    The step is down the gradient of the variance of the borders, as the thesis minimises the
    variation of place and size.
    """
    moved = boxes.copy()
    rows, columns = (_together(boxes, axis, own.same_row).astype(np.float64) for axis in (1, 0))
    rows /= rows.sum(axis=1, keepdims=True)
    columns /= columns.sum(axis=1, keepdims=True)
    for _ in range(own.steps):
        means = np.column_stack(
            [columns @ moved[:, 0], rows @ moved[:, 1], columns @ moved[:, 2], rows @ moved[:, 3]]
        )
        moved += own.rate * (means - moved)
    return moved
