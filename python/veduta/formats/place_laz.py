"""The points of a place as LAZ: all its clouds in one file, in the place's own CRS."""

from __future__ import annotations

from pathlib import Path

from veduta.formats.laz import write_laz
from veduta.formats.place_points import points_of
from veduta.place.place import Place
from veduta.run.atomic import atomic_write
from veduta.run.errors import InputError


def write_place_laz(place: Place, path: Path) -> None:
    """Write the points; InputError where the place has none."""
    found = points_of(place)
    if found is None:
        raise InputError(path, "the place has no points", "Choose a format for surfaces.")
    east, north, up = place.origin_m
    with atomic_write(path) as temporary:
        write_laz(
            found.points_m, found.colours, temporary, crs=place.crs, origin_m=(east, north, up),
            classes=found.classes,
        )  # fmt: skip
