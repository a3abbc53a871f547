"""glTF 2.0 binary of an indexed mesh: shared vertices, colours, morph targets, a skin and clips.

The file says the same of features, attributes and notes as that of a part (`formats.gltf`), and
`scenes[0].extras.veduta.mesh` tells the two apart; what a verb adds for its player is beside. The
skeleton is a tree of nodes beside the mesh; glTF is y-up, so every joint's frame is turned with
the part's: a turn and a move in z-up become the same ones in y-up.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from veduta.formats.gltf import feature_columns, looks
from veduta.formats.gltf_bin import GltfBin, glb_container, y_up
from veduta.formats.gltf_materials import CLAMP, REPEAT, GltfMaterials
from veduta.formats.gltf_metadata import describe
from veduta.formats.gltf_rig import rig_for_others
from veduta.formats.known_values import known
from veduta.imaging.srgb import linear_of_srgb
from veduta.place.mesh import Mesh
from veduta.place.skin import Clip, Skin
from veduta.run.atomic import write_bytes

_BESIDE_UV = 1e-3
_SIXTEEN_BITS = 65535
_STILL = 1e-6
"""A joint that moves by less in a clip (m, or of a quaternion) has no channel there."""
WEBP = "EXT_texture_webp"
LINEAR, MIPMAPS = 9729, 9987
"""glTF's filters."""
Y_UP = np.array([[1.0, 0.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, -1.0, 0.0, 0.0], [0, 0, 0, 1.0]])
"""glTF's frame from the part's."""


def write_mesh_glb(mesh: Mesh, path: Path, *, rigged: bool = False) -> None:
    """Write the mesh; the file appears whole or not at all. rigged: see `mesh_glb_bytes`."""
    write_bytes(path, mesh_glb_bytes(mesh, rigged=rigged))


def mesh_glb_bytes(mesh: Mesh, *, rigged: bool = False, alone: bool = True) -> bytes:
    """The content of a GLB file of the mesh.

    rigged: for other programs, as `formats.gltf_rig` says; Veduta does not read that back.
    alone: as that of `gltf.glb_bytes`.
    """
    binary = GltfBin()
    told = {
        "mesh": True,
        "features": feature_columns(mesh),
        "attributes": known(mesh.attributes),
        "notes": list(mesh.notes),
        **mesh.extras,
    }
    root: dict[str, Any] = {
        "asset": {"version": "2.0", "generator": "veduta"},
        "scene": 0,
        "scenes": [{"nodes": [0], "extras": {"veduta": told}}],
        "nodes": [{"name": mesh.id, "mesh": 0}],
        "meshes": [],
        "materials": [],
    }
    materials = GltfMaterials(root, mesh.materials, lambda row: _wrap(mesh, row), binary)
    own = mesh.features.class_code if alone else np.zeros_like(mesh.features.class_code)
    classes = own[mesh.triangle_feature]
    used = looks(mesh.triangle_material, classes, mesh.materials)
    for row in range(len(mesh.materials)):  # also what nothing has: a reader expects it
        materials.number(row, next((code for number, code in used if number == row), 0))
    _add_pictures(root, mesh)
    primitives = [
        _primitive(mesh, row, classes == code, materials.number(row, code), binary)
        for row, code in used
    ]
    shape: dict[str, Any] = {"primitives": primitives}
    if mesh.morphs:
        shape["weights"] = [0.0] * len(mesh.morphs)
        shape["extras"] = {"targetNames": [morph.name for morph in mesh.morphs]}
    root["meshes"].append(shape)
    if mesh.skin is not None:
        _add_skin(root, mesh.skin, binary)
        for clip in mesh.clips:
            _add_clip(root, mesh.skin, clip, binary)
    if rigged and mesh.skin is not None:
        rig_for_others(root, mesh, binary)
    if alone:
        describe(root, mesh.id, mesh.features, mesh.feature_area_m2, binary)
    root["bufferViews"] = binary.views
    root["accessors"] = binary.accessors
    binary.content.extend(b"\0" * (-len(binary.content) % 4))
    root["buffers"] = [{"byteLength": len(binary.content)}]
    return glb_container(root, bytes(binary.content))


def _add_pictures(root: dict[str, Any], mesh: Mesh) -> None:
    """Textures that are WebP files beside the model."""
    if not mesh.pictures:
        return
    names = list(dict.fromkeys(mesh.pictures.values()))
    images, textures = root.setdefault("images", []), root.setdefault("textures", [])
    samplers = root.setdefault("samplers", [])
    sampler = {"magFilter": LINEAR, "minFilter": MIPMAPS, "wrapS": CLAMP, "wrapT": CLAMP}
    samplers.append(sampler)
    number = {}
    for name in names:
        images.append({"uri": name, "mimeType": "image/webp"})
        entry = {"sampler": len(samplers) - 1, "extensions": {WEBP: {"source": len(images) - 1}}}
        textures.append(entry)
        number[name] = len(textures) - 1
    for material in root["materials"]:
        if material["name"] in mesh.pictures:
            texture = {"index": number[mesh.pictures[material["name"]]]}
            material["pbrMetallicRoughness"]["baseColorTexture"] = texture
    for kind in ("extensionsUsed", "extensionsRequired"):
        root[kind] = [*root.get(kind, []), WEBP]


def _primitive(
    mesh: Mesh, row: int, of_class: NDArray[np.bool_], number: int, binary: GltfBin
) -> dict[str, Any]:
    """What has a material and a class; a vertex of several features is written once for each."""
    rows = max(1, len(mesh.features))
    chosen = of_class & (mesh.triangle_material == row)
    corner = mesh.triangles[chosen].reshape(-1).astype(np.int64)
    feature = np.repeat(mesh.triangle_feature[chosen], 3).astype(np.int64)
    keys, indices = np.unique(corner * rows + feature, return_inverse=True)
    return {
        "attributes": _attributes(mesh, keys // rows, keys % rows, binary),
        "indices": binary.add_array(indices.reshape(-1).astype(np.uint32), "SCALAR"),
        "material": number,
        **_targets(mesh, keys // rows, binary),
    }


def _attributes(
    mesh: Mesh, used: NDArray[np.int64], feature: NDArray[np.int64], binary: GltfBin
) -> dict[str, int]:
    """The columns of the used vertices, as accessors."""
    attributes = {
        "POSITION": binary.add_array(y_up(mesh.positions_m[used]), "VEC3", bounds=True),
        "NORMAL": binary.add_array(y_up(mesh.vertex_normals[used]), "VEC3"),
        "_FEATURE_ID_0": binary.add_array(feature.astype(np.float32), "SCALAR"),
    }
    for name, uv in (("TEXCOORD_0", mesh.uv), ("TEXCOORD_1", mesh.uv_second)):
        if uv is not None:
            attributes[name] = binary.add_array(uv[used], "VEC2")
    for name, values in mesh.values.items():
        column = values[used].astype(np.float32)[:, None]
        attributes[f"_{name.upper()}"] = binary.add_array(column, "SCALAR")
    if mesh.colours is not None:
        shares = linear_of_srgb(mesh.colours[used].astype(np.float64) / 255.0)
        opaque = np.column_stack([shares, np.ones(len(used))])
        values = np.round(opaque * _SIXTEEN_BITS).astype(np.uint16)
        attributes["COLOR_0"] = binary.add_array(values, "VEC4", normalized=True)
    if mesh.skin is not None:
        attributes["JOINTS_0"] = binary.add_array(mesh.skin.joints[used], "VEC4")
        weights = mesh.skin.weights[used].astype(np.float32)
        attributes["WEIGHTS_0"] = binary.add_array(weights, "VEC4")
    return attributes


def _targets(mesh: Mesh, used: NDArray[np.int64], binary: GltfBin) -> dict[str, Any]:
    """The shapes to morph into, as differences."""
    if not mesh.morphs:
        return {}
    targets = []
    for morph in mesh.morphs:
        moved = morph.positions_m[used] - mesh.positions_m[used]
        targets.append({"POSITION": binary.add_array(y_up(moved), "VEC3", bounds=True)})
    return {"targets": targets}


def _wrap(mesh: Mesh, row: int) -> int:
    """A texture is repeated where triangles of its material ask for more than it has."""
    if mesh.uv is None:
        return CLAMP
    uv = mesh.uv[mesh.triangles[mesh.triangle_material == row].reshape(-1)]
    return REPEAT if ((uv < -_BESIDE_UV) | (uv > 1.0 + _BESIDE_UV)).any() else CLAMP


def _add_skin(root: dict[str, Any], skin: Skin, binary: GltfBin) -> None:
    """The joints as nodes after the mesh's, and the skin that binds it to them."""
    from scipy.spatial.transform import Rotation  # here: most meshes need none, and it is slow

    first = len(root["nodes"])
    local = Y_UP @ skin.rest_in_parent() @ Y_UP.T
    turns = Rotation.from_matrix(local[:, :3, :3]).as_quat()
    for joint, name in enumerate(skin.names):
        node: dict[str, Any] = {
            "name": name,
            "translation": local[joint, :3, 3].tolist(),
            "rotation": turns[joint].tolist(),
        }
        children = [first + int(row) for row in np.flatnonzero(skin.parent == joint)]
        if children:
            node["children"] = children
        root["nodes"].append(node)
    roots = [first + int(row) for row in np.flatnonzero(skin.parent < 0)]
    root["scenes"][0]["nodes"].extend(roots)
    unbound = np.linalg.inv(Y_UP @ skin.rest @ Y_UP.T)
    columns = unbound.transpose(0, 2, 1).reshape(-1, 16).astype(np.float32)
    columns[:, [3, 7, 11]], columns[:, 15] = 0.0, 1.0
    bind = binary.add_array(columns, "MAT4", of_vertices=False)
    joints = list(range(first, first + len(skin.names)))
    root["skins"] = [{"joints": joints, "inverseBindMatrices": bind}]
    root["nodes"][0]["skin"] = 0


def _add_clip(root: dict[str, Any], skin: Skin, clip: Clip, binary: GltfBin) -> None:
    """An animation with a channel for what moves."""
    from scipy.spatial.transform import Rotation  # here: most meshes need none, and it is slow

    first = root["skins"][0]["joints"][0]
    times = clip.times_s.astype(np.float32)
    clock = binary.add_array(times[:, None], "SCALAR", bounds=True, of_vertices=False)
    rest = skin.rest_in_parent()
    still = {
        "translation": np.broadcast_to(rest[:, :3, 3], clip.translations_m.shape),
        "rotation": np.broadcast_to(
            Rotation.from_matrix(rest[:, :3, :3]).as_quat(), clip.rotations_xyzw.shape
        ),
    }
    moved = {"translation": clip.translations_m, "rotation": _continuous(clip.rotations_xyzw)}
    channels: list[dict[str, Any]] = []
    samplers: list[dict[str, Any]] = []
    for joint in range(len(skin.names)):
        for path, kind in (("translation", "VEC3"), ("rotation", "VEC4")):
            keys, rested = moved[path][:, joint], still[path][:, joint]
            if channels and _is_still(keys, rested):
                continue
            values = keys.copy()
            values[:, :3] = np.stack([keys[:, 0], keys[:, 2], -keys[:, 1]], axis=1)
            samplers.append(
                {
                    "input": clock,
                    "output": binary.add_array(values.astype(np.float32), kind, of_vertices=False),
                    "interpolation": "LINEAR",
                }
            )
            target = {"node": first + joint, "path": path}
            channels.append({"sampler": len(samplers) - 1, "target": target})
    root.setdefault("animations", []).append(
        {
            "name": clip.name,
            "channels": channels,
            "samplers": samplers,
            "extras": {"veduta": {"loops": clip.loops, **_contacts(clip)}},
        }
    )


def _contacts(clip: Clip) -> dict[str, Any]:
    """When each foot stands (s), for who plays the clip; nothing where that is not known."""
    found: list[dict[str, Any]] = []
    for one in clip.contacts:
        told: dict[str, Any] = {"foot": one.foot, "joint": one.joint}
        told["down_s"] = [list(pair) for pair in one.down_s]
        if one.leg and one.end_m is not None:
            told["leg"] = list(one.leg)
            told["end"] = [one.end_m[0], one.end_m[2], -one.end_m[1]]
        found.append(told)
    return {"contacts": found} if found else {}


def _is_still(keys: NDArray[np.float64], rested: NDArray[np.float64]) -> bool:
    """Whether a joint stays at rest; a quaternion and its negative are one turn."""
    apart = float(np.abs(keys - rested).max())
    if keys.shape[1] == 4:
        apart = min(apart, float(np.abs(keys + rested).max()))
    return apart < _STILL


def _continuous(turns: NDArray[np.float64]) -> NDArray[np.float64]:
    """The same turns, each quaternion on the side of the one before it."""
    along = np.einsum("tjk,tjk->tj", turns[1:], turns[:-1])
    signs = np.cumprod(np.where(along < 0.0, -1.0, 1.0), axis=0)
    return np.concatenate([turns[:1], turns[1:] * signs[..., None]])
