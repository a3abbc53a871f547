"""The window rectangle of each floor and column, and the balconies in front of them.

Within a floor the rows of a window stripe read from top to bottom: wall, window, railing, wall.
The best rows (t, k, b) maximise the sum of the pixels' log-odds in the stripes plus, for each gap
between the stripes, that of a railing running on through it where that is positive: one exact
search decides windows, single balconies and running balconies together.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from veduta.facade.appearance import Scores
from veduta.facade.columns import Columns
from veduta.facade.evidence import Evidence
from veduta.facade.floors import Floors

# In storeys: heights of a window's visible part and of a railing in the image.
_WINDOW = (0.2, 0.9)
_RAILING = (0.12, 0.5)
# Weight of the horizontal edges at t, k and b against the pixel scores.
_EDGE = 0.04
# Mean log-odds at which a railing is taken to run on through a gap.
_RUNS_ON = 0.15

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Box:
    """A rectangle in analysis pixels, with what says that it is there (0..1)."""

    kind: str
    x: int
    y: int
    width: int
    height: int
    floor: int | None
    column: int | None
    score: float


def find_openings(
    evidence: Evidence, floors: Floors, columns: Columns, scores: Scores
) -> list[Box]:
    """Windows and balconies of every floor above the ground floor, eaves first."""
    boxes: list[Box] = []
    if not columns.stripes:
        return boxes
    above = len(floors.boundaries) - 1
    for i, (top, bottom) in enumerate(pairwise(floors.boundaries)):
        rows = np.s_[top - floors.eaves : bottom - floors.eaves]
        edges = np.minimum(np.abs(evidence.gy[top:bottom]), 25)
        boxes += _floor(
            columns.stripes,
            scores.window[rows],
            scores.railing[rows],
            edges,
            floors.mean_storey,
            (above - i, top),
        )
    return boxes


def _running(values: NDArray[np.floating]) -> Array:
    """Running sums down the rows, with a zero row first."""
    total = np.zeros((values.shape[0] + 1, *values.shape[1:]))
    np.cumsum(values, axis=0, out=total[1:])
    return total


def _floor(
    stripes: list[tuple[int, int]],
    window: NDArray[np.float32],
    railing: NDArray[np.float32],
    edges: NDArray[np.float32],
    storey: float,
    place: tuple[int, int],
) -> list[Box]:
    floor, top = place
    inside = np.zeros(window.shape[1], bool)
    for x, w in stripes:
        inside[x + w // 8 : x + w - w // 8] = True
    gaps = _gaps(stripes, window.shape[1])
    share = inside.sum() * storey
    through = np.stack(
        [_running(railing[:, a:b].sum(1) - _RUNS_ON * (b - a)) for a, b in gaps], axis=1
    )
    t, k, b = _best_rows(
        _running(window[:, inside].sum(1)) / share,
        _running(railing[:, inside].sum(1)) / share,
        through / share,
        _line(edges, inside),
        storey,
    )
    boxes = [Box("window", x, top + t, w, k - t, floor, i, 0.5) for i, (x, w) in enumerate(stripes)]
    if b > k:
        on = through[b] - through[k] > 0
        boxes += [
            Box("balcony", x, top + k, end - x, b - k, floor, None, 0.5)
            for x, end in _spans(stripes, gaps, on)
        ]
    return boxes


def _gaps(stripes: list[tuple[int, int]], width: int) -> list[tuple[int, int]]:
    """Pixel columns between the stripes, and to the left and right of all."""
    starts = [0, *(x + w for x, w in stripes)]
    ends = [*(x for x, _ in stripes), width]
    return list(zip(starts, ends, strict=True))


def _best_rows(
    window: Array, railing: Array, through: Array, line: Array, storey: float
) -> tuple[int, int, int]:
    """The rows (t, k, b) of the greatest sum; b equals k where no railing shows."""
    n = len(window)
    at = np.arange(n)
    span = at[None, :] - at[:, None]
    gain = _window_gain(window, line, storey, _WINDOW)
    t_of_k = gain.argmax(0)
    upper = gain.max(0)
    lower = railing[None, :] - railing[:, None] + line[None, :]
    lower = lower + np.maximum(through[None] - through[:, None], 0).sum(-1)
    lower[(span < _RAILING[0] * storey) | (span > _RAILING[1] * storey)] = -np.inf
    np.fill_diagonal(lower, 0.0)
    total = upper[:, None] + line[:, None] + lower
    k, b = np.unravel_index(int(np.argmax(total)), total.shape)
    return int(t_of_k[k]), int(k), int(b)


def _window_gain(window: Array, line: Array, storey: float, heights: tuple[float, float]) -> Array:
    """Gain (n, n) of a window from row t to row k: its pixels, and the edge that it begins at."""
    at = np.arange(len(window))
    span = at[None, :] - at[:, None]
    gain = window[None, :] - window[:, None] + line[:, None]
    gain[(span < heights[0] * storey) | (span > heights[1] * storey)] = -np.inf
    return np.asarray(gain, np.float64)


def window_rows(
    window: NDArray[np.float32],
    edges: NDArray[np.float32],
    inside: NDArray[np.bool_],
    storey: float,
    heights: tuple[float, float],
) -> tuple[int, int]:
    """Rows (t, b) of a row of windows without railings, in the stripes `inside` (w,)."""
    line = _line(edges, inside)
    summed = _running(window[:, inside].sum(1)) / (inside.sum() * storey)
    gain = _window_gain(summed, line, storey, heights) + line[None, :]
    t, b = np.unravel_index(int(np.argmax(gain)), gain.shape)
    return (int(t), int(b)) if np.isfinite(gain[t, b]) else (0, 0)


def _line(edges: NDArray[np.float32], inside: NDArray[np.bool_]) -> Array:
    """Gain (n + 1,) of beginning or ending something at each row: its horizontal edges."""
    line = edges[:, inside].mean(1).astype(np.float64)
    return np.append(_EDGE * (line - line.mean()) / (float(line.std()) + 1e-6), 0.0)


def _spans(
    stripes: list[tuple[int, int]], gaps: list[tuple[int, int]], on: NDArray[np.bool_]
) -> list[tuple[int, int]]:
    """Stripes joined through the gaps that the railing runs through."""
    spans: list[tuple[int, int]] = []
    for i, (x, w) in enumerate(stripes):
        start = gaps[i][0] if on[i] else x
        if on[i] and spans:
            start = spans.pop()[0]
        end = gaps[-1][1] if i == len(stripes) - 1 and on[-1] else x + w
        spans.append((start, end))
    return spans
