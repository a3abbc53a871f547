"""Reading meshes from Wavefront OBJ files with the colours and pictures of their MTL files.

Points, faces, texture coordinates, materials and groups count; normals do not.
"""

from __future__ import annotations

import math
import os
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from veduta.formats.model_pictures import beside
from veduta.formats.mtl_read import MtlMaterial, read_mtl
from veduta.place.material import Colour
from veduta.run.errors import InputError
from veduta.run.inputs import require_file
from veduta.run.names import real_path

LARGEST_BYTES = 32 * 2**20
MOST_CORNERS = 600_000
_REMEDY = "Write it again with the program that it comes from, or use a simpler mesh."
MOST_REPEATS = 1e5
"""Farther from the first picture than so many, single precision tells no place on it."""
NOWHERE = (math.nan, math.nan)
"""The texture coordinates of a corner that has none."""


@dataclass(frozen=True)
class ReadMesh:
    """Faces over points, as a file has them.

    points: (v, 3) float64. corners: (c,) uint32. offsets: (f + 1,) int64, first corner of each
    face. face_material: (f,) int32, place in `materials`: names with colours (sRGB, 0..1; None
    where the file has none). face_group: (f,) int32, place in `groups`: names of objects or groups.
    uv: (c, 2) float32, where each corner lies on the picture of its material, from the lower left;
    NaN where that is not told, None where no material has a picture. pictures: that of each
    material as `model_pictures` names it, or None. notes: what of them could not be had.
    """

    points: NDArray[np.float64]
    corners: NDArray[np.uint32]
    offsets: NDArray[np.int64]
    face_material: NDArray[np.int32]
    materials: tuple[tuple[str, Colour | None], ...]
    face_group: NDArray[np.int32]
    groups: tuple[str, ...]
    uv: NDArray[np.float32] | None
    pictures: tuple[str | None, ...]
    notes: tuple[str, ...] = ()


@dataclass
class _Read:
    """What was read of a file so far; corners and texture places face by face."""

    points: list[list[float]] = field(default_factory=list)
    places: list[tuple[float, float]] = field(default_factory=list)
    corners: list[int] = field(default_factory=list)
    uv: list[tuple[float, float]] = field(default_factory=list)
    sizes: list[int] = field(default_factory=list)
    material: list[int] = field(default_factory=list)
    group: list[int] = field(default_factory=list)
    names: dict[str, int] = field(default_factory=dict)
    groups: dict[str, int] = field(default_factory=dict)
    named: str = ""
    current: str = ""
    libraries: list[str] = field(default_factory=list)

    def line(self, word: str, rest: str) -> None:
        """Take in a line; ValueError says what is wrong with it."""
        if word == "v":
            x, y, z = (float(part) for part in rest.split()[:3])
            self.points.append([x, y, z])
        elif word == "vt":
            self.places.append(_place(rest))
        elif word == "f":
            self._face(rest.split())
        elif word in ("o", "g"):
            self.named = rest.strip()
        elif word == "usemtl":
            self.current = rest.strip()
        elif word == "mtllib":
            self.libraries.append(rest.strip())

    def _face(self, parts: list[str]) -> None:
        if len(parts) < 3:
            raise ValueError("a face of fewer than three corners")
        for part in parts:
            point, _, rest = part.partition("/")
            self.corners.append(_corner(point, len(self.points)))
            self.uv.append(self._uv(rest.partition("/")[0]))
        self.sizes.append(len(parts))
        self.material.append(self.names.setdefault(self.current, len(self.names)))
        self.group.append(self.groups.setdefault(self.named, len(self.groups)))

    def _uv(self, part: str) -> tuple[float, float]:
        """A number that leads nowhere is no fault: the face is there without its picture."""
        try:
            given = int(part)
            return self.places[given - 1 if given > 0 else given] if given else NOWHERE
        except (ValueError, IndexError):
            return NOWHERE


def read_obj(path: Path, root: Path) -> ReadMesh:
    """The mesh; material files and pictures are read below `root` alone.

    InputError says what is wrong.
    """
    read = _Read()
    for number, line in enumerate(_text(path).splitlines(), start=1):
        word, _, rest = line.strip().partition(" ")
        try:
            read.line(word, rest)
        except ValueError as error:
            raise InputError(path, f"line {number}: {error}", _REMEDY) from error
        if len(read.corners) > MOST_CORNERS:
            raise InputError(path, f"has more than {MOST_CORNERS} corners of faces", _REMEDY)
    if not read.sizes:
        raise InputError(path, "has no faces", _REMEDY)
    points = np.array(read.points, dtype=np.float64)
    if not np.isfinite(points).all():
        raise InputError(path, "has points that are no numbers", _REMEDY)
    materials, folders = _materials(read.libraries, path, root)
    known = [materials.get(name, MtlMaterial()) for name in read.names]
    found = [
        _picture(own, folders.get(name, path.parent), root)
        for name, own in zip(read.names, known, strict=True)
    ]
    lost = zip(read.names, known, found, strict=True)
    return ReadMesh(
        points=points,
        corners=np.array(read.corners, dtype=np.uint32),
        offsets=np.concatenate([[0], np.cumsum(read.sizes)]).astype(np.int64),
        face_material=np.array(read.material, dtype=np.int32),
        materials=tuple((name, own.colour) for name, own in zip(read.names, known, strict=True)),
        face_group=np.array(read.group, dtype=np.int32),
        groups=tuple(read.groups),
        uv=_laid(read, known) if any(found) else None,
        pictures=tuple(found),
        notes=tuple(
            lost_picture(own.picture, name) for name, own, at in lost if own.picture and not at
        ),
    )


def lost_picture(picture: str, material: str) -> str:
    """What to say of a picture that is not there."""
    named = f"the picture {picture[:200]} of its material {material[:200]}"
    return f"{named} does not lie in its folder or below: the colour alone is shown"


def _picture(material: MtlMaterial, folder: Path, root: Path) -> str | None:
    found = None if material.picture is None else beside(material.picture, folder, root)
    return None if found is None else str(found)


def _laid(read: _Read, materials: list[MtlMaterial]) -> NDArray[np.float32]:
    """(c, 2) the places of corners on the pictures of their materials, as these are laid."""
    uv = np.array(read.uv, dtype=np.float64)
    row = np.repeat(read.material, read.sizes)
    stretch = np.array([one.stretch for one in materials])[row]
    shift = np.array([one.shift for one in materials])[row]
    laid: NDArray[np.float32] = (uv * stretch + shift).astype(np.float32)
    return laid


def _corner(part: str, count: int) -> int:
    """The number of a point, from 0; OBJ counts from 1, or backwards from -1."""
    given = int(part)
    number = given - 1 if given > 0 else count + given
    if given == 0 or not 0 <= number < count:
        raise ValueError(f"a face names point {given} of {count}")
    return number


def _place(rest: str) -> tuple[float, float]:
    """The place on a picture that `vt` tells; nowhere, where it is no place."""
    try:
        u, v = (float(part) for part in [*rest.split()[:2], "0"][:2])
    except ValueError:
        return NOWHERE
    return (u, v) if abs(u) < MOST_REPEATS and abs(v) < MOST_REPEATS else NOWHERE


def _text(path: Path) -> str:
    try:
        require_file(path, LARGEST_BYTES)
        return path.read_text(encoding="utf-8", errors="replace")
    except OSError as error:
        raise InputError(path, f"cannot be read ({error.strerror})", "Check its name.") from error


def _materials(
    libraries: list[str], path: Path, root: Path
) -> tuple[dict[str, MtlMaterial], dict[str, Path]]:
    """The materials of the files that an OBJ file names, and the folder that each is from."""
    found: dict[str, MtlMaterial] = {}
    folders: dict[str, Path] = {}
    for name in dict.fromkeys(libraries):
        real = _inside(path.parent / name, root)
        if real is None:
            continue
        try:
            own = read_mtl(_text(real).splitlines())
        except ValueError as error:
            raise InputError(real, f"has a colour that is none ({error})", _REMEDY) from error
        found |= own
        folders |= dict.fromkeys(own, real.parent)
    return found, folders


def _inside(path: Path, root: Path) -> Path | None:
    """A file that lies in `root`; None where it is missing or lies elsewhere."""
    if "\0" in str(path):
        return None
    real, inside = str(real_path(path)), str(real_path(root))
    held = os.path.isfile(real) and os.path.commonpath([inside, real]) == inside
    return Path(real) if held else None
