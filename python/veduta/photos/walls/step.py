"""The steps of the walls in the recipe: set upright, found, pictured, written."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from veduta.imaging.encode import png_bytes
from veduta.imaging.segments import Segments, detect_segments
from veduta.photos.cameras.component import Component
from veduta.photos.cameras.upright import upright
from veduta.photos.cameras.vertical_edges import SegmentsOf, edge_normals
from veduta.photos.options import WallOptions
from veduta.photos.structure import Structure
from veduta.photos.walls.document import Unit, picture_file, walls_document
from veduta.photos.walls.find_walls import relief_depth
from veduta.photos.walls.part import DOCUMENT, walls_part
from veduta.photos.walls.pictures import ReadPhoto, WallPicture, wall_pictures
from veduta.photos.walls.wall import Wall
from veduta.place.part import Part
from veduta.run.atomic import write_bytes
from veduta.run.progress import StepProgress, no_progress


@dataclass(frozen=True)
class FoundWalls:
    """The walls of a structure and their pictures, in the same order."""

    walls: tuple[Wall, ...]
    pictures: tuple[WallPicture, ...]


def segments_by_photo(read_photo: ReadPhoto) -> Callable[[Structure], SegmentsOf]:
    """The edges of each photo, looked for once; `read_photo` by image id."""
    known: dict[int, Segments] = {}

    def of(image: int) -> Segments:
        if image not in known:
            known[image] = detect_segments(read_photo(image))
        return known[image]

    return lambda structure: lambda row: of(structure.image_ids[row])


def photo_reader(structure: Structure, read_photo: ReadPhoto) -> ReadPhoto:
    """Reads a photo by its row in the structure; `read_photo` by image id."""
    return lambda row: read_photo(structure.image_ids[row])


def set_upright(component: Component, edges: Callable[[Structure], SegmentsOf]) -> Component:
    """The component turned so that its walls and vertical edges stand upright."""
    structure = component.structure
    z = np.array([0.0, 0.0, 1.0])
    turned, found = upright(structure, edge_normals(structure, z, edges(structure)))
    return replace(component, structure=turned, upright=found)


def picture_walls(
    structure: Structure,
    walls: tuple[Wall, ...],
    read_photo: ReadPhoto,
    options: WallOptions,
    progress: StepProgress = no_progress,
) -> FoundWalls:
    """The walls with their pictures, from the photos that `read_photo` gives by image id."""
    if not walls:
        return FoundWalls((), ())
    pictures = wall_pictures(
        structure,
        walls,
        photo_reader(structure, read_photo),
        options.wall_side_px,
        relief_depth(structure),
        progress,
    )
    return FoundWalls(walls, pictures)


def write_walls(
    found: FoundWalls, structure: Structure, unit: Unit, out: Path, walls: Path
) -> Part | None:
    """Write `walls.json` into `out` and pictures into `walls`; the part of the place.

    `walls` is published as the folder of that name beside `walls.json`.
    """
    document = walls_document(found.walls, found.pictures, structure, unit)
    write_bytes(out / DOCUMENT, (document.model_dump_json(by_alias=True, indent=2) + "\n").encode())
    for picture in found.pictures:
        write_bytes(walls / Path(picture_file(picture.grid.wall)).name, png_bytes(picture.pixels))
    return walls_part(found.pictures)
