"""How far the railings of a floor reach sideways: one window, several, or the whole floor."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from veduta.facade.opening_rows import FloorRows, Stripes, gaps

# Mean log-odds at which a railing is taken to run on.
_RUNS_ON = 0.15
# In storeys of pixel columns at log-odds 1: what a break in a railing must gain.
_BREAK = 0.1
# In storeys: how much the rows of two railings may differ for them to be one.
_SAME_ROWS = 0.1


@dataclass(frozen=True)
class _Gap:
    """What a gap shows: how far the railings at its sides reach in, and whether it is all one."""

    from_left: int
    from_right: int
    joined: bool


def find_railings(
    floor: FloorRows, stripes: Stripes, storey: float
) -> list[tuple[int, int, int, int]]:
    """Railings (x, end, k, b) of a floor, in analysis pixels and rows from the floor's top."""
    shown = [b > k for _, k, b in floor.cells]
    between = [
        _read_gap(floor, g, gap, storey)
        for g, gap in enumerate(gaps(stripes, floor.railing.shape[1]))
    ]
    spans: list[tuple[int, int, list[int]]] = []
    for i, (x, w) in enumerate(stripes):
        if not shown[i]:
            continue
        start, end = x - between[i].from_right, x + w + between[i + 1].from_left
        if spans and between[i].joined:
            start, _, members = spans.pop()
            spans.append((start, end, [*members, i]))
        else:
            spans.append((start, end, [i]))
    return [(a, b, *_rows(floor, members)) for a, b, members in spans]


def _rows(floor: FloorRows, members: list[int]) -> tuple[int, int]:
    k, b = np.median([floor.cells[i][1:] for i in members], axis=0)
    return int(k), int(b)


def _read_gap(floor: FloorRows, g: int, gap: tuple[int, int], storey: float) -> _Gap:
    """The best of: one railing through the gap, or an end of each in it."""
    before = floor.cells[g - 1] if g > 0 else (0, 0, 0)
    after = floor.cells[g] if g < len(floor.cells) else (0, 0, 0)
    (start, end), both = gap, before[1] < before[2] and after[1] < after[2]
    if end <= start:
        return _Gap(0, 0, both)
    left, reach_left, whole_left = _reach(floor, before, start, end, False)
    right, reach_right, whole_right = _reach(floor, after, start, end, True)
    off = max(abs(before[1] - after[1]), abs(before[2] - after[2]))
    if both and off < _SAME_ROWS * storey:
        whole = (whole_left + whole_right) / 2
        if whole >= 0 and whole > max(left, right) - _BREAK * storey:
            return _Gap(0, 0, True)
        if reach_left + reach_right >= end - start:
            return _Gap(0, 0, True)
    if reach_left + reach_right > end - start:
        reach_left = (end - start) * reach_left // (reach_left + reach_right)
        reach_right = end - start - reach_left
    return _Gap(reach_left, reach_right, False)


def _reach(
    floor: FloorRows, cell: tuple[int, int, int], start: int, end: int, backwards: bool
) -> tuple[float, int, float]:
    """The greatest sum on entering the gap from one side, its columns, and the sum of all."""
    _, k, b = cell
    if b <= k:
        return 0.0, 0, 0.0
    columns = floor.railing[k:b, start:end].mean(0) - _RUNS_ON
    summed = np.concatenate([[0.0], np.cumsum(columns[::-1] if backwards else columns)])
    best = int(np.argmax(summed))
    return float(summed[best]), best, float(summed[-1])
