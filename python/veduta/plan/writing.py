"""All files of a plan but its report."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import chain
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from veduta.imaging.encode import png_bytes
from veduta.place.part import Part
from veduta.place.place import UNMOVED, ModelFile, Place, Standing
from veduta.plan.building import CITY_MODEL, Building, BuildingFiles, Visit
from veduta.plan.document import PlanDocument
from veduta.plan.drawing import Drawing, draw
from veduta.plan.house.build import House
from veduta.plan.house.neighbours import build_neighbours
from veduta.plan.house.placing import place_of, raised_m, visitor_start
from veduta.plan.house.room_looks import TilePictures
from veduta.plan.load import DOCUMENT
from veduta.plan.options import HouseOptions
from veduta.plan.outputs.overlay import overlay
from veduta.plan.outputs.tiles import write_tiles
from veduta.plan.outputs.tour_picture import tour_picture
from veduta.plan.photos.finish import Finished
from veduta.plan.photos.look import Look
from veduta.plan.sheets import sheet_name
from veduta.plan.surroundings.backdrop import PANORAMA, add_backdrop, build_backdrop
from veduta.plan.surroundings.build import Surroundings, add_surroundings, build_surroundings
from veduta.plan.surroundings.daylight import daylight_of, sunlight_of
from veduta.plan.surroundings.panorama import Pictures
from veduta.plan.surroundings.site import Site
from veduta.plan.surroundings.sky_picture import sky_picture
from veduta.plan.surroundings.terrain import terrain_of
from veduta.plan.surroundings.turning import turned_north
from veduta.plan.tour.find import Tour
from veduta.plan.tour.placing import placed_tour
from veduta.run.beside import Beside

MODEL = "house.glb"
BACKDROP = f"{PANORAMA}.glb"
TOUR_PICTURE = "tour.png"


@dataclass(frozen=True)
class Result:
    """What was made: sheets are the cleaned drawings, overlay the picture that shows all.

    drawings: of the storeys from the lowest up. tour_picture: the plan with the tour; None without.
    tiles: their pictures, by name. looks: what was seen in photos of rooms. panorama: the pictures
    of what is seen around the house; None without. site: where it stands.
    """

    document: PlanDocument
    house: House
    tour: Tour | None
    sheets: Sequence[NDArray[np.uint8]]
    drawings: Sequence[Drawing]
    overlay: NDArray[np.uint8]
    tour_picture: NDArray[np.uint8] | None
    tiles: TilePictures
    looks: Sequence[Look]
    panorama: Pictures | None
    site: Site


def result_of(
    document: PlanDocument,
    house: House,
    tour: Tour | None,
    sheets: Sequence[NDArray[np.uint8]],
    finished: Finished,
    panorama: Pictures | None,
    site: Site,
) -> Result:
    """With the pictures drawn; sheets in the order of the document's storeys."""
    drawings = [draw(space) for space in house.spaces]
    by_name = {one.storey.name: one for one in drawings}
    ordered = [by_name[storey.name] for storey in document.storeys]
    shown = None if tour is None else tour_picture(ordered, tour)
    return Result(
        document, house, tour, sheets, drawings, overlay(ordered, sheets), shown,
        finished.pictures, finished.looks, panorama, site,
    )  # fmt: skip


def write_result(
    result: Result,
    beside: Beside[Building | Visit, BuildingFiles],
    folder: Path,
    options: HouseOptions,
) -> list[str]:
    """Write the document, the drawings, the model and the place; what is not as it should be.

    beside: was given the building; the scene is made by it, while the models are written.
    """
    around, backdrop = _surroundings(result, options), _backdrop(result, options)
    up_m = raised_m(result.house, options)
    tours = [] if result.tour is None else [placed_tour(result.tour, up_m)]
    paths = () if result.tour is None else (result.tour.path,)
    house, sun = result.house, sunlight_of(result.site)
    place = place_of(house, MODEL, DOCUMENT, options, tours, CITY_MODEL, paths, sun)
    whole = Building(house, options, result.site)
    made = [beside.take()]
    others = [] if around is None else around.parts
    beside_it = build_neighbours(house, options, up_m) if options.neighbours else None
    others += [] if beside_it is None else [beside_it]
    beside.give(Visit(whole, visitor_start(house), tours, others, backdrop))
    _write_sheets(result, folder)
    if beside_it is not None:
        standing = Standing("Neighbours", UNMOVED, arrangement="invented")
        place.add(beside_it, standing, ModelFile(f"{beside_it.id}.glb"))
    place = _whole_place(result, place, around, backdrop)
    place.save(folder)
    write_tiles(house, place.parts[house.part.id].standing.transform, folder)
    made.append(beside.take())
    for name, content in chain.from_iterable(one.contents.items() for one in made):
        (folder / name).write_bytes(content)
    return [note for one in made for note in one.notes]


def _whole_place(
    result: Result, place: Place, around: Surroundings | None, backdrop: Part | None
) -> Place:
    """The place with what lies around the house, and turned by the compass."""
    if around is not None:
        add_surroundings(place, around)
    if backdrop is not None:
        add_backdrop(place, backdrop, BACKDROP)
    place.sun = result.site.for_place()
    return turned_north(place, result.site.turn_deg)


def _write_sheets(result: Result, folder: Path) -> None:
    """The document, and all pictures."""
    for name, content in ({} if result.panorama is None else result.panorama.files).items():
        (folder / name).write_bytes(content)
    text = result.document.model_dump_json(by_alias=True, indent=1) + "\n"
    (folder / DOCUMENT).write_text(text, encoding="utf-8")
    for index, pixels in enumerate(result.sheets):
        (folder / sheet_name(index)).write_bytes(png_bytes(pixels, compress_level=3))
    for name, pixels in result.tiles.items():
        (folder / name).write_bytes(png_bytes(pixels))
    (folder / "overlay.png").write_bytes(png_bytes(result.overlay, compress_level=3))
    if result.tour_picture is not None:
        (folder / TOUR_PICTURE).write_bytes(png_bytes(result.tour_picture, compress_level=3))


def _surroundings(result: Result, options: HouseOptions) -> Surroundings | None:
    if options.surroundings == "none":
        return None
    return build_surroundings(result.house.spaces[result.house.ground], options)


def _backdrop(result: Result, options: HouseOptions) -> Part | None:
    """The panorama around the garden, by the light of the sun; None without pictures."""
    if result.panorama is None:
        return None
    garden = options.surroundings != "none"
    slope_deg = options.ground_slope if garden else 0.0
    terrain = terrain_of(result.house.spaces[result.house.ground], slope_deg)
    shown = daylight_of(result.site.sun).shown
    sky = sky_picture(result.panorama)
    return build_backdrop(sky, terrain, result.site.turn_deg, shown, garden=garden)
