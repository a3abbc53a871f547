"""A tile of one class in one colour: its document, its material and its table of surfaces.

`tile_glb` writes what the engine packs; this writes what is plainer: boxes seen from afar, the
ground. Each surface is a thing of its own, row by row with the table of buildings.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from veduta.formats.tile_glb import (
    NO_SIZE_MM,
    Binary,
    BuildingRow,
    buildings_table,
    linear,
    packed,
    schema,
)
from veduta.place.material import Colour
from veduta.place.semantics import SemanticClass

METADATA = "EXT_structural_metadata"


@dataclass(frozen=True)
class PlainLook:
    """What all surfaces of a tile are: their class, their colour (sRGB), glTF's roughness."""

    semantic: SemanticClass
    colour: Colour
    roughness: float


def feature_ids(count: int) -> list[dict[str, int]]:
    """The feature ids of `count` surfaces, in the first attribute of that name."""
    return [{"featureCount": count, "attribute": 0, "propertyTable": 0}]


def plain_tile(
    look: PlainLook,
    rows: Sequence[BuildingRow],
    sizes_m: NDArray[np.float64],
    primitive: Mapping[str, Any],
    binary: Binary,
    *,
    node: Mapping[str, Any] | None = None,
    used: Collection[str],
    required: Collection[str] = (),
) -> bytes:
    """The GLB of a mesh with one primitive.

    sizes_m: (n, 2) width and height of the surfaces, one for each of `rows`; NaN where it has none.
    node: what the mesh's node has besides. used, required: the extensions of primitive and node.
    """
    root: dict[str, Any] = {
        "asset": {"version": "2.0", "generator": "veduta"},
        "extensionsUsed": [*used, *required, METADATA],
        "extensionsRequired": list(required),
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0, **(node or {})}],
        "meshes": [{"primitives": [{**primitive, "material": 0}]}],
        "materials": [_material(look)],
        "extensions": {METADATA: _metadata(look, rows, sizes_m, binary)},
    }
    return packed(root, binary)


def _material(look: PlainLook) -> dict[str, Any]:
    return {
        "name": look.semantic.value,
        "pbrMetallicRoughness": {
            "baseColorFactor": [*(linear(channel) for channel in look.colour), 1.0],
            "metallicFactor": 0.0,
            "roughnessFactor": look.roughness,
        },
    }


def _metadata(
    look: PlainLook, rows: Sequence[BuildingRow], sizes_m: NDArray[np.float64], binary: Binary
) -> dict[str, Any]:
    """The schema, and the tables of surfaces and of what they belong to."""
    count = len(rows)
    columns = {
        "class": np.full(count, look.semantic.code, dtype=np.uint8),
        "building": np.arange(count, dtype="<u2"),
        "width": _millimetres(sizes_m[:, 0]),
        "height": _millimetres(sizes_m[:, 1]),
    }
    surfaces = {
        "class": "surface",
        "count": count,
        "properties": {
            name: {"values": binary.number(binary.view(column.tobytes()))}
            for name, column in columns.items()
        },
    }
    return {"schema": schema(()), "propertyTables": [surfaces, buildings_table(rows, binary)]}


def _millimetres(sizes_m: NDArray[np.float64]) -> NDArray[np.uint16]:
    """What cannot be told in 16 bits has the largest number that can."""
    known = np.nan_to_num(sizes_m, nan=np.inf)
    return np.clip(np.round(known * 1000), 0, NO_SIZE_MM).astype("<u2")
