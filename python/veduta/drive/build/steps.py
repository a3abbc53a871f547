"""Where fronts step back or forth: the column of each step, from the points of both fronts.

The main depth is looked for over some metres of the path at once, so that it knows a step only about
as well. A stepped building is no assumption of section 5; its steps are kept, not flattened.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.drive.build.frame import ColumnPoints

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class StepParameters:
    """least_m: fronts that differ by more in depth are two, most_m: by less; what stands farther
    before a front is a hedge or a fence, whose ends are ragged. near_m: so far to both sides of where
    the main depth changes the step is looked for. front_m: over so many metres beside that a
    front's depth is taken. off_m: points so near to it are of it. lowest_m: over the ground.
    """

    least_m: float = 0.3
    most_m: float = 2.5
    near_m: float = 1.5
    front_m: float = 1.5
    off_m: float = 0.2
    lowest_m: float = 0.4


def sharpened(
    main: Floats,
    points: ColumnPoints,
    above: NDArray[np.floating],
    spacing_m: float,
    parameters: StepParameters | None = None,
) -> Floats:
    """(c,) the main depth with each change between two fronts in one column, where the points say.
    Columns without one (NaN) stay so.

    above: (n,) heights of the points over the ground (m).
    """
    chosen = parameters or StepParameters()
    near = max(int(round(chosen.near_m / spacing_m)), 1)
    wide = max(int(round(chosen.front_m / spacing_m)), 2)
    result = main.copy()
    order = np.argsort(points.column, kind="stable")
    first = np.searchsorted(points.column[order], np.arange(len(main) + 1))
    for jump in _jumps(main, near, chosen.least_m):
        low, high = max(jump - near, 0), min(jump + near + 1, len(main))
        before = _level(main[max(low - wide, 0) : low + 1])
        after = _level(main[high - 1 : high + wide])
        if not chosen.least_m < abs(after - before) < chosen.most_m:
            continue
        own = order[first[low] : first[high]]
        own = own[above[own] > chosen.lowest_m]
        column = points.column[own].astype(np.int64) - low
        votes = [
            np.bincount(
                column[np.abs(points.depth[own] - depth) < chosen.off_m], minlength=high - low
            )
            for depth in (before, after)
        ]
        # Columns up to the cut are of the front before it, the others of the one after.
        gain = np.concatenate([[0], np.cumsum(votes[0])])
        gain = gain + np.concatenate([np.cumsum(votes[1][::-1])[::-1], [0]])
        best = np.flatnonzero(gain == gain.max())
        cut = low + int(best[np.argmin(np.abs(best + low - jump))])
        result[low:cut] = _of_front(main[low:cut], before, chosen)
        result[cut:high] = _of_front(main[cut:high], after, chosen)
    return result


def _of_front(given: Floats, depth: float, chosen: StepParameters) -> Floats:
    """What lies near a front stays, and so do columns without a wall; the rest is put on it."""
    with np.errstate(invalid="ignore"):
        other = np.abs(given - depth) >= chosen.least_m
    return np.where(other, depth, given)


def _level(values: Floats) -> float:
    known = values[np.isfinite(values)]
    return float(np.median(known)) if len(known) else float("nan")


def _jumps(main: Floats, near: int, least_m: float) -> list[int]:
    """Columns at which the main depth changes by more over a few columns than over each beside."""
    reach = 2
    change = np.zeros(len(main))
    change[reach:-reach] = np.abs(main[2 * reach :] - main[: -2 * reach])
    change = np.nan_to_num(change)
    found: list[int] = []
    while change.max(initial=0.0) > least_m:
        at = int(np.argmax(change))
        found.append(at)
        change[max(at - near, 0) : at + near + 1] = 0.0
    return sorted(found)
