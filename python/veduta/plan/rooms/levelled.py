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

    stray: what strays more from an upright line is none. long: it is so long, at least. beside: a
    wall that goes on from it lies no farther from its middle; ahead: nor from its ends.
    """

    stray: float = 1.2
    long: float = 5.0
    beside: float = 1.0
    ahead: float = 2.5


LEVEL = LevelRule()


def levelled(
    points: Points, axes: Sequence[Axis], thick_px: float, rule: LevelRule = LEVEL
) -> Points:
    """A line (n, 2) as two points where it is nearly upright, and as it is where it is not."""
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
    return points


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
