"""The horizontal split: window stripes with gaps (paper section 3.3)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta import _core
from veduta.facade.appearance import Scores
from veduta.facade.evidence import Evidence, blur_line, two_class_threshold
from veduta.facade.floors import Floors

# In storeys (3 m): stripes of 0.55 to 2.4 m, gaps of 0.25 to 7.5 m.
_WIDTH = (0.18, 0.8)
_GAP = (0.08, 2.5)
_JAMB = 0.018
_WIDTH_CHANGE = 0.6


@dataclass(frozen=True)
class Columns:
    """Window stripes `(x, width)` in analysis pixels, left to right."""

    stripes: list[tuple[int, int]]
    energy: float
    labels: int


def split_columns(evidence: Evidence, floors: Floors, scores: Scores) -> Columns:
    """Solve the chain of stripes on the evidence of all floors above the ground floor."""
    storey = floors.mean_storey
    profile, jambs = _profiles(evidence, floors, scores)
    widths = list(range(max(3, int(_WIDTH[0] * storey)), int(_WIDTH[1] * storey) + 1))
    energy, stripes = _core.column_chain(
        np.zeros((evidence.width, evidence.width), np.float32),
        profile,
        jambs,
        widths,
        step=1,
        gap_min=max(2, int(_GAP[0] * storey)),
        gap_max=int(_GAP[1] * storey),
        jamb_weight=_JAMB * storey,
        similarity=0.0,
        width_change=_WIDTH_CHANGE / storey,
        gap_symmetry=0.0,
        stripe_symmetry=0.0,
        neutral=0.0,
    )
    return Columns(stripes, energy / evidence.width, len(widths) * evidence.width)


def _profiles(
    evidence: Evidence, floors: Floors, scores: Scores
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Window evidence per pixel column (w,) and jamb evidence per column boundary (w + 1,)."""
    edges = np.minimum(np.abs(evidence.gx[floors.eaves : floors.ground_top]), 20)
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
