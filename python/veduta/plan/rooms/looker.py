"""What speaks for closing a break: what is drawn there, and what it parts."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from shapely import STRtree, buffer, normalize, to_wkb, unary_union
from shapely.geometry import Point, Polygon, box

from veduta.plan.openings.classify import Judged, judge
from veduta.plan.openings.evidence import look_at
from veduta.plan.openings.gaps import Gap
from veduta.plan.openings.strip import Sheet
from veduta.plan.rooms.breaks import Break, Parting, find_breaks
from veduta.plan.rooms.close import LEAST_WIDTH, wall_body
from veduta.plan.rooms.closing import Closing, Placed
from veduta.plan.rooms.enclosed import Enclosed
from veduta.plan.rooms.rays import FARTHEST, IN_LINE_FARTHEST
from veduta.plan.walls.find import Found

WIDEST_BREAK = 12.0
"""Breaks for which nothing is drawn are at most so many (thin) wall thicknesses wide."""

WIDEST_FACING = 18.0
"""Or so many between two walls in one line, in a space with two names."""

DOOR_WIDTHS = (0.55, 1.6)
"""Doors differ from the usual door of the sheet by these factors at most."""

DOOR_BY_WALL = (3.5, 14.0)
"""Widths of doors in (thin) wall thicknesses, where few doors are known."""

SURE_ARC = 0.6
"""An arc beside a corner is a door's only if it is drawn well: bowls and tables have arcs, too."""

LEAFLESS = 1.5
"""Doors of closets, drawn without leaves, are wider than others by this factor at most."""

PASSAGE = 10.0
"""Ends of walls face each other across a passage of so many (thin) wall thicknesses at most."""

ROOMY = (0.9, 2.0)
"""On both sides of a passage a space is so many times as broad, and holds so many squares of its
width: a corridor is hardly broader, a niche holds less."""

ROOM = 1.2
"""On one side it is so many times as broad: in the middle of a corridor there is no passage, where
walls of rooms on both its sides face each other."""


class Looker:
    """What speaks for closing a break."""

    def __init__(
        self,
        found: Found,
        sheet: Sheet,
        labels: Sequence[NDArray[np.float64]],
        door_px: float | None,
    ) -> None:
        self.found, self.sheet = found, sheet
        self.parting = Parting(found.solid)
        self.labels = [Point(*one) for one in labels]
        thin = found.thin_px
        low, high = DOOR_BY_WALL if door_px is None else DOOR_WIDTHS
        unit = thin if door_px is None else door_px
        self.door_px = (low * unit, high * unit)
        self.leaking: list[Point] = []
        self.seen: dict[tuple[int, ...], Judged | None] = {}
        self.parts: dict[tuple[bytes, bytes], list[Polygon]] = {}
        self.looked_at = 0

    def closings(self, enclosed: Enclosed) -> list[Placed]:
        """All breaks of these walls that are worth closing."""
        spaces = self._spaces(enclosed)
        self.leaking = self._leaking(enclosed)
        breaks = find_breaks(enclosed.graph, enclosed.axes, self.parting, self.found.thin_px)
        self.looked_at += len(breaks)
        bodies = _grown(
            [wall_body(one.start, one.end, one.thickness_px, (0.0, 0.0)) for one in breaks], 0.7
        )
        tree = STRtree([space for space, _ in spaces])
        # A closing changes few spaces: the others are parted as they were in the round before.
        exact = to_wkb(normalize([space for space, _ in spaces])), to_wkb(bodies)
        pairs = tree.query(bodies, predicate="intersects").T.tolist()
        met: dict[int, set[int]] = {}
        for place, index in pairs:
            met.setdefault(place, set()).add(index)
        found = []
        for place, index in pairs:
            space, outdoors = spaces[index]
            both = exact[0][index], exact[1][place]
            if both not in self.parts:
                self.parts[both] = self._parts(space, bodies[place])
            parts = self.parts[both]
            closing = self._judged(breaks[place], parts, outdoors) if len(parts) > 1 else None
            if closing is not None:
                still_open = tuple(map(self._open, parts)) if outdoors else None
                where = frozenset(met[place])
                found.append(Placed(closing, bodies[place], where, tuple(parts), still_open))
        return found

    def _spaces(self, enclosed: Enclosed) -> list[tuple[Polygon, bool]]:
        """Rooms, and what is outdoors, which alone reaches the border of the sheet."""
        rooms = [(room, False) for room in enclosed.rooms]
        around = self._border()
        free = around.difference(unary_union(_grown(enclosed.bodies, 0.6)))
        border = around.exterior
        for part in getattr(free, "geoms", [free]):
            if isinstance(part, Polygon) and part.distance(border) < 1:
                rooms.append((part, True))
        return rooms

    def _leaking(self, enclosed: Enclosed) -> list[Point]:
        """Points in rooms that only breaks of usual width open to the outdoors.

        No disc as broad as these gets there from the border of the sheet.
        """
        reach = WIDEST_BREAK / 2 * self.found.thin_px
        around = self._border()
        free = around.difference(unary_union(enclosed.bodies).buffer(reach))
        parts = [one for one in getattr(free, "geoms", [free]) if isinstance(one, Polygon)]
        inside = [one.representative_point() for one in parts if one.distance(around.exterior) > 1]
        return [one for one in inside if not any(room.contains(one) for room in enclosed.rooms)]

    def _border(self) -> Polygon:
        """A frame well outside the sheet, so that one can go all around the house."""
        height, width = self.found.solid.shape
        away = WIDEST_BREAK * self.found.thin_px + 20
        return box(-away, -away, width + away, height + away)

    def _parts(self, space: Polygon, body: Polygon) -> list[Polygon]:
        """The parts of a space that a break parts which are as broad as rooms are."""
        rest = space.difference(body)
        parts = [one for one in getattr(rest, "geoms", []) if isinstance(one, Polygon)]
        least = LEAST_WIDTH / 2 * self.found.thin_px
        return [one for one in parts if one.area > 4 * least**2 and _holds_disc(one, least)]

    def _judged(self, one: Break, parts: list[Polygon], outdoors: bool) -> Closing | None:
        if not one.gaps:
            return None if one.slanted else Closing(one, "it is solid there", 3.0)
        drawn = tuple(self._look(gap, one.key, outdoors) for gap in one.gaps)
        doors = [each.score for each in drawn if each is not None and self._is_door(each)]
        if doors:
            return Closing(one, "a door is drawn there", 2.0 + max(doors), drawn)
        if not outdoors and all(self._is_leafless(each) for each in drawn):
            return Closing(one, "both faces are drawn on there", 2.0, drawn)
        if not outdoors and self._is_passage(one, parts):
            return Closing(one, "walls face each other across a passage there", 1.0, drawn)
        window = all(each is not None and each.kind != "gap" for each in drawn)
        if one.slanted and outdoors and all(_is_window(each) for each in drawn):
            return Closing(one, "a window is drawn there", 2.0, drawn)
        widest = FARTHEST if window else WIDEST_BREAK
        if one.in_line:
            widest = IN_LINE_FARTHEST if outdoors else max(widest, WIDEST_FACING)
        if one.slanted or one.width_px > widest * self.found.thin_px:
            return None
        # What is narrow and has lines drawn in it is the better place.
        worth = 0.2 * window + 0.7 / (1.0 + one.width_px / (WIDEST_BREAK * self.found.thin_px))
        held = [sum(part.contains(label) for label in self.labels) for part in parts]
        if not outdoors:
            enough = sum(count > 0 for count in held) > 1
            return (
                Closing(one, "two rooms are named in one space", worth, drawn) if enough else None
            )
        inside = [part for part in parts if not self._open(part)]
        closed = [*self.labels, *self.leaking]
        count = sum(part.contains(point) for part in inside for point in closed)
        # The break that is nearest to the outdoors has the most rooms behind it.
        worth = 1.0 + count / (count + 1) * 0.9 + 0.1 * worth
        return Closing(one, "a room is open to the outdoors", worth, drawn) if count else None

    def _is_door(self, judged: Judged) -> bool:
        """Whether a door's leaf is drawn, and as wide as the others."""
        fits = self.door_px[0] <= judged.gap.width_px <= self.door_px[1]
        return fits and judged.hinge != "none" and judged.score >= SURE_ARC

    def _is_leafless(self, judged: Judged | None) -> bool:
        """Whether the wall's two faces go on as lines with paper between them, over a door's width.

        One line alone is the front of a counter or a wardrobe.
        """
        if judged is None or judged.seen is None or judged.kind == "gap":
            return False
        low, high = self.door_px[0], LEAFLESS * self.door_px[1]
        drawn = judged.seen.faces == 2 and not judged.seen.inner
        return drawn and low <= judged.gap.width_px <= high

    def _is_passage(self, one: Break, parts: Sequence[Polygon]) -> bool:
        """Whether a wall goes on behind an undrawn way of usual width, with rooms on both sides."""
        if one.slanted or not one.facing or len(one.gaps) != 1:
            return False
        if one.width_px > PASSAGE * self.found.thin_px:
            return False
        roomy = [part for part in parts if part.area >= ROOMY[1] * one.width_px**2]

        def as_broad(factor: float) -> int:
            return sum(not part.buffer(-factor * one.width_px / 2).is_empty for part in roomy)

        return as_broad(ROOMY[0]) > 1 and as_broad(ROOM) > 0

    def _open(self, part: Polygon) -> bool:
        """Whether it reaches the border of the sheet."""
        return bool(part.distance(self._border().exterior) < 1)

    def _look(self, gap: Gap, key: tuple[int, ...], outdoors: bool) -> Judged | None:
        place = (*key, *(int(value) for value in gap.start))
        if place not in self.seen:
            view = look_at(gap, self.sheet)
            # A leaf without its trace is too doubtful to close a wall by.
            seen = replace(view, bare=())
            self.seen[place] = judge(gap, seen, self.found.thin_px, outdoors)
        return self.seen[place]


def _holds_disc(region: Polygon, radius_px: float) -> bool:
    """Whether a disc fits in; where one does in the middle of it, that is all to look at."""
    if region.representative_point().distance(region.boundary) > radius_px:
        return True
    return not region.buffer(-radius_px).is_empty


def _grown(bodies: Sequence[Polygon], by_px: float) -> NDArray[np.object_]:
    """(n,) polygons with corners as round as `Polygon.buffer` makes them."""
    return np.asarray(buffer(np.array(bodies, dtype=object), by_px, quad_segs=16))


def _is_window(judged: Judged | None) -> bool:
    return judged is not None and judged.seen is not None and bool(judged.seen.lines)
