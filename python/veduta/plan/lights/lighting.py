"""Each room of a house gets the lamps that it needs: the recipe."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray
from shapely.geometry import Point, Polygon
from shapely.geometry.base import BaseGeometry
from shapely.ops import unary_union

from veduta.plan.document import Furniture, Light, PlanDocument, Room, Storey
from veduta.plan.furnish.catalogue.read import Catalogue, catalogue_of
from veduta.plan.house.furniture import footprint
from veduta.plan.house.hole import Hole
from veduta.plan.house.space import Space, pieces_of, space_of
from veduta.plan.lights.ceiling import ceiling_lamps
from veduta.plan.lights.furnished import followed, furniture_lamps, seat_lamp
from veduta.plan.lights.needs import (
    CEILING_LUMEN,
    REACH_PER_HEIGHT,
    WALL_LUMEN,
    WALL_SPACING_M,
    lumen_each,
    needed_lumen,
)
from veduta.plan.lights.sight import Field
from veduta.plan.lights.walls import outline_of, wall_lamps
from veduta.plan.options import HouseOptions

BELOW_CEILING_M = 0.12
WALL_LAMP_M = 1.9
"""From the floor to a wall lamp: above who stands, below the lintels."""
_LEAST_M2 = 0.25
"""A smaller piece of a room is a niche: it has no lamp of its own."""
_LEAF_ROOM_M = 0.1
_HIGH_M = 1.6
"""A thing that is higher than this hides the wall behind it."""
_SEATED = {"living", "study", "bedroom"}
_BY_SEATS = {"floor", "table"}
"""Lamps of these kinds are for who sits there."""


@dataclass(frozen=True)
class Lit:
    """A document with lamps, and how well they light it.

    points, dark: of the floor that were looked at, and that no lamp lights. notes: what is dark.
    """

    document: PlanDocument
    points: int = 0
    dark: int = 0
    notes: tuple[str, ...] = field(default=())


def light_house(document: PlanDocument, options: HouseOptions) -> Lit:
    """Lamps for each storey that has none yet; those that a document has are left as they are.

    Lights of furniture go with it, wherever a document has moved it to.
    """
    catalogue = catalogue_of(options.catalogue)
    storeys: list[Storey] = []
    notes: list[str] = []
    for storey in document.storeys:
        kept, said = followed(storey, catalogue)
        storeys.append(kept)
        notes += said
    if options.lights == "none":
        return Lit(document.model_copy(update={"storeys": storeys}), notes=tuple(notes))
    points = dark = 0
    for index, storey in enumerate(storeys):
        space = space_of(storey, storey.height_m - options.slab)
        if storey.lights is None:
            lights = _storey_lights(space, options, catalogue)
            storeys[index] = storey.model_copy(update={"lights": lights})
        for room, seen, unseen in darkness(space, storeys[index].lights or []):
            points, dark = points + seen, dark + unseen
            if unseen:
                share = f"{100 * unseen / seen:.0f} %"
                notes.append(f"{storey.name}: {share} of {room.id} lie in the dark")
    return Lit(document.model_copy(update={"storeys": storeys}), points, dark, tuple(notes))


def darkness(space: Space, lights: Sequence[Light]) -> list[tuple[Room, int, int]]:
    """Of each room: how many points of its floor were looked at, and how many no lamp lights."""
    found = []
    for room, region in _regions(space):
        own = [light for light in lights if light.room == room.id]
        floor = Field(region)
        lit = np.zeros(len(floor.points), dtype=np.bool_)
        for light in own:
            lit |= floor.lit_by(np.array([light.at_m]), reach_of(light))[:, 0]
        found.append((room, len(lit), int((~lit).sum())))
    return found


def reach_of(light: Light) -> float:
    """The radius of illumination on the floor (m)."""
    return REACH_PER_HEIGHT * light.above_m


def _regions(space: Space) -> list[tuple[Room, Polygon]]:
    """The pieces of the rooms' floors that are lit by themselves."""
    return [
        (room, piece)
        for room, region in space.floors
        if room is not None
        for piece in pieces_of(region)
        if piece.area >= _LEAST_M2
    ]


def _storey_lights(space: Space, options: HouseOptions, catalogue: Catalogue) -> list[Light]:
    ceiling_m = space.storey.height_m - options.slab
    things: dict[str, list[Furniture]] = {}
    for item in space.storey.furniture or []:
        things.setdefault(item.room, []).append(item)
    lights: list[Light] = []
    for room, region in _regions(space):
        standing = things.get(room.id, [])
        # What hangs lights all of the room; what stands is for those who sit there.
        if options.lights == "wall" or room.outdoors:
            lights += _on_walls(room, region, space, standing, len(lights))
        else:
            lights += _on_ceiling(room, region, ceiling_m, len(lights))
    for room_id, standing in things.items():
        lights += furniture_lamps(room_id, standing, catalogue)
    for room, region in _regions(space):
        standing = things.get(room.id, [])
        if room.use in _SEATED and standing:
            free = _free(region, space, standing)
            own = [one for one in lights if one.room == room.id and one.kind in _BY_SEATS]
            extra = seat_lamp(room.id, _fresh_id(lights), standing, free, own, catalogue)
            lights += [extra] if extra else []
    return lights


def _fresh_id(lights: Sequence[Light]) -> str:
    known = {light.id for light in lights}
    return next(name for n in range(1, len(known) + 2) if (name := f"l{n}") not in known)


def _on_ceiling(room: Room, region: Polygon, ceiling_m: float, first: int) -> list[Light]:
    above = ceiling_m - BELOW_CEILING_M
    needed = needed_lumen(room.use, region.area)
    least = int(-(-needed // CEILING_LUMEN))
    places = ceiling_lamps(region, REACH_PER_HEIGHT * above, least)
    return _lights("ceiling", room, places, above, needed, first)


def _on_walls(
    room: Room, region: Polygon, space: Space, things: Sequence[Furniture], first: int
) -> list[Light]:
    needed = needed_lumen(room.use, region.area)
    least = int(-(-needed // WALL_LUMEN))
    usable = space.walls.buffer(0.06).difference(_hidden(space, things))
    doors = [hole for hole in space.holes if hole.reaches_floor and room in (hole.left, hole.right)]
    door = None if not doors else doors[0].line.line.interpolate(doors[0].start_m)
    outline = outline_of(region, usable, door)
    reach = REACH_PER_HEIGHT * WALL_LAMP_M
    places = wall_lamps(region, outline, WALL_SPACING_M, reach, least)
    return _lights("wall", room, places, WALL_LAMP_M, needed, first)


def _lights(
    kind: str, room: Room, places: NDArray[np.float64], above_m: float, needed: float, first: int
) -> list[Light]:
    """Records of lamps that share what a room needs."""
    if not len(places):
        return []
    lumen = lumen_each(needed, len(places))
    return [
        Light.model_validate(
            {
                "id": f"l{first + index + 1}",
                "kind": kind,
                "room": room.id,
                "at_m": (round(float(at[0]), 3), round(float(at[1]), 3)),
                "above_m": round(above_m, 3),
                "lumen": lumen,
            }
        )
        for index, at in enumerate(places)
    ]


def _hidden(space: Space, things: Sequence[Furniture]) -> BaseGeometry:
    """Where openings, open leaves and high things take the walls."""
    openings = [
        hole.outline.buffer(0.1)
        for hole in space.holes
        if hole.low_m < WALL_LAMP_M + 0.2 and hole.high_m > WALL_LAMP_M - 0.2
    ]
    high = [
        footprint(item).buffer(0.15) for item in things if item.above_m + item.size_m[2] > _HIGH_M
    ]
    return unary_union([*openings, *leaves(space), *high])


def leaves(space: Space) -> list[Polygon]:
    """What doors sweep: a disc about each hinge."""
    return [
        Point(at).buffer(width + _LEAF_ROOM_M)
        for hole in space.holes
        if hole.opening.kind == "door"
        for at, width in _hinges(hole)
    ]


_WITHOUT_HINGE = frozenset({"sliding", "pocket", "garage", "plain"})


def _hinges(hole: Hole) -> list[tuple[NDArray[np.float64], float]]:
    ends = {"start": [hole.start_m], "end": [hole.end_m], "both": [hole.start_m, hole.end_m]}
    at = [] if hole.type in _WITHOUT_HINGE else ends[hole.hinge]
    return [(hole.line.at(one), hole.width_m / len(at)) for one in at]


def _free(region: Polygon, space: Space, things: Sequence[Furniture]) -> BaseGeometry:
    taken = [footprint(item) for item in things if item.above_m < 1.8]
    doorways = [hole.outline.buffer(0.6) for hole in space.holes if hole.reaches_floor]
    return region.difference(unary_union([*taken, *leaves(space), *doorways]))
