"""A place as binary PLY: triangles with colours, and what each one is; or its points alone.

A place without parts is written as its points. A vertex has its texture's colour there. A face has
its class, by its place in the list that a comment tells. Axes: z up, in metres where the place is.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from veduta.formats.pictures import colours_at
from veduta.formats.place_points import points_of
from veduta.formats.ply import write_points
from veduta.formats.shapes import Shape, shapes
from veduta.place.place import Place
from veduta.place.semantics import SemanticClass
from veduta.run.atomic import atomic_write
from veduta.run.errors import InputError

_VERTEX = np.dtype([("at", "<f4", 3), ("normal", "<f4", 3), ("colour", "u1", 3)])
_FACE = np.dtype([("size", "u1"), ("corners", "<i4", 3), ("class", "u1")])


def write_ply(place: Place, path: Path) -> None:
    """Write the triangles of all parts, or the points of a place that has no parts."""
    if not place.parts:
        _write_clouds(place, path)
        return
    vertices, faces, first = [np.zeros(0, _VERTEX)], [np.zeros(0, _FACE)], 0
    for shape in shapes(place, drawn_only=False):
        own_vertices, own_faces = _columns(shape, first)
        vertices.append(own_vertices)
        faces.append(own_faces)
        first += len(own_vertices)
    every, triangles = np.concatenate(vertices), np.concatenate(faces)
    with atomic_write(path) as temporary, temporary.open("wb") as file:
        file.write(_header(len(every), len(triangles), place.scale).encode("ascii"))
        file.write(every.tobytes())
        file.write(triangles.tobytes())


def _write_clouds(place: Place, path: Path) -> None:
    found = points_of(place)
    if found is None:
        raise InputError(path, "the place has neither parts nor points", "Choose another place.")
    with atomic_write(path) as temporary:
        write_points(found.points_m, found.colours, temporary)


def _columns(shape: Shape, first: int) -> tuple[NDArray[np.void], NDArray[np.void]]:
    """Vertices, each of one look, and faces whose corners count from `first`."""
    own = shape.triangles
    width = len(shape.looks)
    keys = own.corners * width + shape.look[:, None]
    used, corners = np.unique(keys.reshape(-1), return_inverse=True)
    vertex, look = used // width, used % width
    rows = np.zeros(len(used), dtype=_VERTEX)
    rows["at"], rows["normal"] = own.positions_m[vertex], own.normals[vertex]
    for number, one in enumerate(shape.looks):
        chosen = look == number
        seen = colours_at(one.material.texture, one.material.colour, own.uv[vertex[chosen]])
        if own.colours is not None:
            seen = (seen.astype(np.uint16) * own.colours[vertex[chosen]] // 255).astype(np.uint8)
        rows["colour"][chosen] = seen
    faces = np.zeros(len(own.corners), dtype=_FACE)
    faces["size"] = 3
    faces["corners"] = corners.reshape(-1, 3) + first
    faces["class"] = shape.features.class_code[own.feature]
    return rows, faces


def _header(vertices: int, faces: int, scale: str) -> str:
    columns = ("x", "y", "z", "nx", "ny", "nz")
    floats = "".join(f"property float {name}\n" for name in columns)
    colours = "".join(f"property uchar {name}\n" for name in ("red", "green", "blue"))
    unit = "metres" if scale == "metres" else "unit of length unknown"
    classes = " ".join(f"{one.code}={one.value}" for one in SemanticClass)
    return (
        "ply\nformat binary_little_endian 1.0\n"
        f"comment Veduta, z up, {unit}; class: {classes}\n"
        f"element vertex {vertices}\n{floats}{colours}"
        f"element face {faces}\n"
        "property list uchar int vertex_indices\nproperty uchar class\nend_header\n"
    )
