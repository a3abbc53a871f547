"""The animal in a place that is there already: its parts, and the files that they name."""

from __future__ import annotations

import shutil
from pathlib import Path

import numpy as np

from veduta.fauna.build.build import Built, going
from veduta.fauna.document.load import DOCUMENT
from veduta.fauna.document.schema import Animal
from veduta.fauna.motion.angles import Floats
from veduta.place.manifest import Start
from veduta.place.place import Place, Standing
from veduta.run.errors import InputError


def require_place(place: Place, folder: Path) -> None:
    """InputError for a place whose parts are streamed: they are too many to be written again."""
    if place.tileset is not None:
        fault = "is streamed as 3D Tiles, in which no animal can be put"
        raise InputError(folder, fault, "Name a smaller place.")


def place_into(
    place: Place, animal: Animal, built: Built, path: Floats, target: Path, *, closed: bool
) -> Place:
    """The place with the animal in it; the files that its parts and cameras name go to `target`.

    One animal of the same id is replaced: the same record twice is one animal.
    """
    place.parts.pop(built.mesh.id, None)
    place.animals = [one for one in place.animals if one.id != animal.name]
    _bring_files(place, target)
    standing = Standing(name=animal.name, document=DOCUMENT, arrangement="invented")
    place.add(built.mesh, standing)
    place.animals.append(going(animal, built, path, closed=closed))
    low, high = path.min(axis=0), path.max(axis=0)
    size = max(float(np.linalg.norm(high - low)), 4.0 * animal.length.metres)
    middle = 0.5 * (low + high)
    eye = middle + size * np.array([-0.3, -0.75, 0.45])
    place.start = Start(
        eye=(float(eye[0]), float(eye[1]), float(eye[2])),
        target=(float(middle[0]), float(middle[1]), float(middle[2])),
    )
    return place


def _bring_files(place: Place, target: Path) -> None:
    if place.folder is None:
        return
    names = {camera.picture for camera in place.cameras}
    for placed in place.parts.values():
        standing = placed.standing
        names |= {
            name
            for name in (standing.document, standing.photo, standing.city_model)
            if name is not None
        }
    for name in sorted(names - {DOCUMENT}):
        source = place.folder / name
        if source.is_file():
            (target / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(source, target / name)
