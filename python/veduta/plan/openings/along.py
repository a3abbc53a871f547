"""Openings where the wall is not interrupted: stretches that are drawn in another way than walls.

Windows in hollow walls, and windows in walls of a single thick line, leave no gap in what is solid.
The ink across the wall, column by column, is compared with that of walls of the same sheet; where
it differs over the width of an opening there is one. AV3D looks for lines across the wall instead
(`av3d`), which fails where lines are blurred or as thick as the wall.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import median_filter, uniform_filter1d
from shapely.geometry.base import BaseGeometry

from veduta.plan.openings.classify import judge
from veduta.plan.openings.evidence import look_at
from veduta.plan.openings.gaps import Gap
from veduta.plan.openings.lines import runs
from veduta.plan.openings.sky import leads_out
from veduta.plan.openings.strip import Sheet, Strip, cut_strip
from veduta.plan.walls.axes import Axis, OnAxis
from veduta.plan.walls.join import SAME_THICKNESS

OUTLINED = 2.0
"""The lines of glazing lie within so many thicknesses of a wall that is an outline."""

ROWS = np.linspace(-1.2, 1.2, 13)
"""Where across the wall ink is compared, in half thicknesses."""

RIM = 0.7
"""What lies farther out, in half thicknesses, is the rim of a wall."""

CHANGE = 0.1
"""A column differs from a wall's if its ink does by this part of the wall's darkest row."""

PALER, PALER_RIMMED, RIMMED = 0.75, 0.55, 0.85
"""A wall may be paler than others by this factor in all of its rows, as ink is uneven: more so one
with a rim, whose inner rows are so much paler than it, as a shaded pane without one is all pale."""

SMOOTH_PX = 5
JOINED_PX = 3
"""Parts of one opening are no farther apart."""

LEAST_WIDTH = 4.0
"""Windows are at least so many (thin) wall thicknesses wide."""

BESIDE = 0.6
"""What differs so near to an opening or the wall's end, in its thicknesses, is part of that."""

SOLID = 0.7
"""Walls are filled if no row between their faces is paler than this part of the darkest one."""

PIERCED = 0.6
"""An opening in a filled wall shows a row that is at most so dark, as a part of the wall there."""

BAR, BAR_SIDE = 0.1, 0.03
"""Where the lines of a window run into the one that a wall is drawn as, this is so much darker
beside both faces together, in the mean, and beside each, as a part of its darkest row."""

OVERLAP, LIKE = 0.35, 1.3
"""Two panels overlap by at most this part of one, which is as long as the other by this factor."""

THICKER, DRAWN_ON, BARE = (1.2, 2.2), 0.85, 0.05
"""A wall goes on thicker by such factors, its faces are drawn along this part of it, and at most so
much of what lies between them is ink."""

MOST_WINDOW = 0.8
"""Less than this part of a wall that is a single line is window."""

LEAST_DOUBLED = 0.64
"""A wall that is glazed from end to end has two lines along this part of it: posts part them."""

STEADY = 0.16
"""Across an opening its own drawing is the same, up to this part of the darkest row."""


def with_unbroken(
    axes: Sequence[Axis], sheet: Sheet, thin_px: float, sky: BaseGeometry
) -> list[Axis]:
    """The axes with windows and doors that lead outdoors where their walls are not interrupted."""
    walls = _Walls(axes, sheet)
    done = []
    for number, axis in enumerate(axes):
        spans = _spans(axis, walls, number, thin_px)
        both = [one for span in _pairs(spans) if (one := _opening(axis, span, sheet, thin_px, sky))]
        axis = replace(axis, openings=(*axis.openings, *both))
        more = [one for span in spans if (one := _opening(axis, span, sheet, thin_px, sky))]
        done.append(replace(axis, openings=(*axis.openings, *more)))
    return done


def _spans(axis: Axis, walls: _Walls, number: int, thin_px: float) -> list[tuple[int, int]]:
    """Stretches of a wall that may be openings.

    What closes a gap was judged there. Of an outline nothing but its line is drawn, so that it
    differs from walls everywhere: glazing has a second line. So it has where a wall is glazed from
    end to end: one that differs all along, and shows none, is a wall that is drawn otherwise.
    """
    if axis.closing:
        return []
    least_px = LEAST_WIDTH * thin_px
    if axis.outline:
        return doubled_stretches(_wide_strip(axis, walls.sheet, thin_px), least_px)
    spans = walls.changed(number, least_px)
    if not spans or axis.line.drawing == "single-line" or not _mostly(spans, axis.line.length_px):
        return spans
    doubled = doubled_stretches(_wide_strip(axis, walls.sheet, thin_px), least_px)
    return spans if _mostly(doubled, axis.line.length_px, LEAST_DOUBLED) else []


def _pairs(spans: Sequence[tuple[int, int]]) -> list[tuple[int, int]]:
    """Two stretches beside each other, as long as each other: panels that overlap a little."""
    found = []
    for first, second in pairwise(spans):
        sizes = first[1] - first[0], second[1] - second[0]
        near = second[0] - first[1] <= OVERLAP * min(sizes)
        if near and max(sizes) <= LIKE * min(sizes):
            found.append((first[0], second[1]))
    return found


def _wide_strip(axis: Axis, sheet: Sheet, thin_px: float) -> Strip:
    """A wall with what may be its other line beside it."""
    line, wide_px = axis.line, OUTLINED * max(axis.line.thickness_px, thin_px)
    return cut_strip(line.start, line.end, wide_px, sheet, 0.0, line.bulge)


def doubled_stretches(strip: Strip, least_px: float) -> list[tuple[int, int]]:
    """Columns from and to which two lines or more run along a wall, at least `least_px` long."""
    near = np.abs(strip.steps) <= strip.half_px
    ink = np.pad(strip.faint[near] > 0, ((1, 0), (0, 0)))
    lines = (ink[1:] & ~ink[:-1]).sum(axis=0)
    # Where all of it is dark it is solid, and what is crossed here and there is crossed.
    doubled = median_filter((lines >= 2).astype(np.uint8), 2 * JOINED_PX + 1) > 0
    return [
        (int(low), int(high))
        for low, high in zip(*runs(doubled), strict=True)
        if high - low >= least_px
    ]


@dataclass(frozen=True)
class _Walls:
    """The walls of a sheet, with the ink across each."""

    axes: Sequence[Axis]
    sheet: Sheet

    @cached_property
    def _as_thick(self) -> list[_Across]:
        """Of each wall, as broad as it is."""
        return [_across(one, self.sheet, one.line.thickness_px) for one in self.axes]

    @cached_property
    def _as_pen(self) -> dict[int, _Across]:
        """Of those that are single lines, as broad as the pen of most."""
        pen_px = _pen(self.axes)
        return {
            number: _across(one, self.sheet, pen_px)
            for number, one in enumerate(self.axes)
            if one.line.drawing == "single-line"
        }

    def changed(self, number: int, least_px: float) -> list[tuple[int, int]]:
        """The stretches of a wall that are drawn in another way than walls.

        A single line is compared with all of these, as what is mostly windows is broadened by them.
        One that differs from end to end is of another pen: it is compared with those as broad.
        """
        if self.axes[number].line.drawing != "single-line":
            return _changed(self._as_thick[number], self._alike(number), least_px, bars=False)
        own = self._as_pen[number]
        spans = _changed(own, list(self._as_pen.values()), least_px, bars=True)
        if _mostly(spans, own.all.shape[1]):
            own = self._as_thick[number]
            spans = _changed(own, self._alike(number), least_px, bars=True)
        return [] if _mostly(spans, own.all.shape[1]) else spans

    def _alike(self, number: int) -> list[_Across]:
        """Walls that are as thick."""
        own = self.axes[number].line.thickness_px
        thick = [one.line.thickness_px for one in self.axes]
        return [
            wall
            for wall, one in zip(self._as_thick, thick, strict=True)
            if max(one, own) <= SAME_THICKNESS * min(one, own)
        ]


@dataclass(frozen=True)
class _Across:
    """The ink across a wall, (rows, columns): of all its columns, and of those without openings."""

    all: NDArray[np.float64]
    bare: NDArray[np.float64]


def _across(axis: Axis, sheet: Sheet, thick_px: float) -> _Across:
    """Half a pixel off its middle is much of a line."""
    line = axis.line
    strip = cut_strip(line.start, line.end, thick_px, sheet, 0.0, line.bulge)
    own = profile(strip, _middle(strip) if line.drawing == "single-line" else 0.0)
    if line.drawing == "hatched":  # strokes and paper between them together are the wall
        own = uniform_filter1d(own, max(SMOOTH_PX, round(thick_px)), axis=1, mode="nearest")
    return _Across(own, _without(axis, own))


def _changed(
    own: _Across, walls: Sequence[_Across], least_px: float, *, bars: bool
) -> list[tuple[int, int]]:
    """Where a wall differs from walls."""
    bare = [wall.bare for wall in walls]
    if sum(one.shape[1] for one in bare) == 0:
        return []
    return changed_stretches(own.all, usual_profile(bare), least_px, bars=bars)


def _mostly(spans: Sequence[tuple[int, int]], length_px: float, share: float = MOST_WINDOW) -> bool:
    """Whether so much of a wall is in these stretches; as it is given, more than can be window."""
    return sum(high - low for low, high in spans) >= share * length_px


def _middle(strip: Strip) -> float:
    """Where across a strip the ink of its line has its middle, in most columns, px."""
    near = np.abs(strip.steps) <= strip.half_px + 1.0
    ink = np.maximum(strip.ink[near] - strip.paper, 0.0)
    total = ink.sum(axis=0)
    drawn = total > 0
    if not drawn.any():
        return 0.0
    middle = np.median((strip.steps[near] @ ink)[drawn] / total[drawn])
    return float(np.clip(middle, -1.0, 1.0))


def _pen(axes: Sequence[Axis]) -> float:
    """How broad walls that are single lines are drawn, usually; 0 where there are none."""
    lines = [axis.line for axis in axes if axis.line.drawing == "single-line"]
    lengths = [max(1, round(line.length_px)) for line in lines]
    widths = np.repeat([line.thickness_px for line in lines], lengths)
    return float(np.median(widths)) if len(widths) else 0.0


def _without(axis: Axis, own: NDArray[np.float64]) -> NDArray[np.float64]:
    """The columns that are no openings."""
    at = np.arange(own.shape[1])
    free = np.ones(own.shape[1], np.bool_)
    for one in axis.openings:
        free &= (at < one.first) | (at > one.last)
    return own[:, free]


def _opening(
    axis: Axis, span: tuple[int, int], sheet: Sheet, thin_px: float, sky: BaseGeometry
) -> OnAxis | None:
    """What is drawn in a stretch of wall, if it is an opening.

    Between rooms it is a door of panels that slide: what else differs there may be anything.
    """
    line, near = axis.line, BESIDE * axis.line.thickness_px
    low, high = max(float(span[0]), near), min(float(span[1]), line.length_px - near)
    taken = any(one.first - near < high and low < one.last + near for one in axis.openings)
    if taken or high - low < LEAST_WIDTH * thin_px:
        return None
    gap = Gap.along(line, low, high)
    outer = leads_out(line, (low, high), sky)
    seen = judge(gap, look_at(gap, sheet), thin_px, outer)
    if seen is not None and seen.kind == "window" and is_thicker(axis, (low, high), sheet):
        return None
    if seen is None or seen.kind == "gap" or not (outer or seen.type == "sliding"):
        return None
    return OnAxis(seen, low, high, along=True)


def is_thicker(axis: Axis, span: tuple[float, float], sheet: Sheet) -> bool:
    """Whether the wall goes on there and is thicker: two lines alone, farther apart than its own.

    An inner wall and an outer one may lie in one line.
    """
    part = axis.line.part(*span)
    reach = THICKER[1] * axis.line.thickness_px
    strip = cut_strip(part.start, part.end, reach, sheet, 0.0, part.bulge)
    trim = slice(SMOOTH_PX, -SMOOTH_PX)
    dark = strip.faint[:, trim].mean(axis=1) >= DRAWN_ON
    dark &= np.abs(strip.steps) <= strip.half_px
    starts, ends = runs(dark)
    if len(starts) != 2:
        return False
    first, second = (float(strip.steps[a:b].mean()) for a, b in zip(starts, ends, strict=True))
    between = strip.faint[(strip.steps > first + 1.5) & (strip.steps < second - 1.5), trim]
    wide = (second - first) >= THICKER[0] * axis.line.thickness_px
    return bool(first < 0.0 < second and wide and float(between.mean()) < BARE)


def profile(strip: Strip, middle_px: float = 0.0) -> NDArray[np.float64]:
    """Ink above the paper at ROWS, about a middle, for each column: (rows, columns)."""
    at = middle_px + ROWS * strip.half_px
    order = np.clip(np.searchsorted(strip.steps, at), 1, len(strip.steps) - 1)
    low = strip.steps[order - 1]
    share = ((at - low) / (strip.steps[order] - low))[:, None]
    ink = strip.ink - strip.paper
    across = (1 - share) * ink[order - 1] + share * ink[order]
    return np.asarray(median_filter(across, (1, SMOOTH_PX), mode="nearest"), np.float64)


def usual_profile(profiles: Sequence[NDArray[np.float64]]) -> NDArray[np.float64]:
    """That of walls, (rows,): most of the length of walls is wall."""
    return np.asarray(np.median(np.concatenate(profiles, axis=1), axis=1))


def changed_stretches(
    own: NDArray[np.float64], usual: NDArray[np.float64], least_px: float, *, bars: bool = False
) -> list[tuple[int, int]]:
    """Columns from and to which a wall is drawn in another way, at least `least_px` long.

    `bars`: whether a broader line counts, which in walls of some breadth is a bench beside them.
    """
    level = max(float(usual.max()), 0.1)
    rimmed = float(usual[np.abs(ROWS) <= RIM].min()) < RIMMED * level
    palest = PALER_RIMMED if rimmed else PALER
    tone = np.clip(usual @ own / max(float(usual @ usual), 1e-9), palest, 1.0 / palest)
    changed = np.abs(own - tone * usual[:, None]).mean(axis=0) > CHANGE * level
    starts, ends = runs(~changed)
    for low, high in zip(starts, ends, strict=True):
        if high - low <= JOINED_PX and low > 0 and high < len(changed):
            changed[low:high] = True
    found = []
    for low, high in zip(*runs(changed), strict=True):
        inside = own[:, low + 2 : high - 2]
        if high - low < max(least_px, 6):
            continue
        stray = min(_stray(inside), _stray_of_halves(inside))
        drawn = _pierced(inside, usual, level) or (bars and _barred(inside, usual, level))
        if stray <= STEADY * level and drawn:
            found.append((int(low), int(high)))
    return found


def _stray(inside: NDArray[np.float64]) -> float:
    """How much the ink of a stretch (rows, columns) strays along it, in the mean."""
    return float(np.abs(inside - np.median(inside, axis=1)[:, None]).mean())


def _stray_of_halves(inside: NDArray[np.float64]) -> float:
    """The same of each half, as two panels beside each other; they overlap in the middle."""
    count = inside.shape[1]
    parts = inside[:, : round(0.44 * count)], inside[:, round(0.56 * count) :]
    return max(_stray(part) if part.size else np.inf for part in parts)


def _pierced(inside: NDArray[np.float64], usual: NDArray[np.float64], level: float) -> bool:
    """Whether a stretch may be an opening: a filled wall is not filled there.

    What differs beside a filled wall alone is a bench, a counter, or a face that runs askew.
    """
    within = np.abs(ROWS) <= RIM
    if float(usual[within].min()) < SOLID * level:
        return True
    rows = np.median(inside[within], axis=1)
    return bool((rows < PIERCED * usual[within]).any())


def _barred(inside: NDArray[np.float64], usual: NDArray[np.float64], level: float) -> bool:
    """Whether a line is broader there on both of its sides."""
    beyond = np.median(inside, axis=1) - usual
    sides = beyond[:2].mean() / level, beyond[-2:].mean() / level
    return bool(min(sides) > BAR_SIDE and sum(sides) > 2 * BAR)
