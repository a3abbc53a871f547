"""Doors in walls of two lines that run on through them: between strokes that go across the wall.

A sill is drawn as the faces of the wall are, so that nothing is interrupted. Jambs are strokes
across, or the walls at both ends; between two of them, or beside one, a trace of a leaf, or panels
that meet, says that there is a door.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np
from shapely.geometry.base import BaseGeometry

from veduta.plan.openings.classify import Judged, judge
from veduta.plan.openings.evidence import look_at
from veduta.plan.openings.gaps import Gap
from veduta.plan.openings.leaves import find_arcs
from veduta.plan.openings.lines import runs
from veduta.plan.openings.settle import USUAL_DOOR
from veduta.plan.openings.sky import leads_out
from veduta.plan.openings.strip import Sheet, cut_strip
from veduta.plan.walls.axes import Axis, OnAxis
from veduta.plan.walls.pieces import Piece

ACROSS = 0.85
"""A jamb covers so much of what is between the faces ..."""
THICK = 0.6
"""... and is no thicker than this part of the wall: a pillar is."""
WIDTHS = (3.5, 20.0)
"""Between jambs lie so many (thin) wall thicknesses."""
SURE = 0.75
"""A trace is drawn at least so well: nothing else says that the wall is interrupted."""
ALONE = 0.85
"""... and so well where there is one jamb alone, from which doors of these widths are tried."""
TRIED = (0.85, 1.05, 1.3)
BY_OWN, MOST_OWN = 7.0, 12.0
"""The usual door in thicknesses of its own wall, which is thin too where rails of balconies are
thinner, and at most so many of what is thinnest."""
MOST_JAMBS = 24
"""What is crossed more often is hatched, or stairs."""


def with_jambed(
    axes: Sequence[Axis], sheet: Sheet, thin_px: float, sky: BaseGeometry
) -> list[Axis]:
    """The axes with the doors between jambs in walls of two lines."""
    return [
        replace(one, openings=(*one.openings, *_doors(one, sheet, thin_px, sky)))
        if one.line.drawing == "hollow" and not one.closing
        else one
        for one in axes
    ]


def _doors(axis: Axis, sheet: Sheet, thin_px: float, sky: BaseGeometry) -> list[OnAxis]:
    """The doors in a wall, the surest of those that overlap."""
    line = axis.line
    found: list[OnAxis] = []
    jambs = jambs_of(axis, sheet)
    beside = _beside(jambs, _usual(line, thin_px), line)
    for (low, high), sure in (
        *((each, SURE) for each in _between(jambs, thin_px)),
        *((each, ALONE) for each in beside),
    ):
        gap = Gap.along(line, low, high)
        if sure == ALONE and find_arcs(gap, sheet)[0].score < sure:
            continue
        outer = leads_out(line, (low, high), sky)
        judged = _door(judge(gap, look_at(gap, sheet), thin_px, outer), outer, sure)
        if judged is not None:
            found.append(_fitted(axis, judged, low, high))
    taken = list(axis.openings)
    doors = []
    for one in sorted(found, key=lambda each: -each.judged.score):
        if not any(one.first < other.last and other.first < one.last for other in taken):
            taken.append(one)
            doors.append(one)
    return doors


def _usual(line: Piece, thin_px: float) -> float:
    """How wide doors are, most likely: by what is thin on a sheet, and by their own wall."""
    own_px = min(BY_OWN * line.thickness_px, MOST_OWN * thin_px)
    return max(USUAL_DOOR * thin_px, own_px)


def _fitted(axis: Axis, judged: Judged, low: float, high: float) -> OnAxis:
    """A door on its axis; of one leaf as wide as its trace is."""
    if judged.type == "swing" and judged.seen is not None:
        arc = judged.seen.arcs[0]
        wide = float(np.hypot(*(arc.tip - arc.hinge)))
        low, high = (low, low + wide) if arc.hinge_at_start else (high - wide, high)
        low, high = max(low, 0.0), min(high, axis.line.length_px)
        part = axis.line.part(low, high)
        judged = replace(judged, gap=replace(judged.gap, start=part.start, end=part.end))
    return OnAxis(judged, low, high, along=True)


def _door(judged: Judged | None, outer: bool, sure: float) -> Judged | None:
    """What is a door beyond doubt; panels only between rooms, where windows have none."""
    if judged is None or judged.seen is None or judged.kind != "door":
        return None
    traced = bool(judged.seen.arcs) and judged.seen.arcs[0].score >= sure
    if judged.type in ("swing", "double") and traced:
        return judged
    # Without a line between the faces a stroke across is a jamb.
    meet = judged.seen.meets and bool(judged.seen.inner)
    panels = judged.type == "sliding" and meet and not outer and sure < ALONE
    return judged if panels else None


def jambs_of(axis: Axis, sheet: Sheet) -> list[tuple[float, float]]:
    """From where to where along a wall strokes go across it, in pixels; with both of its ends."""
    line = axis.line
    strip = cut_strip(line.start, line.end, line.thickness_px, sheet, 0.0, line.bulge)
    near = np.abs(strip.steps) <= strip.half_px
    dark = strip.faint[near].mean(axis=0) >= ACROSS
    most = max(3.0, THICK * line.thickness_px)
    crossed = [
        (float(low), float(high))
        for low, high in zip(*runs(dark), strict=True)
        if high - low <= most
    ]
    return [(0.0, 0.0), *crossed, (line.length_px, line.length_px)]


def _between(jambs: Sequence[tuple[float, float]], thin_px: float) -> Iterator[tuple[float, float]]:
    """Stretches between two jambs, also over one between them, where panels meet."""
    if len(jambs) > MOST_JAMBS:
        return
    least, most = (share * thin_px for share in WIDTHS)
    for skipped in (1, 2):
        for (_, low), (high, _) in zip(jambs, jambs[skipped:], strict=False):
            if least <= high - low <= most:
                yield low, high


def _beside(
    jambs: Sequence[tuple[float, float]], usual_px: float, line: Piece
) -> Iterator[tuple[float, float]]:
    """Stretches as wide as doors that begin or end at a jamb, or a frame's thickness from it."""
    if len(jambs) > MOST_JAMBS:
        return
    for low, high in jambs:
        for wide in (share * usual_px for share in TRIED):
            for frame in (0.0, line.thickness_px):
                if high + frame + wide <= line.length_px:
                    yield high + frame, high + frame + wide
                if low - frame - wide >= 0.0:
                    yield low - frame - wide, low - frame
