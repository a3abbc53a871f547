"""A tile of ground: one surface, triangles between places whose heights are known."""

from __future__ import annotations

import struct
from typing import Any

import numpy as np
from numpy.typing import NDArray

from veduta.formats.tile_glb import (
    FLOAT,
    UINT,
    Binary,
    BuildingRow,
    buildings_table,
    linear,
    packed,
    schema,
)
from veduta.place.semantics import SemanticClass

_ARRAY, _ELEMENTS = 34962, 34963
_COLOUR = (0.81, 0.8, 0.77)
_NO_SIZE = 65535
_ROW = BuildingRow("ground", "Ground")


def ground_glb(points_m: NDArray[np.float64], triangles: NDArray[np.int32]) -> bytes:
    """The GLB of (n, 3) points (m, z up) and (m, 3) triangles, counter-clockwise from above."""
    binary = Binary()
    places = np.column_stack([points_m[:, 0], points_m[:, 2], -points_m[:, 1]]).astype("<f4")
    low, high = places.min(axis=0).tolist(), places.max(axis=0).tolist()
    primitive = {
        "attributes": {
            "POSITION": binary.accessor(
                places.tobytes(), FLOAT, "VEC3", target=_ARRAY, min=low, max=high
            ),
            "_FEATURE_ID_0": binary.accessor(
                np.zeros(len(places), dtype="<f4").tobytes(), FLOAT, "SCALAR", target=_ARRAY
            ),
        },
        "indices": binary.accessor(
            triangles.astype("<u4").tobytes(), UINT, "SCALAR", target=_ELEMENTS
        ),
        "material": 0,
        "extensions": {
            "EXT_mesh_features": {
                "featureIds": [{"featureCount": 1, "attribute": 0, "propertyTable": 0}]
            }
        },
    }
    root: dict[str, Any] = {
        "asset": {"version": "2.0", "generator": "veduta"},
        "extensionsUsed": ["EXT_mesh_features", "EXT_structural_metadata"],
        "extensionsRequired": [],
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [primitive]}],
        "materials": [
            {
                "name": SemanticClass.GROUND.value,
                "pbrMetallicRoughness": {
                    "baseColorFactor": [*(linear(channel) for channel in _COLOUR), 1.0],
                    "metallicFactor": 0.0,
                    "roughnessFactor": 0.95,
                },
            }
        ],
        "extensions": {"EXT_structural_metadata": _metadata(binary)},
    }
    return packed(root, binary)


def _metadata(binary: Binary) -> dict[str, Any]:
    columns = {
        "class": struct.pack("<B", SemanticClass.GROUND.code),
        "building": struct.pack("<H", 0),
        "width": struct.pack("<H", _NO_SIZE),
        "height": struct.pack("<H", _NO_SIZE),
    }
    surfaces = {
        "class": "surface",
        "count": 1,
        "properties": {
            name: {"values": binary.number(binary.view(column))} for name, column in columns.items()
        },
    }
    return {"schema": schema(()), "propertyTables": [surfaces, buildings_table([_ROW], binary)]}
