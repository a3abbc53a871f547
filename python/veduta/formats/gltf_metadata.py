"""Feature tables in glTF: EXT_structural_metadata, and EXT_mesh_features that refer to them.

https://github.com/CesiumGS/glTF/tree/3d-tiles-next/extensions/2.0/Vendor/EXT_structural_metadata -
one property table per part; a row is a feature with its id, name, class, provenance, parent (a row
of the same table), size and area. Strings are UTF-8 with offsets. Columns begin at multiples of
eight bytes.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from veduta.formats.gltf_bin import GltfBin
from veduta.place.part import NO_PARENT, Features
from veduta.place.semantics import Provenance, SemanticClass

METADATA, MESH_FEATURES = "EXT_structural_metadata", "EXT_mesh_features"
INSTANCE_FEATURES = "EXT_instance_features"
FEATURE_ROW = "_FEATURE_ID_0"
_ALIGNED = 8
_UNKNOWN = -1.0
"""A length or an area that is not known."""


def schema() -> dict[str, Any]:
    """What a row of the tables says."""
    return {
        "id": "veduta_place",
        "name": "Features of a place",
        "version": "1",
        "classes": {"feature": {"name": "Surface or thing", "properties": _properties()}},
        "enums": {
            "class": _enum([one.value for one in SemanticClass]),
            "provenance": _enum([one.value for one in Provenance]),
        },
    }


def _properties() -> dict[str, Any]:
    text = {"type": "STRING", "required": True}
    size = {"type": "SCALAR", "componentType": "FLOAT32", "noData": _UNKNOWN}
    return {
        "id": {"name": "Stable id", "semantic": "ID", **text},
        "name": {"name": "Name", "semantic": "NAME", **text},
        "class": {"name": "Class", "type": "ENUM", "enumType": "class", "required": True},
        "provenance": {
            "name": "measured, inferred or invented",
            "type": "ENUM",
            "enumType": "provenance",
            "required": True,
        },
        "parent": {
            "name": "Row of the feature that it lies in",
            "type": "SCALAR",
            "componentType": "INT32",
            "noData": NO_PARENT,
        },
        "width_m": {"name": "Size along the surface (m)", **size},
        "height_m": {"name": "Size up the surface (m)", **size},
        "area_m2": {"name": "Area (m2)", **size},
    }


def _enum(names: Sequence[str]) -> dict[str, Any]:
    values = [{"name": name, "value": code} for code, name in enumerate(names)]
    return {"valueType": "UINT8", "values": values}


def property_table(
    part_id: str, features: Features, area_m2: NDArray[np.float64], binary: GltfBin
) -> dict[str, Any]:
    """The table of a part, its columns put into the binary chunk."""
    return {
        "name": part_id,
        "class": "feature",
        "count": len(features),
        "properties": {
            "id": _text_column(features.id, binary),
            "name": _text_column(features.name, binary),
            "class": {"values": _view(features.class_code.astype("u1"), binary)},
            "provenance": {"values": _view(features.provenance_code.astype("u1"), binary)},
            "parent": {"values": _view(features.parent.astype("<i4"), binary)},
            "width_m": {"values": _view(_sizes(features.width_m), binary)},
            "height_m": {"values": _view(_sizes(features.height_m), binary)},
            "area_m2": {"values": _view(_sizes(area_m2), binary)},
        },
    }


def describe(
    root: dict[str, Any],
    part_id: str,
    features: Features,
    area_m2: NDArray[np.float64],
    binary: GltfBin,
) -> None:
    """Tell other programs what the vertices and the instances of a part's document are.

    The table goes behind the geometry. What stands many times as plain nodes has its row in their
    extras: the extension has no word for a node.
    """
    if len(features) == 0:
        return
    told = feature_ids(len(features), 0)
    primitives = [piece for mesh in root["meshes"] for piece in mesh["primitives"]]
    described = [piece for piece in primitives if FEATURE_ROW in piece["attributes"]]
    for piece in described:
        piece.setdefault("extensions", {})[MESH_FEATURES] = told
    for node in root["nodes"]:
        if INSTANCE_FEATURES in node.get("extensions", {}):
            node["extensions"][INSTANCE_FEATURES] = told
    table = property_table(part_id, features, area_m2, binary)
    root.setdefault("extensions", {})[METADATA] = {"schema": schema(), "propertyTables": [table]}
    used = root.setdefault("extensionsUsed", [])
    used += [METADATA, MESH_FEATURES] if described else [METADATA]


def feature_ids(count: int, table: int) -> dict[str, Any]:
    """The extension of a primitive whose vertices have the rows of a table (`_FEATURE_ID_0`)."""
    return {"featureIds": [{"featureCount": count, "attribute": 0, "propertyTable": table}]}


def _text_column(texts: Sequence[str], binary: GltfBin) -> dict[str, Any]:
    encoded = [text.encode() for text in texts]
    offsets = np.cumsum([0, *(len(text) for text in encoded)]).astype("<u4")
    # A view may not be empty.
    return {
        "values": _aligned(b"".join(encoded) or b"\0", binary),
        "stringOffsets": _view(offsets, binary),
        "stringOffsetType": "UINT32",
    }


def _sizes(values: NDArray[np.float64]) -> NDArray[np.float32]:
    return np.nan_to_num(values, nan=_UNKNOWN).astype("<f4")


def _view(column: NDArray[Any], binary: GltfBin) -> int:
    return _aligned(np.ascontiguousarray(column).tobytes(), binary)


def _aligned(data: bytes, binary: GltfBin) -> int:
    binary.content.extend(b"\0" * (-len(binary.content) % _ALIGNED))
    return binary.add(data)
