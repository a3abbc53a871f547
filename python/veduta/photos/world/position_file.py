"""Positions of photos from a text file, as OpenDroneMap's `geo.txt`: for photos without GPS.

The first line names the CRS, as in a file of control points. Each other line is a photo: its name,
x, y and, where known, z; what follows (angles, accuracies) is not used.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from difflib import get_close_matches
from pathlib import Path

import numpy as np
import pyproj

from veduta.imaging.shot import Position
from veduta.photos.intake.read import PhotoRecord
from veduta.photos.world.control_file import crs_of_head, lines_of
from veduta.photos.world.control_plausible import require_plausible
from veduta.run.errors import InputError

FAR_KM = 1.0
"""No receiver is so far off: then the file, or its CRS, is of another place."""
_LINE = "Write it as: photo x y [z]."
_NAMED = re.compile(
    r"""^(?:"(?P<quoted>[^"]+)"|(?P<name>.+?\.[A-Za-z]{3,4})|(?P<word>\S+))\s+(?P<rest>[-+\d.].*)$"""
)


@dataclass(frozen=True)
class PhotoPositions:
    """by_name: what the file says of each photo, in WGS 84."""

    path: Path
    by_name: Mapping[str, Position]


def read_positions(path: Path) -> PhotoPositions:
    """InputError with the line that is wrong."""
    lines = lines_of(path)
    crs = crs_of_head(path, lines[0][1])
    rows = [(number, *_parts(path, number, line)) for number, line in lines[1:]]
    if not rows:
        raise InputError(path, "has no positions", _LINE)
    places = {name: np.array([*values[:2], 0.0]) for _, name, values in rows}
    require_plausible(path, crs, places)
    to_world = pyproj.Transformer.from_crs(crs, "EPSG:4326", always_xy=True)
    found: dict[str, Position] = {}
    for number, name, values in rows:
        longitude, latitude = to_world.transform(values[0], values[1])
        if not (math.isfinite(longitude) and abs(latitude) <= 90.0 and abs(longitude) <= 180.0):
            fault = f"line {number} lies where {crs} has no place: {values[0]:g} {values[1]:g}"
            raise InputError(path, fault, "Write east before north, longitude before latitude.")
        altitude = values[2] if len(values) > 2 else None
        found[name] = Position(float(latitude), float(longitude), altitude)
    return PhotoPositions(path, found)


def _parts(path: Path, number: int, line: str) -> tuple[str, list[float]]:
    match = _NAMED.match(line.replace("\t", " "))
    try:
        if match is None:
            raise ValueError("no photo and numbers")
        values = [float(word) for word in match["rest"].split()[:3]]
        if len(values) < 2 or not all(map(math.isfinite, values)):
            raise ValueError(f"{len(values)} numbers")
    except ValueError as error:
        fault = f"line {number} is no position of a photo ({error})"
        raise InputError(path, fault, _LINE) from error
    return match["quoted"] or match["name"] or match["word"], values


def _names(photo: PhotoRecord) -> tuple[str, ...]:
    """What a file may call a photo: a view, after the panorama that it was cut out of, too."""
    return (photo.name,) if photo.view is None else (photo.name, photo.view.panorama)


def _position(photo: PhotoRecord, known: Mapping[str, Position]) -> Position | None:
    told = (known.get(name.casefold()) for name in _names(photo))
    return next((one for one in told if one is not None), photo.position)


def at_positions(
    photos: Sequence[PhotoRecord], positions: PhotoPositions
) -> tuple[tuple[PhotoRecord, ...], list[str]]:
    """The photos where the file says, and what is to be told; InputError where none is named.

    Small and capital letters are alike, for systems differ; the file counts more than EXIF.
    """
    by_small = {name.casefold(): name for photo in photos for name in _names(photo)}
    known = {name.casefold(): position for name, position in positions.by_name.items()}
    placed = tuple(replace(photo, position=_position(photo, known)) for photo in photos)
    strange = [name for name in positions.by_name if name.casefold() not in by_small]
    if len(strange) == len(positions.by_name):
        near = get_close_matches(strange[0].casefold(), by_small, n=1)
        hint = f", where {by_small[near[0]]} is" if near else ""
        fault = f"names no photo that is there: {strange[0]}{hint}"
        raise InputError(positions.path, fault, "Correct the names of the photos.")
    told = [f"{positions.path.name}: {name} is not among the photos" for name in strange[:5]]
    named = len(positions.by_name) - len(strange)
    told.append(f"positions of {named} photos are from {positions.path.name}")
    told += _contradicted(photos, placed, positions.path.name)
    return placed, told


def _degrees(position: Position) -> tuple[float, float]:
    return position.longitude_deg, position.latitude_deg


def _contradicted(
    before: Sequence[PhotoRecord], after: Sequence[PhotoRecord], file: str
) -> list[str]:
    """What to say where a file puts photos far from where their EXIF has them."""
    geod = pyproj.Geod(ellps="WGS84")
    away_m = [
        geod.inv(*_degrees(old.position), *_degrees(new.position))[2]
        for old, new in zip(before, after, strict=True)
        if old.position is not None and new.position is not None
    ]
    away_km = float(np.median(away_m)) / 1000.0 if away_m else 0.0
    if away_km < FAR_KM:
        return []
    hint = "check its CRS, and that longitude stands before latitude"
    return [f"{file}: its positions lie {away_km:.0f} km from those in the photos' EXIF; {hint}"]
