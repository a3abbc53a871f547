"""glTF 2.0 binary: one part as one mesh, with a feature id per face.

glTF is y-up: (x, y, z) of the part becomes (x, z, -y) here and nowhere else. One primitive per
material; faces have flat normals; no vertex is shared between features. The feature table is in
`scenes[0].extras.veduta.features` as columns. A texture's mask of invented pixels is an image
of its own (PNG, white = invented) that the material names in `extras.veduta.invented_mask`.
Meshes that stand many times are nodes of their own (`gltf_instances`), and so is what moves
(`gltf_movers`), lamps and the sun (`gltf_lights`). Tours are cameras that move (`gltf_camera`).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from veduta.formats.gltf_bin import GltfBin, glb_container, y_up
from veduta.formats.gltf_camera import add_camera
from veduta.formats.gltf_instances import MOST_NODES, add_instances
from veduta.formats.gltf_lights import add_lights, add_sun
from veduta.formats.gltf_movers import add_movers
from veduta.formats.gltf_read import read_glb
from veduta.imaging.encode import jpeg_bytes, mask_bytes
from veduta.place.camera_path import CameraPath
from veduta.place.material import Texture
from veduta.place.mover import Vector
from veduta.place.part import Features, Part
from veduta.place.sunlight import Sunlight
from veduta.run.atomic import write_bytes

__all__ = ["feature_columns", "glb_bytes", "read_glb", "write_glb"]

JPEG_QUALITY = 90
UNLIT = "KHR_materials_unlit"
_LINEAR, _LINEAR_MIPMAP_LINEAR, _CLAMP, _REPEAT = 9729, 9987, 33071, 10497
_BESIDE_UV = 1e-3


def write_glb(
    part: Part, path: Path, tours: Sequence[CameraPath] = (), sun: Sunlight | None = None
) -> None:
    """Write the part, tours through it and the sun; the file appears whole or not at all."""
    write_bytes(path, glb_bytes(part, tours, sun))


def glb_bytes(
    part: Part,
    tours: Sequence[CameraPath] = (),
    sun: Sunlight | None = None,
    most_nodes: int = MOST_NODES,
) -> bytes:
    """The part, the tours through it and the sun that shines on it, as a GLB file's content.

    most_nodes: more instances than that are written with EXT_mesh_gpu_instancing.
    """
    binary = GltfBin()
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
        "nodes": [{"name": part.id}],
        "meshes": [],
        "materials": [],
    }
    materials = _Materials(root, part, binary)

    def primitives_of(chosen: NDArray[np.bool_], about_m: Vector) -> list[dict[str, Any]]:
        return _primitives(part, chosen, about_m, materials, binary)

    still = _still(part)
    if still.any():
        root["nodes"][0]["mesh"] = 0
        root["meshes"].append({"primitives": primitives_of(still, (0.0, 0.0, 0.0))})
    add_movers(root, part, primitives_of, binary)
    add_lights(root, part)
    if sun is not None:
        add_sun(root, sun)
    if part.instances is not None:
        add_instances(root, part.instances, materials.number, binary, most_nodes)
    for tour in tours:
        add_camera(root, tour, binary)
    root["bufferViews"] = binary.views
    root["accessors"] = binary.accessors
    binary.content.extend(b"\0" * (-len(binary.content) % 4))
    root["buffers"] = [{"byteLength": len(binary.content)}]
    return glb_container(root, bytes(binary.content))


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


class _Materials:
    """The materials of the file: those of the part that are used, in the order of use."""

    def __init__(self, root: dict[str, Any], part: Part, binary: GltfBin) -> None:
        self._root, self._part, self._binary = root, part, binary
        self._number_of: dict[int, int] = {}
        self._images: dict[Texture, tuple[int, int]] = {}

    def number(self, row: int) -> int:
        """The number in the file of a material of the part."""
        if row not in self._number_of:
            entry = self._entry(row)
            self._number_of[row] = len(self._number_of)
            self._root["materials"].append(entry)
        return self._number_of[row]

    def _entry(self, row: int) -> dict[str, Any]:
        material = self._part.materials[row]
        shading: dict[str, Any] = {
            "baseColorFactor": [
                *(_linear(channel) for channel in material.colour),
                material.opacity,
            ],
            "metallicFactor": material.metalness,
            "roughnessFactor": material.roughness,
        }
        entry: dict[str, Any] = {"name": material.name, "pbrMetallicRoughness": shading}
        if material.opacity < 1.0:
            entry["alphaMode"] = "BLEND"
        if material.glow > 0.0:
            entry["emissiveFactor"] = [
                round(material.glow * _linear(channel), 6) for channel in material.colour
            ]
        if material.texture is not None:
            image, invented = self._pictures(material.texture)
            shading["baseColorTexture"] = {"index": self._texture(image, _wrap(self._part, row))}
            entry["extras"] = {"veduta": {"invented_mask": invented}}
        if material.unlit:
            entry["extensions"] = {UNLIT: {}}
            if UNLIT not in self._root.setdefault("extensionsUsed", []):
                self._root["extensionsUsed"].append(UNLIT)
        return entry

    def _pictures(self, texture: Texture) -> tuple[int, int]:
        """The images of a texture and of its mask: once in the file, whatever colours it has."""
        if texture not in self._images:
            image = _image(self._root, _jpeg(texture), "image/jpeg", self._binary)
            invented = _image(self._root, _mask_png(texture), "image/png", self._binary)
            self._images[texture] = (image, invented)
        return self._images[texture]

    def _texture(self, image: int, wrap: int) -> int:
        """The number of the texture with this image and wrapping."""
        samplers = self._root.setdefault("samplers", [])
        sampler = {
            "magFilter": _LINEAR,
            "minFilter": _LINEAR_MIPMAP_LINEAR,
            "wrapS": wrap,
            "wrapT": wrap,
        }
        if sampler not in samplers:
            samplers.append(sampler)
        textures: list[dict[str, Any]] = self._root.setdefault("textures", [])
        told = {"source": image, "sampler": samplers.index(sampler)}
        if told not in textures:
            textures.append(told)
        return textures.index(told)


def _still(part: Part) -> NDArray[np.bool_]:
    """(p,) the polygons that do not move."""
    still = np.ones(len(part.polygon_feature), dtype=np.bool_)
    for mover in part.movers:
        still[mover.polygons] = False
    return still


def _primitives(
    part: Part,
    chosen_polygons: NDArray[np.bool_],
    about_m: Vector,
    materials: _Materials,
    binary: GltfBin,
) -> list[dict[str, Any]]:
    """One primitive for each material that the chosen polygons have; corners are about a point."""
    triangles = part.triangles
    places = part.positions_m - np.array(about_m, dtype=np.float32)
    is_chosen = chosen_polygons[triangles.polygon]
    normal = _vertex_normals(part)
    feature = _vertex_features(part)
    material_of_triangle = part.polygon_material[triangles.polygon]
    primitives: list[dict[str, Any]] = []
    for number, material in enumerate(part.materials):
        chosen = triangles.indices[is_chosen & (material_of_triangle == number)]
        if len(chosen) == 0:
            continue
        used, indices = np.unique(chosen, return_inverse=True)
        attributes = {
            "POSITION": binary.add_array(y_up(places[used]), "VEC3", bounds=True),
            "NORMAL": binary.add_array(y_up(normal[used]), "VEC3"),
            "_FEATURE_ID_0": binary.add_array(feature[used], "SCALAR"),
        }
        if material.texture is not None:
            attributes["TEXCOORD_0"] = binary.add_array(part.uv[used], "VEC2")
        primitives.append(
            {
                "attributes": attributes,
                "indices": binary.add_array(indices.reshape(-1).astype(np.uint32), "SCALAR"),
                "material": materials.number(number),
            }
        )
    return primitives


def _polygon_of_vertex(part: Part) -> NDArray[np.int64]:
    first_vertex = part.ring_offsets[part.polygon_offsets]
    return np.repeat(np.arange(len(part.polygon_feature)), np.diff(first_vertex))


def _vertex_normals(part: Part) -> NDArray[np.float32]:
    return part.triangles.polygon_normal[_polygon_of_vertex(part)].astype(np.float32)


def _vertex_features(part: Part) -> NDArray[np.float32]:
    """Feature ids are floats in glTF: integers up to 2^24 are exact."""
    return part.polygon_feature[_polygon_of_vertex(part)].astype(np.float32)


def _wrap(part: Part, row: int) -> int:
    """A texture is repeated where surfaces of its material ask for more than it has.

    What stands many times has coordinates in repeats.
    """
    groups = part.instances.groups if part.instances is not None else ()
    if any(row in group.materials for group in groups):
        return _REPEAT
    corners = np.repeat(part.polygon_material, np.diff(part.ring_offsets[part.polygon_offsets]))
    uv = part.uv[corners == row]
    beside = (uv < -_BESIDE_UV) | (uv > 1.0 + _BESIDE_UV)
    return _REPEAT if beside.any() else _CLAMP


def _linear(srgb: float) -> float:
    """IEC 61966-2-1: glTF's factors are linear."""
    value = srgb / 12.92 if srgb <= 0.04045 else ((srgb + 0.055) / 1.055) ** 2.4
    return round(value, 6)


def _image(root: dict[str, Any], data: bytes, mime: str, binary: GltfBin) -> int:
    images = root.setdefault("images", [])
    images.append({"bufferView": binary.add(data), "mimeType": mime})
    return len(images) - 1


@lru_cache(maxsize=32)
def _jpeg(texture: Texture) -> bytes:
    """Encoded once for all models of a process."""
    return jpeg_bytes(texture.pixels, JPEG_QUALITY, optimize=True)


@lru_cache(maxsize=32)
def _mask_png(texture: Texture) -> bytes:
    return mask_bytes(texture.invented)
