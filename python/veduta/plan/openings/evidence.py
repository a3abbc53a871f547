"""What is drawn in and beside an interruption of a wall: lines along it, leaves and arcs.

Lines along the opening are found as in de Sousa et al. (AV3D), "Determination of a Window/Door":
rows of the strip under the wall that are mostly inked; adjacent rows are one line. Beside it goes
what that paper does not have: the quarter circles of door leaves, sampled for all hinges, sides
and radii at once, so that an arc that is broken or drawn open by 60 degrees counts, too.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import map_coordinates

from veduta.plan.openings.gaps import Gap

LINE_COVERAGE = 0.8
"""A row of the strip is a line if so much of it is ink (the paper's 90 %, less for scans)."""

ARC_STEPS = 28
RADII = np.linspace(0.8, 1.08, 9)
SLACK = (-0.5, -0.25, 0.0, 0.25, 0.5)
"""Where across the wall the leaf may hang, in thicknesses."""


@dataclass(frozen=True)
class Sheet:
    """What openings are looked for in: soft ink, and masks of marks, pale lines included."""

    ink: NDArray[np.float32]
    faint: NDArray[np.bool_]


@dataclass(frozen=True)
class Arc:
    """A door leaf's trace: how well it is drawn, at which end it hangs, to which side it opens.

    `side` +1 is right of who goes from the gap's start to its end, as seen on the page.
    """

    score: float
    hinge_at_start: bool
    side: int
    radius_share: float


@dataclass(frozen=True)
class Evidence:
    """`lines`: their places across the wall (-1 and 1 are its faces); `tone`: mean ink between
    the faces above that beside the wall; `arcs` best first.
    """

    lines: tuple[float, ...]
    tone: float
    empty: float
    arcs: tuple[Arc, ...]


def look_at(gap: Gap, sheet: Sheet) -> Evidence:
    """Gather the evidence of one gap."""
    along = (gap.end - gap.start) / max(gap.width_px, 1e-9)
    normal = np.array([-along[1], along[0]])
    half = gap.thickness_px / 2
    steps = np.arange(-1.6 * half - 4, 1.6 * half + 4.01, 1.0)
    trim = min(0.2 * gap.width_px, 2.0 + 0.1 * gap.thickness_px)
    inside = np.arange(trim, gap.width_px - trim + 1e-6, 1.0)
    if len(inside) < 3:
        inside = np.linspace(0.2, 0.8, 5) * gap.width_px
    points = gap.start + inside[None, :, None] * along + steps[:, None, None] * normal
    rows = _sample(sheet.faint, points).mean(axis=1)
    soft = _sample(sheet.ink, points, order=1)
    within = np.abs(steps) <= max(half - 1.5, 0.3 * half, 1.0)
    # A pane that is shaded is darker than the paper on both sides.
    beside = [float(np.median(soft[side])) for side in (steps < -half - 1, steps > half + 1)]
    tone = float(np.median(soft[within])) - max(beside)
    return Evidence(
        lines=_lines(steps, rows, half),
        tone=tone,
        empty=float((soft[within] < 0.15).mean()),
        arcs=_arcs(gap, along, normal, sheet),
    )


def _lines(steps: NDArray[np.float64], rows: NDArray[np.float64], half: float) -> tuple[float, ...]:
    """Places of lines across the wall, in half thicknesses; adjacent rows are one line."""
    dark = (rows >= LINE_COVERAGE) & (np.abs(steps) <= half + 2)
    edges = np.diff(np.pad(dark.astype(np.int8), 1))
    starts, ends = np.flatnonzero(edges == 1), np.flatnonzero(edges == -1)
    middles = [
        float(steps[first:last].mean() / half) for first, last in zip(starts, ends, strict=True)
    ]
    return tuple(middles)


def _arcs(
    gap: Gap, along: NDArray[np.float64], normal: NDArray[np.float64], sheet: Sheet
) -> tuple[Arc, ...]:
    """The best arc for each hinge and side, of a leaf as wide as the gap or half of it."""
    found = []
    angles = np.radians(np.linspace(4, 86, ARC_STEPS))
    for share in (1.0, 0.5):
        for hinge_at_start in (True, False):
            hinge = gap.start if hinge_at_start else gap.end
            closed = along if hinge_at_start else -along
            for side in (1, -1):
                score = _best_arc(gap, sheet, hinge, closed, side * normal, angles, share)
                found.append(Arc(score, hinge_at_start, side, share))
    return tuple(sorted(found, key=lambda arc: -arc.score))


def _best_arc(
    gap: Gap,
    sheet: Sheet,
    hinge: NDArray[np.float64],
    closed: NDArray[np.float64],
    opened: NDArray[np.float64],
    angles: NDArray[np.float64],
    share: float,
) -> float:
    radii = RADII * gap.width_px * share
    hinges = hinge + np.array(SLACK)[:, None] * gap.thickness_px * opened
    turn = np.cos(angles)[:, None] * closed + np.sin(angles)[:, None] * opened
    points = hinges[:, None, None] + radii[None, :, None, None] * turn[None, None]
    # A line is some pixels wide; both of its neighbours are looked at, so that half a pixel
    # of radius does not matter, and the free space inside and outside is asked for.
    width = max(3.0, 0.1 * gap.width_px * share)
    on = _sample(sheet.faint, points)
    inner = _sample(sheet.faint, points - width * turn)
    outer = _sample(sheet.faint, points + width * turn)
    drawn = (on > 0) & ~((inner > 0) & (outer > 0))
    # Leaves are drawn open by 60 to 90 degrees: the trace is asked for over the first 60.
    first = ARC_STEPS * 2 // 3
    whole, part = drawn.mean(axis=2), drawn[:, :, :first].mean(axis=2)
    crowded = ((inner > 0) | (outer > 0)).mean(axis=2)
    score = np.maximum(whole, 0.9 * part) - 0.6 * crowded
    return float(max(0.0, score.max()))


def _sample(
    grid: NDArray[np.bool_] | NDArray[np.float32], points: NDArray[np.float64], order: int = 0
) -> NDArray[np.float32]:
    """Values at (..., 2) pixel coordinates; nothing outside."""
    if order == 0:
        index = np.floor(points).astype(int)
        x, y = index[..., 0], index[..., 1]
        inside = (x >= 0) & (y >= 0) & (x < grid.shape[1]) & (y < grid.shape[0])
        values = grid[np.where(inside, y, 0), np.where(inside, x, 0)] * inside
        return np.asarray(values, dtype=np.float32)
    flat = points.reshape(-1, 2).T[::-1] - 0.5
    values = map_coordinates(
        np.asarray(grid, np.float32), flat, order=1, mode="nearest", prefilter=False
    )
    return np.asarray(values.reshape(points.shape[:-1]), dtype=np.float32)
