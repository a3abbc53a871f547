"""A line that is nearly upright is laid so: onto the wall that it goes on from, where there is one.

Panes that slide past each other, sills and frames lie on both sides of a wall's middle. The edge of
the paper before them steps, and a wall along it would be slanted though nothing slanted is drawn.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely.geometry import LineString

from veduta.plan.walls.axes import Axis

Points = NDArray[np.float64]


@dataclass(frozen=True)
class LevelRule:
    """Lengths count in thicknesses of the wall that is to be.

    stray: what strays more from an upright line is none. long: it is so long, at least. side: what
    is shorter goes around the end of a known wall, or steps from pane to pane. beside: a wall that
    goes on from it lies no farther from its middle; ahead: nor from its ends.
    """

    stray: float = 1.2
    long: float = 5.0
    side: float = 2.0
    beside: float = 1.0
    ahead: float = 2.5


LEVEL = LevelRule()


def levelled(
    points: Points, axes: Sequence[Axis], thick_px: float, rule: LevelRule = LEVEL
) -> Points:
    """A line (n, 2) as two points where it is nearly upright, and as it is where it is not."""
    sides = np.hypot(*np.diff(points, axis=0).T) >= rule.side * thick_px
    if not sides.any():
        return points
    given = points
    points = np.stack([points[:-1][sides], points[1:][sides]], axis=1).reshape(-1, 2)
    for along in (0, 1):
        across = points[:, 1 - along]
        low, high = float(points[:, along].min()), float(points[:, along].max())
        if np.ptp(across) > rule.stray * thick_px or high - low < rule.long * thick_px:
            continue
        middle = _middle(points, along)
        level = _gone_on_from(axes, along, (low, high), middle, thick_px, rule)
        done = points[[0, -1]].copy()
        done[:, 1 - along] = middle if level is None else level
        return done
    return given


def _middle(points: Points, along: int) -> float:
    """Across a line, in the middle between the outermost sides of what it follows for long."""
    line = LineString(points)
    places = shapely.get_coordinates(
        shapely.line_interpolate_point(line, np.linspace(0.0, 1.0, 81), normalized=True)
    )
    return float(np.median(places[:, 1 - along]))


def _gone_on_from(
    axes: Sequence[Axis], along: int, ends: tuple[float, float], middle: float, thick_px: float,
    rule: LevelRule,
) -> float | None:  # fmt: skip
    """Where the longest wall lies that ends before either end, in line with it; None without."""
    found: list[tuple[float, float]] = []
    for axis in axes:
        line = axis.line
        if line.bulge or abs(line.direction[along]) < 1.0 - 1e-6:
            continue
        level = float(line.start[1 - along])
        if abs(level - middle) > rule.beside * thick_px:
            continue
        low, high = sorted((float(line.start[along]), float(line.end[along])))
        reach = rule.ahead * thick_px
        if min(abs(low - ends[1]), abs(high - ends[0])) <= reach:
            found.append((high - low, level))
    return max(found)[1] if found else None


def between_stubs(
    points: Points, solid: NDArray[np.bool_], thick_px: tuple[float, float], reach_px: float
) -> tuple[Points, float] | None:
    """An upright line (2, 2) as the wall goes on beyond its ends, and how thick that is.

    `solid` (h, w) is wall; its stubs are looked for so far beyond the ends, and are of a thickness
    between two. None where there is no stub, or those of both ends disagree.
    """
    if len(points) != 2:
        return None
    along = 0 if abs(points[1, 0] - points[0, 0]) > abs(points[1, 1] - points[0, 1]) else 1
    mask = solid if along == 0 else solid.T
    ends = sorted(points.tolist(), key=lambda one: one[along])
    across = float(points[:, 1 - along].mean())
    runs = [
        one
        for end, way in zip(ends, (-1.0, 1.0), strict=True)
        if (one := _run(mask, end[along], way, across, thick_px, reach_px)) is not None
    ]
    if (
        not runs
        or np.ptp([low for low, _ in runs]) > 2.5
        or np.ptp([high for _, high in runs]) > 2.5
    ):
        return None
    low, high = (float(np.mean(sides)) for sides in zip(*runs, strict=True))
    done = points.copy()
    done[:, 1 - along] = (low + high) / 2.0
    return done, high - low


def _run(
    mask: NDArray[np.bool_], end: float, way: float, across: float,
    thick_px: tuple[float, float], reach_px: float,
) -> tuple[float, float] | None:  # fmt: skip
    """Both sides of what is solid just beyond an end, where it is as thick as a wall."""
    width = mask.shape[1]
    for step in np.arange(1.0, reach_px + 1.0):
        column = int(np.floor(end + way * step))
        if not 0 <= column < width:
            return None
        edges = np.flatnonzero(np.diff(np.pad(mask[:, column].astype(np.int8), 1)))
        for low, high in zip(edges[::2], edges[1::2], strict=True):
            inside = low - 0.5 * thick_px[0] <= across <= high + 0.5 * thick_px[0]
            if inside and thick_px[0] <= high - low <= thick_px[1]:
                return float(low), float(high)
    return None
