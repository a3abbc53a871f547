"""All files of a plan but its report."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from veduta.formats.gltf import write_glb
from veduta.formats.place_json import write_place
from veduta.imaging.encode import png_bytes
from veduta.place.manifest import Place
from veduta.place.part import Part
from veduta.plan.building_files import CITY_MODEL, BuildingFiles
from veduta.plan.document import PlanDocument
from veduta.plan.drawing import Drawing, draw
from veduta.plan.house.build import House
from veduta.plan.house.placing import place_of, raised_m
from veduta.plan.house.room_looks import TilePictures
from veduta.plan.load import DOCUMENT
from veduta.plan.options import HouseOptions
from veduta.plan.outputs.overlay import overlay
from veduta.plan.outputs.tiles import write_tiles
from veduta.plan.outputs.tour_picture import tour_picture
from veduta.plan.outputs.x3d import house_x3d
from veduta.plan.photos.finish import Finished
from veduta.plan.photos.look import Look
from veduta.plan.sheets import sheet_name
from veduta.plan.surroundings.backdrop import PANORAMA, backdrop_part, build_backdrop
from veduta.plan.surroundings.build import build_surroundings, with_surroundings
from veduta.plan.surroundings.daylight import daylight_of, sunlight_of
from veduta.plan.surroundings.panorama import Pictures
from veduta.plan.surroundings.site import Site
from veduta.plan.surroundings.sky_picture import sky_picture
from veduta.plan.surroundings.terrain import terrain_of
from veduta.plan.surroundings.turning import turned_north
from veduta.plan.tour.find import Tour
from veduta.plan.tour.placing import placed_tour

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
    result: Result, building: BuildingFiles, folder: Path, options: HouseOptions
) -> list[str]:
    """Write the document, the drawings, the model and the place; what is not as it should be."""
    text = result.document.model_dump_json(by_alias=True, indent=1) + "\n"
    (folder / DOCUMENT).write_text(text, encoding="utf-8")
    for index, pixels in enumerate(result.sheets):
        (folder / sheet_name(index)).write_bytes(png_bytes(pixels, compress_level=3))
    for name, pixels in result.tiles.items():
        (folder / name).write_bytes(png_bytes(pixels))
    (folder / "overlay.png").write_bytes(png_bytes(result.overlay, compress_level=3))
    if result.tour_picture is not None:
        (folder / TOUR_PICTURE).write_bytes(png_bytes(result.tour_picture, compress_level=3))
    for name, content in building.contents.items():
        (folder / name).write_bytes(content)
    place = _write_place(result, folder, options)
    write_tiles(result.house, np.array(place.parts[0].transform).reshape(4, 4).T, folder)
    return building.notes


def _write_place(result: Result, folder: Path, options: HouseOptions) -> Place:
    """The models and the place: the house, what lies around it, and its tour."""
    tour = result.tour
    sun = sunlight_of(result.site)
    write_glb(result.house.part, folder / MODEL, [] if tour is None else [tour.path], sun)
    tours = [] if tour is None else [placed_tour(tour, raised_m(result.house, options))]
    place = place_of(result.house, MODEL, DOCUMENT, options, tours, CITY_MODEL)
    around: list[Part] = []
    if options.surroundings != "none":
        surroundings = build_surroundings(result.house.spaces[result.house.ground], options)
        around = [surroundings.ground, *([surroundings.garden] if surroundings.garden else [])]
        models = {part.id: f"{part.id}.glb" for part in around}
        for part in around:
            write_glb(part, folder / models[part.id])
        place = with_surroundings(place, surroundings, models)
    backdrop = _backdrop(result, options)
    if result.panorama is not None and backdrop is not None:
        for name, content in result.panorama.files.items():
            (folder / name).write_bytes(content)
        write_glb(backdrop, folder / BACKDROP)
        place = place.model_copy(
            update={"parts": [*place.parts, backdrop_part(backdrop, BACKDROP)]}
        )
    x3d = house_x3d(
        result.house, options, place.start, tours=tours, others=around,
        site=result.site, backdrop=backdrop,
    )  # fmt: skip
    (folder / "house.x3d").write_bytes(x3d)
    place = place.model_copy(update={"sun": result.site.for_place()})
    place = turned_north(place, result.site.turn_deg)
    write_place(place, folder / "place.json")
    return place


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
