"""Ground control points from a text file, as OpenDroneMap has it.

The first line names the CRS: `EPSG:32632`, `WGS84 UTM 32N`, `WGS84`, or a PROJ string. Each other
line is an observation: x y z px py photo [name]. Lines that begin with # are remarks. Pixels are of
the upright photo, x right and y down.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import pyproj
from numpy.typing import NDArray

from veduta.geometry.utm import epsg_of
from veduta.photos.city.crs import metres_of
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
    """The points of a file. crs: of their metres. lines: those that name each photo."""

    path: Path
    crs: str
    points: tuple[ControlPoint, ...]
    notes: tuple[str, ...] = ()
    lines: Mapping[str, tuple[int, ...]] = field(default_factory=dict)


def read_control(path: Path) -> ControlPoints:
    """The points, in the order of the file; InputError with the line that is wrong."""
    lines = [
        (number, line.strip())
        for number, line in enumerate(_text(path).splitlines(), start=1)
        if line.strip() and not line.lstrip().startswith("#")
    ]
    if not lines:
        raise InputError(path, "is empty", _HEAD)
    crs = _crs(path, lines[0][1])
    places: dict[str, NDArray[np.float64]] = {}
    seen: dict[str, list[tuple[str, tuple[float, float]]]] = {}
    naming: dict[str, tuple[int, ...]] = {}
    for number, line in lines[1:]:
        words = line.split()
        try:
            if len(words) < 6:
                raise ValueError(f"has {len(words)} words")
            x, y, z, across, down = (float(word) for word in words[:5])
        except ValueError as error:
            raise InputError(path, f"line {number} is no control point ({error})", _LINE) from error
        place = np.array([x, y, z])
        if not np.isfinite([x, y, z, across, down]).all():
            raise InputError(path, f"line {number} has a number that is not finite", _LINE)
        name = " ".join(words[6:])[:100] or f"{x:.12g} {y:.12g} {z:.12g}"
        known = places.setdefault(name, place)
        if not np.array_equal(known, place):
            fault = f"line {number} has the point {name!r} at another place than before"
            raise InputError(path, fault, "Give each point one place, or names of their own.")
        seen.setdefault(name, []).append((words[5], (across, down)))
        naming[words[5]] = (*naming.get(words[5], ()), number)
    if not places:
        raise InputError(path, "has no control points", _LINE)
    _require_degrees(path, crs, places)
    metres = metres_of(path, crs, np.array(list(places.values())))
    points = tuple(
        ControlPoint(name, metres.of(place[None])[0], tuple(seen[name]))
        for name, place in places.items()
    )
    return ControlPoints(path, metres.crs, points, metres.notes, naming)


def _require_degrees(path: Path, crs: str, places: Mapping[str, NDArray[np.float64]]) -> None:
    """InputError where longitudes and latitudes cannot be any: metres, or the wrong way round."""
    if not pyproj.CRS.from_user_input(crs).is_geographic:
        return
    for name, (x, y, _) in places.items():
        if abs(x) > 180.0 or abs(y) > 90.0:
            fault = f"has the point {name} at {x:g} {y:g}, and {crs} is in degrees"
            remedy = "Write longitude, latitude and height, or the CRS of the metres."
            raise InputError(path, fault, remedy)


def _text(path: Path) -> str:
    try:
        require_file(path, LARGEST_BYTES)
        return path.read_text(encoding="utf-8-sig")
    except OSError as error:
        fault = f"cannot be read ({error.strerror})"
        raise InputError(path, fault, "Check its name and its permissions.") from error
    except UnicodeDecodeError as error:
        raise InputError(path, "is no text in UTF-8", "Save it as text.") from error


def _crs(path: Path, line: str) -> str:
    if re.fullmatch(r"(?i)EPSG:\d{4,6}", line):
        return line.upper()
    utm = re.fullmatch(r"(?i)WGS\s?84 UTM (\d{1,2})\s?([NS])", line)
    if utm is not None and 1 <= int(utm[1]) <= 60:
        return f"EPSG:{epsg_of(int(utm[1]), south=utm[2].upper() == 'S')}"
    if re.fullmatch(r"(?i)WGS\s?84", line):
        return "EPSG:4326"
    if "+proj" in line:
        try:
            code = pyproj.CRS.from_user_input(line[:500]).to_epsg(min_confidence=70)
        except pyproj.exceptions.ProjError as error:
            raise InputError(path, f"line 1 names no CRS: {line[:80]!r}", _HEAD) from error
        if code is not None:
            return f"EPSG:{code}"
    raise InputError(path, f"line 1 names no CRS that is known: {line[:80]!r}", _HEAD)
