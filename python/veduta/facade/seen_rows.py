"""Rows of windows as the learned eyes saw them, and the floors that follow from the rows."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from veduta.facade.eyes import SeenElement
from veduta.facade.floors import Floors


@dataclass(frozen=True)
class RowParameters:
    """When windows are a row, and where floors end between rows.

    `overlap`: share of the lower window's height that two windows of a row have in common.
    `share`: windows of a row, at least, as a share of those of the fullest. `line`: where between
    the sills of one floor and the heads of the floor below the line is drawn, from above.
    `eaves`, `ground`: how far above the upper heads and below the last sills, in storeys, the wall
    goes on where nothing else says it. `own_ground`: the lowest row is the ground floor's own where
    less than this, in storeys, lies below its sills. `even`: how much the widest step from row to
    row may exceed the narrowest before the storeys are doubtful.
    `least_even`: so many rows, evenly apart, tell that one between two of them is none.
    `sure`: the score of a window that is; at least `least_sure` of them, and `sure_share` of all,
    must be for storeys to be read from them.
    `cellar_high`, `cellar_near`: the lowest row is that of a cellar where its windows are lower
    than this share of those above, and its step from them is less than this share of the storey (of
    their height, where no other step tells it: `cellar_by_height`).
    `through`: a floor's border is none where it runs through a row, this share of the row's height
    away from its heads and sills. `two_in_one`: a ground floor has no two rows, if not a cellar's,
    whose sills are this many storeys apart.
    """

    overlap: float = 0.5
    share: float = 0.2
    line: float = 0.62
    eaves: float = 0.3
    ground: float = 0.3
    own_ground: float = 0.72
    even: float = 1.75
    least_even: int = 3
    sure: float = 0.5
    least_sure: int = 3
    sure_share: float = 0.5
    cellar_high: float = 0.65
    cellar_near: float = 0.8
    cellar_by_height: float = 1.6
    through: float = 0.15
    two_in_one: float = 0.7


@dataclass(frozen=True)
class WindowRow:
    """The windows (places in a list) of one row, and its median head and sill (rows of pixels)."""

    members: tuple[int, ...]
    top: float
    bottom: float


def window_rows(boxes: NDArray[np.float64], parameters: RowParameters) -> list[WindowRow]:
    """Rows of the windows (n, 4: x0, y0, x1, y1; the surest first), from above."""
    rows: list[list[int]] = []
    for i, (_, y0, _, y1) in enumerate(boxes):
        best, most = None, parameters.overlap
        for row in rows:
            top, bottom = np.median(boxes[row, 1]), np.median(boxes[row, 3])
            share = (min(y1, bottom) - max(y0, top)) / max(min(y1 - y0, bottom - top), 1e-6)
            if share > most:
                best, most = row, share
        if best is None:
            rows.append([i])
        else:
            best.append(i)
    fullest = max((len(row) for row in rows), default=0)
    kept = [row for row in rows if len(row) >= max(1, parameters.share * fullest)]
    found = [
        WindowRow(tuple(row), float(np.median(boxes[row, 1])), float(np.median(boxes[row, 3])))
        for row in kept
    ]
    return _clear(sorted(found, key=lambda r: r.top + r.bottom))


def _clear(rows: list[WindowRow]) -> list[WindowRow]:
    """Without rows that lie in a fuller one."""
    kept: list[WindowRow] = []
    for row in rows:
        if kept and row.top < kept[-1].bottom - 0.25 * (row.bottom - row.top):
            if len(row.members) > len(kept[-1].members):
                kept[-1] = row
            continue
        kept.append(row)
    return kept


def are_sure(windows: Sequence[SeenElement], parameters: RowParameters) -> bool:
    """Whether enough of the windows are sure."""
    sure = sum(e.score >= parameters.sure for e in windows)
    return sure >= max(parameters.least_sure, parameters.sure_share * len(windows))


def pitch(rows: Sequence[WindowRow]) -> float | None:
    """The median step from the sills of one row to those of the next (px)."""
    steps = [b.bottom - a.bottom for a, b in pairwise(rows)]
    return float(np.median(steps)) if steps else None


def is_even(rows: Sequence[WindowRow], eaves: float | None, parameters: RowParameters) -> bool:
    """Whether the rows below the eaves are about as far apart as storeys are."""
    below = [r for r in rows if eaves is None or 0.5 * (r.top + r.bottom) > eaves]
    steps = [b.bottom - a.bottom for a, b in pairwise(below)]
    return bool(steps) and max(steps) <= parameters.even * min(steps)


def odd_row(
    rows: Sequence[WindowRow],
    scores: Sequence[float],
    eaves: float | None,
    parameters: RowParameters,
) -> WindowRow | None:
    """The one row of doubtful windows without which uneven rows are evenly apart; or None.

    Such are reliefs, niches and signs between the windows of two floors. scores: of the windows.
    """
    if len(rows) < parameters.least_even + 1 or is_even(rows, eaves, parameters):
        return None
    doubtful = [
        row
        for row in rows[1:-1]
        if float(np.median([scores[i] for i in row.members])) < parameters.sure
    ]
    odd = [row for row in doubtful if is_even([r for r in rows if r is not row], eaves, parameters)]
    return odd[0] if len(odd) == 1 else None


def without_cellar(rows: Sequence[WindowRow], parameters: RowParameters) -> list[WindowRow]:
    """The rows without that of a cellar or plinth, whose low windows lie close below others."""
    if len(rows) < 2:
        return list(rows)
    *above, last = rows
    high = np.array([r.bottom - r.top for r in above])
    storey = pitch(above) or parameters.cellar_by_height * float(high[-1])
    is_low = last.bottom - last.top < parameters.cellar_high * float(min(high[-1], np.median(high)))
    step = last.bottom - above[-1].bottom
    return above if is_low and step < parameters.cellar_near * storey else list(rows)


def agrees(floors: Floors, rows: Sequence[WindowRow], parameters: RowParameters) -> bool:
    """Whether each floor above the ground floor has just one of the rows, and none is cut.

    Nor has the ground floor two rows of its own; the rows are those without a cellar's.
    """
    middles = np.array([0.5 * (r.top + r.bottom) for r in rows])
    inside = middles[(middles > floors.eaves) & (middles < floors.ground_top)]
    counts = np.histogram(inside, np.array(floors.boundaries, np.float64))[0]
    if not bool((counts == 1).all()):
        return False
    sills = [r.bottom for r in rows if 0.5 * (r.top + r.bottom) > floors.ground_top]
    apart = parameters.two_in_one * floors.mean_storey
    if any(b - a > apart for a, b in pairwise(sills)):
        return False
    return not any(_is_through(border, r, parameters) for border in floors.boundaries for r in rows)


def _is_through(border: float, row: WindowRow, parameters: RowParameters) -> bool:
    """Whether a border of floors runs through the windows of a row."""
    aside = parameters.through * (row.bottom - row.top)
    return row.top + aside < border < row.bottom - aside


def without_roof(floors: Floors, top: int, rows: Sequence[WindowRow]) -> Floors | None:
    """The floors with the wall up to `top`; None where a row of windows is above them."""
    if any(0.5 * (r.top + r.bottom) < floors.eaves for r in rows):
        return None
    return replace(floors, boundaries=[top, *floors.boundaries[1:]])


def floors_of_rows(
    rows: Sequence[WindowRow],
    eaves: float | None,
    roof: float,
    bottom: int,
    parameters: RowParameters,
    *,
    has_cellar: bool = False,
) -> Floors | None:
    """Floors with a row of windows each; None where there are none above the ground floor.

    `eaves` is where another step has them, `roof` the upper end of the building, `bottom` the
    street (rows of pixels). Above windows of a cellar, the lowest row is the ground floor's.
    """
    storey = pitch(rows)
    if storey is None:
        return None
    rows = [r for r in rows if eaves is None or 0.5 * (r.top + r.bottom) > eaves]
    if not rows:
        return None
    lines = [a.bottom + parameters.line * (b.top - a.bottom) for a, b in pairwise(rows)]
    if not has_cellar and bottom - rows[-1].bottom >= parameters.own_ground * storey:
        below = rows[-1].bottom + parameters.ground * storey
        lines.append(min(below, bottom - 0.3 * storey))
    above = rows[0].top - parameters.eaves * storey
    if eaves is not None and 0 <= rows[0].top - eaves <= 0.9 * storey:
        above = eaves
    boundaries = [max(above, roof, 0.0), *lines]
    found = [round(v) for v in boundaries]
    if len(found) < 2 or min(np.diff(found)) < 2:
        return None
    return Floors(found, storey, 0.0, {}, 0)
