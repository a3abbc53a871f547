"""A tile's content: glTF 2.0 binary with many buildings, and what each surface is.

Positions are whole numbers (KHR_mesh_quantization), columns are compressed
(EXT_meshopt_compression), pieces that repeat are one mesh with instances
(EXT_mesh_gpu_instancing), all faces are flat (no normals). Each vertex or instance has the number
of its surface (EXT_mesh_features, EXT_instance_features): its row in the property table `surfaces`,
which names the row of its building in the table `buildings` (EXT_structural_metadata). Pictures are
files that tiles share; texture coordinates are whole steps, too (KHR_texture_transform). Axes:
glTF's y-up.
"""

from __future__ import annotations

import itertools
import struct
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

from veduta import _core
from veduta.formats.gltf_bin import glb_container
from veduta.place.semantics import Provenance, SemanticClass

TRANSFORM = "KHR_texture_transform"
LINEAR, LINEAR_MIPMAP, REPEAT = 9729, 9987, 10497
BYTE, UBYTE, SHORT, USHORT, UINT, FLOAT = 5120, 5121, 5122, 5123, 5125, 5126
_SIZES = {BYTE: 1, UBYTE: 1, SHORT: 2, USHORT: 2, UINT: 4, FLOAT: 4}
_WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}
_ARRAY, _ELEMENTS = 34962, 34963
_ROUGHNESS = {SemanticClass.WINDOW: 0.25, SemanticClass.SHOP: 0.2}
COMPRESSION = "EXT_meshopt_compression"
NO_SIZE_MM = 65535
SIZE_SCALE_M = 65.535
"""Sizes are stored as shares of this: a step is a millimetre."""
MOST_SMALL = 65535

Value = str | float | bool


@dataclass(frozen=True)
class BuildingRow:
    """A building of the tile, as the property table has it."""

    id: str
    name: str


class Views(Protocol):
    """Where columns of tables are put."""

    def view(self, data: bytes) -> int:
        """Bytes with a view of their own; returns a number for `number`."""

    def number(self, own: int) -> int:
        """The number in the file of a view."""


class Binary:
    """The binary chunk, its views and accessors.

    Columns of one kind share a view: thousands of small meshes must not cost a view each.
    """

    def __init__(self) -> None:
        self._columns: dict[tuple[int, int | None], bytearray] = {}
        self._own: list[bytes] = []
        self.accessors: list[dict[str, Any]] = []

    def view(self, data: bytes) -> int:
        """Bytes with a view of their own; returns its number among those (from -1 down)."""
        self._own.append(data)
        return -len(self._own)

    def accessor(
        self,
        data: bytes,
        component: int,
        kind: str,
        *,
        stride: int = 0,
        target: int | None = None,
        **more: Any,
    ) -> int:
        """Append a column of tuples; `stride` where they lie farther apart than they are long."""
        size = _SIZES[component] * _WIDTHS[kind]
        key = (stride or (size if target == _ARRAY else -size), target)
        column = self._columns.setdefault(key, bytearray())
        column.extend(b"\0" * (-len(column) % 4))
        self.accessors.append(
            {
                "bufferView": list(self._columns).index(key),
                "byteOffset": len(column),
                "componentType": component,
                "count": len(data) // (stride or size),
                "type": kind,
            }
            | more
        )
        column.extend(data)
        return len(self.accessors) - 1

    def number(self, own: int) -> int:
        """The number in the file of a view that `view` gave, when all columns are there."""
        return len(self._columns) - own - 1

    def chunk(self) -> tuple[bytes, list[dict[str, Any]], list[dict[str, Any]]]:
        """The content, its views and its buffers.

        Columns are compressed: their views name a buffer that is not there, with what it would
        hold, and in the extension where the compressed bytes are.
        """
        content = bytearray()
        views: list[dict[str, Any]] = []
        whole = 0
        for (stride, target), column in self._columns.items():
            column.extend(b"\0" * (-len(column) % 4))
            size = abs(stride)
            is_small = size < 4 or target == _ELEMENTS
            encode = _core.compress_indices if is_small else _core.compress_attributes
            where = _appended(content, encode(bytes(column), size)) | {
                "byteStride": size,
                "count": len(column) // size,
                "mode": "INDICES" if is_small else "ATTRIBUTES",
            }
            view: dict[str, Any] = {
                "buffer": 1,
                "byteOffset": whole,
                "byteLength": len(column),
                "extensions": {COMPRESSION: where},
            }
            whole += len(column)
            if target is not None:
                view["target"] = target
            if stride > 0:
                view["byteStride"] = stride
            views.append(view)
        views += [_appended(content, own) for own in self._own]
        content.extend(b"\0" * (-len(content) % 4))
        buffers: list[dict[str, Any]] = [{"byteLength": len(content)}]
        if self._columns:
            fallback = {COMPRESSION: {"fallback": True}}
            buffers.append({"byteLength": whole, "extensions": fallback})
        return bytes(content), views, buffers


def _appended(content: bytearray, data: bytes) -> dict[str, Any]:
    content.extend(b"\0" * (-len(content) % 8))
    where = {"buffer": 0, "byteOffset": len(content), "byteLength": len(data)}
    content.extend(data)
    return where


def tile_glb(
    buffers: _core.TileBuffers,
    buildings: Sequence[BuildingRow],
    pictures: Sequence[str] = (),
    cut: Collection[int] = (),
    *,
    name: str = "tile",
) -> bytes:
    """The GLB of a tile; the frame is the tile's, y-up.

    pictures: the addresses of textures. cut: the numbers of those that one sees through somewhere.
    """
    binary = Binary()
    low, step = buffers.grid
    extensions = {"KHR_mesh_quantization", "EXT_mesh_features", "EXT_structural_metadata"}
    surfaces = buffers.surfaces
    count = len(surfaces[0])
    meshes: list[dict[str, Any]] = []
    nodes: list[dict[str, Any]] = []
    primitives = [_merged(one, binary, count) for one in buffers.merged]
    if primitives:
        meshes.append({"primitives": primitives})
        nodes.append({"mesh": 0, "translation": list(low), "scale": list(step)})
    for group in _together(buffers.repeated):
        extensions |= {"EXT_mesh_gpu_instancing", "EXT_instance_features"}
        mesh, extension = _repeated(group, binary, count)
        meshes.append(mesh)
        nodes.append(
            {
                "mesh": len(meshes) - 1,
                "scale": [buffers.step_m] * 3,
                "extensions": extension,
            }
        )
    metadata = _metadata(buffers, buildings, binary)
    shown = sorted({number for *_, number in buffers.materials if number is not None})
    if shown:
        extensions.add(TRANSFORM)
    root: dict[str, Any] = {
        "asset": {"version": "2.0", "generator": "veduta"},
        "extensionsUsed": sorted(extensions),
        "extensionsRequired": sorted(
            extensions & {"KHR_mesh_quantization", "EXT_mesh_gpu_instancing", TRANSFORM}
        ),
        "scene": 0,
        "scenes": [{"name": name, "nodes": list(range(len(nodes)))}],
        "nodes": nodes,
        "meshes": meshes,
        "materials": [
            _material(row, shown, buffers.uv_steps.get(number, 1.0), cut)
            for number, row in enumerate(buffers.materials)
        ],
        "extensions": {"EXT_structural_metadata": metadata},
    }
    if shown:
        root["images"] = [{"uri": pictures[number]} for number in shown]
        root["samplers"] = [
            {"magFilter": LINEAR, "minFilter": LINEAR_MIPMAP, "wrapS": REPEAT, "wrapT": REPEAT}
        ]
        root["textures"] = [{"source": place, "sampler": 0} for place in range(len(shown))]
    return packed(root, binary)


def packed(root: Mapping[str, Any], binary: Binary) -> bytes:
    """The file of a document and its binary chunk."""
    content, views, buffers = binary.chunk()
    whole = dict(root) | {
        "bufferViews": views,
        "accessors": binary.accessors,
        "buffers": buffers,
    }
    for name in ("extensionsUsed", "extensionsRequired"):
        whole[name] = sorted({*root[name], COMPRESSION})
    return glb_container(whole, content)


def _merged(
    mesh: tuple[int, bytes, bytes, bytes, list[int], list[int], bytes], binary: Binary, count: int
) -> dict[str, Any]:
    material, positions, features, indices, low, high, uv = mesh
    vertices = len(features) // 4
    component = USHORT if vertices <= MOST_SMALL else UINT
    return {
        "attributes": {
            "POSITION": binary.accessor(
                positions, USHORT, "VEC3", stride=8, target=_ARRAY, min=low, max=high
            ),
            "_FEATURE_ID_0": binary.accessor(features, FLOAT, "SCALAR", target=_ARRAY),
        }
        | _mapped(uv, binary),
        "indices": binary.accessor(indices, component, "SCALAR", target=_ELEMENTS),
        "material": material,
        "extensions": {"EXT_mesh_features": {"featureIds": [_feature_id(count)]}},
    }


def _mapped(uv: bytes, binary: Binary) -> dict[str, int]:
    if not uv:
        return {}
    return {"TEXCOORD_0": binary.accessor(uv, USHORT, "VEC2", target=_ARRAY)}


Repeated = tuple[int, bytes, bytes, list[int], list[int], bytes, bytes, bytes, bytes, bytes]


def _together(repeated: Sequence[Repeated]) -> list[list[Repeated]]:
    """Neighbours with the same instances: the materials of one mesh."""
    return [list(group) for _, group in itertools.groupby(repeated, key=lambda one: one[5:9])]


def _repeated(
    group: Sequence[Repeated], binary: Binary, count: int
) -> tuple[dict[str, Any], dict[str, Any]]:
    primitives = [
        {
            "attributes": {
                "POSITION": binary.accessor(
                    positions, SHORT, "VEC3", stride=8, target=_ARRAY, min=low, max=high
                )
            }
            | _mapped(uv, binary),
            "indices": binary.accessor(indices, USHORT, "SCALAR", target=_ELEMENTS),
            "material": material,
        }
        for material, positions, indices, low, high, *_, uv in group
    ]
    translations, rotations, features, scales = group[0][5:9]
    component = USHORT if count <= MOST_SMALL else FLOAT
    attributes = {
        "TRANSLATION": binary.accessor(translations, FLOAT, "VEC3"),
        "ROTATION": binary.accessor(rotations, SHORT, "VEC4", normalized=True),
    }
    if scales:
        attributes["SCALE"] = binary.accessor(scales, FLOAT, "VEC3")
    attributes["_FEATURE_ID_0"] = binary.accessor(features, component, "SCALAR")
    extension = {
        "EXT_mesh_gpu_instancing": {"attributes": attributes},
        "EXT_instance_features": {"featureIds": [_feature_id(count)]},
    }
    return {"primitives": primitives}, extension


def _feature_id(count: int) -> dict[str, Any]:
    return {"featureCount": count, "attribute": 0, "propertyTable": 0}


Look = tuple[int, int, Sequence[float], float, int | None]


def _material(row: Look, shown: Sequence[int], step: float, cut: Collection[int]) -> dict[str, Any]:
    """row: class, provenance, colour, opacity, picture. step: of texture coordinates. cut: the
    pictures that one sees through somewhere.
    """
    code, known, colour, opacity, picture = row
    semantic, provenance = SemanticClass.of_code(code), list(Provenance)[known]
    shading: dict[str, Any] = {
        "baseColorFactor": [*(linear(channel) for channel in colour), round(opacity, 4)],
        "metallicFactor": 0.0,
        "roughnessFactor": _ROUGHNESS.get(semantic, 0.9),
    }
    if picture is not None:
        shading["baseColorTexture"] = {
            "index": shown.index(picture),
            "extensions": {TRANSFORM: {"scale": [step, step]}},
        }
    made: dict[str, Any] = {"name": semantic.value, "pbrMetallicRoughness": shading}
    if opacity < 1.0:
        made["alphaMode"] = "BLEND"
    elif picture in cut:
        made |= {"alphaMode": "MASK", "alphaCutoff": 0.5, "doubleSided": True}
    if provenance is not Provenance.INVENTED:
        made["extras"] = {"veduta": {"provenance": provenance.value}}
    return made


def linear(srgb: float) -> float:
    """IEC 61966-2-1: glTF's factors are linear."""
    value = srgb / 12.92 if srgb <= 0.04045 else ((srgb + 0.055) / 1.055) ** 2.4
    return round(value, 5)


def _metadata(
    buffers: _core.TileBuffers, buildings: Sequence[BuildingRow], binary: Binary
) -> dict[str, Any]:
    """The schema, and the tables of surfaces and of buildings."""
    names = ["class", "building", "rule", "width", "height", "provenance"]
    if set(buffers.surfaces[5]) <= {Provenance.INVENTED.code}:
        names.remove("provenance")
    columns = [binary.number(binary.view(column)) for column in buffers.surfaces[: len(names)]]
    tables = [
        {
            "class": "surface",
            "count": len(buffers.surfaces[0]),
            "properties": {
                name: {"values": view} for name, view in zip(names, columns, strict=True)
            },
        }
    ]
    tables.append(buildings_table(buildings, binary))
    return {"schema": schema(buffers.rules), "propertyTables": tables}


def buildings_table(buildings: Sequence[BuildingRow], binary: Views) -> dict[str, Any]:
    """The table of buildings: identifier and name."""
    columns = {"id": [row.id for row in buildings], "name": [row.name for row in buildings]}
    properties = {}
    for name, texts in columns.items():
        encoded = [text.encode() for text in texts]
        ends = [0]
        for text in encoded:
            ends.append(ends[-1] + len(text))
        properties[name] = {
            "values": binary.number(binary.view(b"".join(encoded))),
            "stringOffsets": binary.number(binary.view(struct.pack(f"<{len(ends)}I", *ends))),
        }
    return {"class": "building", "count": len(buildings), "properties": properties}


def schema(rules: Sequence[str]) -> dict[str, Any]:
    """What the tables hold: one schema for all tiles but for the names of rules."""
    enums: dict[str, Any] = {
        "semantic": {
            "valueType": "UINT8",
            "values": [{"name": one.value, "value": one.code} for one in SemanticClass],
        }
    }
    enums["provenance"] = {
        "valueType": "UINT8",
        "values": [{"name": one.value, "value": one.code} for one in Provenance],
    }
    if rules:
        enums["rule"] = {
            "valueType": "UINT16",
            "values": [{"name": name, "value": value} for value, name in enumerate(rules)],
        }
    size = {
        "type": "SCALAR",
        "componentType": "UINT16",
        "normalized": True,
        "scale": SIZE_SCALE_M,
        "noData": NO_SIZE_MM,
    }
    surface: dict[str, Any] = {
        "class": {"type": "ENUM", "enumType": "semantic"},
        "building": {
            "description": "row in the table of buildings",
            "type": "SCALAR",
            "componentType": "UINT16",
        },
        "width": {"description": "metres"} | size,
        "height": {"description": "metres"} | size,
    }
    surface["provenance"] = {
        "description": "how it is known",
        "type": "ENUM",
        "enumType": "provenance",
        "default": Provenance.INVENTED.value,
    }
    if rules:
        surface["rule"] = {"type": "ENUM", "enumType": "rule"}
    building = {"id": {"type": "STRING"}, "name": {"type": "STRING"}}
    return {
        "id": "veduta",
        "enums": enums,
        "classes": {
            "surface": {
                "description": "a surface of a building",
                "properties": surface,
            },
            "building": {"properties": building},
        },
    }
