"""Meshes that stand many times in a part: each is in the file once.

Where they are no more than `MOST_NODES`, each place is a plain node, which every reader of glTF
knows; `extras.veduta.instance` is the row in the feature table. Many more are a node of
EXT_mesh_gpu_instancing for each mesh and look: where it stands is in the attributes TRANSLATION,
ROTATION and SCALE, and the row of each instance in `_FEATURE_ID_0` (EXT_instance_features).
Meshes in other looks share the accessors of their vertices.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from veduta.formats.gltf_bin import GltfBin, y_up
from veduta.geometry.quaternions import quaternions_of, rotations_of
from veduta.place.instances import (
    InstanceGroup,
    Instances,
    SharedMesh,
    turn_and_stretch,
)

INSTANCING, FEATURES = "EXT_mesh_gpu_instancing", "EXT_instance_features"
MOST_NODES = 1000
"""Of a part: readers draw each by itself."""
GLTF_FROM_PART = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]])


def add_instances(
    root: dict[str, Any],
    instances: Instances,
    material_of: Callable[[int, int], int],
    binary: GltfBin,
    most_nodes: int,
) -> None:
    """Adds nodes and meshes.

    material_of: the number in the file of a part's material, as a feature has it.
    """
    as_nodes = len(instances) <= most_nodes
    vertices = [_vertices(mesh, binary) for mesh in instances.meshes]
    for group in instances.groups:
        if len(group.feature) == 0:
            continue
        mesh, (attributes, indices) = instances.meshes[group.mesh], vertices[group.mesh]
        first = int(group.feature[0])
        primitives = [
            {"attributes": attributes, "indices": accessor, "material": material_of(row, first)}
            for row, accessor in zip(group.materials, indices, strict=True)
            if accessor is not None
        ]
        root["meshes"].append({"name": mesh.name, "primitives": primitives})
        number = len(root["meshes"]) - 1
        root["scenes"][0]["nodes"].append(len(root["nodes"]))
        if as_nodes:
            _add_nodes(root["nodes"], mesh.name, number, group)
        else:
            root["nodes"].append(_node(mesh.name, number, group, binary))
    if not as_nodes:
        root.setdefault("extensionsUsed", []).extend([INSTANCING, FEATURES])
        root.setdefault("extensionsRequired", []).append(INSTANCING)


def _add_nodes(nodes: list[dict[str, Any]], name: str, mesh: int, group: InstanceGroup) -> None:
    """A node for the group, and in it one for each place."""
    first = len(nodes) + 1
    children = list(range(first, first + len(group.feature)))
    nodes.append({"name": name, "children": children, "extras": {"veduta": {"instances": True}}})
    placement = (
        column.astype(np.float64).round(7).tolist()
        for column in gltf_placement(group.part_from_mesh)
    )
    for row, move, turn, stretch in zip(group.feature.tolist(), *placement, strict=True):
        nodes.append(
            {
                "name": f"{name} {row}",
                "mesh": mesh,
                "translation": move,
                "rotation": turn,
                "scale": stretch,
                "extras": {"veduta": {"instance": row}},
            }
        )


def _vertices(mesh: SharedMesh, binary: GltfBin) -> tuple[dict[str, int], list[int | None]]:
    """The accessors of the vertices, and of the triangles of each slot."""
    attributes = {
        "POSITION": binary.add_array(y_up(mesh.positions_m), "VEC3", bounds=True),
        "NORMAL": binary.add_array(y_up(mesh.normals), "VEC3"),
    }
    if mesh.uv is not None:
        attributes["TEXCOORD_0"] = binary.add_array(mesh.uv, "VEC2")
    of_slot = [mesh.indices[mesh.slot == slot].reshape(-1) for slot in range(len(mesh.slots))]
    return attributes, [
        binary.add_array(corners, "SCALAR") if len(corners) else None for corners in of_slot
    ]


def _node(name: str, mesh: int, group: InstanceGroup, binary: GltfBin) -> dict[str, Any]:
    move, turn, stretch = gltf_placement(group.part_from_mesh)
    accessors = {
        "TRANSLATION": binary.add_array(move, "VEC3", of_vertices=False),
        "ROTATION": binary.add_array(turn, "VEC4", of_vertices=False),
        "SCALE": binary.add_array(stretch, "VEC3", of_vertices=False),
        "_FEATURE_ID_0": binary.add_array(
            group.feature.astype(np.float32), "SCALAR", of_vertices=False
        ),
    }
    told = {"featureCount": len(np.unique(group.feature)), "attribute": 0}
    return {
        "name": name,
        "mesh": mesh,
        "extensions": {
            INSTANCING: {"attributes": accessors},
            FEATURES: {"featureIds": [told]},
        },
    }


def gltf_placement(
    part_from_mesh: NDArray[np.float64],
) -> tuple[NDArray[np.float32], NDArray[np.float32], NDArray[np.float32]]:
    """(n, 3) moves, (n, 4) turns as quaternions (x, y, z, w) and (n, 3) stretches, y up."""
    turn, stretch = turn_and_stretch(part_from_mesh)
    turned = GLTF_FROM_PART @ turn @ GLTF_FROM_PART.T
    move = y_up(part_from_mesh[:, :, 3].astype(np.float32))
    return (
        move,
        quaternions_of(turned).astype(np.float32),
        stretch[:, [0, 2, 1]].astype(np.float32),
    )


def part_placement(
    move: NDArray[np.float32], turn: NDArray[np.float32], stretch: NDArray[np.float32]
) -> NDArray[np.float64]:
    """(n, 3, 4) the way back from `gltf_placement`."""
    turned = rotations_of(turn)
    back = GLTF_FROM_PART.T
    matrix = back @ (turned * stretch[:, None, :].astype(np.float64)) @ GLTF_FROM_PART
    at = move.astype(np.float64) @ GLTF_FROM_PART
    return np.concatenate([matrix, at[:, :, None]], axis=2)
