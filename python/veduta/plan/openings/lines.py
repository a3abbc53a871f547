"""What runs along an opening: lines, shade, panels that slide past each other, dashes.

Lines are found as in AV3D, "Determination of a Window/Door": rows of the strip that are mostly
inked; adjacent rows are one line.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from veduta.plan.openings.strip import Strip

LINE_COVERAGE = 0.8
"""A row of the strip is a line if so much of it is ink (the paper's 90 %, less for scans)."""

AT_FACE = 0.72
"""Lines farther out, in half thicknesses, run along the wall's faces."""

STEADY = 0.6
"""Within each panel the ink strays by less than this part of the step between the panels."""

LEAST_STEP = 0.1
"""Panels that slide past each other are apart by so much of the wall's thickness."""

LEAST_STEP_PX = 0.8

DASHED = (0.3, 0.9)
"""A dashed line covers so much of its length."""

LEAST_BREAKS = 2
LEAST_DASH = 0.1
"""Ink of the dashes above the paper."""

BEAM, BEAM_DASHES, ALIKE, BETWEEN = (0.3, 0.8), 5, 0.4, 0.1
"""Dashes along a face cover so much of it, are so many, and differ in length by such a part; of
what lies between both faces at most so much is ink."""

LEAST_WAY = 0.35
"""The way beside a pocket is at least so much of an interruption."""


def full_lines(strip: Strip) -> tuple[float, ...]:
    """Places of lines across the wall, in half thicknesses."""
    dark = strip.faint.mean(axis=1) >= LINE_COVERAGE
    dark &= np.abs(strip.steps) <= strip.half_px + 2
    starts, ends = runs(dark)
    return tuple(
        float(strip.steps[low:high].mean() / strip.half_px)
        for low, high in zip(starts, ends, strict=True)
    )


def shade(strip: Strip) -> float:
    """How much darker than the paper beside it the palest row between the faces is."""
    rows = np.abs(strip.steps) <= max(0.8 * strip.half_px - 1.0, 0.5)
    profile = np.median(strip.ink[rows], axis=1)
    return float(profile.min() - strip.paper)


def panel_step(strip: Strip) -> float:
    """By how many half thicknesses the ink of the first half lies beside that of the second.

    0 where the drawing does not step in the middle: panels that slide are drawn side by side, and
    overlap by a little. The middle of the ink is taken in four parts of the opening, the two of
    each panel must agree.
    """
    width = strip.along[-1] - strip.along[0]
    share = (strip.along - strip.along[0]) / max(width, 1e-9)
    # The faces' lines are the same in both halves, and what stands before them does not count.
    near = np.abs(strip.steps) <= max(0.85 * strip.half_px, 2.0)
    ink = np.maximum(strip.ink[near] - strip.paper - 0.04, 0.0)
    steps = strip.steps[near]
    quarters = [(0.06, 0.25), (0.25, 0.42), (0.58, 0.75), (0.75, 0.94)]
    middles = []
    for low, high in quarters:
        mass = ink[:, (share >= low) & (share < high)].sum(axis=1)
        if mass.sum() <= 0.15 * max(1.0, (high - low) * width):
            return 0.0
        middles.append(float(mass @ steps / mass.sum()))
    first, second = (middles[0] + middles[1]) / 2, (middles[2] + middles[3]) / 2
    step = second - first
    apart = max(abs(middles[0] - middles[1]), abs(middles[2] - middles[3]))
    if abs(step) < max(LEAST_STEP_PX, 2 * LEAST_STEP * strip.half_px) or apart > STEADY * abs(step):
        return 0.0
    return step / strip.half_px


def leaf_lines(strip: Strip) -> bool:
    """Whether a line runs along each half of an opening, and those of both lie beside each other.

    Thin leaves that slide past each other overlap by a little; neither line goes all the way.
    """
    count = strip.faint.shape[1]
    near = np.abs(strip.steps) <= max(AT_FACE * strip.half_px, 2.0)
    halves = (strip.faint[:, : round(0.44 * count)], strip.faint[:, round(0.56 * count) :])
    first, second = (half[near].mean(axis=1) >= LINE_COVERAGE for half in halves)
    own, other = ((one & ~rest).any() for one, rest in ((first, second), (second, first)))
    return bool(own and other)


def pocket_share(strip: Strip) -> tuple[float, float] | None:
    """Where the way through is, as shares of the strip, if a leaf slides into the wall beside it.

    The leaf is drawn as two lines in the wall; a dashed line in the middle shows its way. None
    where that is not what is drawn.
    """
    ink = strip.ink - strip.paper
    reach = max(1.5, 0.25 * strip.half_px)
    outer = np.abs(strip.steps) <= max(strip.half_px, reach + 2.0)
    line = ink[np.abs(strip.steps) <= reach].max(axis=0)
    left, right = (
        ink[outer & (side * strip.steps > reach + 0.75)].max(axis=0, initial=0.0)
        for side in (1, -1)
    )
    level = float(np.quantile(line, 0.9))
    count = len(line)
    starts, ends = runs(np.minimum(left, right) > 0.5 * level)
    low = int(ends[0]) if len(starts) and starts[0] <= 2 else 0
    high = int(starts[-1]) if len(ends) and ends[-1] >= count - 2 else count
    if level < LEAST_DASH or high - low < LEAST_WAY * count or (low == 0) == (high == count):
        return None
    on = line[low:high] > 0.5 * level
    beside = float((np.maximum(left, right)[low:high] > 0.5 * level).mean())
    breaks = np.flatnonzero(runs(~on)[0] > 0)
    dashed = DASHED[0] <= on.mean() <= DASHED[1] and len(breaks) >= LEAST_BREAKS
    return (low / count, high / count) if dashed and beside < 0.15 else None


def dashed_faces(strip: Strip) -> bool:
    """Whether both faces of the wall go on in dashes, with nothing between: a beam over a way."""
    ink = strip.faint > 0
    between = ink[np.abs(strip.steps) <= max(0.4 * strip.half_px, 0.6)]
    if between.size == 0 or between.mean() > BETWEEN:
        return False
    near = max(0.35 * strip.half_px, 1.5)
    return all(
        _is_dashed(np.asarray(ink[np.abs(side * strip.steps - strip.half_px) <= near].any(axis=0)))
        for side in (1, -1)
    )


def _is_dashed(line: NDArray[np.bool_]) -> bool:
    """Whether a line is of several dashes, each about as long as the others."""
    starts, ends = runs(line)
    inner = (ends - starts)[1:-1]
    if len(inner) < BEAM_DASHES - 2 or not BEAM[0] <= line.mean() <= BEAM[1]:
        return False
    return bool(inner.std() <= ALIKE * inner.mean())


def runs(mask: NDArray[np.bool_]) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Where runs of True begin, and the index after each of their ends."""
    edges = np.diff(np.pad(mask.astype(np.int8), 1))
    return np.flatnonzero(edges == 1), np.flatnonzero(edges == -1)
