"""A place as Wavefront OBJ with an MTL file and its textures beside it.

OBJ is y-up by custom: (x, y, z) of the place becomes (x, z, -y) here and nowhere else. A part is an
object (`o`), a feature a group (`g`), a look a material (`usemtl`); metres from the place's origin,
which the first lines tell with its CRS. What shines, moves or is seen through beyond its opacity
has no word in OBJ.

Written by hand, where trimesh could: a place's parts are taken one by one from the disk and written
at once, while trimesh wants a scene whole in memory; and it has no groups for features, merges
materials of a name, and writes textures by names of its own.
"""

from __future__ import annotations

from pathlib import Path
from typing import TextIO

import numpy as np
from numpy.typing import NDArray

import veduta
from veduta.formats.pictures import Pictures
from veduta.formats.shapes import Look, Shape, shapes
from veduta.place.place import Place
from veduta.run.atomic import atomic_write, write_bytes

_ROWS = 100_000
"""Rows of text that are made at a time."""


def write_obj(place: Place, path: Path) -> None:
    """Write `path`, an `.mtl` and a `.jpg` for each texture beside it."""
    library = path.with_suffix(".mtl")
    pictures = Pictures(path)
    known: dict[str, str] = {}
    with atomic_write(path) as temporary, temporary.open("w", encoding="utf-8") as file:
        file.write("".join(f"# {line}\n" for line in header(place)))
        file.write(f"mtllib {library.name}\n")
        starts = (1, 1, 1)
        for shape in shapes(place):
            for look in shape.looks:
                known.setdefault(look.name, _material(look, pictures.name(look)))
            starts = _write_shape(shape, file, starts)
        write_bytes(library, "\n".join(known.values()).encode())


def header(place: Place) -> list[str]:
    """What a mesh file can say of the place in a comment: who wrote it, and where zero is."""
    x, y, z = place.origin_m
    unit = "metres" if place.scale == "metres" else "of unknown scale"
    where = f"from ({x}, {y}, {z}) in {place.crs}" if place.crs else "from an origin of its own"
    told = [f"Veduta {veduta.__version__}", f"{unit}, y up, -z north, {where}"]
    for word, value in (
        ("title", place.title),
        ("author", place.author),
        ("licence", place.licence),
    ):
        if value:
            told.append(f"{word}: {' '.join(value.split())}")
    return told


def _write_shape(shape: Shape, file: TextIO, starts: tuple[int, int, int]) -> tuple[int, int, int]:
    """Write an object; the numbers of the next point, texture point and normal."""
    own = shape.triangles
    places = _y_up(own.positions_m)
    if own.colours is not None:
        # Not in the format's first text, but read by all that read coloured meshes.
        places = np.column_stack([places, own.colours / 255.0])
    at, points = _numbered(places, 5)
    seen, uv = _numbered(np.column_stack([own.uv[:, 0], 1.0 - own.uv[:, 1]]), 6)
    leaning, normals = _numbered(_y_up(own.normals), 4)
    file.write(f"o {_word(shape.placed.id)}\n")
    _write_rows(file, "v" + " %.5f" * points.shape[1] + "\n", points)
    _write_rows(file, "vt %.6f %.6f\n", uv)
    _write_rows(file, "vn %.4f %.4f %.4f\n", normals)
    columns = np.stack([at + starts[0], seen + starts[1], leaning + starts[2]], axis=1)
    for feature, rows in shape.by_feature():
        file.write(f"g {_word(shape.features.id[feature])}\n")
        for look in np.unique(shape.look[rows]).tolist():
            file.write(f"usemtl {shape.looks[look].name}\n")
            corners = columns[own.corners[rows[shape.look[rows] == look]]]
            _write_rows(file, "f %d/%d/%d %d/%d/%d %d/%d/%d\n", corners.reshape(-1, 9))
    return starts[0] + len(points), starts[1] + len(uv), starts[2] + len(normals)


def _numbered(
    rows: NDArray[np.float64], digits: int
) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
    """Which of the different rounded rows each row is, and those."""
    if len(rows) == 0:
        return np.zeros(0, dtype=np.int64), rows
    found, number = np.unique(np.round(rows, digits) + 0.0, axis=0, return_inverse=True)
    return number.reshape(-1).astype(np.int64), found


def _write_rows(file: TextIO, pattern: str, rows: NDArray[np.generic]) -> None:
    for first in range(0, len(rows), _ROWS):
        some = rows[first : first + _ROWS]
        file.write(pattern * len(some) % tuple(some.reshape(-1).tolist()))


def _y_up(vectors: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.stack([vectors[:, 0], vectors[:, 2], -vectors[:, 1]], axis=1)


def _material(look: Look, picture: str | None) -> str:
    """An MTL entry: its diffuse colour, opacity, glow and texture; roughness and metalness (Pr, Pm)
    are read by those who know the PBR words.
    """
    material = look.material
    red, green, blue = (f"{channel:.4f}" for channel in material.colour)
    lines = [
        f"newmtl {look.name}",
        f"Kd {red} {green} {blue}",
        f"d {material.opacity:.3f}",
        f"illum {0 if material.unlit else 1}",
        f"Pr {material.roughness:.3f}",
        f"Pm {material.metalness:.3f}",
    ]
    if material.glow > 0.0:
        lines.append("Ke " + " ".join(f"{material.glow * c:.4f}" for c in material.colour))
    if picture is not None:
        lines.append(f"map_Kd {picture}")
    return "\n".join(lines) + "\n"


def _word(name: str) -> str:
    """A name without spaces, which would part it."""
    return "_".join(name.split()) or "_"
