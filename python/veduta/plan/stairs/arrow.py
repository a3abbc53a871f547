"""Which way a flight rises: by the word at one end, or by the head of its arrow."""

from __future__ import annotations

import re
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from shapely.geometry import Point, Polygon

from veduta.plan.document import Text

UP = re.compile(r"^\W*((up|sobe|subir|monte|montée|haut|auf|hoch|ylös)\b|h\W*$)", re.I)
DOWN = re.compile(r"^\W*((dn|down|desce|descer|descend|descente|bas|ab|runter|alas)\b|b\W*$)", re.I)
HEAD = 1.3
"""How far from the end of its shaft an arrow's head is looked for, in treads."""
BESIDE = (0.15, 0.6)
"""Where its barbs are, from the shaft, in treads."""
LEAST_BARB = 0.5
"""Of the width that is looked at; a tread hides a part of the head."""
LEAST_SHAFT = 0.45
LEAST_DIFFERENCE = 1.5
"""One end has so many times the ink beside the shaft, or the arrow is not told."""


def way_up(
    area: Polygon,
    across: bool,
    ink: NDArray[np.bool_],
    treads: int,
    texts: Sequence[Text],
) -> tuple[float, float]:
    """The unit vector (x, y down) in which the flight rises; (0, 0) where nothing tells it.

    `across`: its treads are upright lines, so that it runs along x.
    """
    forward = np.array([1.0, 0.0]) if across else np.array([0.0, 1.0])
    sign = _by_word(area, forward, texts) or _by_head(area, across, ink, treads)
    x, y = sign * forward
    return float(x), float(y)


def _by_word(area: Polygon, forward: NDArray[np.float64], texts: Sequence[Text]) -> int:
    """The word `up` stands at the foot, `down` at the head; 0 where there is none."""
    left, low, right, high = area.bounds
    middle = np.array([(left + right) / 2, (low + high) / 2])
    half = float(np.array([right - left, high - low]) @ forward) / 2
    near = area.buffer(0.35 * half)
    for text in texts:
        at = np.mean(text.box_px, axis=0)
        along = float((at - middle) @ forward) / max(half, 1e-9)
        if abs(along) < 0.25 or not near.contains(Point(*at)):
            continue
        if UP.match(text.text):
            return -1 if along > 0 else 1
        if DOWN.match(text.text):
            return 1 if along > 0 else -1
    return 0


def _by_head(area: Polygon, across: bool, ink: NDArray[np.bool_], treads: int) -> int:
    left, low, right, high = (round(one) for one in area.bounds)
    part = ink[max(0, low) : high, max(0, left) : right]
    return head_end(part.T if across else part, treads)


def head_end(part: NDArray[np.bool_], treads: int) -> int:
    """1 where an arrow's head is at the last of (n, m) rows, -1 at the first, 0 where none is.

    It is the shaft's end with barbs beside it; treads, lines along the rows, are taken out first.
    """
    if min(part.shape) < 12:
        return 0
    own = part & ~_treads(part, treads)
    length, width = own.shape
    third = slice(width // 4, width - width // 4)
    shafts = own[:, third].mean(axis=0)
    column = int(np.argmax(shafts)) + width // 4
    rows = np.flatnonzero(own[:, max(0, column - 1) : column + 2].any(axis=1))
    if len(rows) < LEAST_SHAFT * length * 0.6 or np.ptp(rows) < LEAST_SHAFT * length:
        return 0
    tread = length / treads
    reach = max(4, round(HEAD * tread))
    inner, outer = (max(2, round(one * tread)) for one in BESIDE)
    sides = [
        own[:, max(0, column - outer) : column - inner],
        own[:, column + inner : column + outer],
    ]
    first, last = int(rows[0]), int(rows[-1])
    # A barb on both sides: a letter stands on one.
    ends = [
        min(float(side[low_:high_].sum()) for side in sides)
        for low_, high_ in ((first, first + reach), (max(0, last - reach), last + 1))
    ]
    if max(ends) < LEAST_BARB * (outer - inner) or max(ends) < LEAST_DIFFERENCE * min(ends):
        return 0
    return 1 if ends[1] > ends[0] else -1


def _treads(part: NDArray[np.bool_], treads: int) -> NDArray[np.bool_]:
    """Rows that are mostly ink, and those beside them."""
    dark = part.mean(axis=1) > 0.5
    grown = dark.copy()
    for shift in (-1, 1):
        grown |= np.roll(dark, shift)
    if grown.mean() > 0.6 or treads < 1:
        return np.zeros(part.shape, np.bool_)
    return np.repeat(grown[:, None], part.shape[1], axis=1)
