"""The boxes of balconies, brought to their railings: what lies below them is slab and wall.

The eyes learned balconies from rectangles that people drew around railing, slab and consoles. As
such boxes railings come out too tall, and what is below them is taken off the wall.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.facade.evidence import Evidence, Float
from veduta.facade.eyes import Seen, SeenElement

Line = NDArray[np.float64]


@dataclass(frozen=True)
class RailingParameters:
    """Where a railing begins and ends in the box that the eyes give.

    chance: that rows of it are of a balcony, half of their pixels at least. around: how far beyond
    the box these are looked for, and kept: the least height of them, in heights of the box. upper:
    the share of these rows that is railing for sure. upright: the share of its upright edges that a
    row has, at least, that belongs to it. shortest: the least height of it, as a share of the rows.
    least_px: lower boxes stay (evidence pixels).
    """

    chance: float = 0.5
    around: float = 0.25
    kept: float = 0.4
    upper: float = 0.6
    upright: float = 0.5
    shortest: float = 0.45
    least_px: int = 6


def on_railings(
    elements: Sequence[SeenElement],
    seen: Seen,
    evidence: Evidence,
    parameters: RailingParameters | None = None,
) -> list[SeenElement]:
    """The elements (pixels of what was seen), balconies as high as their railings."""
    if not any(e.kind == "balcony" for e in elements):
        return list(elements)
    p = parameters or RailingParameters()
    chance = seen.chance_at((evidence.width, evidence.height), "balcony")
    upright = np.abs(evidence.gx)
    scale = evidence.px_per_rectified
    return [_fitted(e, chance, upright, scale, p) if e.kind == "balcony" else e for e in elements]


def _fitted(
    e: SeenElement, chance: Float, upright: Float, scale: float, p: RailingParameters
) -> SeenElement:
    """chance, upright: (h, w), `scale` times as large as what was seen."""
    left = max(0, int(e.x0 * scale))
    columns = slice(left, max(left + 1, int(e.x1 * scale) + 1))
    rows = _rows_of(chance[:, columns], (e.y0 * scale, e.y1 * scale), p)
    top, bottom = rows or (e.y0 * scale, e.y1 * scale)
    foot = _foot(upright[:, columns], round(top), round(bottom), p)
    return replace(
        e,
        y0=e.y0 if rows is None else top / scale,
        y1=e.y1 if rows is None and foot is None else (bottom if foot is None else foot) / scale,
    )


def _rows_of(
    chance: Float, box: tuple[float, float], p: RailingParameters
) -> tuple[float, float] | None:
    """From and to which row pixels of the columns of a box are of a balcony; None where few are."""
    high = box[1] - box[0]
    first = max(0, int(box[0] - p.around * high))
    last = min(len(chance), int(box[1] + p.around * high) + 1)
    if last - first < 2:
        return None
    usual = np.median(chance[first:last], axis=1)
    place = int(usual.argmax())
    if usual[place] <= p.chance:
        return None
    none = np.flatnonzero(usual <= p.chance)
    start = int(none[none < place].max(initial=-1)) + 1
    end = int(none[none > place].min(initial=len(usual)))
    return (first + start, first + end) if end - start >= p.kept * high else None


def _foot(upright: Float, top: int, bottom: int, p: RailingParameters) -> float | None:
    """The row at which the bars of a railing end; None where they reach to the bottom.

    It is the first gap of two rows: below the slab, consoles have upright edges again.
    upright: (h, w) the strength of upright edges in the columns of a box.
    """
    rows = upright[max(0, top) : bottom].mean(axis=1, dtype=np.float64)
    if len(rows) < p.least_px:
        return None
    profile = cv2.blur(rows.reshape(-1, 1), (1, 3)).ravel()
    usual = float(np.median(profile[: max(3, round(p.upper * len(rows)))]))
    first = int(p.shortest * len(rows)) + 1
    gaps = np.flatnonzero(profile[first:] < p.upright * usual)
    slab = [a for a, b in pairwise(gaps.tolist()) if b == a + 1]
    return max(0, top) + first + slab[0] if slab else None
