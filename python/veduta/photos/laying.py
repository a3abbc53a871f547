"""Each component set upright, with its walls, laid into the world where something says where."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from veduta.photos.cameras.component import Component, component_name
from veduta.photos.cameras.vertical_edges import SegmentsOf
from veduta.photos.city.facades import facades_of
from veduta.photos.city.lifted import lifted
from veduta.photos.decoded import DecodedPhotos
from veduta.photos.intake.read import PhotoRecord
from veduta.photos.options import PhotosOptions
from veduta.photos.structure import Structure, without_parallel
from veduta.photos.walls.find_walls import find_walls
from veduta.photos.walls.level_edges import turned_to_edges
from veduta.photos.walls.step import segments_by_photo, set_upright
from veduta.photos.walls.wall import Wall
from veduta.photos.world.gauss_newton import UP_SD_RAD
from veduta.photos.world.georeference import Georeference, Similarity
from veduta.photos.world.georeferencing import (
    Georeferenced,
    References,
    georeference,
    in_the_world,
)
from veduta.photos.world.ground import ground_height
from veduta.photos.world.pictures import georef_pictures, model_beside
from veduta.photos.world.which_way_up import looks_down, which_way_up
from veduta.run.page import Picture
from veduta.run.progress import StepProgress
from veduta.run.report import StepRecord, timed_step


@dataclass(frozen=True)
class Laid:
    """A component and its walls, in metres of the world where `georef` has something believed.

    pictures: plans of what was tried, for the report.
    """

    component: Component
    walls: tuple[Wall, ...]
    georef: Georeferenced
    pictures: tuple[Picture, ...] = ()


def lay_components(
    components: Sequence[Component],
    references: References,
    photos: Sequence[PhotoRecord],
    options: PhotosOptions,
    steps: list[StepRecord],
    progress: StepProgress,
) -> list[Laid]:
    """Walls of the first component, and of all where a city model is given; then the world."""
    with timed_step(steps, "walls") as step:
        upright, walls = [], []
        edges = segments_by_photo(DecodedPhotos(photos))
        for number, component in enumerate(components):
            progress("walls", number / len(components))
            near = replace(component, structure=without_parallel(component.structure))
            if lost := len(component.structure.points) - len(near.structure.points):
                name = component_name(number)
                told = f"component {name}: {lost} points whose distance nobody knows"
                step.rejected.append(told)
            upright.append(_upright(near, photos, edges))
            wanted = number == 0 or references.model is not None
            walls.append(_walls(upright[-1].structure, options, edges) if wanted else ())
        step.counts["walls"] = sum(map(len, walls))
    with timed_step(steps, "georeference") as step:
        laid = [
            _laid(component, own, references, photos, options)
            for component, own in zip(upright, walls, strict=True)
        ]
        for number, one in enumerate(laid):
            step.rejected.extend(
                f"component {component_name(number)}, {tried.method}: {tried.why}"
                for tried in one.georef.tried
                if not tried.accepted
            )
        step.counts["in the world"] = sum(one.georef.accepted is not None for one in laid)
    return laid


def _upright(
    component: Component,
    photos: Sequence[PhotoRecord],
    edges: Callable[[Structure], SegmentsOf],
) -> Component:
    component = which_way_up(component, photos)
    if looks_down(component.structure):
        return component
    return set_upright(component, edges)


def _walls(
    structure: Structure, options: PhotosOptions, edges: Callable[[Structure], SegmentsOf]
) -> tuple[Wall, ...]:
    if options.walls.no_walls:
        return ()
    found = find_walls(structure, options.walls, options.random.seed)
    return turned_to_edges(found, structure, edges(structure))


def _laid(
    component: Component,
    walls: tuple[Wall, ...],
    references: References,
    photos: Sequence[PhotoRecord],
    options: PhotosOptions,
) -> Laid:
    structure = component.structure
    method, seed = options.world.georef, options.random.seed
    upright = component.upright
    up_sd_rad = UP_SD_RAD if upright is None else upright.whole_sd_rad
    found = georeference(structure, walls, photos, references, method, seed, up_sd_rad)
    pictures: list[Picture] = []
    for tried in found.tried:
        known = references.model
        model = known if tried.method == "model" else model_beside(tried, known)
        pictures += georef_pictures(structure, walls, tried, model)
    moved = replace(component, structure=in_the_world(structure, found.accepted))
    return Laid(moved, walls_in_the_world(walls, found.accepted), found, tuple(pictures))


def on_the_ground(laid: Sequence[Laid], references: References) -> tuple[References, str]:
    """A model without heights set onto the ground where control points say how high that lies.

    By the model itself and by GPS the photos are laid onto its feet instead.
    """
    accepted = laid[0].georef.accepted
    model = references.model
    if accepted is None or accepted.method != "gcp" or model is None:
        return references, ""
    ground = ground_height(laid[0].component.structure)
    city, note = lifted(model, facades_of(model), ground)
    return replace(references, model=city), note


def walls_in_the_world(walls: tuple[Wall, ...], found: Georeference | None) -> tuple[Wall, ...]:
    """The walls in metres about the origin; as they are where nothing is believed."""
    if found is None or found.best is None or not found.accepted:
        return walls
    return tuple(_moved(wall, found.best.world_from_model) for wall in walls)


def _moved(wall: Wall, world: Similarity) -> Wall:
    """The wall upright in the world through the middle of its height: it may have leant a bit."""
    middle = 0.5 * (wall.bottom + wall.top)
    ends: NDArray[np.float64] = np.array([[*wall.start, middle], [*wall.end, middle]])
    start, end = world.moved(ends)
    height, half = float(0.5 * (start[2] + end[2])), 0.5 * world.scale * wall.height
    return replace(
        wall,
        start=start[:2],
        end=end[:2],
        bottom=height - half,
        top=height + half,
        rms=world.scale * wall.rms,
    )
