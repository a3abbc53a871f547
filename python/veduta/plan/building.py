"""What files of a house are made from in a second process; what makes them is `building_files`."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from veduta.place.manifest import Start, Tour
from veduta.place.part import Part
from veduta.plan.house.build import House
from veduta.plan.options import HouseOptions
from veduta.plan.surroundings.site import Site
from veduta.run.worker import Named

CITY_MODEL = "house.city.json"
SCENE = "house.x3d"


@dataclass(frozen=True)
class Building:
    """A house, how it was built, and where it stands: drawings, IFC and CityJSON show no more."""

    house: House
    options: HouseOptions
    site: Site


@dataclass(frozen=True)
class Visit:
    """What there is to walk through and to look at, in X3D.

    start: where the visitor begins. others: what stands around the house. backdrop: a picture
    around all of it. All in the frame of the place.
    """

    building: Building
    start: Start
    tours: Sequence[Tour]
    others: Sequence[Part]
    backdrop: Part | None


@dataclass(frozen=True)
class BuildingFiles:
    """The content of files by their names; notes: what is not in them as it should be."""

    contents: dict[str, bytes]
    notes: list[str]


FILES_OF = Named[Building | Visit, BuildingFiles]("veduta.plan.building_files", "files_of")
"""By its name: the first process does not import what writes DXF and IFC."""
