"""A part as the content of a tile: its glTF with the table of features as metadata.

Each vertex and each instance has the row of its feature already (`_FEATURE_ID_0`); here it is told
to readers of tiles (EXT_mesh_features, EXT_instance_features), with the columns of the table
(EXT_structural_metadata) in the schema that all tiles have (`tile_glb.schema`).
"""

from __future__ import annotations

import json
import struct
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from veduta.formats.gltf import glb_bytes
from veduta.formats.gltf_bin import glb_container
from veduta.formats.gltf_instances import FEATURES
from veduta.formats.mesh_glb import mesh_glb_bytes
from veduta.formats.tile_glb import NO_SIZE_MM, BuildingRow, buildings_table, schema
from veduta.place.mesh import Mesh
from veduta.place.part import Features, Part

METADATA, MESH_FEATURES = "EXT_structural_metadata", "EXT_mesh_features"
_ALIGNED = 8
"""Columns of tables begin at multiples of eight bytes."""


class _Chunk:
    """The binary chunk of a file as tables are put behind it."""

    def __init__(self, root: dict[str, Any], content: bytes) -> None:
        self._views: list[dict[str, Any]] = root["bufferViews"]
        self.content = bytearray(content)

    def view(self, data: bytes) -> int:
        """Append a column."""
        self.content.extend(b"\0" * (-len(self.content) % _ALIGNED))
        self._views.append({"buffer": 0, "byteOffset": len(self.content), "byteLength": len(data)})
        self.content.extend(data)
        return len(self._views) - 1

    def number(self, own: int) -> int:
        """Views are numbered as they come."""
        return own


def part_tile(part: Part, name: str) -> bytes:
    """The GLB. name: of the thing that all of it belongs to. Lamps are no lights there."""
    glb = glb_bytes(replace(part, lamps=(), notes=()), most_nodes=0, alone=False)
    return _with_tables(glb, part.features, BuildingRow(part.id, name))


def mesh_tile(mesh: Mesh, name: str) -> bytes:
    """The GLB of a mesh. name: as that of `part_tile`."""
    return _with_tables(
        mesh_glb_bytes(mesh, alone=False), mesh.features, BuildingRow(mesh.id, name)
    )


def _with_tables(glb: bytes, features: Features, row: BuildingRow) -> bytes:
    root, content = _opened(glb)
    told = {"featureCount": len(features), "attribute": 0, "propertyTable": 0}
    used = {*root.get("extensionsUsed", ()), METADATA}
    for mesh in root["meshes"]:
        for primitive in mesh["primitives"]:
            if "_FEATURE_ID_0" in primitive["attributes"]:
                used.add(MESH_FEATURES)
                primitive["extensions"] = {MESH_FEATURES: {"featureIds": [told]}}
    for node in root["nodes"]:
        if FEATURES in node.get("extensions", {}):
            node["extensions"][FEATURES] = {"featureIds": [told]}
    root["scenes"][0].pop("extras", None)
    chunk = _Chunk(root, content)
    tables = [_surfaces(features, chunk), buildings_table([row], chunk)]
    root["extensions"] = root.get("extensions", {}) | {
        METADATA: {"schema": schema(()), "propertyTables": tables}
    }
    root["extensionsUsed"] = sorted(used)
    return _closed(root, bytes(chunk.content))


def _surfaces(features: Features, chunk: _Chunk) -> dict[str, Any]:
    """The table of features: class, what they belong to, size, provenance."""
    columns = {
        "class": features.class_code,
        "building": np.zeros(len(features), dtype="<u2"),
        "width": _millimetres(features.width_m),
        "height": _millimetres(features.height_m),
        "provenance": features.provenance_code,
    }
    return {
        "class": "surface",
        "count": len(features),
        "properties": {
            name: {"values": chunk.view(column.tobytes())} for name, column in columns.items()
        },
    }


def _millimetres(size_m: NDArray[np.float64]) -> NDArray[np.uint16]:
    """What is not known has the largest number that can be told."""
    known = np.nan_to_num(size_m, nan=np.inf)
    return np.clip(np.round(known * 1000), 0, NO_SIZE_MM).astype("<u2")


def _opened(glb: bytes) -> tuple[dict[str, Any], bytes]:
    (size,) = struct.unpack_from("<I", glb, 12)
    return json.loads(glb[20 : 20 + size]), glb[28 + size :]


def _closed(root: dict[str, Any], content: bytes) -> bytes:
    content += b"\0" * (-len(content) % 4)
    root["buffers"] = [{"byteLength": len(content)}]
    return glb_container(root, content)
