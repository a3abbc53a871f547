"""The air of each room: what its walls, slabs and shut openings leave of the space above its floor.

Air ends in the middle of a gap, and where stairs go through a ceiling: there it is open to the
next.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import manifold3d
from shapely.geometry import Point, Polygon
from shapely.geometry.base import BaseGeometry

from veduta.formats.cityjson_solids import closes
from veduta.plan.city.marked import OPEN, Mark, Marks, bodies, joined
from veduta.plan.city.matter import INTO_M, half_of
from veduta.plan.document import Room
from veduta.plan.house.floors import FINISH_M
from veduta.plan.house.hole import Hole
from veduta.plan.house.space import Space

BESIDE_M = 0.1
"""What lies so near to a room's floor, and is no wall's and no other room's, belongs to it."""
LEAST_ROOM_M3 = 0.3
_REACH_M = 0.02
_SLITS_M = (0.004, 0.02, 0.05)
_EDGES_M = (0.001, 0.004, 0.01)
"""Slits between walls of twice this width are no air: they would fall shut on the grid of a file.
Wider ones are left out, and longer edges collapsed, where a room is no sound solid with them.
"""
_STEP_M = 0.05
_NEAR_M = 0.01


@dataclass(frozen=True)
class Cavity:
    """Where a room is. region: its floor (m). air: its bodies, the largest first.

    room: None where walls with gaps close a space that is no room of the document.
    """

    space: Space
    room: Room | None
    region: BaseGeometry
    air: tuple[manifold3d.Manifold, ...]

    @property
    def name(self) -> str:
        """The storey and the room, as features are named."""
        return self.space.name_of(self.room)


def cavities(
    spaces: Sequence[Space], matter: manifold3d.Manifold, slab_m: float, marks: Marks
) -> tuple[list[Cavity], manifold3d.Manifold, list[str]]:
    """The rooms of all storeys but for what is outdoors, and the matter with its rooms filled.

    Also which rooms of the document are not there, as they have no air.
    """
    found, filled, notes = [], [matter], []
    for index, space in enumerate(spaces):
        above = spaces[index + 1] if index + 1 < len(spaces) else None
        opening = Polygon() if above is None else above.well
        narrow, *wider = (_hollows(space, opening, slab_m, slit, marks) for slit in _SLITS_M)
        for tries in zip(narrow, *wider, strict=True):
            hollow, air = _sound(tries, matter, marks)
            filled.append(hollow.solid(into_m=2.0 * _REACH_M))
            if air:
                found.append(Cavity(space, hollow.room, hollow.region, air))
            elif hollow.room is not None:
                name = space.name_of(hollow.room)
                notes.append(f"{name} has no air in it: house.city.json has no such room")
        notes += [
            f"{space.name_of(room)} has no floor of its own: house.city.json has no such room"
            for room in _without_floor(space)
        ]
    return found, joined(filled), notes


def _without_floor(space: Space) -> list[Room]:
    """Rooms indoors that walls, other rooms or a well leave nothing of."""
    with_floor = {room.id for room, _ in replace(space, well=Polygon()).floors if room is not None}
    return [room for room, _ in space.rooms if not room.outdoors and room.id not in with_floor]


def _sound(
    tries: Sequence[_Hollow], matter: manifold3d.Manifold, marks: Marks
) -> tuple[_Hollow, tuple[manifold3d.Manifold, ...]]:
    """The first way to see a room in which no two edges fall together; else the last."""
    for hollow, edge in zip(tries, _EDGES_M, strict=True):
        every = bodies(hollow.solid(into_m=0.0) - matter, edge)
        air = tuple(body for body in every if body.volume() > LEAST_ROOM_M3)
        if all(closes([face.rings for face in marks.faces(body)]) for body in air):
            break
    return hollow, air


def _hollows(
    space: Space, opening: BaseGeometry, slab_m: float, slit_m: float, marks: Marks
) -> list[_Hollow]:
    """The rooms of a storey; a floor goes on over the well in it."""
    floors = replace(space, well=Polygon()).floors
    regions = _regions(space, [region for _, region in floors], slit_m)
    return [
        _Hollow(space, room, region, regions, opening, slab_m, marks)
        for (room, _), region in zip(floors, regions, strict=True)
        if room is None or not room.outdoors
    ]


def _regions(space: Space, floors: Sequence[BaseGeometry], slit_m: float) -> list[BaseGeometry]:
    """The floors with what is left between them and the walls."""
    free = space.slab.difference(space.walls)
    for floor in floors:
        free = free.difference(floor)
    found: list[BaseGeometry] = []
    for floor in floors:
        own = floor.union(floor.buffer(BESIDE_M, join_style="mitre").intersection(free))
        free = free.difference(own)
        clear = own.difference(space.walls).buffer(-slit_m, join_style="mitre")
        found.append(clear.buffer(slit_m, join_style="mitre"))
    return found


@dataclass(frozen=True)
class _Hollow:
    """A room as prisms that reach into all that is around it."""

    space: Space
    room: Room | None
    region: BaseGeometry
    regions: Sequence[BaseGeometry]
    opening: BaseGeometry
    slab_m: float
    marks: Marks

    def solid(self, into_m: float) -> manifold3d.Manifold:
        """All of it. into_m: how far it reaches into what is below and above."""
        floor = self.space.storey.elevation_m
        under = floor + self.space.storey.height_m - self.slab_m
        low = floor + FINISH_M - (FINISH_M + into_m if into_m else 0.0)
        high = under - (FINISH_M if not into_m else -into_m)
        name = self.space.name_of(self.room)
        ground, ceiling = Mark("floor", f"{name} floor"), Mark("ceiling", f"{name} ceiling")
        wide = self._wide()
        well = self.space.well.intersection(self.region)
        prisms = []
        # What lies over a well has no floor, what lies below one no ceiling.
        for region, bottom, lowest in (
            (wide.difference(well), ground, low),
            (wide.intersection(well), OPEN, floor - self.slab_m),
        ):
            for piece, top, highest in (
                (region.difference(self.opening), ceiling, high),
                (region.intersection(self.opening), OPEN, under),
            ):
                side = OPEN if top is ceiling else ceiling
                if piece.area > 1e-4:
                    prisms.append(self.marks.prism(piece, lowest, highest, bottom, top, side))
        prisms += self._openings(into_m, ground)
        return joined(prisms)

    def _wide(self) -> BaseGeometry:
        """The region, a little into the walls."""
        thin = min((line.half_m for line in self.space.lines.values()), default=_REACH_M)
        grown = self.region.buffer(min(_REACH_M, thin), join_style="mitre")
        return grown.intersection(self.region.union(self.space.walls))

    def _openings(self, into_m: float, ground: Mark) -> list[manifold3d.Manifold]:
        """The near half of each opening in the walls around."""
        floor = self.space.storey.elevation_m
        found = []
        for hole in self.space.holes:
            low = floor + (hole.low_m - INTO_M)
            if hole.reaches_floor:
                low = floor + (FINISH_M if not into_m else -into_m)
            for side in (1.0, -1.0):
                if self._is_own(hole, side):
                    found.append(
                        self.marks.prism(
                            half_of(hole, side, _REACH_M), low, floor + hole.high_m + INTO_M,
                            ground, OPEN, OPEN,
                        )
                    )  # fmt: skip
        return found

    def _is_own(self, hole: Hole, side: float) -> bool:
        """Whether an opening leads into the room on a side."""
        at = Point(hole.middle + side * hole.leftward * (hole.line.half_m + _STEP_M))
        return bool(self.region.distance(at) < _NEAR_M)
