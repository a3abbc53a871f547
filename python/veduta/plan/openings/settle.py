"""Openings judged once more, when it is known which lead outdoors, and how the sheet draws.

A sheet draws its windows in one manner. Between rooms there are no windows: what is drawn there
shows how the sheet draws a door without a leaf, and an outer opening drawn like those, and unlike
the windows, is a door, too.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
from shapely.geometry.base import BaseGeometry

from veduta.plan.document import OpeningType
from veduta.plan.openings.classify import LEAST_TONE, Judged, is_bare, judge, slides
from veduta.plan.openings.evidence import Evidence
from veduta.plan.openings.score import likely
from veduta.plan.openings.sky import leads_out
from veduta.plan.walls.axes import Axis, OnAxis

GARAGE = 2.3
"""Garage doors are at least so many times as wide as the usual door."""

USUAL_DOOR = 8.0
"""The usual door in (thin) wall thicknesses, where no leaves say it."""

LEAST_DOOR = 0.5
"""Ways through are at least so many usual doors wide."""

LEAST_WAY = 2.5
"""Or so many (thin) wall thicknesses, where no leaves say how wide doors are."""

LEAST_LEAF = 0.6
"""What has a leaf, as of a cupboard, may be narrower by this factor."""

LEAST_TIMES = 3
"""What is drawn so often between rooms is this sheet's manner of drawing doors."""

GLAZED = 1.2
"""Glazed leaves are drawn at least so many times as thick as the others."""


@dataclass(frozen=True)
class Manner:
    """How an opening without a leaf is drawn: lines on its faces and between, shade, panels."""

    faces: int
    inner: int
    shaded: bool
    panels: bool


@dataclass(frozen=True)
class _Place:
    """Where an opening is: the axis and its index there; whether it leads outdoors."""

    axis: int
    index: int
    outer: bool
    one: OnAxis


def settled(axes: Sequence[Axis], thin_px: float, sky: BaseGeometry) -> list[Axis]:
    """The axes with their openings judged by what lies on both sides; `sky` is what is outdoors."""
    places = list(_places(axes, sky))
    again = [_again(place, thin_px) for place in places]
    usual = usual_door(again)
    door_px = usual or USUAL_DOOR * thin_px
    least_px = LEAST_DOOR * usual if usual else LEAST_WAY * thin_px
    leaf_px = _usual_leaf(again)
    windows = _window_manner(places, again)
    doors = _door_manners(places, again)
    done: dict[tuple[int, int], Judged] = {}
    for place, judged in zip(places, again, strict=True):
        final = replace(judged, type="french") if _is_french(judged, leaf_px) else judged
        if place.outer and windows is not None:
            final = _by_manner(judged, windows, doors, door_px)
        done[(place.axis, place.index)] = replace(final, score=likely(final))
    return [
        replace(axis, openings=tuple(_kept(axis, number, done, least_px)))
        for number, axis in enumerate(axes)
    ]


def _kept(
    axis: Axis, number: int, done: dict[tuple[int, int], Judged], least_px: float
) -> Iterator[OnAxis]:
    """The openings of an axis with their new judgements, without slits."""
    for index, one in enumerate(axis.openings):
        judged = done[(number, index)]
        if not _is_slit(judged, least_px):
            yield _moved(axis, one, judged)


def manner(seen: Evidence) -> Manner:
    """Of what is drawn in an opening."""
    return Manner(seen.faces, min(len(seen.inner), 2), seen.shade > LEAST_TONE, slides(seen))


def _places(axes: Sequence[Axis], sky: BaseGeometry) -> Iterator[_Place]:
    for number, axis in enumerate(axes):
        for index, one in enumerate(axis.openings):
            outer = leads_out(axis.line, (one.first, one.last), sky)
            yield _Place(number, index, outer, one)


def _again(place: _Place, thin_px: float) -> Judged:
    old = place.one.judged
    if old.seen is None or old.type == "pocket":
        return old
    return judge(old.gap, old.seen, thin_px, place.outer) or old


def _is_slit(judged: Judged, least_px: float) -> bool:
    """Whether nobody could walk through: a flaw of the ink, behind which the wall goes on."""
    leafless = judged.kind == "gap" or judged.type in ("plain", "unknown", "sliding")
    narrow = least_px if leafless else LEAST_LEAF * least_px
    return judged.kind != "window" and judged.gap.width_px < narrow


def usual_door(judged: Sequence[Judged], fewest: int = 3) -> float | None:
    """The median width of doors with leaves, in pixels; None where fewer are known.

    Leaves without their traces are too doubtful to say it.
    """
    widths = [one.gap.width_px for one in judged if one.type == "swing" and not is_bare(one)]
    return float(np.median(widths)) if len(widths) >= fewest else None


def _usual_leaf(judged: Sequence[Judged]) -> float | None:
    """How thick leaves of single doors are drawn."""
    drawn = [one.seen.leaf_px for one in judged if one.type == "swing" and one.seen is not None]
    return float(np.median(drawn)) if len(drawn) >= 3 else None


def _is_french(judged: Judged, leaf_px: float | None) -> bool:
    """French doors are double doors whose leaves are drawn thicker: they are glazed."""
    if judged.type != "double" or judged.seen is None or leaf_px is None:
        return False
    return judged.seen.leaf_px > max(GLAZED * leaf_px, leaf_px + 1.0)


def _window_manner(places: Sequence[_Place], judged: Sequence[Judged]) -> Manner | None:
    """How most of the openings are drawn that lead outdoors and have no leaf."""
    count = Counter(
        manner(one.seen)
        for place, one in zip(places, judged, strict=True)
        if place.outer and one.seen is not None and one.hinge == "none" and one.kind != "gap"
    )
    return count.most_common(1)[0][0] if count else None


def _door_manners(places: Sequence[_Place], judged: Sequence[Judged]) -> set[Manner]:
    """How doors without a leaf are drawn between rooms, more than once."""
    count = Counter(
        manner(one.seen)
        for place, one in zip(places, judged, strict=True)
        if not place.outer and one.seen is not None and one.hinge == "none" and one.kind == "door"
    )
    return {one for one, times in count.items() if times >= LEAST_TIMES}


def _by_manner(judged: Judged, windows: Manner, doors: set[Manner], door_px: float) -> Judged:
    """What an outer opening without a leaf is."""
    seen = judged.seen
    if seen is None or judged.hinge != "none" or judged.kind == "gap":
        return judged
    own = manner(seen)
    if own == windows or (own.panels and windows.panels):
        # The commonest drawing is that of windows, even where it looks like sliding panels.
        kind: OpeningType = "unknown" if own.panels else judged.type
        return replace(judged, kind="window", type=kind if judged.kind == "window" else "unknown")
    if own.panels:
        return judged
    wide = judged.gap.width_px >= GARAGE * door_px
    if own in doors:
        kind = "garage" if wide else "unknown"
        return replace(judged, kind="door", type=kind)
    if wide and own.inner == 2 and own.faces == windows.faces - 2 * (windows.faces == 2):
        return replace(judged, kind="door", type="garage")
    return judged


def _moved(axis: Axis, one: OnAxis, judged: Judged) -> OnAxis:
    """The opening with its new judgement; its place follows where the gap was narrowed."""
    if judged.gap is one.judged.gap:
        return replace(one, judged=judged)
    first, last = axis.line.arc.place(np.stack([judged.gap.start, judged.gap.end]))[0].tolist()
    return OnAxis(judged, min(first, last), max(first, last), along=first <= last)
