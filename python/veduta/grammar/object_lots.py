"""Building lots from OBJ files: the faces of each object or group, in metres.

CityEngine and most modellers write OBJ with y up; then x is east and -z is north. Faces of one
object that share edges are one lot. Materials and texture coordinates are not looked at.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from veduta.grammar.city_lots import border, polygons_of, ring_area
from veduta.grammar.outline import Outline
from veduta.grammar.rings import MAX_VERTICES, RingFault
from veduta.run.errors import InputError
from veduta.run.inputs import require_file
from veduta.run.report import Failure

MAX_BYTES = 512 * 2**20
MAX_POINTS = 10_000_000
MAX_LINE = 1 << 20
Up = Literal["y", "z"]
Loop = NDArray[np.int64]


def object_outlines(path: Path, up: Up) -> tuple[list[Outline], list[Failure]]:
    """The outlines of all objects; InputError with the line where the file is no OBJ."""
    points, groups = _parsed(path)
    if up == "y":
        points = np.column_stack([points[:, 0], -points[:, 2], points[:, 1]])
    found: list[Outline] = []
    failures: list[Failure] = []
    for name, faces in groups:
        subject = f"{path}: {name}"
        try:
            polygons = _polygons(points, faces)
        except RingFault as fault:
            failures.append(Failure(subject=subject, kind="input", reason=str(fault)))
            continue
        for number, rings in enumerate(polygons, 1):
            own = name if len(polygons) == 1 else f"{name}-{number}"
            found.append(Outline(f"{subject} ({own})", own[:200], rings, {}))
    return found, failures


def _polygons(points: NDArray[np.float64], faces: list[Loop]) -> list[list[NDArray[np.float64]]]:
    """The outlines with their holes; a lone face keeps its first edge."""
    if len(faces) == 1:
        return [[points[faces[0]]]]
    up = [face if ring_area(points[face]) > 0 else face[::-1] for face in faces]
    loops = border(points, [[face] for face in up], seen_from_below=False)
    return polygons_of([points[loop] for loop in loops])


def _parsed(path: Path) -> tuple[NDArray[np.float64], list[tuple[str, list[Loop]]]]:
    """(n, 3) vertices as the file has them, and the faces of each object, in order."""
    corners: list[tuple[float, float, float]] = []
    groups: list[tuple[str, list[Loop]]] = []
    name = path.stem
    for number, words in _lines(path):
        try:
            if words[0] == "v":
                x, y, z = (float(word) for word in words[1:4])
                corners.append((x, y, z))
            elif words[0] in ("o", "g"):
                name = " ".join(words[1:]) or path.stem
                groups.append((name, []))
            elif words[0] == "f":
                if not groups:
                    groups.append((name, []))
                groups[-1][1].append(_face(words[1:], len(corners)))
        except (ValueError, RingFault) as error:
            raise InputError(
                path, f"has a line that cannot be read (line {number})", "Save it as OBJ."
            ) from error
        if len(corners) > MAX_POINTS:
            raise InputError(path, f"has more than {MAX_POINTS} vertices", "Cut it into several.")
    points = np.array(corners, dtype=np.float64).reshape(-1, 3)
    if not np.isfinite(points).all():
        raise InputError(path, "has vertices that are not finite", "Check the file.")
    return points, [(name, faces) for name, faces in groups if faces]


def _face(words: list[str], count: int) -> Loop:
    """The vertices of a face, from 0; negative numbers count from the last one back."""
    if not 3 <= len(words) <= MAX_VERTICES:
        raise RingFault("a face has fewer than three corners, or too many")
    numbers = np.array([int(word.partition("/")[0]) for word in words], dtype=np.int64)
    places = np.where(numbers < 0, numbers + count, numbers - 1)
    if (places < 0).any() or (places >= count).any():
        raise RingFault("names a vertex that is not there")
    return places


def _lines(path: Path) -> Iterator[tuple[int, list[str]]]:
    """Numbers and words of the lines that say something; a line may go on after a backslash."""
    try:
        require_file(path, MAX_BYTES)
        with path.open(encoding="utf-8", errors="replace") as file:
            kept = ""
            for number, line in enumerate(file, 1):
                if len(kept) + len(line) > MAX_LINE:
                    raise InputError(
                        path, f"has a line too long (line {number})", "Save it as OBJ."
                    )
                text = kept + line.partition("#")[0].rstrip()
                if text.endswith("\\"):
                    kept = text[:-1] + " "
                    continue
                kept = ""
                if words := text.split():
                    yield number, words
    except FileNotFoundError as error:
        raise InputError(path, "does not exist", "Check its name.") from error
    except OSError as error:
        told = f"cannot be read ({error.strerror})"
        raise InputError(path, told, "Check its permissions.") from error
