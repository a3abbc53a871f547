"""Doors that slide within the wall: into it, or two panels past each other.

A leaf comes out of one end of the wall on its middle; in its slot the wall is broken as little as
elsewhere, in the way nothing is drawn but the leaf, which ends somewhere. Where a dashed line goes
on from it, `lines.pocket_share` knows the door without this. Panels of thin walls are half as thick
as these: one of two is then taken for a wall, and what is left for a narrow way.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from veduta.plan.openings.classify import Judged
from veduta.plan.openings.gaps import Gap
from veduta.plan.openings.lines import panel_step, runs
from veduta.plan.openings.strip import Sheet, Strip, cut_strip
from veduta.plan.walls.axes import Axis, OnAxis

BEYOND = 1.3
"""A strip is looked at so many widths of the way beyond both of its ends: the slot, the leaf."""

MIDDLE, FACE = 0.35, (0.8, 1.2)
"""The leaf lies within so many half thicknesses of the middle; faces lie between these: in a thin
wall a leaf is most of it."""

LEAF = (0.08, 0.6)
"""So much of the way the leaf stands out into it, as a part."""

CLEAN = 0.92
"""So much of leaf, of free way and of faces is as it should be, as a part of each."""

FLAW_PX = 3
"""What is shorter is a flaw of the drawing."""

PART = 0.5
"""What lies in the slot or the way by so much of its width is part of the door."""

WAYS, PANELS = (0.5, 1.6), 2.6
"""The way is so many usual doors wide, that of two panels at most so many."""


@dataclass(frozen=True)
class Within:
    """From `low` to `high` pixels along a strip: out of which end the leaf comes, or two panels."""

    low: float
    high: float
    leaf: Literal["start", "end", "panels"]


def with_pockets(axes: Sequence[Axis], sheet: Sheet, door_px: float) -> list[Axis]:
    """The axes with pockets for ways with a leaf on the wall's middle.

    What else was found in the slot or in the way of such a door is part of it.
    """
    return [_with_pockets(axis, sheet, door_px) for axis in axes]


def _with_pockets(axis: Axis, sheet: Sheet, door_px: float) -> Axis:
    found = [
        pocket
        for one in axis.openings
        if _is_doubtful(one.judged) and (pocket := _pocket(axis, one, sheet, door_px))
    ]
    if not found:
        return axis
    kept = [one for one in axis.openings if not any(_is_part(one, pocket) for pocket in found)]
    once = [one for place, one in enumerate(found) if not _among(one, found[:place])]
    return replace(axis, openings=tuple(sorted([*kept, *once], key=lambda one: one.first)))


def _is_doubtful(one: Judged) -> bool:
    """Whether no leaf was seen."""
    return one.kind != "window" and one.type in ("plain", "unknown")


def _pocket(axis: Axis, one: OnAxis, sheet: Sheet, door_px: float) -> OnAxis | None:
    line = axis.line
    reach = BEYOND * min(one.last - one.first, WAYS[1] * door_px)
    low, high = max(one.first - reach, 0.0), min(one.last + reach, line.length_px)
    if line.bulge or high - low < 1.0:
        return None
    start, end = line.arc.at(np.array([low, high]))
    strip = cut_strip(start, end, line.thickness_px, sheet, 0.0)
    found = pocket_in(strip, (one.first - low, one.last - low))
    widest = PANELS if found is not None and found.leaf == "panels" else WAYS[1]
    if found is None or not WAYS[0] * door_px <= found.high - found.low <= widest * door_px:
        return None
    first, last = low + found.low, low + found.high
    gap = Gap.along(line, first, last)
    if found.leaf == "panels":
        judged = Judged(gap, "door", "sliding", "none", "none", 0.7)
    else:
        judged = Judged(gap, "door", "pocket", found.leaf, "none", 0.8, one.judged.seen)
    return OnAxis(judged, first, last, along=True)


def _is_part(one: OnAxis, pocket: OnAxis) -> bool:
    """Whether what was found lies mostly in the way of a pocket door, or in its slot."""
    wide = pocket.last - pocket.first
    hinge = pocket.judged.hinge
    low, high = pocket.first - wide * (hinge == "start"), pocket.last + wide * (hinge == "end")
    return min(one.last, high) - max(one.first, low) > PART * (one.last - one.first)


def _among(one: OnAxis, others: Sequence[OnAxis]) -> bool:
    return any(min(one.last, two.last) > max(one.first, two.first) for two in others)


def pocket_in(strip: Strip, within: tuple[float, float]) -> Within | None:
    """A way with a leaf or panels between the faces of its wall; it meets the stretch `within`."""
    half = strip.half_px
    away = np.abs(strip.steps)
    ink = strip.faint > 0
    middle = _any(ink[away <= max(MIDDLE * half, 1.0)])
    sides = [
        _any(ink[(side * strip.steps >= FACE[0] * half) & (side * strip.steps <= FACE[1] * half)])
        for side in (1, -1)
    ]
    wall = _closed(sides[0] & sides[1])
    starts, ends = runs(~wall)
    for low, high in zip(starts.tolist(), ends.tolist(), strict=True):
        if low == 0 or high == len(wall) or high <= within[0] or low >= within[1]:
            continue
        bare = ~(sides[0] | sides[1])[low:high]
        if bare.mean() < CLEAN:
            continue
        if _comes_out(middle[low:high]):
            return Within(float(low), float(high), "start")
        if _comes_out(middle[low:high][::-1]):
            return Within(float(low), float(high), "end")
        if middle[low:high].mean() >= CLEAN and panel_step(_part(strip, low, high)):
            return Within(float(low), float(high), "panels")
    return None


def _any(rows: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """(columns,) whether there is ink in any of the rows."""
    return np.asarray(rows.any(axis=0), np.bool_)


def _part(strip: Strip, low: int, high: int) -> Strip:
    """Some columns of a strip."""
    cut = slice(low, high)
    ink, faint = strip.ink[:, cut], strip.faint[:, cut]
    return replace(strip, along=strip.along[cut], ink=ink, faint=faint)


def _closed(mask: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """The mask without flaws: breaks and marks of a few pixels."""
    done = mask.copy()
    for value in (False, True):
        starts, ends = runs(done == value)
        for low, high in zip(starts, ends, strict=True):
            if high - low < FLAW_PX and low > 0 and high < len(done):
                done[low:high] = not value
    return done


def _comes_out(leaf: NDArray[np.bool_]) -> bool:
    """Whether a line begins where a way begins, ends in it, and nothing follows."""
    size = len(leaf)
    if size < 4 * FLAW_PX:
        return False
    drawn = np.flatnonzero(leaf[: round(0.9 * size)])
    if len(drawn) == 0:
        return False
    tip = int(drawn[-1]) + 1
    part = tip / size
    return bool(LEAF[0] <= part <= LEAF[1] and leaf[:tip].mean() >= CLEAN)
