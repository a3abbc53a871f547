"""The horizontal split: window stripes with gaps (paper section 3.3)."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from veduta import _core
from veduta.facade.appearance import Scores
from veduta.facade.dissimilarity import of_pairs
from veduta.facade.evidence import Evidence, Float, blur_line, two_class_threshold

# In storeys (3 m): stripes of 0.55 to 2.4 m, gaps of 0.25 to 7.5 m.
_WIDTH = (0.18, 0.8)
_GAP = (0.08, 2.5)
_JAMB = 0.025
_WIDTH_CHANGE = 1.0
_SIMILARITY = 0.15
_GAP_SYMMETRY = 0.2
_NEUTRAL = 0.6
_STEPS = 36


@dataclass(frozen=True)
class Columns:
    """Window stripes `(x, width)` in analysis pixels, left to right."""

    stripes: list[tuple[int, int]]
    energy: float
    terms: dict[str, float]
    labels: int


def split_columns(
    evidence: Evidence, top: int, bottom: int, storey: float, scores: Scores
) -> Columns:
    """Solve the chain of stripes on the evidence of all rows from `top` to `bottom`."""
    window = scores.window + scores.level
    profile, jambs = _profiles(evidence, top, bottom, window)
    step = max(1, round(storey / _STEPS))
    narrow, wide = (max(1, round(w * storey / step)) for w in _WIDTH)
    widths = [step * i for i in range(narrow, wide + 1)]
    distance = _distance(window)
    energy, stripes = _core.column_chain(
        distance,
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
        neutral=_NEUTRAL,
    )
    terms = _terms(stripes, distance, profile, jambs, storey)
    return Columns(stripes, energy / evidence.width, terms, len(widths) * evidence.width)


def _terms(
    stripes: list[tuple[int, int]],
    distance: NDArray[np.float32],
    profile: NDArray[np.float64],
    jambs: NDArray[np.float64],
    storey: float,
) -> dict[str, float]:
    """What each term adds to the energy (per pixel column), summed up anew from the stripes."""
    sums = {
        "evidence": float(profile.sum()),
        "jambs": 0.0,
        "similarity": 0.0,
        "width_change": 0.0,
        "gap_symmetry": 0.0,
    }
    for x, w in stripes:
        sums["evidence"] -= 2 * float(profile[x : x + w].sum())
        sums["jambs"] -= _JAMB * storey * float(jambs[x] + jambs[x + w])
    for (x, w), (other, width) in pairwise(stripes):
        shared = np.arange(min(w, width))
        unlike = float(distance[x + shared, other + shared].mean(dtype=np.float64)) - _NEUTRAL
        sums["similarity"] += _SIMILARITY * unlike * width
        sums["width_change"] += _WIDTH_CHANGE / storey * abs(w - width)
        half = np.arange((other - x - w) // 2)
        mirrored = distance[x + w + half, other - 1 - half]
        unlike = float(mirrored.mean(dtype=np.float64)) if len(half) else 0.0
        sums["gap_symmetry"] += _GAP_SYMMETRY * (unlike - _NEUTRAL) * (other - x - w)
    return {name: total / len(profile) for name, total in sums.items()}


def _distance(window: Float) -> NDArray[np.float32]:
    """Mean squared difference of any two pixel columns (w, w), 1 for two at random."""
    distance = of_pairs(window.T)
    return np.asarray(distance / max(float(distance.mean()), 1e-6), np.float32)


def _profiles(
    evidence: Evidence, top: int, bottom: int, scores: Float
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Window evidence per pixel column (w,) and jamb evidence per column boundary (w + 1,)."""
    edges = np.minimum(np.abs(evidence.gx[top:bottom]), 20)
    rows = np.maximum(scores.std(1), 1e-3)
    rows /= rows.sum()
    window = rows @ scores
    window = window - two_class_threshold(window)
    window /= float(window.std()) + 1e-6
    edge = blur_line(rows @ edges, 0.8)
    edge = (edge - edge.mean()) / (float(edge.std()) + 1e-6)
    jambs = np.zeros(len(edge) + 1)
    jambs[1:-1] = np.clip(np.maximum(edge[:-1], edge[1:]), -1, 3)
    return np.clip(window, -1.5, 1.5).astype(np.float64), jambs
