"""Building lots from OBJ files: the faces of each object or group, in metres.

CityEngine and most modellers write OBJ with y up; then x is east and -z is north. Faces of one
object that share edges are one lot. Materials and texture coordinates are not looked at.
"""

from __future__ import annotations

import tempfile
from array import array
from collections.abc import Iterator
from pathlib import Path
from typing import IO, Literal

import numpy as np
from numpy.typing import NDArray

from veduta.grammar.city_lots import border, polygons_of, ring_area
from veduta.grammar.outline import Found, Outline, Outlines
from veduta.grammar.rings import MAX_VERTICES, RingFault
from veduta.run.errors import InputError

MAX_FACE_CORNERS = 1_000_000
"""Of the faces of one object, which are looked at together."""
MAX_LINE = 1 << 20
AT_ONCE = 1 << 18
"""Vertices that are worked on at a time."""
Up = Literal["y", "z"]
Loop = NDArray[np.int64]


def object_outlines(path: Path, up: Up, found: Found, folder: Path | None = None) -> Outlines:
    """The outlines of all objects; InputError with the line where the file is no OBJ.

    folder: has room for the vertices, which lie on the disk meanwhile.
    """
    found.notes.append(f"OBJ: {up} is up, the unit is taken for metres")
    with tempfile.TemporaryFile(dir=folder) as room:
        points = _vertices(path, up, room)
        for name, faces, fault in _objects(path):
            subject = f"{path}: {name}"
            try:
                polygons = _polygons(points, faces, fault)
            except RingFault as reason:
                found.fail(subject, str(reason))
                continue
            for number, rings in enumerate(polygons, 1):
                own = name if len(polygons) == 1 else f"{name}-{number}"
                yield Outline(f"{subject} ({own})", own[:200], rings, {})


def _polygons(
    points: NDArray[np.float64], faces: list[Loop], fault: str
) -> list[list[NDArray[np.float64]]]:
    """The outlines with their holes; a lone face keeps its first edge."""
    if fault:
        raise RingFault(fault)
    if len(faces) == 1:
        return [[points[faces[0]]]]
    up = [face if ring_area(points[face]) > 0 else face[::-1] for face in faces]
    loops = border(points, [[face] for face in up], seen_from_below=False)
    return polygons_of([points[loop] for loop in loops])


def _vertices(path: Path, up: Up, room: IO[bytes]) -> NDArray[np.float64]:
    """(n, 3) of the whole file, z up."""
    some, count = array("d"), 0
    for number, words in _lines(path):
        if words[0] != "v":
            continue
        try:
            x, y, z = (float(word) for word in words[1:4])
        except ValueError as error:
            raise _unreadable(path, number) from error
        some.extend((x, y, z) if up == "z" else (x, -z, y))
        count += 1
        if len(some) >= 3 * AT_ONCE:
            _keep(path, some, room)
            some = array("d")
    _keep(path, some, room)
    room.flush()
    if not count:
        return np.zeros((0, 3))
    return np.memmap(room, dtype=np.float64, mode="r", shape=(count, 3))


def _keep(path: Path, some: array[float], room: IO[bytes]) -> None:
    if not np.isfinite(np.frombuffer(some)).all():
        raise InputError(path, "has vertices that are not finite", "Check the file.")
    room.write(some.tobytes())


def _objects(path: Path) -> Iterator[tuple[str, list[Loop], str]]:
    """Name and faces of each object that has some, and what is wrong with the first bad face."""
    name, fault = path.stem, ""
    faces: list[Loop] = []
    count = corners = 0
    for number, words in _lines(path):
        if words[0] == "v":
            count += 1
        elif words[0] in ("o", "g"):
            if faces or fault:
                yield name, faces, fault
            name, faces, fault, corners = " ".join(words[1:]) or path.stem, [], "", 0
        elif words[0] == "f" and not fault:
            try:
                faces.append(_face(words[1:], count))
            except (ValueError, RingFault) as error:
                told = (
                    str(error) if isinstance(error, RingFault) else "a face is no list of numbers"
                )
                fault = f"line {number}: {told}"
            corners += len(words) - 1
            if corners > MAX_FACE_CORNERS:
                told = f"has an object of more than {MAX_FACE_CORNERS:,} corners (line {number})"
                raise InputError(path, told, "Give each lot an object of its own (o NAME).")
    if faces or fault:
        yield name, faces, fault


def _unreadable(path: Path, number: int) -> InputError:
    told = f"has a line that cannot be read (line {number})"
    return InputError(path, told, "Save it as OBJ.")


def _face(words: list[str], count: int) -> Loop:
    """The vertices of a face, from 0; negative numbers count from the last one back."""
    if not 3 <= len(words) <= MAX_VERTICES:
        raise RingFault("a face has fewer than three corners, or too many")
    try:
        numbers = np.array([int(word.partition("/")[0]) for word in words], dtype=np.int64)
    except OverflowError:
        raise RingFault("names a vertex that is not there") from None
    places = np.where(numbers < 0, numbers + count, numbers - 1)
    if (places < 0).any() or (places >= count).any():
        raise RingFault("names a vertex that is not there")
    return places


def _lines(path: Path) -> Iterator[tuple[int, list[str]]]:
    """Numbers and words of the lines that say something; a line may go on after a backslash."""
    try:
        with path.open(encoding="utf-8", errors="replace") as file:
            kept = ""
            number = 0
            while line := file.readline(MAX_LINE):
                number += 1
                if len(kept) + len(line) >= MAX_LINE:
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
    except OSError as error:
        told = f"cannot be read ({error.strerror})"
        raise InputError(path, told, "Check its permissions.") from error
