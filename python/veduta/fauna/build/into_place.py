"""The animal in a place that is there already: its parts, and the files that they name."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from veduta.fauna.build.going import Goer, first_view
from veduta.fauna.document.load import DOCUMENT
from veduta.place.manifest import PlaceAnimal
from veduta.place.place import Place
from veduta.run.errors import InputError


def require_place(place: Place, folder: Path) -> None:
    """InputError for a place whose parts are streamed: they are too many to be written again."""
    if place.tileset is not None:
        fault = "is streamed as 3D Tiles, in which no animal can be put"
        raise InputError(folder, fault, "Name a smaller place.")


def place_into(place: Place, goer: Goer, goes: PlaceAnimal) -> Place:
    """The place with the animal in it; its document lies where the place will be saved.

    One animal of the same id is replaced: the same record twice is one animal.
    """
    place.parts.pop(goer.mesh.id, None)
    place.animals = [one for one in place.animals if one.id != goer.name]
    standing = goer.standing()
    alone = Place()
    alone.add(goer.mesh, standing)
    place = alone.with_names_apart(place)  # another animal's document has the same name
    place.files.pop(DOCUMENT, None)  # the animal's own lies where the place is saved
    place.add(goer.mesh, standing)
    place.animals.append(goes)
    place.start = first_view(np.array(goes.path), goer.length_m)
    return place

