"""Doors and windows in a wall that is known, the way of the AV3D paper.

"Detection of Potential Side Edges" and "Determination of a Window/Door": lines across the wall are
found in its strip; those that a wall touches on one side only are edges; each pair of edges is
scored for every type by how alike the edges are, how near the lines between them are to where the
type has them, and how much of the area between is free. The paper shows its four drawings of
windows and nine of doors in figures that its text does not describe: those of windows here are
the ones of `classify.window_type`; of doors the free way with a leaf at one of its edges.
`benchmarks/plan/plan_openings.py` measures it beside `along`.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.plan.document import OpeningType
from veduta.plan.openings.lines import runs
from veduta.plan.openings.strip import Sheet, Strip, cut_strip, sample

LEAST_CONTACT = 0.75
"""An edge touches the column on one of its sides by less than this part."""

LINE_COVERAGE = 0.9
LEAST_SCORE = 0.9
"""The paper's, as the least mean of the three items."""

NEAR = 0.35
"""A line so far from its place, in half thicknesses, counts nothing."""

PLACES: Mapping[OpeningType, tuple[float, ...]] = {
    "single-line": (0.0,),
    "double-line": (-1.0, 1.0),
    "triple-line": (-1.0, 0.0, 1.0),
    "filled": (-1.0, 1.0),
}
"""Where each drawing of a window has its lines, in half thicknesses."""

LEAF_SLACK = 0.15
"""A leaf is as long as the way is wide, or less by this part."""


@dataclass(frozen=True)
class Found:
    """An opening from `first_px` to `last_px` along the wall; `type` "swing" is any door."""

    first_px: float
    last_px: float
    type: OpeningType
    score: float


@dataclass(frozen=True)
class _Edge:
    """A line across the wall at column `at`, over rows `low` to `high`."""

    at: int
    low: int
    high: int


def search_wall(
    start: NDArray[np.float64],
    end: NDArray[np.float64],
    thickness_px: float,
    sheet: Sheet,
    widths_px: tuple[float, float],
) -> list[Found]:
    """The best pairs of edges along a straight wall, none over another; `widths_px` bounds them."""
    strip = cut_strip(start, end, thickness_px, sheet)
    found = []
    edges = side_edges(strip)
    for index, first in enumerate(edges):
        for second in edges[index + 1 :]:
            if widths_px[0] <= second.at - first.at <= widths_px[1]:
                found += _scored(strip, first, second, (start, end), sheet)
    return _apart(found)


def side_edges(strip: Strip) -> list[_Edge]:
    """Lines across the wall that may be the sides of openings."""
    marks = strip.faint > 0
    edges: list[_Edge] = []
    columns = marks.shape[1]
    for at in range(columns):
        starts, ends = runs(marks[:, at])
        if len(starts) == 0:
            continue
        longest = int(np.argmax(ends - starts))
        low, high = int(starts[longest]), int(ends[longest])
        if high - low < 2 * strip.half_px - 2:
            continue
        contact = [
            marks[low:high, other].mean() if 0 <= other < columns else 1.0
            for other in (at - 1, at + 1)
        ]
        if min(contact) < LEAST_CONTACT:
            edges.append(_Edge(at, low, high))
    return edges


def _scored(
    strip: Strip,
    first: _Edge,
    second: _Edge,
    wall: tuple[NDArray[np.float64], NDArray[np.float64]],
    sheet: Sheet,
) -> list[Found]:
    """The pair as each type whose score is high enough."""
    between = slice(first.at + 2, second.at - 1)
    if second.at - first.at < 5:
        return []
    alike = 1 - (abs(first.low - second.low) + abs(first.high - second.high)) / (4 * strip.half_px)
    inside = np.abs(strip.steps) <= strip.half_px + 1.5
    rows = strip.faint[:, between].mean(axis=1) > LINE_COVERAGE
    starts, ends = runs(rows & inside)
    lines = [strip.steps[a:b].mean() / strip.half_px for a, b in zip(starts, ends, strict=True)]
    clear = strip.faint[:, between][inside & ~rows]
    free = 1 - float(clear.mean()) if clear.size else 0.0
    shaded = float(np.median(strip.ink[strip.within][:, between])) - strip.paper > 0.08
    found = []
    for name, places in PLACES.items():
        score = (alike + _nearness(lines, places) + free) / 3
        if score > LEAST_SCORE and shaded == (name == "filled"):
            found.append(Found(first.at, second.at, name, score))
    if not lines:
        score = (alike + free + _leaf(first.at, second.at, wall, sheet)) / 3
        if score > LEAST_SCORE:
            found.append(Found(first.at, second.at, "swing", score))
    return found


def _nearness(lines: list[float], places: tuple[float, ...]) -> float:
    """How near the lines are to their places; a line too many or too few counts nothing."""
    if not lines:
        return 0.0
    near = [max(0.0, 1 - min(abs(line - place) for line in lines) / NEAR) for place in places]
    return sum(near) / max(len(places), len(lines))


def _leaf(
    first: int, second: int, wall: tuple[NDArray[np.float64], NDArray[np.float64]], sheet: Sheet
) -> float:
    """How much of a leaf across the wall is drawn at either edge, on either side."""
    start, end = wall
    way = (end - start) / max(float(np.hypot(*(end - start))), 1e-9)
    normal = np.array([-way[1], way[0]])
    width = second - first
    along = np.linspace(0.1, 1 - LEAF_SLACK, 30)[:, None] * width
    beside = np.linspace(-0.06, 0.06, 7) * width
    best = 0.0
    for at in (first, second):
        for side in (1, -1):
            hinges = start + (at + beside)[:, None, None] * way
            best = max(
                best, float(sample(sheet.faint, hinges + side * along * normal).mean(axis=1).max())
            )
    return best


def _apart(found: list[Found]) -> list[Found]:
    """The best first, and none that lies over a better one; narrow ones go before wide ones."""
    kept: list[Found] = []
    for one in sorted(found, key=lambda one: (-round(one.score, 2), one.last_px - one.first_px)):
        if all(one.last_px <= two.first_px or one.first_px >= two.last_px for two in kept):
            kept.append(one)
    return sorted(kept, key=lambda one: one.first_px)
