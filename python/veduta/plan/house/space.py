"""A storey as regions of the plan: walls, openings where they can be cut, rooms, and its slab."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from shapely.geometry import MultiPolygon, Point, Polygon
from shapely.geometry.base import BaseGeometry
from shapely.ops import unary_union

from veduta.plan.document import Opening, Room, Storey
from veduta.plan.house.hanging import hung
from veduta.plan.house.hole import Hole
from veduta.plan.house.lines import WallLine, footprint, wall_lines

END_M = 0.02
"""What is left of a wall at least beside an opening, so that the wall does not fall apart."""
LEAST_OPENING_M = 0.25
LINTEL_M = 0.05
"""What is left of a wall at least above an opening."""
GAP_M = 1.6
"""A gap in the walls around a space that is no wider than this does not make it outdoors."""
UNNAMED = "unnamed"
"""In the place of a room's id, of what is floored but no room."""
_SLIVER_M2 = 0.01
_JOIN_M = 1e-3
_STEP_M = 0.05


@dataclass(frozen=True)
class Space:
    """A storey's regions (plan frame, m); notes say what was left out and why."""

    storey: Storey
    lines: dict[str, WallLine]
    walls: BaseGeometry
    holes: tuple[Hole, ...]
    notes: tuple[str, ...]
    well: BaseGeometry = field(default_factory=Polygon)
    """The opening in its floor through which stairs come up."""

    @cached_property
    def rooms(self) -> tuple[tuple[Room, Polygon], ...]:
        """The rooms with their polygons."""
        return tuple((room, room_polygon(room)) for room in self.storey.rooms)

    @cached_property
    def built(self) -> BaseGeometry:
        """All that lies within the outer faces of the walls, the walls with it.

        A space whose walls have a gap lies within them, too (`leaks`).
        """
        return unary_union([filled(self.walls), *self.leaks])

    @cached_property
    def leaks(self) -> tuple[Polygon, ...]:
        """Spaces that walls close but for gaps of at most `GAP_M`."""
        if self.walls.is_empty:
            return ()
        reach = GAP_M / 2.0
        closed = filled(self.walls.buffer(reach, join_style="mitre"))
        inside = closed.buffer(-reach, join_style="mitre").difference(filled(self.walls))
        wide = inside.buffer(-reach)
        return tuple(piece for piece in pieces_of(inside) if piece.intersects(wide))

    @cached_property
    def outdoors(self) -> BaseGeometry:
        """Balconies and terraces."""
        return unary_union([shape for room, shape in self.rooms if room.outdoors])

    @cached_property
    def slab(self) -> BaseGeometry:
        """What the storey stands on: all that is built, and all rooms."""
        return solid_region(unary_union([self.built, *(shape for _, shape in self.rooms)]))

    @cached_property
    def covered(self) -> BaseGeometry:
        """What is under a ceiling or a roof."""
        if self.outdoors.is_empty:
            return self.slab
        open_air = self.outdoors.difference(self.walls)
        return solid_region(self.slab.difference(open_air.buffer(_JOIN_M)).buffer(0.0))

    @cached_property
    def floors(self) -> tuple[tuple[Room | None, BaseGeometry], ...]:
        """What one can walk on, by rooms; what lies in none has no room."""
        free = self.slab.difference(self.walls).difference(self.well)
        found: list[tuple[Room | None, BaseGeometry]] = []
        for room, shape in self.rooms:
            own = solid_region(free.intersection(shape))
            if not own.is_empty:
                found.append((room, own))
            free = free.difference(shape)
        rest = solid_region(free.buffer(-0.1).buffer(0.1))
        if not rest.is_empty:
            found.append((None, rest))
        return tuple(found)

    def name_of(self, room: Room | None) -> str:
        """The storey and the room, as features are named; None: what lies in no room."""
        return f"{self.storey.name} {UNNAMED if room is None else room.id}"

    def room_at(self, point: NDArray[np.float64]) -> Room | None:
        """The room in which a point lies; None in none."""
        at = Point(point)
        return next((room for room, shape in self.rooms if shape.covers(at)), None)


def space_of(storey: Storey, wall_height_m: float) -> Space:
    """The regions of a storey whose walls end below its ceiling."""
    lines = wall_lines(storey)
    lines = {name: line for name, line in lines.items() if line.line.length > 1e-3}
    walls = solid_region(footprint(lines.values()))
    empty = Space(storey, lines, walls, (), ())
    holes: list[Hole] = []
    notes: list[str] = []
    for opening in storey.openings:
        hole = _hole(opening, empty, wall_height_m - LINTEL_M)
        clash = None if hole is None else _clash(hole, holes)
        if hole is None:
            notes.append(f"{opening.kind} {opening.id} is left out: its wall is too short for it")
        elif clash is not None:
            notes.append(f"{opening.kind} {opening.id} is left out: it lies in {clash}")
        else:
            holes.append(hole)
    notes += [
        f"{piece.area:.1f} m² of {storey.name} have a gap in their walls:"
        " floored and roofed, but no room"
        for piece in empty.leaks
    ]
    return Space(storey, lines, walls, hung(holes, empty.rooms, walls), tuple(notes))


def room_polygon(room: Room) -> Polygon:
    """The room's polygon."""
    shape = Polygon(room.outline_m, room.holes_m)
    return shape if shape.is_valid else shape.buffer(0.0)


def filled(region: BaseGeometry) -> BaseGeometry:
    """The region with its holes."""
    return unary_union([Polygon(piece.exterior) for piece in pieces_of(region)])


def pieces_of(region: BaseGeometry) -> list[Polygon]:
    """The polygons of a region."""
    if isinstance(region, Polygon):
        return [] if region.is_empty else [region]
    if isinstance(region, MultiPolygon):
        return list(region.geoms)
    return [piece for part in getattr(region, "geoms", ()) for piece in pieces_of(part)]


def solid_region(region: BaseGeometry, least_m2: float = _SLIVER_M2) -> BaseGeometry:
    """The polygons of a region, without slivers and without corners on straight lines."""
    kept = [
        Polygon(
            piece.exterior,
            [hole for hole in piece.interiors if Polygon(hole).area > least_m2],
        )
        for piece in pieces_of(region)
        if piece.area > least_m2
    ]
    return MultiPolygon(kept).simplify(1e-4) if kept else MultiPolygon()


def _hole(opening: Opening, space: Space, highest: float) -> Hole | None:
    """The opening within its wall; None where there is no room for it."""
    line = space.lines.get(opening.wall)
    if line is None:
        return None
    start = max(opening.along_m, END_M)
    end = min(opening.along_m + opening.width_m, line.line.length - END_M)
    low = min(opening.sill_m, highest)
    high = min(opening.sill_m + opening.height_m, highest)
    if end - start < LEAST_OPENING_M or high - low < LEAST_OPENING_M:
        return None
    hole = Hole(opening, line, start, end, low, high)
    middle = line.at((start + end) / 2.0)
    left = hole.leftward * (line.half_m + _STEP_M)
    return Hole(
        opening, line, start, end, low, high,
        space.room_at(middle + left), space.room_at(middle - left),
    )  # fmt: skip


def _clash(hole: Hole, holes: list[Hole]) -> str | None:
    """The opening that it would run into."""
    for other in holes:
        beside = hole.start_m >= other.end_m or hole.end_m <= other.start_m
        stacked = hole.low_m >= other.high_m or hole.high_m <= other.low_m
        if other.line is hole.line and not beside and not stacked:
            return other.opening.id
    return None
