"""The horizontal split: window stripes with gaps (paper section 3.3)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta import _core
from veduta.facade.appearance import Scores
from veduta.facade.evidence import Evidence, blur_line, two_class_threshold

# In storeys (3 m): stripes of 0.55 to 2.4 m, gaps of 0.25 to 7.5 m.
_WIDTH = (0.18, 0.8)
_GAP = (0.08, 2.5)
_JAMB = 0.025
_WIDTH_CHANGE = 1.0
_SIMILARITY = 0.15
_GAP_SYMMETRY = 0.2
_STRIPE_SYMMETRY = 0.0
_NEUTRAL = 0.6
_STEPS = 36


@dataclass(frozen=True)
class Columns:
    """Window stripes `(x, width)` in analysis pixels, left to right."""

    stripes: list[tuple[int, int]]
    energy: float
    labels: int


def split_columns(
    evidence: Evidence, top: int, bottom: int, storey: float, scores: Scores
) -> Columns:
    """Solve the chain of stripes on the evidence of all rows from `top` to `bottom`."""
    profile, jambs = _profiles(evidence, top, bottom, scores)
    step = max(1, round(storey / _STEPS))
    narrow, wide = (max(1, round(w * storey / step)) for w in _WIDTH)
    widths = [step * i for i in range(narrow, wide + 1)]
    energy, stripes = _core.column_chain(
        _distance(scores),
        profile,
        jambs,
        widths,
        step=step,
        gap_min=max(2, int(_GAP[0] * storey)),
        gap_max=int(_GAP[1] * storey),
        jamb_weight=_JAMB * storey,
        similarity=_SIMILARITY,
        width_change=_WIDTH_CHANGE / storey,
        gap_symmetry=_GAP_SYMMETRY,
        stripe_symmetry=_STRIPE_SYMMETRY,
        neutral=_NEUTRAL,
    )
    return Columns(stripes, energy / evidence.width, len(widths) * evidence.width)


def _distance(scores: Scores) -> NDArray[np.float32]:
    """Mean squared difference of any two pixel columns (w, w), 1 for two at random."""
    columns = scores.window.T
    squares = (columns * columns).sum(1)
    distance = squares[:, None] + squares[None] - 2 * columns @ columns.T
    return np.asarray(distance / max(float(distance.mean()), 1e-6), np.float32)


def _profiles(
    evidence: Evidence, top: int, bottom: int, scores: Scores
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Window evidence per pixel column (w,) and jamb evidence per column boundary (w + 1,)."""
    edges = np.minimum(np.abs(evidence.gx[top:bottom]), 20)
    rows = np.maximum(scores.window.std(1), 1e-3)
    rows /= rows.sum()
    window = rows @ scores.window
    window = window - two_class_threshold(window)
    window /= float(window.std()) + 1e-6
    edge = blur_line(rows @ edges, 0.8)
    edge = (edge - edge.mean()) / (float(edge.std()) + 1e-6)
    jambs = np.zeros(len(edge) + 1)
    jambs[1:-1] = np.clip(np.maximum(edge[:-1], edge[1:]), -1, 3)
    return np.clip(window, -1.5, 1.5).astype(np.float64), jambs
