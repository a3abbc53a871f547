"""The house of a plan document, as one part: storey by storey, then the roof."""

from __future__ import annotations

from dataclasses import dataclass

from veduta.place.builder import PartBuilder
from veduta.place.part import Part
from veduta.plan.document import PlanDocument
from veduta.plan.furnish.catalogue.read import catalogue_of
from veduta.plan.house.contact_shadows import add_contact_shadows
from veduta.plan.house.doors import add_door
from veduta.plan.house.flights import Stairwell, storey_spaces
from veduta.plan.house.floors import (
    FINISH_M,
    add_ceilings,
    add_floors,
    add_skirting,
    add_slab,
    slab_over,
)
from veduta.plan.house.frame import Sculptor
from veduta.plan.house.furniture import Furnishing
from veduta.plan.house.ground_level import ground_storey
from veduta.plan.house.looks import Looks
from veduta.plan.house.party import court_notes, parties_of
from veduta.plan.house.roof import add_roof
from veduta.plan.house.room_looks import TilePictures, room_looks
from veduta.plan.house.sound import sound_part
from veduta.plan.house.space import Space
from veduta.plan.house.stairs import add_stairs
from veduta.plan.house.walls import add_walls
from veduta.plan.house.windows import add_window
from veduta.plan.lights.bodies import add_lamps
from veduta.plan.options import HouseOptions

GROUND_SLAB_M = 0.2
PART = "house"


@dataclass(frozen=True)
class House:
    """The part, and the regions of its storeys that it was made of."""

    part: Part
    spaces: tuple[Space, ...]
    """From the lowest storey up."""

    @property
    def ground(self) -> int:
        """The row of the storey at the level of the ground around the house."""
        return ground_storey([space.storey for space in self.spaces])


def build_house(
    document: PlanDocument, options: HouseOptions, pictures: TilePictures | None = None
) -> House:
    """The house; the notes of the part say what was left out or is otherwise than asked.

    pictures: of tiles that photos of rooms show.
    """
    builder = PartBuilder(PART)
    sculptor = Sculptor(builder, Looks(builder, room_looks(document, pictures or {})))
    furnishing = Furnishing(
        builder, catalogue_of(options.catalogue), coarse=options.furniture_detail == "coarse"
    )
    storeys = sorted(document.storeys, key=lambda storey: storey.elevation_m)
    spaces, wells = storey_spaces(storeys, options.slab)
    for index, (space, well) in enumerate(zip(spaces, wells, strict=True)):
        above = spaces[index + 1] if index + 1 < len(spaces) else None
        _add_storey(space, above, well, sculptor, options)
        furnishing.add(space.storey)
        add_contact_shadows(space, furnishing.catalogue, sculptor)
        builder.notes.extend([*space.notes, *well.notes])
    first, last = spaces[0], spaces[-1]
    base = first.storey.elevation_m
    add_slab(first.slab, base - GROUND_SLAB_M, base, "ground slab", sculptor)
    top = last.storey.elevation_m + last.storey.height_m
    builder.notes.extend(court_notes(last))
    builder.notes.extend(add_roof(last.covered, top, sculptor, options, parties_of(last)))
    below = ground_storey(storeys)
    builder.attributes["storeysAboveGround"] = len(spaces) - below
    if below:
        builder.attributes["storeysBelowGround"] = below
    return House(furnishing.onto(sound_part(builder.build())), spaces)


def _add_storey(
    space: Space,
    above: Space | None,
    well: Stairwell,
    sculptor: Sculptor,
    options: HouseOptions,
) -> None:
    """Walls, what fills their openings, floors, ceilings, stairs, and the slab over them."""
    storey = space.storey
    height = storey.height_m - options.slab
    add_walls(space, height, sculptor)
    for hole in space.holes:
        if hole.opening.kind == "window":
            add_window(hole, space, sculptor, options.window_frames)
        else:
            add_door(hole, space, sculptor, options)
    add_floors(space, sculptor)
    add_ceilings(space, height, well.opening, sculptor)
    add_skirting(space, sculptor)
    add_lamps(storey, height - FINISH_M, sculptor)
    if above is not None:
        add_stairs(well, space, above, sculptor)
    top = storey.elevation_m + storey.height_m
    add_slab(slab_over(space, above), top - options.slab, top, f"{storey.name} slab", sculptor)
