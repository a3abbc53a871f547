"""Reading meshes from Wavefront OBJ files with the colours of their MTL files.

Points, faces, materials and groups count; normals and texture coordinates do not.
"""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from veduta.place.material import Colour
from veduta.run.errors import InputError
from veduta.run.inputs import require_file
from veduta.run.names import real_path

LARGEST_BYTES = 32 * 2**20
MOST_CORNERS = 600_000
_REMEDY = "Write it again with the program that it comes from, or use a simpler mesh."


@dataclass(frozen=True)
class ReadMesh:
    """Faces over points, as a file has them.

    points: (v, 3) float64. corners: (c,) uint32. offsets: (f + 1,) int64, first corner of each
    face. face_material: (f,) int32, place in `materials`: names with colours (sRGB, 0..1; None
    where the file has none). face_group: (f,) int32, place in `groups`: names of objects or groups.
    """

    points: NDArray[np.float64]
    corners: NDArray[np.uint32]
    offsets: NDArray[np.int64]
    face_material: NDArray[np.int32]
    materials: tuple[tuple[str, Colour | None], ...]
    face_group: NDArray[np.int32]
    groups: tuple[str, ...]


def read_obj(path: Path, root: Path) -> ReadMesh:
    """The mesh; material files are read below `root` alone. InputError says what is wrong."""
    lines = _text(path).splitlines()
    points: list[list[float]] = []
    corners: list[int] = []
    sizes: list[int] = []
    material: list[int] = []
    group: list[int] = []
    names: dict[str, int] = {}
    groups: dict[str, int] = {}
    named = ""
    colours: dict[str, Colour] = {}
    current = ""
    for number, line in enumerate(lines, start=1):
        word, _, rest = line.strip().partition(" ")
        try:
            if word == "v":
                x, y, z = (float(part) for part in rest.split()[:3])
                points.append([x, y, z])
            elif word == "f":
                face = [_corner(part, len(points)) for part in rest.split()]
                if len(face) < 3:
                    raise ValueError("a face of fewer than three corners")
                corners += face
                sizes.append(len(face))
                material.append(names.setdefault(current, len(names)))
                group.append(groups.setdefault(named, len(groups)))
            elif word in ("o", "g"):
                named = rest.strip()
            elif word == "usemtl":
                current = rest.strip()
            elif word == "mtllib":
                colours |= _colours(path.parent / rest.strip(), root)
        except ValueError as error:
            raise InputError(path, f"line {number}: {error}", _REMEDY) from error
        if len(corners) > MOST_CORNERS:
            raise InputError(path, f"has more than {MOST_CORNERS} corners of faces", _REMEDY)
    if not sizes:
        raise InputError(path, "has no faces", _REMEDY)
    found = np.array(points, dtype=np.float64)
    if not np.isfinite(found).all():
        raise InputError(path, "has points that are no numbers", _REMEDY)
    return ReadMesh(
        points=found,
        corners=np.array(corners, dtype=np.uint32),
        offsets=np.concatenate([[0], np.cumsum(sizes)]).astype(np.int64),
        face_material=np.array(material, dtype=np.int32),
        materials=tuple((name, colours.get(name)) for name in names),
        face_group=np.array(group, dtype=np.int32),
        groups=tuple(groups),
    )


def _corner(part: str, count: int) -> int:
    """The number of a point, from 0; OBJ counts from 1, or backwards from -1."""
    given = int(part.partition("/")[0])
    number = given - 1 if given > 0 else count + given
    if given == 0 or not 0 <= number < count:
        raise ValueError(f"a face names point {given} of {count}")
    return number


def _text(path: Path) -> str:
    try:
        require_file(path, LARGEST_BYTES)
        return path.read_text(encoding="utf-8", errors="replace")
    except OSError as error:
        raise InputError(path, f"cannot be read ({error.strerror})", "Check its name.") from error


def _colours(path: Path, root: Path) -> dict[str, Colour]:
    """The diffuse colours of a material file; none where it is missing or lies elsewhere."""
    real = str(real_path(path))
    if not os.path.isfile(real) or os.path.commonpath([str(real_path(root)), real]) != str(
        real_path(root)
    ):
        return {}
    found: dict[str, Colour] = {}
    name = ""
    for line in _text(Path(real)).splitlines():
        word, _, rest = line.strip().partition(" ")
        if word == "newmtl":
            name = rest.strip()
        elif word == "Kd" and name:
            red, green, blue = (min(max(float(part), 0.0), 1.0) for part in rest.split()[:3])
            found[name] = (red, green, blue)
    return found
