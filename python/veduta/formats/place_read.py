"""Files of other programs as places: meshes, points, and the buildings of city models.

A material that is named after a class (`window`, `wall.brick`) gives its surfaces that class, as
Veduta's own writers name them; all other surfaces are `other`. glTF and OBJ are y-up, COLLADA
says which way is up, STL and PLY are taken to be z-up.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from veduta.formats.building_faces import MOST_CORNERS
from veduta.formats.dae_read import read_dae_mesh
from veduta.formats.glb_mesh import read_glb_mesh
from veduta.formats.gltf_chunks import BROKEN, glb_chunks, glb_content
from veduta.formats.mesh_glb_read import read_model
from veduta.formats.model_pictures import read_picture
from veduta.formats.obj_read import ReadMesh, read_obj
from veduta.formats.triangles_read import ReadPoints, read_triangles
from veduta.place.features import feature_table
from veduta.place.material import Colour, Material, Texture
from veduta.place.mesh import Mesh
from veduta.place.part import Part
from veduta.place.place import Cloud, Place
from veduta.place.semantics import CLASS_NAMED, Provenance, SemanticClass
from veduta.run.errors import InputError
from veduta.run.limits import limited

_FARTHEST_M = 1e12
_MOST_PIXELS = 2**28
"""Of all pictures of a model together."""


def read_glb_place(path: Path) -> Place:
    """A model of Veduta's as it was; of any other glTF its triangles, colours and pictures."""
    place = Place(title=path.stem)
    if _is_model(path):
        place.add(read_model(path))
    else:
        place.add(_part(read_glb_mesh(path, MOST_CORNERS), path))
    return place


def read_obj_place(path: Path) -> Place:
    """The polygons of an OBJ file, with the colours and pictures of its MTL files."""
    place = Place(title=path.stem)
    place.add(_part(read_obj(path, path.parent), path))
    return place


def read_dae_place(path: Path) -> Place:
    """The polygons of a COLLADA file's scene, with the colours and pictures of its materials."""
    place = Place(title=path.stem)
    place.add(_part(read_dae_mesh(path, MOST_CORNERS), path))
    return place


def read_trimesh_place(path: Path) -> Place:
    """The triangles of an STL or PLY file; of a PLY file without any, its points."""
    read = limited(read_triangles, path, path, "Export it again.")
    place = Place(title=path.stem)
    if isinstance(read, ReadPoints):
        place.clouds.append(Cloud(path.stem, read.points_m, read.colours))
        return place
    try:
        mesh = Mesh.simple(path.stem, read.vertices_m, read.triangles, colours=read.colours)
    except ValueError as error:
        raise InputError(path, f"is no mesh ({error})", "Export it again.") from error
    place.add(mesh)
    return place


def _is_model(path: Path) -> bool:
    """Whether a GLB file is one part of Veduta's."""
    try:
        root = glb_chunks(glb_content(path)).root
        return "features" in root["scenes"][0]["extras"]["veduta"]
    except (*BROKEN, RecursionError):
        return False


def _class_of(name: str) -> SemanticClass:
    return CLASS_NAMED.get(name.split(".")[0].lower(), SemanticClass.OTHER)


def _part(read: ReadMesh, path: Path) -> Part:
    """Polygons as a file has them; y up becomes z up."""
    points = read.points[read.corners]
    if len(points) and float(np.abs(points).max()) > _FARTHEST_M:
        fault = f"has a point farther than {_FARTHEST_M:g} m from where it counts from"
        raise InputError(path, fault, "Export it in metres, about a place near it.")
    count = len(read.offsets) - 1
    names = [name or f"material {row + 1}" for row, (name, _) in enumerate(read.materials)]
    rows = _unique([(_class_of(name), Provenance.MEASURED, name) for name in names])
    textures, faults = _textures(read.pictures)
    return Part(
        id=path.stem,
        positions_m=np.stack([points[:, 0], -points[:, 2], points[:, 1]], axis=1).astype(
            np.float32
        ),
        uv=_from_the_top(read),
        ring_offsets=read.offsets.astype(np.int64),
        polygon_offsets=np.arange(count + 1, dtype=np.int64),
        polygon_feature=read.face_material.astype(np.int32),
        polygon_material=read.face_material.astype(np.int32),
        features=feature_table(path.stem, rows),
        materials=tuple(
            _material(name, colour, textures.get(picture or ""))
            for name, (_, colour), picture in zip(names, read.materials, read.pictures, strict=True)
        ),
        notes=tuple(dict.fromkeys([*read.notes, *faults])),
    )


def _material(name: str, colour: Colour | None, texture: Texture | None) -> Material:
    is_cut = texture is not None and texture.cut
    return Material(name, colour or (1.0, 1.0, 1.0), texture=texture, two_sided=is_cut)


def _from_the_top(read: ReadMesh) -> NDArray[np.float32]:
    """(c, 2) the places of corners on pictures as parts have them: from the upper left."""
    if read.uv is None:
        return np.zeros((len(read.corners), 2), dtype=np.float32)
    uv = np.nan_to_num(read.uv, nan=0.0)
    uv[:, 1] = 1.0 - uv[:, 1]
    return uv


def _textures(pictures: Sequence[str | None]) -> tuple[dict[str, Texture], list[str]]:
    """The pictures that can be read, and what is wrong with the others."""
    found: dict[str, Texture] = {}
    faults: list[str] = []
    room = _MOST_PIXELS
    for picture in dict.fromkeys(pictures):
        if picture is None:
            continue
        try:
            texture = read_picture(picture)
        except InputError as error:
            faults.append(f"a picture is not shown, but the colour of its material: {error}")
            continue
        room -= texture.invented.size
        if room < 0:
            told = f"its pictures have more than {_MOST_PIXELS} pixels together"
            faults.append(f"{told}: of the others the colours of the materials are shown")
            break
        found[picture] = texture
    return found, faults


def _unique(
    rows: Sequence[tuple[SemanticClass, Provenance, str]],
) -> list[tuple[SemanticClass, Provenance, str]]:
    seen: dict[str, int] = {}
    made = []
    for semantic, provenance, name in rows:
        count = seen[name] = seen.get(name, 0) + 1
        made.append((semantic, provenance, name if count == 1 else f"{name} ({count})"))
    return made
