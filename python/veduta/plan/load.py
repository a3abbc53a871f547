"""Reading a plan document that somebody may have edited: every fault by its place in the file."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from itertools import pairwise
from pathlib import Path

import numpy as np
from shapely.geometry import Polygon

from veduta.plan.document import (
    TYPES_OF,
    Furniture,
    Opening,
    PlanDocument,
    Room,
    Stairs,
    Storey,
    Wall,
)
from veduta.plan.house.lines import wall_lines
from veduta.plan.house.space import UNNAMED
from veduta.plan.load_treads import MAX_CORNERS, walk_faults
from veduta.run.edited import numbers_of, read_edited, shown_faults
from veduta.run.errors import InputError

DOCUMENT = "plan.json"
MAX_BYTES = 50_000_000
MAX_STOREYS = 50
MAX_PARTS = 20_000
"""Of one kind in one storey: walls, openings, rooms and so on."""
MAX_POINTS = 20_000
MAX_COORDINATE = 1e6
"""No number of a document is larger than this, by amount."""
MAX_BULGE = 1.0
"""A wall is at most half a circle."""
LEAST_STOREY_M = 2.0
TALLEST_M = 100.0
"""Nothing that stands in a house reaches higher."""
LARGEST_M = 500.0
"""From one end of a storey to the other: what is larger is no house."""
_SHORTEST_M = 0.01
_LEAST_FLIGHT_M2 = 0.05
_LEAST_STEP_M2 = 0.01
_SAME_POINT_M = 5e-4
"""Points that are nearer to each other give a line no direction."""
_UNIT_SLACK = 0.01
_BEYOND_M = 0.02
_REMEDY = "Mend it there; docs/plan.md says what each field means."


def load_document(path: Path) -> PlanDocument:
    """The document in `path`; InputError names each place in the file and its fault.

    The areas of rooms are made anew from their outlines.
    """
    document = read_edited(path, PlanDocument, MAX_BYTES, _REMEDY)
    faults = _faults(document)
    if faults:
        raise InputError(path, shown_faults(faults), _REMEDY)
    return _with_areas(document)


def _faults(document: PlanDocument) -> list[str]:
    """What the schema cannot say."""
    if not 1 <= len(document.storeys) <= MAX_STOREYS:
        return [f"storeys: {len(document.storeys)}, not between 1 and {MAX_STOREYS}"]
    found = [
        f"{place}: {value} is out of range"
        for place, value in numbers_of(document)
        if not (math.isfinite(value) and abs(value) <= MAX_COORDINATE)
    ]
    if document.time is not None and document.place_deg is None:
        found.append("time: says where the sun stands only with a place_deg, which is null")
    found += _name_faults(document)
    for index, storey in enumerate(document.storeys):
        place = f"storeys[{index}]"
        # Geometry is looked at only where the ids hold together.
        found += _id_faults(storey, place) or _storey_faults(storey, place)
        if size_of(storey) > LARGEST_M:
            size = f"{size_of(storey):.0f} m from end to end"
            found.append(f"{place}: is {size}; {LARGEST_M:.0f} m are the most")
        if not storey.walls and not storey.rooms:
            found.append(f"{place}: has neither walls nor rooms")
    elevations = [storey.elevation_m for storey in document.storeys]
    for index, elevation in enumerate(elevations):
        if elevation in elevations[:index]:
            found.append(
                f"storeys[{index}].elevation_m: another storey lies at {elevation:g} m, too"
            )
    return found


def _name_faults(document: PlanDocument) -> list[str]:
    """Storeys, and rooms with their storeys, that would be one and the same in the model."""
    found = []
    storeys: set[str] = set()
    rooms: dict[str, tuple[str, int]] = {}
    for number, storey in enumerate(document.storeys):
        if _as_id(storey.name) in storeys:
            found.append(
                f"storeys[{number}].name: {storey.name!r} is the name of another storey, too"
            )
            continue
        storeys.add(_as_id(storey.name))
        for index, room in enumerate(storey.rooms):
            place = f"storeys[{number}].rooms[{index}].id"
            if room.id == UNNAMED:
                found.append(f"{place}: {UNNAMED!r} is what is said of floors without a room")
            other, owner = rooms.setdefault(_as_id(f"{storey.name} {room.id}"), (place, number))
            if owner != number:
                found.append(f"{place}: with its storey's name it is the same as {other}")
    return found


def _as_id(name: str) -> str:
    """As ids of the model have it: a blank is a dash there."""
    return name.replace(" ", "-")


def size_of(storey: Storey) -> float:
    """From one end of its walls, rooms and stairs to the other, along x or y (m)."""
    points = [junction.at_m for junction in storey.junctions]
    points += [point for room in storey.rooms for point in room.outline_m]
    points += [point for flight in storey.stairs for point in flight.outline_m]
    return float(np.ptp(points, axis=0).max()) if points else 0.0


_WITH_IDS = (
    "junctions", "walls", "openings", "rooms", "stairs", "fittings", "furniture", "lights",
)  # fmt: skip


def _id_faults(storey: Storey, place: str) -> list[str]:
    """Ids that are there twice, and ids of nothing."""
    found = []
    for kind in _WITH_IDS:
        items = getattr(storey, kind) or ()
        if len(items) > MAX_PARTS:
            return [f"{place}.{kind}: {len(items)}, more than {MAX_PARTS}"]
        seen: set[str] = set()
        for index, item in enumerate(items):
            if _as_id(item.id) in seen:
                found.append(f"{place}.{kind}[{index}].id: {item.id!r} is there twice")
            seen.add(_as_id(item.id))
    junctions = {item.id for item in storey.junctions}
    walls = {item.id for item in storey.walls}
    openings = {item.id for item in storey.openings}
    rooms = {item.id for item in storey.rooms}
    for index, light in enumerate(storey.lights or []):
        at = f"{place}.lights[{index}]"
        found += _unknown([(f"{at}.room", light.room)], rooms)
        if not 0.0 < light.above_m < storey.height_m:
            found.append(f"{at}.above_m: {light.above_m:g} m is not between floor and ceiling")
    for index, one in enumerate(storey.fittings):
        found += _unknown([(f"{place}.fittings[{index}].room", one.room)], rooms)
    for index, wall in enumerate(storey.walls):
        at = f"{place}.walls[{index}]"
        found += _unknown([(f"{at}.start", wall.start), (f"{at}.end", wall.end)], junctions)
    for index, opening in enumerate(storey.openings):
        found += _unknown([(f"{place}.openings[{index}].wall", opening.wall)], walls)
    for index, room in enumerate(storey.rooms):
        at = f"{place}.rooms[{index}]"
        found += _unknown([(f"{at}.walls", name) for name in room.walls], walls)
        found += _unknown([(f"{at}.openings", name) for name in room.openings], openings)
    return found + _furniture_faults(storey, place)


def _furniture_faults(storey: Storey, place: str) -> list[str]:
    """Rooms that are not there, things that stand on nothing or around in a circle, no size."""
    rooms = {room.id for room in storey.rooms}
    things = {thing.id: thing for thing in storey.furniture or ()}
    found = []
    for index, thing in enumerate(storey.furniture or ()):
        at = f"{place}.furniture[{index}]"
        found += _unknown([(f"{at}.room", thing.room)], rooms)
        if min(thing.size_m) < _SHORTEST_M:
            found.append(f"{at}.size_m: a side is less than {_SHORTEST_M:g} m")
        if thing.above_m + thing.size_m[2] > TALLEST_M:
            found.append(f"{at}: reaches {thing.above_m + thing.size_m[2]:g} m up")
        if thing.on is not None and thing.on not in things:
            found.append(f"{at}.on: there is no {thing.on!r}")
        elif thing.on is not None and _stands_on_itself(thing, things):
            found.append(f"{at}.on: things stand on each other in a circle")
    return found


def _stands_on_itself(thing: Furniture, things: Mapping[str, Furniture]) -> bool:
    seen: set[str] = set()
    below: Furniture | None = thing
    while below is not None and below.on is not None:
        if below.id in seen:
            return True
        seen.add(below.id)
        below = things.get(below.on)
    return False


def _unknown(named: Iterable[tuple[str, str]], known: set[str]) -> list[str]:
    return [f"{place}: there is no {name!r}" for place, name in named if name not in known]


def _storey_faults(storey: Storey, place: str) -> list[str]:
    found = []
    if storey.height_m < LEAST_STOREY_M:
        found.append(f"{place}.height_m: {storey.height_m:g} m, less than {LEAST_STOREY_M:g}")
    at = {junction.id: junction.at_m for junction in storey.junctions}
    for index, wall in enumerate(storey.walls):
        found += _wall_faults(wall, math.dist(at[wall.start], at[wall.end]), place, index)
    if found:
        return found
    lengths = {name: line.line.length for name, line in wall_lines(storey).items()}
    for index, opening in enumerate(storey.openings):
        found += _opening_faults(opening, lengths[opening.wall], f"{place}.openings[{index}]")
    for index, room in enumerate(storey.rooms):
        found += _room_faults(room, f"{place}.rooms[{index}]")
    for index, flight in enumerate(storey.stairs):
        found += _stairs_faults(flight, f"{place}.stairs[{index}]")
    return found


def _wall_faults(wall: Wall, length_m: float, place: str, index: int) -> list[str]:
    at = f"{place}.walls[{index}]"
    found = []
    if length_m < _SHORTEST_M:
        found.append(f"{at}: its junctions lie on each other")
    if wall.thickness_m < _SHORTEST_M:
        found.append(f"{at}.thickness_m: {wall.thickness_m:g} m, less than {_SHORTEST_M:g}")
    if abs(wall.bulge) > MAX_BULGE:
        found.append(f"{at}.bulge: {wall.bulge:g}, more than {MAX_BULGE:g} (half a circle)")
    if wall.party and not wall.outer:
        found.append(
            f"{at}.party: wall {wall.id!r} is an inner one; only outer ones are to neighbours"
        )
    return found


def _opening_faults(opening: Opening, length_m: float, place: str) -> list[str]:
    types = TYPES_OF[opening.kind]
    if opening.type not in types:
        return [f"{place}.type: {opening.type!r} is none of a {opening.kind}: {', '.join(types)}"]
    if opening.along_m + opening.width_m > length_m + _BEYOND_M:
        end = opening.along_m + opening.width_m
        return [
            f"{place}: ends at {end:.2f} m (along_m and width_m) of wall {opening.wall!r},"
            f" which is {length_m:.2f} m long"
        ]
    return [
        f"{place}.{side}: must be above zero"
        for side in ("width_m", "height_m")
        if getattr(opening, side) <= 0.0
    ]


def _room_faults(room: Room, place: str) -> list[str]:
    rings = [("outline_m", room.outline_m)]
    rings += [(f"holes_m[{index}]", ring) for index, ring in enumerate(room.holes_m)]
    for name, ring in rings:
        if not 3 <= len(ring) <= MAX_POINTS:
            return [f"{place}.{name}: {len(ring)} points, not between 3 and {MAX_POINTS}"]
        if not Polygon(ring).is_valid:
            return [f"{place}.{name}: its line crosses or touches itself"]
    if room.tilings and (faults := _tiling_faults(room, place)):
        return faults
    if len(rings) > 1 and not Polygon(room.outline_m, room.holes_m).is_valid:
        return [f"{place}.holes_m: they cross or touch the outline, or each other"]
    return []


def _tiling_faults(room: Room, place: str) -> list[str]:
    found = []
    for index, tiling in enumerate(room.tilings):
        at = f"{place}.tilings[{index}]"
        if min(tiling.size_m) < _SHORTEST_M:
            found.append(f"{at}.size_m: a side is less than {_SHORTEST_M:g} m")
        if any(other.surface == tiling.surface for other in room.tilings[:index]):
            found.append(f"{at}.surface: the {tiling.surface} has tiles already")
    return found


def _stairs_faults(flight: Stairs, place: str) -> list[str]:
    count, length = len(flight.outline_m), math.hypot(*flight.up)
    if not 3 <= count <= MAX_POINTS:
        return [f"{place}.outline_m: {count} points, not between 3 and {MAX_POINTS}"]
    outline = Polygon(flight.outline_m)
    if not outline.is_valid or outline.area < _LEAST_FLIGHT_M2:
        return [f"{place}.outline_m: its line crosses itself, or encloses nothing"]
    if length > 0.0 and abs(length - 1.0) > _UNIT_SLACK:
        return [f"{place}.up: is {length:g} long, not 1 (or 0 where it is not known)"]
    return _steps_faults(flight, place)


def _steps_faults(flight: Stairs, place: str) -> list[str]:
    """Of stairs that turn: as many outlines as treads, and a walking line over all of them."""
    if not flight.steps_m:
        return [f"{place}.path_m: there are no steps_m that it leads over"] if flight.path_m else []
    if len(flight.steps_m) != flight.treads:
        return [f"{place}.steps_m: {len(flight.steps_m)} outlines, but {flight.treads} treads"]
    for index, ring in enumerate(flight.steps_m):
        if not 3 <= len(ring) <= MAX_CORNERS:
            told = f"{len(ring)} points, not between 3 and {MAX_CORNERS}"
            return [f"{place}.steps_m[{index}]: {told}"]
        step = Polygon(ring)
        if not step.is_valid or step.area < _LEAST_STEP_M2:
            return [f"{place}.steps_m[{index}]: its line crosses itself, or encloses nothing"]
    if not 2 <= len(flight.path_m) <= MAX_POINTS:
        return [f"{place}.path_m: {len(flight.path_m)} points, not between 2 and {MAX_POINTS}"]
    for index, ends in enumerate(pairwise(flight.path_m)):
        if math.dist(*ends) < _SAME_POINT_M:
            return [f"{place}.path_m: points {index + 1} and {index + 2} lie on each other"]
    return walk_faults(flight, place)


def _with_areas(document: PlanDocument) -> PlanDocument:
    storeys = [
        storey.model_copy(
            update={
                "rooms": [
                    room.model_copy(
                        update={"area_m2": round(Polygon(room.outline_m, room.holes_m).area, 3)}
                    )
                    for room in storey.rooms
                ]
            }
        )
        for storey in document.storeys
    ]
    return document.model_copy(update={"storeys": storeys})
