"""glTF 2.0 binary: one part as one mesh, with a feature id per face.

glTF is y-up: (x, y, z) of the part becomes (x, z, -y) here and nowhere else. One primitive per
material; faces have flat normals; no vertex is shared between features. The feature table is in
`scenes[0].extras.veduta.features` as columns. A texture's mask of invented pixels is an image
of its own (PNG, white = invented) that the material names in `extras.veduta.invented_mask`.
"""

from __future__ import annotations

import io
import json
import math
import struct
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from veduta.formats.gltf_read import read_glb
from veduta.place.material import Material
from veduta.place.part import Features, Part
from veduta.run.atomic import write_bytes

__all__ = ["feature_columns", "glb_bytes", "read_glb", "write_glb"]

JPEG_QUALITY = 90
_FLOAT, _UINT = 5126, 5125
_ARRAY_BUFFER, _ELEMENT_ARRAY_BUFFER = 34962, 34963
_LINEAR, _LINEAR_MIPMAP_LINEAR, _CLAMP, _REPEAT = 9729, 9987, 33071, 10497
_BESIDE_UV = 1e-3
_JSON_CHUNK, _BIN_CHUNK = 0x4E4F534A, 0x004E4942


class _Bin:
    """The binary chunk and the views into it."""

    def __init__(self) -> None:
        self.content = bytearray()
        self.views: list[dict[str, Any]] = []
        self.accessors: list[dict[str, Any]] = []

    def add(self, data: bytes, target: int | None = None) -> int:
        """Append bytes at a multiple of four; returns the buffer view."""
        self.content.extend(b"\0" * (-len(self.content) % 4))
        view = {"buffer": 0, "byteOffset": len(self.content), "byteLength": len(data)}
        if target is not None:
            view["target"] = target
        self.content.extend(data)
        self.views.append(view)
        return len(self.views) - 1

    def add_array(
        self, values: NDArray[np.float32] | NDArray[np.uint32], kind: str, *, bounds: bool = False
    ) -> int:
        """Append an array; returns the accessor."""
        is_index = values.dtype == np.uint32
        target = _ELEMENT_ARRAY_BUFFER if is_index else _ARRAY_BUFFER
        accessor: dict[str, Any] = {
            "bufferView": self.add(np.ascontiguousarray(values).tobytes(), target),
            "componentType": _UINT if is_index else _FLOAT,
            "count": len(values),
            "type": kind,
        }
        if bounds:
            accessor["min"] = values.min(axis=0).tolist()
            accessor["max"] = values.max(axis=0).tolist()
        self.accessors.append(accessor)
        return len(self.accessors) - 1


def write_glb(part: Part, path: Path) -> None:
    """Write the part; the file appears whole or not at all."""
    write_bytes(path, glb_bytes(part))


def glb_bytes(part: Part) -> bytes:
    """The part as a GLB file's content."""
    binary = _Bin()
    root: dict[str, Any] = {
        "asset": {"version": "2.0", "generator": "veduta"},
        "scene": 0,
        "scenes": [
            {
                "nodes": [0],
                "extras": {
                    "veduta": {
                        "features": feature_columns(part),
                        "attributes": dict(part.attributes),
                        "notes": list(part.notes),
                    }
                },
            }
        ],
        "nodes": [{"mesh": 0, "name": part.id}],
        "meshes": [{"primitives": []}],
    }
    _add_primitives(root, part, binary)
    root["bufferViews"] = binary.views
    root["accessors"] = binary.accessors
    binary.content.extend(b"\0" * (-len(binary.content) % 4))
    root["buffers"] = [{"byteLength": len(binary.content)}]
    text = json.dumps(root, separators=(",", ":"), allow_nan=False).encode()
    text += b" " * (-len(text) % 4)
    total = 12 + 8 + len(text) + 8 + len(binary.content)
    return b"".join(
        (
            struct.pack("<4sII", b"glTF", 2, total),
            struct.pack("<II", len(text), _JSON_CHUNK),
            text,
            struct.pack("<II", len(binary.content), _BIN_CHUNK),
            bytes(binary.content),
        )
    )


def feature_columns(part: Part) -> dict[str, list[Any]]:
    """The feature table as JSON columns; NaN becomes null."""
    features: Features = part.features
    rows = range(len(features))
    return {
        "id": list(features.id),
        "class": [features.semantic(row).value for row in rows],
        "parent": features.parent.tolist(),
        "provenance": [features.provenance(row).value for row in rows],
        "name": list(features.name),
        "width_m": [_rounded(value) for value in features.width_m.tolist()],
        "height_m": [_rounded(value) for value in features.height_m.tolist()],
        "area_m2": [_rounded(value) for value in part.feature_area_m2.tolist()],
        "photo_px": [
            None if math.isnan(rect[0]) else [_rounded(value) for value in rect]
            for rect in features.photo_px.tolist()
        ],
        "seen_height_m": [_rounded(value) for value in features.seen_height_m.tolist()],
        "shell": features.shell.tolist(),
    }


def _rounded(value: float) -> float | None:
    return None if math.isnan(value) else round(value, 4)


def _add_primitives(root: dict[str, Any], part: Part, binary: _Bin) -> None:
    """One primitive and one material for each material of the part that is used."""
    triangles = part.triangles
    normal = _vertex_normals(part)
    feature = _vertex_features(part)
    material_of_triangle = part.polygon_material[triangles.polygon]
    materials: list[dict[str, Any]] = []
    for number, material in enumerate(part.materials):
        chosen = triangles.indices[material_of_triangle == number]
        if len(chosen) == 0:
            continue
        used, indices = np.unique(chosen, return_inverse=True)
        attributes = {
            "POSITION": binary.add_array(_y_up(part.positions_m[used]), "VEC3", bounds=True),
            "NORMAL": binary.add_array(_y_up(normal[used]), "VEC3"),
            "_FEATURE_ID_0": binary.add_array(feature[used], "SCALAR"),
        }
        if material.texture is not None:
            attributes["TEXCOORD_0"] = binary.add_array(part.uv[used], "VEC2")
        root["meshes"][0]["primitives"].append(
            {
                "attributes": attributes,
                "indices": binary.add_array(indices.reshape(-1).astype(np.uint32), "SCALAR"),
                "material": len(materials),
            }
        )
        materials.append(_material(root, material, binary, _wrap(part.uv[used])))
    root["materials"] = materials


def _y_up(vectors: NDArray[np.float32]) -> NDArray[np.float32]:
    """(x, y, z) with z up to glTF's (x, z, -y); no negative zeros."""
    return np.stack([vectors[:, 0], vectors[:, 2], -vectors[:, 1]], axis=1) + np.float32(0.0)


def _polygon_of_vertex(part: Part) -> NDArray[np.int64]:
    first_vertex = part.ring_offsets[part.polygon_offsets]
    return np.repeat(np.arange(len(part.polygon_feature)), np.diff(first_vertex))


def _vertex_normals(part: Part) -> NDArray[np.float32]:
    return part.triangles.polygon_normal[_polygon_of_vertex(part)].astype(np.float32)


def _vertex_features(part: Part) -> NDArray[np.float32]:
    """Feature ids are floats in glTF: integers up to 2^24 are exact."""
    return part.polygon_feature[_polygon_of_vertex(part)].astype(np.float32)


def _wrap(uv: NDArray[np.float32]) -> int:
    """A texture is repeated where surfaces ask for more than it has."""
    low, high = float(uv.min()), float(uv.max())
    return _REPEAT if low < -_BESIDE_UV or high > 1.0 + _BESIDE_UV else _CLAMP


def _material(root: dict[str, Any], material: Material, binary: _Bin, wrap: int) -> dict[str, Any]:
    shading: dict[str, Any] = {
        "baseColorFactor": [*(_linear(channel) for channel in material.colour), 1.0],
        "metallicFactor": material.metalness,
        "roughnessFactor": material.roughness,
    }
    entry: dict[str, Any] = {"name": material.name, "pbrMetallicRoughness": shading}
    if material.texture is not None:
        image = _image(root, _encoded(material.texture.pixels, "JPEG"), "image/jpeg", binary)
        mask = material.texture.invented.astype(np.uint8) * 255
        invented = _image(root, _encoded(mask, "PNG"), "image/png", binary)
        root.setdefault("samplers", []).append(
            {
                "magFilter": _LINEAR,
                "minFilter": _LINEAR_MIPMAP_LINEAR,
                "wrapS": wrap,
                "wrapT": wrap,
            }
        )
        textures = root.setdefault("textures", [])
        textures.append({"source": image, "sampler": len(root["samplers"]) - 1})
        shading["baseColorTexture"] = {"index": len(textures) - 1}
        entry["extras"] = {"veduta": {"invented_mask": invented}}
    return entry


def _linear(srgb: float) -> float:
    """IEC 61966-2-1: glTF's factors are linear."""
    value = srgb / 12.92 if srgb <= 0.04045 else ((srgb + 0.055) / 1.055) ** 2.4
    return round(value, 6)


def _image(root: dict[str, Any], data: bytes, mime: str, binary: _Bin) -> int:
    images = root.setdefault("images", [])
    images.append({"bufferView": binary.add(data), "mimeType": mime})
    return len(images) - 1


def _encoded(pixels: NDArray[np.uint8], form: str) -> bytes:
    memory = io.BytesIO()
    image = Image.fromarray(pixels)
    if form == "JPEG":
        image.save(memory, "JPEG", quality=JPEG_QUALITY, optimize=True)
    else:
        image.convert("1").save(memory, "PNG")
    return memory.getvalue()
