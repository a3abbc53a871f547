"""`house.city.json`: the house as CityJSON 2.0, its rooms with it.

The Building has the outer shell, with openings shut, as a Solid; a BuildingStorey has its
BuildingRooms, whose Solids are the air within walls, floor and ceiling; BuildingInstallations are
stairs, rails and lamps, BuildingFurniture what stands in rooms. All of it is of level of detail 3,
the finest of 2.0. Where air goes on without a door, a ClosureSurface ends it.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from veduta.formats.cityjson_solids import CityDocument
from veduta.plan.city.air import Cavity, cavities
from veduta.plan.city.marked import Marks, bodies, joined
from veduta.plan.city.matter import matter_of, roofs_of
from veduta.plan.city.surfaces import SurfaceTable, inner_kind, outer_kind
from veduta.plan.city.things import add_furniture, add_lamps, add_stairs, not_closed, storey_id
from veduta.plan.document import Storey
from veduta.plan.furnish.catalogue.read import catalogue_of
from veduta.plan.house.build import House
from veduta.plan.house.party import parties_of
from veduta.plan.house.roof import Roof, roofs_over
from veduta.plan.house.space import UNNAMED
from veduta.plan.options import HouseOptions

TITLE = "House from a floor plan"


def house_cityjson(house: House, options: HouseOptions) -> tuple[bytes, list[str]]:
    """The file's content, in the frame of the part, and what is not in it as it should be."""
    part, spaces = house.part, house.spaces
    marks = Marks()
    matter = matter_of(spaces, options.slab, marks)
    over = roofs_over(spaces[-1].covered, options, parties_of(spaces[-1]))
    roofs, notes = roofs_of(over, spaces[-1], options, marks)
    rooms, filled, airless = cavities(spaces, matter, options.slab, marks)
    notes += airless
    low, high = part.bounds_m
    document = CityDocument(TITLE, np.array(low))
    table = SurfaceTable(part, spaces)
    shells = [
        table.faces(marks.faces(body), outer_kind) for body in bodies(joined([filled, *roofs]))
    ]
    shape = document.solid(shells, table.surfaces(shells))
    told = {**part.attributes, "roofType": _roof_type(over)}
    building = document.add(part.id, "Building", None, told, [shape])
    notes += not_closed(building, shape)
    for space in spaces:
        storey = _add_storey(document, house, space.storey, storey_id(house, space))
        own = [room for room in rooms if room.space is space]
        for room in own:
            notes += _add_room(document, storey, room, table, marks)
    notes += add_stairs(house, document, table, marks)
    add_lamps(house, document)
    add_furniture(house, document, catalogue_of(options.catalogue))
    return document.content(low, high), notes


def _roof_type(roofs: Sequence[Roof]) -> str:
    """As they were built; of several that differ, that of the largest first."""
    kinds = [one.built for one in sorted(roofs, key=lambda one: -one.shape.area)]
    return ", ".join(dict.fromkeys(kinds)) or "none"


def _add_storey(document: CityDocument, house: House, storey: Storey, name: str) -> str:
    told = {
        "name": storey.name,
        "elevation_m": round(storey.elevation_m, 4),
        "height_m": round(storey.height_m, 4),
    }
    return document.add(name, "BuildingStorey", house.part.id, told)


def _add_room(
    document: CityDocument, storey: str, cavity: Cavity, table: SurfaceTable, marks: Marks
) -> list[str]:
    room = cavity.room
    shells = [table.faces(marks.faces(body), inner_kind) for body in cavity.air]
    surfaces = table.surfaces(shells)
    shape = document.solid(shells, surfaces)
    told: dict[str, str | float] = {
        "area_m2": round(float(cavity.region.area), 2),
        "volume_m3": round(sum(body.volume() for body in cavity.air), 2),
        "provenance": room.origin if room else "inferred",
    }
    if room is not None:
        told |= {"name": room.name or room.use, "function": room.use}
    own = f"{storey}/{room.id if room else UNNAMED}"
    name = document.add(own, "BuildingRoom", storey, told, [shape])
    return not_closed(name, shape)
