"""The rows of each floor's windows and railings.

Within a floor the rows of a window stripe read from top to bottom: wall, window, railing, wall.
The best rows (t, k, b) maximise the sum of the pixels' log-odds plus the horizontal edges at t, k
and b: one exact search for all stripes of a floor together, then one for each stripe alone, which
leaves the floor's rows only for a clear gain. Floors are alike in where windows begin and where
windows or railings end, so departing from the median over the floors has a price, as the heights
of neighbours have in the paper (equation 5).
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from veduta.facade.appearance import Scores
from veduta.facade.evidence import Evidence, Float
from veduta.facade.floors import Floors

Array = NDArray[np.float64]
Stripes = list[tuple[int, int]]
Span = tuple[float, float]
Cell = tuple[int, int, int]

# In storeys: heights of a window's visible part and of a railing in the image.
_WINDOW = (0.2, 0.9)
_RAILING = (0.12, 0.5)
# Weight of the horizontal edges at t, k and b against the pixel scores.
_EDGE = 0.04
# Mean log-odds at which a railing is taken to run on through a gap.
_RUNS_ON = 0.15
# Price of beginning or ending away from the other floors, per storey, up to `_OTHERWISE` storeys.
_UNLIKE_OTHERS = 1.0
_OTHERWISE = 0.3
# Gain, in storeys of pixels at log-odds 1, for which a cell leaves its floor's rows.
_OWN_ROWS = 0.3


@dataclass(frozen=True)
class FloorRows:
    """What the stripes of one floor show, in rows from the floor's `top` (analysis pixels).

    `cells` holds (t, k, b) for each stripe; b equals k where no railing shows. `window` and
    `railing` are the floor's scores (n, w).
    """

    top: int
    rows: Cell
    cells: list[Cell]
    window: Float
    railing: Float


@dataclass(frozen=True)
class _Part:
    """Running sums over the rows of what is in some stripes, as parts of their width."""

    window: Array
    railing: Array
    line: Array
    storey: float


def read_floors(
    evidence: Evidence, floors: Floors, stripes: Stripes, scores: Scores
) -> list[FloorRows]:
    """Rows of every floor above the ground floor, eaves first; read twice, the floors then tied.

    Without stripes there is nothing to read, and no floors are returned.
    """
    if not stripes:
        return []
    free = [_read(evidence, floors, stripes, scores, n, None) for n in range(_count(floors))]
    heights = [b - a for a, b in pairwise(floors.boundaries)]
    begin, end = (
        float(np.median([f.rows[i] / h for f, h in zip(free, heights, strict=True)]))
        for i in (0, 2)
    )
    return [
        _read(evidence, floors, stripes, scores, n, (begin * h, end * h))
        for n, h in enumerate(heights)
    ]


def _count(floors: Floors) -> int:
    return len(floors.boundaries) - 1


def _read(
    evidence: Evidence, floors: Floors, stripes: Stripes, scores: Scores, n: int, tie: Span | None
) -> FloorRows:
    top, bottom = floors.boundaries[n : n + 2]
    rows = np.s_[top - floors.eaves : bottom - floors.eaves]
    window, railing = scores.window[rows], scores.railing[rows]
    edges = np.minimum(np.abs(evidence.gy[top:bottom]), 25)
    storey = floors.mean_storey
    every = np.zeros(evidence.width, bool)
    masks = [_core_of(x, w, evidence.width) for x, w in stripes]
    for mask in masks:
        every |= mask
    through = np.stack(
        [
            _running(railing[:, a:b].sum(1) - _RUNS_ON * (b - a))
            for a, b in gaps(stripes, evidence.width)
        ],
        axis=1,
    ) / (every.sum() * storey)
    whole = _best_rows(_part(window, railing, edges, every, storey), through, tie)
    cells = []
    for mask in masks:
        part = _part(window, railing, edges, mask, storey)
        own = _best_rows(part, None, (whole[0], whole[2]))
        better = _gain(part, own) - _gain(part, whole) > _OWN_ROWS
        cells.append(own if better else whole)
    return FloorRows(top, whole, cells, window, railing)


def _core_of(x: int, width: int, image_width: int) -> NDArray[np.bool_]:
    """A stripe without its sides, where a window may already have ended."""
    mask = np.zeros(image_width, bool)
    mask[x + width // 8 : x + width - width // 8] = True
    return mask


def gaps(stripes: Stripes, width: int) -> Stripes:
    """Pixel columns (start, end) between the stripes, and to the left and right of all."""
    starts = [0, *(x + w for x, w in stripes)]
    ends = [*(x for x, _ in stripes), width]
    return list(zip(starts, ends, strict=True))


def _part(
    window: Float, railing: Float, edges: Float, inside: NDArray[np.bool_], storey: float
) -> _Part:
    share = max(1, inside.sum()) * storey
    of_window, of_railing = (_running(v[:, inside].sum(1)) / share for v in (window, railing))
    return _Part(of_window, of_railing, _line(edges, inside), storey)


def _running(values: NDArray[np.floating]) -> Array:
    """Running sums down the rows, with a zero row first."""
    total = np.zeros((values.shape[0] + 1, *values.shape[1:]))
    np.cumsum(values, axis=0, out=total[1:])
    return total


def _line(edges: Float, inside: NDArray[np.bool_]) -> Array:
    """Gain (n + 1,) of beginning or ending something between rows: the edge on either side."""
    strength = edges[:, inside].mean(1).astype(np.float64)
    line = np.concatenate([strength[:1], np.maximum(strength[:-1], strength[1:]), strength[-1:]])
    return np.asarray(_EDGE * (line - line.mean()) / (float(line.std()) + 1e-6))


def _best_rows(part: _Part, through: Array | None, tie: Span | None) -> Cell:
    """The rows (t, k, b) of the greatest sum; b equals k where no railing shows."""
    at = np.arange(len(part.line))
    span = at[None, :] - at[:, None]
    begin, end = (np.zeros(len(at), np.float64) for _ in range(2))
    if tie is not None:
        begin, end = (_price(at - row, part.storey) for row in tie)
    gain = _window_gain(part.window, part.line, part.storey, _WINDOW) - begin[:, None]
    t_of_k = gain.argmax(0)
    lower = part.railing[None, :] - part.railing[:, None] + part.line[None, :]
    if through is not None:
        lower = lower + np.maximum(through[None] - through[:, None], 0).sum(-1)
    lower[(span < _RAILING[0] * part.storey) | (span > _RAILING[1] * part.storey)] = -np.inf
    np.fill_diagonal(lower, 0.0)
    total = (gain.max(0) + part.line)[:, None] + lower - end[None, :]
    k, b = np.unravel_index(int(np.argmax(total)), total.shape)
    return int(t_of_k[k]), int(k), int(b)


def _price(off: NDArray[np.floating] | NDArray[np.integer], storey: float) -> Array:
    return np.asarray(_UNLIKE_OTHERS * np.minimum(np.abs(off) / storey, _OTHERWISE), np.float64)


def _gain(part: _Part, cell: Cell) -> float:
    t, k, b = cell
    gain = part.window[k] - part.window[t] + part.line[t] + part.line[k]
    if b > k:
        gain += part.railing[b] - part.railing[k] + part.line[b]
    return float(gain)


def _window_gain(window: Array, line: Array, storey: float, heights: Span) -> Array:
    """Gain (n, n) of a window from row t to row k: its pixels, and the edge that it begins at."""
    at = np.arange(len(window))
    span = at[None, :] - at[:, None]
    gain = window[None, :] - window[:, None] + line[:, None]
    gain[(span < heights[0] * storey) | (span > heights[1] * storey)] = -np.inf
    return np.asarray(gain, np.float64)


def window_rows(
    window: Float, edges: Float, inside: NDArray[np.bool_], storey: float, heights: Span
) -> tuple[int, int]:
    """Rows (t, b) of a row of windows without railings, in the stripes `inside` (w,)."""
    line = _line(edges, inside)
    summed = _running(window[:, inside].sum(1)) / (inside.sum() * storey)
    gain = _window_gain(summed, line, storey, heights) + line[None, :]
    t, b = np.unravel_index(int(np.argmax(gain)), gain.shape)
    return (int(t), int(b)) if np.isfinite(gain[t, b]) else (0, 0)
