"""An exact chain over pixel columns: wall and openings take turns.

Openings (doors, windows, shop fronts) part stretches of wall; each has a range of widths and a gain
that depends on where it starts and ends. The best sequence is found exactly, by the best way to
reach each pixel column with wall, and with an opening, to its left (a semi-Markov chain, Viterbi).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Rows = NDArray[np.int64]


@dataclass(frozen=True)
class Gains:
    """Gain (m,) of each start for one end, and the rows at which the opening begins and ends."""

    gain: Array
    top: Rows
    bottom: Rows


@dataclass(frozen=True)
class Kind:
    """A kind of opening: widths (pixels), and the gains of all starts `slice` for an end."""

    name: str
    widths: tuple[int, int]
    gains: Callable[[slice, int], Gains]


@dataclass(frozen=True)
class Opening:
    """An opening from column `start` to `end` and from row `top` to `bottom`, ends not included."""

    name: str
    start: int
    end: int
    top: int
    bottom: int


def solve(wall: Array, boundary: Array, pier: int, kinds: list[Kind]) -> list[Opening]:
    """Openings of the best sequence, left to right.

    `wall` (w + 1,) are running sums of the gain of wall, `boundary` (w + 1,) what a change between
    wall and opening gains at each column boundary, `pier` the least width of wall in pixels.
    """
    width = len(wall) - 1
    pier = min(pier, width)
    after_wall, after_opening = (np.full(width + 1, -np.inf) for _ in range(2))
    after_wall[0] = after_opening[0] = 0.0
    wall_from = np.zeros(width + 1, np.int64)
    found: list[Opening | None] = [None] * (width + 1)
    for end in range(1, width + 1):
        for kind in kinds:
            starts = slice(max(0, end - kind.widths[1]), end - kind.widths[0] + 1)
            if starts.stop <= starts.start:
                continue
            options = kind.gains(starts, end)
            total = after_wall[starts] + boundary[starts] + options.gain
            i = int(np.argmax(total))
            if total[i] > after_opening[end]:
                after_opening[end] = total[i]
                rows = int(options.top[i]), int(options.bottom[i])
                found[end] = Opening(kind.name, starts.start + i, end, *rows)
        if end >= pier:
            total = after_opening[: end - pier + 1] + boundary[: end - pier + 1]
            total = total - wall[: end - pier + 1]
            wall_from[end] = np.argmax(total)
            after_wall[end] = total[wall_from[end]] + wall[end]
    return _trace(after_wall[width] >= after_opening[width], wall_from, found)


def _trace(wall_last: bool, wall_from: Rows, found: list[Opening | None]) -> list[Opening]:
    """Follow the best sequence back from the right end."""
    openings: list[Opening] = []
    at = int(wall_from[-1]) if wall_last else len(found) - 1
    while at > 0:
        opening = found[at]
        if opening is None:
            break
        openings.append(opening)
        at = int(wall_from[opening.start])
    return openings[::-1]
