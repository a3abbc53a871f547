"""Rooms do not leak: where a wall is broken the space is closed, and that is said.

A break is closed where it parts a space in two, and something speaks for it: a door's leaf that is
drawn there, both faces of the wall drawn on, a window, solid ink, ends of a wall that face each
other across a passage, a name or size of a room on either side, or a room that is open to the
outdoors. The best one is closed first, as it changes what the others part, and with it those of
which that is not so.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray
from shapely.geometry import Point, Polygon

from veduta.plan.document import OpeningType, Origin, Text
from veduta.plan.openings.classify import Judged
from veduta.plan.openings.gaps import Gap
from veduta.plan.openings.settle import USUAL_DOOR, usual_door
from veduta.plan.openings.strip import Sheet
from veduta.plan.rooms.closing import UNDRAWN, Closing, apart
from veduta.plan.rooms.drawn_round import drawn_walls, thin_outline
from veduta.plan.rooms.enclosed import Enclosed, enclosed_by
from veduta.plan.rooms.labels import room_labels
from veduta.plan.rooms.looker import Looker
from veduta.plan.rooms.paper import Raster, raster_of
from veduta.plan.walls.axes import Axis, OnAxis
from veduta.plan.walls.find import Found
from veduta.plan.walls.pieces import Piece

NARROWEST_GAP = 4.0
"""Nobody walks through what is narrower, in (thin) wall thicknesses: it is wall."""

GLAZED = 1.5
"""Ways out that are so many times as wide as a door are taken for glazed doors that slide."""

BESIDE_PX = 3.0
"""So far from the face of a wall that closes a break one is in what lies beside it."""

LEAST_SHUT_PX = 3
"""Gaps between lines that are narrower are none, in whole pixels ..."""

SHUT = 0.7
"""... nor, where a room is open even then, those narrower than this part of a thin wall: panes that
slide past each other leave such a one."""

MOST_ROUNDS = 24
"""In each, all breaks are closed that change nothing for each other."""
MOST_LOOKED_AT = 5000
"""Breaks that are looked at in all rounds together: drawings of noise have hundreds in each."""
MOST_WALLS = 500
"""Of a drawing that is not noise: more leave thousands of breaks, none of which says anything."""
TOO_MANY = (
    "{} pieces of wall were found, too many to be walls alone: gaps between them are not closed."
    " Take a cleaner or a sharper scan"
)


@dataclass(frozen=True)
class Mended:
    """The axes with those that close rooms, and a note for each of these."""

    axes: list[Axis]
    notes: tuple[str, ...]


def mended(
    axes: Sequence[Axis],
    found: Found,
    sheet: Sheet,
    texts: Sequence[Text] = (),
    *,
    by_lines: bool = True,
    thin: bool = False,
) -> Mended:
    """Close what is broken, the best break first, as long as that makes another room.

    `by_lines`: rooms with a name that are open even then are closed along lines around them; not
    where walls are known, so that other lines are no walls. `thin`: along single thin lines, too.
    """
    notes = list[str]()
    if len(axes) > MOST_WALLS:
        return Mended(list(axes), (TOO_MANY.format(len(axes)),))
    usual = usual_door([one.judged for axis in axes for one in axis.openings])
    glazed_px = GLAZED * (usual or USUAL_DOOR * found.thin_px)
    looker = Looker(found, sheet, room_labels(texts), usual)
    failed: set[tuple[int, ...]] = set()
    enclosed = enclosed_by(axes, found.thin_px)
    closings = looker.closings(enclosed)
    for _ in range(MOST_ROUNDS):
        left = [one for one in closings if one.closing.broken.key not in failed]
        if not left or looker.looked_at > MOST_LOOKED_AT:
            break
        best = apart(left)
        failed |= {one.broken.key for one in best}
        walls = [_axis(one, found.thin_px, glazed_px) for one in best]
        kept, enclosed = _closed(enclosed, walls, found.thin_px)
        if kept:
            notes += [_note(best[place], walls[place]) for place in kept]
            closings = looker.closings(enclosed)
    if by_lines and axes:
        indoors = room_labels(texts, indoors=True)
        door_px = usual or USUAL_DOOR * found.thin_px
        shut = (
            max(LEAST_SHUT_PX, round(SHUT * found.thin_px)) | 1
        )  # odd: even ones shift by a pixel
        passes = ((False, LEAST_SHUT_PX), (True, LEAST_SHUT_PX), (True, shut))
        for also, shut_px in passes if thin else passes[:1]:
            around = partial(_around, found=found, door_px=door_px, thin=also)
            # Thin lines close the room that is named, and make no others.
            most = 1.0 if also else math.inf
            look = _Looked(found, partial(raster_of, drawn=sheet.faint, shut_px=shut_px), most)
            enclosed, said = _along_lines(enclosed, look, indoors, around)
            notes += said
    return Mended(list(enclosed.axes), tuple(notes))


def _closed(
    enclosed: Enclosed, walls: Sequence[Axis], thin_px: float
) -> tuple[list[int], Enclosed]:
    """Which of the walls each make another room, and all with these; all at once if all do."""
    whole = enclosed_by([*enclosed.axes, *walls], thin_px)
    more = len(whole.rooms) - len(enclosed.rooms)
    if len(walls) == 1:
        return ([0], whole) if more > 0 else ([], enclosed)
    if more >= len(walls) and all(_parts(wall, whole) for wall in walls):
        return [*range(len(walls))], whole
    kept = []
    for place, wall in enumerate(walls):
        made, enclosed = _closed(enclosed, [wall], thin_px)
        kept += [place for _ in made]
    return kept, enclosed


def _parts(wall: Axis, enclosed: Enclosed) -> bool:
    """Whether a wall lies between two rooms, or a room and what is none, at its middle."""
    line = wall.line
    away = np.array([1.0, -1.0]) * (line.thickness_px / 2 + BESIDE_PX)
    sides = [Point(*one) for one in line.arc.at(line.length_px / 2, away)]
    first, second = ([room.contains(one) for room in enclosed.rooms] for one in sides)
    return first != second


@dataclass(frozen=True)
class _Looked:
    """What lines are looked for in, and how many more rooms one of them may make, at most."""

    found: Found
    raster: Callable[[Sequence[Polygon]], Raster]
    most: float


def _along_lines(
    enclosed: Enclosed,
    look: _Looked,
    labels: Sequence[NDArray[np.float64]],
    around: Callable[[Sequence[Axis], Raster, NDArray[np.float64]], list[Axis]],
) -> tuple[Enclosed, list[str]]:
    """With walls that close spaces with a label where lines do, and a note for each space."""
    notes = list[str]()
    raster = None
    for label in labels:
        name = Point(*label)
        if any(room.contains(name) for room in enclosed.rooms):
            continue
        if raster is None:
            raster = look.raster(enclosed.bodies)
        walls = around(enclosed.axes, raster, label)
        if not walls:
            continue
        tried = enclosed_by([*enclosed.axes, *walls], look.found.thin_px)
        more = len(tried.rooms) - len(enclosed.rooms)
        own = any(room.contains(name) for room in tried.rooms)
        if not own or more < 1 or more > look.most:
            continue
        enclosed, raster = tried, None
        place = f"at pixel ({name.x:.0f}, {name.y:.0f}) of the cleaned drawing"
        notes.append(f"the room {place} is closed along the lines that are drawn around it")
    return enclosed, notes


def _around(
    axes: Sequence[Axis],
    raster: Raster,
    label: NDArray[np.float64],
    *,
    found: Found,
    door_px: float,
    thin: bool,
) -> list[Axis]:
    """Walls around a label that are drawn as such, or (thin) by a single line."""
    if thin:
        return thin_outline(axes, found, raster, label, door_px)
    return drawn_walls(axes, found, raster, label, door_px)


def _axis(closing: Closing, thin_px: float, glazed_px: float) -> Axis:
    """The wall that closes a break, with the openings in it; nobody leaves a house open."""
    one = closing.broken
    line = Piece(one.start, one.end, one.thickness_px)
    origin: Origin = "inferred" if closing.reason in UNDRAWN else "measured"
    openings = []
    for gap, seen in zip(one.gaps, closing.drawn, strict=True):
        judged = seen if seen is not None and seen.kind != "gap" else _plain(gap)
        if judged.kind == "window" and closing.reason == "two rooms are named in one space":
            # Lines across the way from room to room are panels, as of a wardrobe or a terrace.
            judged = Judged(gap, "door", "sliding", "none", "none", 0.4)
        if judged.kind == "window" and closing.reason == "both faces are drawn on there":
            judged = Judged(gap, "door", "unknown", "none", "none", 0.6)
        way_out = judged.kind == "gap" and closing.reason == "a room is open to the outdoors"
        if way_out and gap.width_px >= NARROWEST_GAP * thin_px:
            if all(each is None or each.kind == "gap" for each in closing.drawn):
                origin = "invented"
            door: OpeningType = "sliding" if gap.width_px >= glazed_px else "unknown"
            judged = Judged(gap, "door", door, "none", "none", 0.2)
        first, last = ((point - one.start) @ line.direction for point in (gap.start, gap.end))
        if judged.kind == "door" or gap.width_px >= NARROWEST_GAP * thin_px:
            openings.append(OnAxis(judged, float(first), float(last), along=True))
    return Axis(line, tuple(openings), origin, closing=True)


def _plain(gap: Gap) -> Judged:
    return Judged(gap, "gap", "plain", "none", "none", 0.3)


def _note(closing: Closing, axis: Axis) -> str:
    middle = (closing.broken.start + closing.broken.end) / 2
    place = f"at pixel ({middle[0]:.0f}, {middle[1]:.0f}) of the cleaned drawing"
    if not closing.broken.gaps:
        return f"a wall is carried on {place}, as {closing.reason}"
    count = Counter(each.judged.kind for each in axis.openings)
    kinds = " and ".join(f"{n} {kind}s" if n > 1 else f"a {kind}" for kind, n in count.items())
    done = f"closed as {kinds}" if kinds else "mended as wall"
    wide = f"{closing.broken.width_px:.0f} px"
    return f"a wall is broken over {wide} {place}: {done}, as {closing.reason}"
