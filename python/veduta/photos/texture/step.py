"""The step `texture` of the pipeline: where photos lie in a city model, its faces get textures."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from veduta.photos.city.model import CityModel
from veduta.photos.options import TextureOptions
from veduta.photos.structure import Structure
from veduta.photos.texture.files import write_texture_files
from veduta.photos.texture.recipe import texture_model
from veduta.photos.texture.report import TextureTold, texture_line
from veduta.photos.texture.sources import ReadPhoto, views_of
from veduta.photos.world.georeference import Georeference
from veduta.place.manifest import PlacePart
from veduta.run.page import Picture, Table
from veduta.run.progress import StepProgress


@dataclass(frozen=True)
class Textured:
    """What was made, for the place and the report. folder: where the models of `parts` lie."""

    parts: tuple[PlacePart, ...] = ()
    folder: Path = Path()
    measures: dict[str, Any] = field(default_factory=dict)
    line: str = ""
    tables: tuple[Table, ...] = ()
    pictures: tuple[Picture, ...] = ()


def can_texture(
    world: Georeference | None,
    city: CityModel | None,
    options: TextureOptions,
    *,
    by_gps: bool = False,
) -> bool:
    """Whether there is a model that photos lie in, in its own CRS and about its own origin.

    GPS alone does not say to which facade a photo belongs: it has to be asked for (`--georef gps`).
    """
    if options.no_texture or city is None or world is None or not world.accepted:
        return False
    if world.method == "gps" and not by_gps:
        return False
    return world.crs == city.crs and world.origin_m == city.origin_m


def texture_step(
    structure: Structure,
    read_photo: ReadPhoto,
    city: CityModel,
    options: TextureOptions,
    folder: Path,
    progress: StepProgress,
) -> Textured:
    """Texture the model and write it into the folder; NotFoundError where photos show none of it.

    structure: in metres about the model's origin. read_photo: gives its photos by image id.
    """
    views = views_of(structure, read_photo)
    model = texture_model(views, city, options, progress, folder)
    told = TextureTold(structure.names, model.gains)
    files = write_texture_files(model, folder, progress, told.take)
    measures = told.measures(files.plain)
    return Textured(
        files.parts,
        folder,
        measures,
        texture_line(measures),
        tuple(told.tables()),
        (told.picture(),),
    )
