"""glTF 2.0 binary: one part as one mesh, with a feature id per face.

glTF is y-up: (x, y, z) of the part becomes (x, z, -y) here and nowhere else. One primitive per
material; faces have flat normals; no vertex is shared between features. The feature table is in
`scenes[0].extras.veduta.features` as columns, and for other programs as `gltf_metadata` says.
Images are named by their digests. A texture's mask of invented pixels is an image of its own (PNG,
white = invented) that the material names in `extras.veduta.invented_mask`; where all pixels are
alike, `extras.veduta.invented` tells.
Meshes that stand many times are nodes of their own (`gltf_instances`), and so is what moves
(`gltf_movers`), lamps and the sun (`gltf_lights`). Tours are cameras that move (`gltf_camera`).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from veduta.formats.gltf_bin import GltfBin, glb_container, y_up
from veduta.formats.gltf_camera import add_camera
from veduta.formats.gltf_instances import MOST_NODES, add_instances
from veduta.formats.gltf_lights import add_lights, add_sun
from veduta.formats.gltf_materials import CLAMP, REPEAT, GltfMaterials
from veduta.formats.gltf_metadata import describe
from veduta.formats.gltf_movers import add_movers
from veduta.formats.gltf_read import read_glb
from veduta.formats.known_values import known
from veduta.place.camera_path import CameraPath
from veduta.place.material import Material
from veduta.place.mesh import Mesh
from veduta.place.mover import Vector
from veduta.place.part import Features, Part
from veduta.place.semantics import SemanticClass
from veduta.place.sunlight import Sunlight
from veduta.run.atomic import write_bytes

__all__ = ["feature_columns", "glb_bytes", "read_glb", "write_glb"]

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
    *,
    alone: bool = True,
) -> bytes:
    """The part, the tours through it and the sun that shines on it, as a GLB file's content.

    most_nodes: more instances than that are written with EXT_mesh_gpu_instancing.
    alone: with materials of each class and the table of `gltf_metadata`; not where it becomes a
    piece of a file that has them for the whole.
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
                        "attributes": known(part.attributes),
                        "notes": list(part.notes),
                    }
                },
            }
        ],
        "nodes": [{"name": part.id}],
        "meshes": [],
        "materials": [],
    }
    own = part.features.class_code
    classes = own if alone else np.zeros_like(own)
    materials = GltfMaterials(root, part.materials, lambda row: _wrap(part, row), binary)

    def primitives_of(chosen: NDArray[np.bool_], about_m: Vector) -> list[dict[str, Any]]:
        return _primitives(part, classes, chosen, about_m, materials, binary)

    still = _still(part)
    if still.any():
        root["nodes"][0]["mesh"] = 0
        root["meshes"].append({"primitives": primitives_of(still, (0.0, 0.0, 0.0))})
    add_movers(root, part, primitives_of, binary)
    add_lights(root, part)
    if sun is not None:
        add_sun(root, sun)
    if part.instances is not None:

        def material_of(row: int, feature: int) -> int:
            return materials.number(row, int(classes[feature]))

        add_instances(root, part.instances, material_of, binary, most_nodes)
    for tour in tours:
        add_camera(root, tour, binary)
    if alone:
        describe(root, part.id, part.features, part.feature_area_m2, binary)
    root["bufferViews"] = binary.views
    root["accessors"] = binary.accessors
    binary.content.extend(b"\0" * (-len(binary.content) % 4))
    root["buffers"] = [{"byteLength": len(binary.content)}]
    return glb_container(root, bytes(binary.content))


def feature_columns(part: Part | Mesh) -> dict[str, list[Any]]:
    """The feature table as JSON columns; NaN becomes null. Scores only where one is said."""
    features: Features = part.features
    rows = range(len(features))
    scores = [_rounded(value) for value in features.score.tolist()]
    said = any(value is not None for value in scores)
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
        **({"score": scores} if said else {}),
        "shell": features.shell.tolist(),
    }


def _rounded(value: float) -> float | None:
    return None if math.isnan(value) else round(value, 4)


def _still(part: Part) -> NDArray[np.bool_]:
    """(p,) the polygons that do not move."""
    still = np.ones(len(part.polygon_feature), dtype=np.bool_)
    for mover in part.movers:
        still[mover.polygons] = False
    return still


def _primitives(
    part: Part,
    classes: NDArray[np.uint8],
    chosen_polygons: NDArray[np.bool_],
    about_m: Vector,
    materials: GltfMaterials,
    binary: GltfBin,
) -> list[dict[str, Any]]:
    """One primitive for each material and class of the chosen polygons; corners about a point."""
    triangles = part.triangles
    places = part.positions_m - np.array(about_m, dtype=np.float32)
    is_chosen = chosen_polygons[triangles.polygon]
    normal = _vertex_normals(part)
    feature = _vertex_features(part)
    material_of = part.polygon_material[triangles.polygon]
    class_of = classes[part.polygon_feature[triangles.polygon]]
    primitives: list[dict[str, Any]] = []
    for number, code in looks(material_of[is_chosen], class_of[is_chosen], part.materials):
        chosen = triangles.indices[is_chosen & (material_of == number) & (class_of == code)]
        used, indices = np.unique(chosen, return_inverse=True)
        attributes = {
            "POSITION": binary.add_array(y_up(places[used]), "VEC3", bounds=True),
            "NORMAL": binary.add_array(y_up(normal[used]), "VEC3"),
            "_FEATURE_ID_0": binary.add_array(feature[used], "SCALAR"),
        }
        if part.materials[number].texture is not None:
            attributes["TEXCOORD_0"] = binary.add_array(part.uv[used], "VEC2")
        primitives.append(
            {
                "attributes": attributes,
                "indices": binary.add_array(indices.reshape(-1).astype(np.uint32), "SCALAR"),
                "material": materials.number(number, code),
            }
        )
    return primitives


def looks(
    material: NDArray[np.int32], semantic: NDArray[np.uint8], materials: Sequence[Material]
) -> list[tuple[int, int]]:
    """The pairs of material and class that there are; the class that a material is named after is
    the first of its own.
    """
    found = np.unique(np.column_stack([material, semantic]).astype(np.int64), axis=0)
    return sorted(
        ((number, code) for number, code in found.tolist()),
        key=lambda look: (
            look[0],
            SemanticClass.of_code(look[1]).value != materials[look[0]].name,
            look[1],
        ),
    )


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
        return REPEAT
    corners = np.repeat(part.polygon_material, np.diff(part.ring_offsets[part.polygon_offsets]))
    uv = part.uv[corners == row]
    beside = (uv < -_BESIDE_UV) | (uv > 1.0 + _BESIDE_UV)
    return REPEAT if beside.any() else CLAMP
