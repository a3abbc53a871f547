"""How bright each photo is: a gain per photo and channel, so that photos agree where they overlap.

In linear light the photos of one place differ by factors: exposure and white balance. For a cell i
that photo v shows, log light = a_i + g_v; all a and g together by least squares, robustly (Huber,
then Geman and McClure, who let what is far off go), with a weak pull of all g to nothing: photos
without overlap keep their light.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from veduta.photos.texture.cells import Sights

ROUNDS, FIRST_ROUNDS = 12, 4
_HUBER = 0.08
"""Of log light: beyond, views show other things (shadows, cars) or are burnt out."""
_PRIOR = 1e-3
_LEAST_SHARE = 0.6
_DARK, _BURNT = 0.004, 0.85
"""Linear light that a photo tells apart."""


def gains_of(
    photos: int, faces: Sequence[Sights], kept: Sequence[NDArray[np.bool_]] | None = None
) -> NDArray[np.float64]:
    """(photos, 3) what each photo's linear light is to be multiplied with.

    kept: per face (k, rows, columns), False where a view shows something else than the others.
    The mean gain of the photos that share cells with others is 1 (of its logarithm, 0).
    """
    view, cell, light = _observations(faces, kept)
    gains = np.ones((photos, 3))
    if len(view) == 0:
        return gains
    for channel in range(3):
        log_gain = _solve(photos, view, cell, np.log(light[:, channel]))
        shown = np.zeros(photos, dtype=bool)
        shown[view] = True
        log_gain[shown] -= log_gain[shown].mean()
        gains[:, channel] = np.exp(-log_gain)
    return gains


def _observations(
    faces: Sequence[Sights], kept: Sequence[NDArray[np.bool_]] | None
) -> tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.float64]]:
    """Photo, cell and light (n, 3) of what may be compared: cells that two photos show well."""
    views, cells, lights = [], [], []
    cells_so_far = 0
    for number, sights in enumerate(faces):
        light = sights.light()
        with np.errstate(invalid="ignore"):
            usable = (light > _DARK).all(axis=-1) & (light < _BURNT).all(axis=-1)
        usable &= sights.share() >= _LEAST_SHARE
        if kept is not None:
            usable &= kept[number]
        usable &= usable.sum(axis=0) >= 2
        k, row, column = np.nonzero(usable)
        views.append(sights.views[k])
        cells.append(row * sights.grid.columns + column + cells_so_far)
        lights.append(light[k, row, column].astype(np.float64))
        cells_so_far += sights.grid.rows * sights.grid.columns
    if not views:
        return np.zeros(0, np.int64), np.zeros(0, np.int64), np.zeros((0, 3))
    numbers = np.unique(np.concatenate(cells), return_inverse=True)[1].reshape(-1)
    return np.concatenate(views), numbers, np.concatenate(lights)


def _solve(
    photos: int, view: NDArray[np.int64], cell: NDArray[np.int64], value: NDArray[np.float64]
) -> NDArray[np.float64]:
    """(photos,) g of value = a[cell] + g[view], with the cells' own values eliminated."""
    weight = np.ones(len(value))
    cells = int(cell.max()) + 1
    found = np.zeros(photos)
    order = np.argsort(cell, kind="stable")
    starts = np.searchsorted(cell[order], np.arange(cells + 1))
    first, second = _pairs(order, starts)
    for turn in range(ROUNDS):
        total = np.bincount(cell, weight, cells)
        normal = np.diag(np.bincount(view, weight, photos) + _PRIOR * len(value) / photos)
        both = weight[first] * weight[second] / total[cell[first]]
        np.add.at(normal, (view[first], view[second]), -both)
        mean = np.bincount(cell, weight * value, cells) / total
        right = np.bincount(view, weight * (value - mean[cell]), photos)
        found = np.linalg.solve(normal, right)
        own = np.bincount(cell, weight * (value - found[view]), cells) / total
        error = np.abs(value - found[view] - own[cell])
        if turn < FIRST_ROUNDS:
            weight = np.minimum(1.0, _HUBER / np.maximum(error, 1e-9))
        else:
            weight = 1.0 / (1.0 + (error / _HUBER) ** 2) ** 2
    return found


def _pairs(
    order: NDArray[np.int64], starts: NDArray[np.int64]
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """All ordered pairs of observations of one cell, each with itself, too."""
    counts = np.diff(starts)
    times = np.repeat(counts, counts)
    first = np.repeat(order, times)
    begins = np.repeat(np.repeat(starts[:-1], counts), times)
    ends = np.cumsum(times)
    within = np.arange(len(first)) - np.repeat(ends - times, times)
    return first, order[begins + within]
