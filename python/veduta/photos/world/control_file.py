"""Ground control points from a text file, as OpenDroneMap has it.

The first line names the CRS: `EPSG:32632`, `WGS84 UTM 32N`, `WGS84`, or a PROJ string; what follows
a # there is a remark. Each other line is an observation: x y z px py photo [name]. Lines that begin
with # are remarks. Pixels are of the upright photo, x right and y down.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from veduta.geometry.crs import epsg_named
from veduta.photos.city.crs import metres_of
from veduta.photos.world.control_plausible import require_plausible
from veduta.photos.world.control_words import control_words
from veduta.run.errors import InputError
from veduta.run.inputs import require_file

LARGEST_BYTES = 16 * 2**20
_LINE = "Write it as: x y z px py photo [name]."
_HEAD = "Write the CRS into the first line, such as EPSG:32632 or WGS84 UTM 32N."


@dataclass(frozen=True)
class ControlPoint:
    """A point that was surveyed. place_m: (3,) in the file's metres. seen: photo and (px, py)."""

    name: str
    place_m: NDArray[np.float64]
    seen: tuple[tuple[str, tuple[float, float]], ...]


@dataclass(frozen=True)
class ControlPoints:
    """The points of a file. crs: of their metres. lines: those that name each photo.

    exchanged: the same with the two level coordinates the other way round, where that is a place.
    """

    path: Path
    crs: str
    points: tuple[ControlPoint, ...]
    notes: tuple[str, ...] = ()
    lines: Mapping[str, tuple[int, ...]] = field(default_factory=dict)
    exchanged: ControlPoints | None = None


def read_control(path: Path) -> ControlPoints:
    """The points, in the order of the file; InputError with the line that is wrong."""
    lines = lines_of(path)
    crs = crs_of_head(path, lines[0][1])
    places: dict[str, NDArray[np.float64]] = {}
    seen: dict[str, list[tuple[str, tuple[float, float]]]] = {}
    naming: dict[str, tuple[int, ...]] = {}
    for number, line in lines[1:]:
        try:
            numbers, photo, named = control_words(line)
            x, y, z, across, down = (float(word) for word in numbers)
        except ValueError as error:
            raise InputError(path, f"line {number} is no control point ({error})", _LINE) from error
        place = np.array([x, y, z])
        if not np.isfinite([x, y, z, across, down]).all():
            raise InputError(path, f"line {number} has a number that is not finite", _LINE)
        name = named[:100] or f"{x:.12g} {y:.12g} {z:.12g}"
        known = places.setdefault(name, place)
        if not np.array_equal(known, place):
            fault = f"line {number} has the point {name!r} at another place than before"
            raise InputError(path, fault, "Give each point one place, or names of their own.")
        seen.setdefault(name, []).append((photo, (across, down)))
        naming[photo] = (*naming.get(photo, ()), number)
    if not places:
        raise InputError(path, "has no control points", _LINE)
    require_plausible(path, crs, places)
    metres = metres_of(path, crs, np.array(list(places.values())))
    points = tuple(
        ControlPoint(name, metres.of(place[None])[0], tuple(seen[name]))
        for name, place in places.items()
    )
    found = ControlPoints(path, metres.crs, points, metres.notes, naming)
    return replace(found, exchanged=_exchanged(found, crs, places))


def lines_of(path: Path) -> list[tuple[int, str]]:
    """Lines with their numbers, without remarks and empty ones; InputError where none is left."""
    lines = [
        (number, line.strip())
        for number, line in enumerate(_text(path).splitlines(), start=1)
        if line.strip() and not line.lstrip().startswith("#")
    ]
    if not lines:
        raise InputError(path, "is empty", _HEAD)
    return lines


def _exchanged(
    found: ControlPoints, crs: str, places: Mapping[str, NDArray[np.float64]]
) -> ControlPoints | None:
    """The points with north before east, or latitude before longitude; None where none can be."""
    other = {name: place[[1, 0, 2]] for name, place in places.items()}
    try:
        require_plausible(found.path, crs, other)
        metres = metres_of(found.path, crs, np.array(list(other.values())))
    except InputError:
        return None
    points = tuple(
        replace(point, place_m=metres.of(other[point.name][None])[0]) for point in found.points
    )
    if not all(np.isfinite(point.place_m).all() for point in points):
        return None
    return replace(found, crs=metres.crs, points=points, notes=metres.notes)


def _text(path: Path) -> str:
    try:
        require_file(path, LARGEST_BYTES)
        return path.read_text(encoding="utf-8-sig")
    except OSError as error:
        fault = f"cannot be read ({error.strerror})"
        raise InputError(path, fault, "Check its name and its permissions.") from error
    except UnicodeDecodeError as error:
        raise InputError(path, "is no text in UTF-8", "Save it as text.") from error


def crs_of_head(path: Path, line: str) -> str:
    """The EPSG code that the first line names; InputError where it names none that is known."""
    line = line.partition("#")[0].strip()
    code = epsg_named(line[:500])
    if code is not None:
        return f"EPSG:{code}"
    raise InputError(path, f"line 1 names no CRS that is known: {line[:80]!r}", _HEAD)
