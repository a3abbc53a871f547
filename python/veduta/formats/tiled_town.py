"""A town that lies in tiles, as a place of buildings: from the city model that was written with it.

Tiles hold many buildings each, compressed, for the eye. What a building is says the CityJSON beside
them: its surfaces, their classes, colours and pictures.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from veduta.formats.city_place import read_city_place
from veduta.formats.cityjson_read import SEQUENCES
from veduta.place.place import Place
from veduta.run.errors import InputError

REMEDY = "Derive it with its CityJSON (without --no-city), or with --separate, and export that."


def untiled(place: Place) -> Place:
    """The same place with its buildings as parts; itself where its parts are no tiles.

    InputError where they are, and no city model lies beside them.
    """
    if place.tileset is None or not _is_tiled(place):
        return place
    path = None if place.folder is None else _city_model(place.folder)
    if path is None:
        raise InputError(
            place.folder or place.tileset,
            "is a town in tiles, whose buildings are not files of their own, without a city model",
            REMEDY,
        )
    town = read_city_place(path)
    parts = {}
    for placed in town.parts.values():
        transform = placed.standing.transform.copy()
        for axis in range(3):
            transform[axis, 3] += town.origin_m[axis] - place.origin_m[axis]
        parts[placed.id] = replace(placed, standing=replace(placed.standing, transform=transform))
    return replace(place, parts=parts, tileset=None, notes=[*place.notes, *town.notes])


def _is_tiled(place: Place) -> bool:
    """Whether the first part cannot be read as one: all are alike."""
    first = next(iter(place.parts.values()), None)
    if first is None:
        return False
    try:
        first.passing()
    except InputError:
        return True
    return False


def _city_model(folder: Path) -> Path | None:
    """The CityJSON or CityJSONSeq in the folder of a place."""
    names = (".city.json", *(f".city{end}" for end in SEQUENCES))
    found = sorted(one for one in folder.iterdir() if one.name.endswith(names) and one.is_file())
    return found[0] if found else None
