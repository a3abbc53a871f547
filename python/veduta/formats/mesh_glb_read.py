"""Reading back the meshes that `formats.mesh_glb` writes, and telling them from parts."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from veduta.formats.gltf_chunks import BROKEN, REMEDY, Glb, feature_rows, glb_chunks, glb_content
from veduta.formats.gltf_read import features_of, looks_of, part_of, row_in
from veduta.formats.mesh_glb import Y_UP
from veduta.imaging.srgb import srgb_of_linear
from veduta.place.mesh import Mesh
from veduta.place.part import Part
from veduta.place.skin import Clip, Contact, Morph, Skin
from veduta.run.errors import InputError

_OWN = {"mesh", "features", "attributes", "notes"}
_Columns = dict[str, NDArray[Any]]


def read_model(path: Path) -> Part | Mesh:
    """The part or the mesh in a GLB file that Veduta wrote; InputError on any other."""
    data = glb_content(path)
    try:
        glb = glb_chunks(data)
        if glb.root["scenes"][0].get("extras", {}).get("veduta", {}).get("mesh"):
            return _mesh(glb)
        return part_of(glb)
    except BROKEN as error:
        raise InputError(path, f"not a GLB file of Veduta ({error})", REMEDY) from error


def _mesh(glb: Glb) -> Mesh:
    told = glb.root["scenes"][0]["extras"]["veduta"]
    shape = glb.root["meshes"][0]
    names = shape.get("extras", {}).get("targetNames", [])
    pieces = [_vertices(glb, primitive) for primitive in shape["primitives"]]
    starts = np.cumsum([0, *(len(piece["POSITION"]) for piece in pieces)])
    corners = [glb.array(primitive["indices"]) for primitive in shape["primitives"]]
    joined = {name: np.concatenate([piece[name] for piece in pieces]) for name in pieces[0]}
    triangles = np.concatenate(
        [own.astype(np.int64) + start for own, start in zip(corners, starts[:-1], strict=True)]
    ).reshape(-1, 3)
    looks, row_of = looks_of(glb)
    material = np.repeat(
        [row_in(row_of, primitive["material"]) for primitive in shape["primitives"]],
        [len(own) // 3 for own in corners],
    )
    skin = _skin(glb, joined)
    return Mesh(
        id=glb.root["nodes"][0]["name"],
        positions_m=joined["POSITION"],
        triangles=triangles.astype(np.uint32),
        features=features_of(told["features"]),
        materials=looks,
        triangle_feature=feature_rows(joined["_FEATURE_ID_0"][triangles[:, 0]]),
        triangle_material=material.astype(np.int32),
        normals=joined["NORMAL"],
        uv=joined.get("TEXCOORD_0"),
        uv_second=joined.get("TEXCOORD_1"),
        colours=joined.get("COLOR_0"),
        morphs=tuple(
            Morph(name, joined["POSITION"] + joined[f"target {row}"])
            for row, name in enumerate(names)
        ),
        skin=skin,
        clips=() if skin is None else tuple(_clips(glb, skin)),
        attributes=dict(told.get("attributes", {})),
        notes=tuple(told.get("notes", ())),
        values={
            name[1:].lower(): column
            for name, column in joined.items()
            if name.startswith("_") and name != "_FEATURE_ID_0"
        },
        extras={name: value for name, value in told.items() if name not in _OWN},
    )


def _vertices(glb: Glb, primitive: dict[str, Any]) -> _Columns:
    """The columns of a primitive's vertices, z up."""
    columns = {name: glb.array(number) for name, number in primitive["attributes"].items()}
    for row, target in enumerate(primitive.get("targets", [])):
        columns[f"target {row}"] = glb.array(target["POSITION"])
    for name, values in columns.items():
        if name in {"POSITION", "NORMAL"} or name.startswith("target"):
            columns[name] = np.stack([values[:, 0], -values[:, 2], values[:, 1]], axis=1) + (
                np.float32(0.0)
            )
    if "COLOR_0" in columns:
        shares = srgb_of_linear(columns["COLOR_0"][:, :3] / 65535.0)
        columns["COLOR_0"] = np.round(shares * 255.0).astype(np.uint8)
    return columns


def _skin(glb: Glb, columns: _Columns) -> Skin | None:
    if "skins" not in glb.root:
        return None
    told = glb.root["skins"][0]
    joints = told["joints"]
    row_of = {node: row for row, node in enumerate(joints)}
    parent = np.full(len(joints), -1, dtype=np.int32)
    for row, node in enumerate(joints):
        for child in glb.root["nodes"][node].get("children", []):
            parent[row_of[child]] = row
    bind = glb.array(told["inverseBindMatrices"]).astype(np.float64)
    rest = Y_UP.T @ np.linalg.inv(bind.reshape(-1, 4, 4).transpose(0, 2, 1)) @ Y_UP
    return Skin(
        names=tuple(glb.root["nodes"][node]["name"] for node in joints),
        parent=parent,
        rest=rest,
        joints=columns["JOINTS_0"],
        weights=columns["WEIGHTS_0"],
    )


def _clips(glb: Glb, skin: Skin) -> list[Clip]:
    from scipy.spatial.transform import Rotation  # here: most calls need none, and it is slow

    first = glb.root["skins"][0]["joints"][0]
    rest = skin.rest_in_parent()
    turns = Rotation.from_matrix(rest[:, :3, :3]).as_quat()
    clips = []
    for told in glb.root.get("animations", []):
        times = glb.array(told["samplers"][0]["input"]).astype(np.float64)
        translations = np.tile(rest[:, :3, 3], (len(times), 1, 1))
        rotations = np.tile(turns, (len(times), 1, 1))
        for channel in told["channels"]:
            keys = glb.array(told["samplers"][channel["sampler"]]["output"]).astype(np.float64)
            keys[:, :3] = np.stack([keys[:, 0], -keys[:, 2], keys[:, 1]], axis=1)
            joint = channel["target"]["node"] - first
            into = translations if channel["target"]["path"] == "translation" else rotations
            into[:, joint] = keys
        more = told.get("extras", {}).get("veduta", {})
        loops = bool(more.get("loops", False))
        contacts = tuple(_contact(one) for one in more.get("contacts", []))
        clips.append(Clip(told["name"], times, translations, rotations, loops, contacts))
    return clips


def _contact(told: dict[str, Any]) -> Contact:
    spans = tuple((a, b) for a, b in told["down_s"])
    if "end" not in told:
        return Contact(told["foot"], told["joint"], spans)
    x, y, z = told["end"]
    return Contact(told["foot"], told["joint"], spans, tuple(told["leg"]), (x, -z, y))
