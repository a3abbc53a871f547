"""The files of a house that do not depend on its tour: drawings, IFC and CityJSON."""

from __future__ import annotations

from dataclasses import dataclass

from veduta.plan.drawing import draw
from veduta.plan.house.build import House
from veduta.plan.options import HouseOptions
from veduta.plan.outputs.cityjson import house_cityjson
from veduta.plan.outputs.dxf import plan_dxf
from veduta.plan.outputs.ifc import house_ifc
from veduta.plan.outputs.svg import plan_svg
from veduta.plan.surroundings.site import Site

CITY_MODEL = "house.city.json"


@dataclass(frozen=True)
class Building:
    """A house, how it was built, and where it stands."""

    house: House
    options: HouseOptions
    site: Site


@dataclass(frozen=True)
class BuildingFiles:
    """The content of files by their names; notes: what is not in them as it should be."""

    contents: dict[str, bytes]
    notes: list[str]


def building_files(building: Building) -> BuildingFiles:
    """Nothing is written; a second process may do it while the tour is sought."""
    house, options = building.house, building.options
    drawings = [draw(space) for space in house.spaces]
    city, notes = house_cityjson(house, options)
    contents = {
        "plan.svg": plan_svg(drawings),
        "plan.dxf": plan_dxf(drawings),
        "house.ifc": house_ifc(house, options, building.site),
        CITY_MODEL: city,
    }
    return BuildingFiles(contents, notes)
