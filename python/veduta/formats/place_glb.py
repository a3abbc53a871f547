"""A whole place as one glTF 2.0 binary: a node for each part, and a table of its features.

Each part is what its own file would be (`formats.gltf`, `formats.mesh_glb`), below a node that puts
it where it stands. Triangles of a primitive are parted by class, so that each class has a material
of its own name: glass is `window`, not `wall`. Vertices have the row of their feature
(EXT_mesh_features) in the part's table (EXT_structural_metadata). Tours are cameras that move.
"""

from __future__ import annotations

import json
import struct
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from veduta.formats.gltf import glb_bytes
from veduta.formats.gltf_bin import glb_container
from veduta.formats.gltf_camera import add_camera
from veduta.formats.gltf_join import JoinedGltf
from veduta.formats.gltf_metadata import (
    MESH_FEATURES,
    METADATA,
    feature_ids,
    property_table,
    schema,
)
from veduta.formats.known_values import known
from veduta.formats.mesh_glb import mesh_glb_bytes
from veduta.formats.shapes import contents
from veduta.place.camera_path import CameraPath
from veduta.place.manifest import Tour
from veduta.place.mesh import Mesh
from veduta.place.part import Features, Part
from veduta.place.place import Place, PlacedPart
from veduta.place.semantics import SemanticClass
from veduta.run.atomic import write_bytes

TOUR_FOV_RAD = 1.05
"""Sixty degrees from top to bottom: what the studio shows a tour with."""
_Y_UP = np.array([[1.0, 0, 0, 0], [0, 0, 1, 0], [0, -1, 0, 0], [0, 0, 0, 1]])


def write_place_glb(place: Place, path: Path) -> None:
    """Write all parts; the file appears whole or not at all."""
    write_bytes(path, place_glb_bytes(place))


def place_glb_bytes(place: Place) -> bytes:
    """The content of the file."""
    joined = JoinedGltf()
    tables: list[dict[str, Any]] = []
    for placed, content in contents(place):
        _add_part(joined, placed, content, tables)
    for tour in place.tours:
        add_camera(joined.root, _path(tour), joined.binary)
    joined.root["scenes"][0] |= {"extras": {"veduta": _told(place)}}
    if place.title:
        joined.root["scenes"][0]["name"] = place.title
    credit = ", ".join(word for word in (place.author, place.licence) if word)
    if credit:
        joined.root["asset"]["copyright"] = credit
    if tables:
        joined.use(METADATA, MESH_FEATURES)
        extensions = joined.root.setdefault("extensions", {})
        extensions[METADATA] = {"schema": schema(), "propertyTables": tables}
    return glb_container(*joined.document())


def _add_part(
    joined: JoinedGltf, placed: PlacedPart, content: Part | Mesh, tables: list[dict[str, Any]]
) -> None:
    if isinstance(content, Mesh):
        root, chunk = _opened(mesh_glb_bytes(content, alone=False))
    else:
        root, chunk = _opened(glb_bytes(content, alone=False))
    told = root["scenes"][0].get("extras", {}).get("veduta", {})
    standing = placed.standing
    node: dict[str, Any] = {
        "name": standing.name or placed.id,
        "extras": {
            "veduta": {
                "part": placed.id,
                "attributes": known(content.attributes),
                "notes": list(content.notes),
                "arrangement": standing.arrangement,
                "table": len(tables),
            }
            | {name: told[name] for name in told if name not in ("features", "notes", "attributes")}
        },
    }
    matrix = _Y_UP @ standing.transform @ _Y_UP.T
    if not np.array_equal(matrix, np.eye(4)):
        node["matrix"] = (matrix.T.reshape(-1) + 0.0).tolist()
    added = joined.add(root, chunk, node)
    looks = _ClassLooks(joined, content.features)
    for mesh in added["meshes"]:
        mesh["primitives"] = [
            piece for primitive in mesh["primitives"] for piece in looks.parted(primitive)
        ]
        for primitive in mesh["primitives"]:
            if "_FEATURE_ID_0" in primitive["attributes"]:
                told_of = feature_ids(len(content.features), len(tables))
                primitive.setdefault("extensions", {})[MESH_FEATURES] = told_of
    looks.name_instances(added)
    tables.append(
        property_table(placed.id, content.features, content.feature_area_m2, joined.binary)
    )


class _ClassLooks:
    """Gives each class of a part materials of its own, named after it."""

    def __init__(self, joined: JoinedGltf, features: Features) -> None:
        self._joined, self._features = joined, features
        self._number: dict[tuple[int, int], int] = {}
        self._taken: set[int] = set()
        self._names: dict[str, int] = {}

    def parted(self, primitive: dict[str, Any]) -> list[dict[str, Any]]:
        """A primitive as one for each class; the vertices stay shared."""
        if "_FEATURE_ID_0" not in primitive["attributes"]:
            return [primitive]
        corners = self._array(primitive["indices"], np.uint32).reshape(-1, 3)
        feature = self._array(primitive["attributes"]["_FEATURE_ID_0"], np.float32)
        classes = self._features.class_code[feature[corners[:, 0]].astype(np.int64)]
        found = np.unique(classes).tolist()
        pieces = []
        for code in found:
            piece = dict(primitive)
            if len(found) > 1:
                own = corners[classes == code].reshape(-1)
                piece["indices"] = self._joined.binary.add_array(own, "SCALAR")
            piece["material"] = self._material(primitive["material"], code)
            pieces.append(piece)
        return pieces

    def name_instances(self, added: dict[str, Any]) -> None:
        """The materials of what stands many times get the class of where it stands first."""
        for node in added["nodes"]:
            row = node.get("extras", {}).get("veduta", {}).get("instance")
            if row is None:
                continue
            for primitive in self._joined.root["meshes"][node["mesh"]]["primitives"]:
                if primitive["material"] not in self._taken:
                    code = int(self._features.class_code[row])
                    primitive["material"] = self._material(primitive["material"], code)

    def _material(self, number: int, code: int) -> int:
        """The material of a class that looks like another one."""
        key = (number, code)
        if key not in self._number:
            materials = self._joined.root["materials"]
            told = json.loads(json.dumps(materials[number]))
            told.setdefault("extras", {}).setdefault("veduta", {})["material"] = told["name"]
            told["name"] = self._free(SemanticClass.of_code(code).value, told["name"])
            if any(first == number for first, _ in self._number):
                materials.append(told)
                self._number[key] = len(materials) - 1
            else:
                materials[number] = told
                self._number[key] = number
            self._taken.add(self._number[key])
        return self._number[key]

    def _free(self, semantic: str, material: str) -> str:
        """The class, with the material's name where another look of the part has it."""
        name = semantic if semantic not in self._names else f"{semantic}.{material}"
        count = self._names[name] = self._names.get(name, 0) + 1
        return name if count == 1 else f"{name}.{count}"

    def _array(self, number: int, dtype: type[np.generic]) -> NDArray[Any]:
        binary = self._joined.binary
        accessor = binary.accessors[number]
        start = binary.views[accessor["bufferView"]]["byteOffset"]
        return np.frombuffer(
            bytes(binary.content[start : start + 4 * accessor["count"]]), dtype=dtype
        )


def _opened(glb: bytes) -> tuple[dict[str, Any], bytes]:
    (size,) = struct.unpack_from("<I", glb, 12)
    return json.loads(glb[20 : 20 + size]), glb[28 + size :]


def _path(tour: Tour) -> CameraPath:
    return CameraPath(
        tour.name,
        np.array(tour.times_s),
        np.array(tour.eyes, dtype=np.float64),
        np.array(tour.directions, dtype=np.float64),
        TOUR_FOV_RAD,
    )


def _told(place: Place) -> dict[str, Any]:
    """Where the place is, which glTF has no word for."""
    told: dict[str, Any] = {
        "crs": place.crs, "origin_m": list(place.origin_m), "scale": place.scale
    }  # fmt: skip
    for name in ("title", "description", "author", "licence"):
        if getattr(place, name):
            told[name] = getattr(place, name)
    if place.languages:
        told["languages"] = list(place.languages)
    return told
