"""Where the facade is in each column: histograms, main depth and split depth (section 5).

The paper takes the depth that occurs most often and a median filter across the columns. Where
scans are merged, near things have more points than far ones; so each depth is weighed by the height
of what stands there, not by points, and the filter is the cheapest line through the 2D histogram.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from veduta.drive.build.frame import ColumnFrame, ColumnPoints
from veduta.drive.build.porches import find_porches
from veduta.drive.build.steps import sharpened


@dataclass(frozen=True)
class DepthParameters:
    """Thresholds of the main depth.

    bin_m: of depth. level_m: of height. lowest_m, highest_m: heights over the ground that count; a
    kerb is no wall. wide_m: a main structure extends over several feet along the path (section 5).
    least_m: height that stands upright at one depth, for a column to have a main structure.
    farther: what a metre of depth is worth, in metres of height: a wall stands behind what hides
    it. step: cost of a change of depth by a bin, at most `jump` (houses step back).
    most_m: more height than this counts no more, but over tall_m each metre is worth `taller` where
    what is farther by behind_m or more is seen below its top only, by over_deg: a room behind
    windows shows more of itself than a wall behind a hedge, but never above the front. nearest_m:
    nearer things are on the road.
    """

    bin_m: float = 0.15
    level_m: float = 0.15
    lowest_m: float = 0.4
    highest_m: float = 8.0
    wide_m: float = 2.0
    least_m: float = 0.35
    most_m: float = 0.8
    tall_m: float = 2.0
    taller: float = 0.1
    behind_m: float = 1.0
    over_deg: float = 1.0
    farther: float = 0.015
    nearest_m: float = 3.0
    step: float = 0.15
    jump: float = 8.0
    split_m: float = 1.2
    valley: float = 0.35
    slants: tuple[float, ...] = (-1.0, -0.5, -0.25, 0.0, 0.25, 0.5, 1.0)
    """Metres of depth per metre of path at which walls are looked for."""
    thick_m: float = 0.6
    """A wall is thin: what stands so far before and behind counts against it (hedges)."""
    thick: float = 1.0
    across_m: float = 1.2
    """A wall across the path is looked for so near to where the main depth jumps."""
    across_jump_m: float = 1.5
    across_share: float = 0.45
    lone_m: float = 3.0
    """A piece shorter than this along the path is a tree or a van, not a front,"""
    lone_before_m: float = 1.5
    """where it stands so far before what is on both of its sides (the paper's median filter)."""


@dataclass(frozen=True, eq=False)
class MainDepth:
    """main, split: (c,) m, NaN in columns without a main structure.

    histogram: (c, k) height that stands at each depth (m), averaged along the path. across: (c,)
    columns in which a wall runs across the path (section 8.4): it is kept, not cut off. porch: (c,)
    columns whose main depth is the front of a porch, with the wall behind it.
    """

    main: NDArray[np.float64]
    split: NDArray[np.float64]
    across: NDArray[np.bool_]
    porch: NDArray[np.bool_]
    histogram: NDArray[np.float32]
    bin_m: float


def find_main_depth(
    points: ColumnPoints,
    above_ground: NDArray[np.floating],
    frame: ColumnFrame,
    farthest_m: float,
    parameters: DepthParameters | None = None,
) -> MainDepth:
    """above_ground: (n,) height of each point over the ground (m)."""
    chosen = parameters or DepthParameters()
    raw = _standing(points, above_ground, frame, farthest_m, chosen)
    histogram = _along(raw, frame.spacing_m, chosen)
    bins = histogram.shape[1]
    depth = (np.arange(bins) + 0.5) * chosen.bin_m
    beside = int(round(chosen.thick_m / chosen.bin_m))
    around = 0.5 * (_moved(histogram, 0, beside) + _moved(histogram, 0, -beside))
    thin = histogram - chosen.thick * around
    gain = np.minimum(thin, chosen.most_m)
    over = _over_what_is_behind(points, above_ground, raw.shape, frame.spacing_m, chosen)
    gain = gain + chosen.taller * np.where(over, np.maximum(thin - chosen.tall_m, 0.0), 0.0)
    standing = (histogram >= chosen.least_m) & (depth >= chosen.nearest_m)
    gain = np.where(standing, gain + chosen.farther * depth, 0.0)
    line = _cheapest_line(-gain, chosen)
    line, lone = _without_lone(line, frame.spacing_m, chosen)
    supported = (gain[np.arange(len(line)), line] > 0.0) | lone
    main = np.where(supported, depth[line], np.nan)
    main = _refined(points, above_ground, main, chosen)
    main = sharpened(main, points, above_ground, frame.spacing_m)
    split = np.minimum(_split(histogram, line, chosen), main - chosen.bin_m)
    split = np.where(supported, split, np.nan)
    split, across = _walls_across(raw, main, split, frame.spacing_m, chosen)
    front = find_porches(points, above_ground, main, frame)
    porch = np.isfinite(front)
    main = np.where(porch, front, main)
    split = np.where(porch, front - 2 * chosen.bin_m, split)
    return MainDepth(main, split, across | porch, porch, histogram, chosen.bin_m)


def _over_what_is_behind(
    points: ColumnPoints,
    above: NDArray[np.floating],
    shape: tuple[int, ...],
    spacing_m: float,
    chosen: DepthParameters,
) -> NDArray[np.bool_]:
    """(c, k) where what stands at a depth reaches higher than all that is seen behind it, about."""
    bins = (points.depth / chosen.bin_m).astype(np.int64)
    kept = (bins < shape[1]) & (above > chosen.lowest_m)
    top = np.full(shape, -np.pi / 2, dtype=np.float32)
    np.maximum.at(top, (points.column[kept], bins[kept]), points.angle[kept])
    wide = max(int(round(chosen.wide_m / spacing_m)) | 1, 3)
    top = ndimage.maximum_filter(top, (wide, 3), mode="nearest")
    gap = max(int(round(chosen.behind_m / chosen.bin_m)), 1)
    behind = np.full(shape, -np.pi / 2, dtype=np.float32)
    behind[:, :-gap] = np.maximum.accumulate(top[:, ::-1], axis=1)[:, ::-1][:, gap:]
    seen = behind > -np.pi / 2
    return np.asarray(seen & (top > behind + np.deg2rad(chosen.over_deg)))


def _moved(values: NDArray[np.float32], columns: int, bins: int) -> NDArray[np.float32]:
    """What stands `columns` and `bins` further on, at each place; 0 outside."""
    return np.asarray(
        ndimage.shift(values, (-columns, -bins), order=0, mode="constant"), dtype=np.float32
    )


def _along(
    raw: NDArray[np.float32], spacing_m: float, chosen: DepthParameters
) -> NDArray[np.float32]:
    """(c, k) the mean height over the columns beside, along the slant that gives most, in a bin
    and its neighbours."""
    half = max(int(round(chosen.wide_m / spacing_m / 2.0)), 1)
    thick = ndimage.uniform_filter1d(raw, 3, axis=1, mode="constant") * 3.0
    best = np.zeros_like(raw)
    for slant in chosen.slants:
        total = np.zeros_like(raw)
        for column in range(-half, half + 1):
            total += _moved(thick, column, int(round(slant * column * spacing_m / chosen.bin_m)))
        np.maximum(best, total / (2 * half + 1), out=best)
    return best


def _walls_across(
    raw: NDArray[np.float32],
    main: NDArray[np.float64],
    split: NDArray[np.float64],
    spacing_m: float,
    chosen: DepthParameters,
) -> tuple[NDArray[np.float64], NDArray[np.bool_]]:
    """Split depths with those of walls across the path, and (c,) where these are."""
    split, across = split.copy(), np.zeros(len(main), dtype=bool)
    deepest = raw.shape[1] * chosen.bin_m
    known = np.where(np.isfinite(main), main, deepest)
    half = max(int(round(chosen.across_m / spacing_m)), 1)
    for jump in np.flatnonzero(np.abs(np.diff(known)) > chosen.across_jump_m).tolist():
        near, far = sorted((known[jump], known[jump + 1]))
        far = min(far, near + 6.0)
        bins = slice(int(near / chosen.bin_m) + 1, max(int(far / chosen.bin_m), 1))
        columns = np.arange(max(jump - half, 0), min(jump + half + 2, len(main)))
        standing = (raw[columns, bins] > chosen.bin_m).astype(float)
        if not standing.size:
            continue
        share = ndimage.maximum_filter1d(standing, 3, axis=0).mean(axis=1)
        found = columns[share > chosen.across_share]
        across[found] = True
        split[found] = np.fmin(split[found], near - 2 * chosen.bin_m)
    return split, across


def _standing(
    points: ColumnPoints,
    above: NDArray[np.floating],
    frame: ColumnFrame,
    farthest_m: float,
    chosen: DepthParameters,
) -> NDArray[np.float32]:
    """(c, k) metres of height that are occupied in each column and bin of depth."""
    bins = int(np.ceil(farthest_m / chosen.bin_m))
    levels = int(np.ceil((chosen.highest_m - chosen.lowest_m) / chosen.level_m))
    level = np.floor((above - chosen.lowest_m) / chosen.level_m).astype(np.int64)
    depth = (points.depth / chosen.bin_m).astype(np.int64)
    kept = (level >= 0) & (level < levels) & (depth < bins)
    cell = (points.column[kept].astype(np.int64) * bins + depth[kept]) * levels + level[kept]
    filled = np.zeros(len(frame.origins) * bins * levels, dtype=bool)
    filled[cell] = True
    counts = filled.reshape(len(frame.origins), bins, levels).sum(axis=2)
    return np.asarray(counts * chosen.level_m, dtype=np.float32)


def _cheapest_line(cost: NDArray[np.float64], chosen: DepthParameters) -> NDArray[np.int64]:
    """(c,) the bin of each column: dynamic programming, changes cost linearly up to a limit."""
    columns, bins = cost.shape
    reach = int(chosen.jump / chosen.step)
    back = np.zeros((columns, bins), dtype=np.int32)
    total = cost[0].copy()
    own = np.arange(bins, dtype=np.int32)
    for column in range(1, columns):
        lowest = int(np.argmin(total))
        best, source = total[lowest] + chosen.jump, np.full(bins, lowest, dtype=np.int32)
        best = np.full(bins, best)
        for shift in range(-min(reach, bins - 1), min(reach, bins - 1) + 1):
            price = abs(shift) * chosen.step
            to = slice(max(shift, 0), bins + min(shift, 0))
            came = slice(max(-shift, 0), bins + min(-shift, 0))
            better = total[came] + price < best[to]
            best[to] = np.where(better, total[came] + price, best[to])
            source[to] = np.where(better, own[came], source[to])
        back[column] = source
        total = best + cost[column]
    line = np.empty(columns, dtype=np.int64)
    line[-1] = int(np.argmin(total))
    for column in range(columns - 1, 0, -1):
        line[column - 1] = back[column, line[column]]
    return line


def _without_lone(
    line: NDArray[np.int64], spacing_m: float, chosen: DepthParameters
) -> tuple[NDArray[np.int64], NDArray[np.bool_]]:
    """The line with short pieces before all else put back to what is beside them, and where."""
    result, lone = line.copy(), np.zeros(len(line), dtype=bool)
    before = int(round(chosen.lone_before_m / chosen.bin_m))
    cuts = np.flatnonzero(np.abs(np.diff(line)) >= before // 2) + 1
    ends = [0, *cuts.tolist(), len(line)]
    for first, last in zip(ends[1:-2], ends[2:-1], strict=True):
        beside = line[first - 1], line[last]
        if (last - first) * spacing_m >= chosen.lone_m:
            continue
        if min(beside) - int(line[first:last].max()) < before:
            continue
        middle = (first + last) // 2
        result[first:middle], result[middle:last] = beside
        lone[first:last] = True
    return result, lone


def _refined(
    points: ColumnPoints,
    above: NDArray[np.floating],
    main: NDArray[np.float64],
    chosen: DepthParameters,
) -> NDArray[np.float64]:
    """The mean of the points within two bins of the main depth, in each column that has some."""
    off = points.depth - main[points.column]
    with np.errstate(invalid="ignore"):
        near = (np.abs(off) < 1.5 * chosen.bin_m) & (above > chosen.lowest_m)
    count = np.bincount(points.column[near], minlength=len(main))
    total = np.bincount(points.column[near], weights=off[near], minlength=len(main))
    mean = np.where(count > 0, total / np.maximum(count, 1), 0.0)
    return np.asarray(main + ndimage.median_filter(mean, 5, mode="nearest"), dtype=np.float64)


def _split(
    histogram: NDArray[np.float32], line: NDArray[np.int64], chosen: DepthParameters
) -> NDArray[np.float64]:
    """(c,) the first minimum before the main depth: where the height that stands has sunk to a
    share of the peak's and rises again nearer, at most `split_m` before it."""
    columns = np.arange(len(line))
    peak = histogram[columns, line]
    limit = int(round(chosen.split_m / chosen.bin_m))
    split = line - limit
    open_ = np.ones(len(line), dtype=bool)
    for back in range(1, limit + 1):
        at = np.clip(line - back, 0, None)
        here = histogram[columns, at]
        before = histogram[columns, np.clip(at - 1, 0, None)]
        low = open_ & (here <= chosen.valley * peak) & (before >= here)
        split = np.where(low, at, split)
        open_ &= ~low
    return np.asarray(np.clip(split, 0, None) * chosen.bin_m, dtype=np.float64)
