"""A part's own model tells other programs what its surfaces are: tables, rows, materials."""

from __future__ import annotations

import json
import struct
from collections import defaultdict
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from json_schema import faults, schema
from sample_document import sample_document, sample_photo

from veduta.facade.model import build_part
from veduta.formats.gltf import glb_bytes, read_glb, write_glb
from veduta.formats.gltf_bin import glb_container
from veduta.formats.mesh_glb import mesh_glb_bytes
from veduta.formats.mesh_glb_read import read_model
from veduta.place.builder import PartBuilder
from veduta.place.instances import InstanceGroup, Instances, SharedMesh
from veduta.place.material import Material
from veduta.place.mesh import Mesh
from veduta.place.part import Features, Part
from veduta.place.semantics import Provenance, SemanticClass
from veduta.run.errors import InputError

KINDS = ("part", "mesh", "forest")


def facade() -> Part:
    document = sample_document()
    return build_part(document, sample_photo(document), "sample")


def wall_and_roof() -> Mesh:
    """Two triangles of two classes in one look, and a third in a second look."""
    return Mesh(
        id="two",
        positions_m=np.random.default_rng(3).normal(size=(9, 3)).astype(np.float32),
        triangles=np.arange(9, dtype=np.uint32).reshape(3, 3),
        features=Features(
            id=("Dach-ü", "wall", "more"),
            name=("", "A wall", "another"),
            class_code=np.array(
                [SemanticClass.ROOF.code, SemanticClass.WALL.code, SemanticClass.WALL.code],
                dtype=np.uint8,
            ),
            provenance_code=np.array([Provenance.MEASURED.code] * 3, dtype=np.uint8),
            parent=np.array([-1, 0, 0], dtype=np.int32),
            shell=np.zeros(3, dtype=np.int32),
            width_m=np.array([np.nan, 2.5, 1.0]),
            height_m=np.array([np.nan, 3.0, 1.0]),
            photo_px=np.full((3, 4), np.nan),
            seen_height_m=np.full(3, np.nan),
            score=np.full(3, np.nan),
        ),
        materials=(Material("wall"), Material("unused"), Material("brick", colour=(0.5, 0.2, 0.1))),
        triangle_feature=np.array([0, 1, 2], dtype=np.int32),
        triangle_material=np.array([0, 0, 2], dtype=np.int32),
    )


def forest() -> Part:
    """Ground, and one thing 1,001 times, which is written with EXT_mesh_gpu_instancing."""
    builder = PartBuilder("forest")
    ground = builder.feature(SemanticClass.GROUND, Provenance.INVENTED, "ground")
    look = builder.material(Material("ground"))
    corners = np.array([[0, 0, 0], [9, 0, 0], [9, 9, 0], [0, 9, 0]], dtype=np.float64)
    builder.polygon([corners], ground, look)
    tree = builder.feature(SemanticClass.FURNITURE, Provenance.INVENTED, "tree")
    mesh = SharedMesh(
        name="tree",
        positions_m=corners[:3].astype(np.float32),
        normals=np.tile(np.array([0, 0, 1], dtype=np.float32), (3, 1)),
        indices=np.array([[0, 1, 2]], dtype=np.uint32),
        slot=np.zeros(1, dtype=np.int32),
        slots=("ground",),
        uv=None,
    )
    places = np.tile(np.eye(3, 4), (1001, 1, 1))
    group = InstanceGroup(0, (look,), places, np.full(1001, tree, dtype=np.int32))
    return replace(builder.build(), instances=Instances((mesh,), (group,)))


def looks(content: Part | Mesh) -> int:
    """How many pairs of a material and a class its surfaces have."""
    if isinstance(content, Mesh):
        material, feature = content.triangle_material, content.triangle_feature
    else:
        material, feature = content.polygon_material, content.polygon_feature
    pairs = set(zip(material.tolist(), content.features.class_code[feature].tolist(), strict=True))
    if isinstance(content, Part) and content.instances is not None:
        pairs.add((0, SemanticClass.FURNITURE.code))
    return len(pairs)


def written(kind: str) -> tuple[Part | Mesh, bytes]:
    if kind == "mesh":
        mesh = wall_and_roof()
        return mesh, mesh_glb_bytes(mesh)
    part = facade() if kind == "part" else forest()
    return part, glb_bytes(part)


def opened(data: bytes) -> tuple[dict[str, Any], bytes]:
    size = struct.unpack_from("<I", data, 12)[0]
    return json.loads(data[20 : 20 + size]), data[28 + size :]


def view(root: dict[str, Any], content: bytes, number: int) -> bytes:
    told = root["bufferViews"][number]
    assert told["byteOffset"] % 8 == 0
    return content[told["byteOffset"] : told["byteOffset"] + told["byteLength"]]


def texts(root: dict[str, Any], content: bytes, column: dict[str, Any]) -> list[str]:
    ends = np.frombuffer(view(root, content, column["stringOffsets"]), "<u4")
    data = view(root, content, column["values"])
    return [data[a:b].decode() for a, b in zip(ends[:-1], ends[1:], strict=True)]


@pytest.mark.parametrize("kind", KINDS)
def test_the_table_says_what_the_part_says(kind: str) -> None:
    content, data = written(kind)
    root, chunk = opened(data)
    metadata = root["extensions"]["EXT_structural_metadata"]
    assert faults(metadata, schema("structural_metadata")) == []
    (table,) = metadata["propertyTables"]
    columns, features = table["properties"], content.features
    assert table["count"] == len(features) > 1
    assert texts(root, chunk, columns["id"]) == list(features.id)
    assert texts(root, chunk, columns["name"]) == list(features.name)
    names = [one["name"] for one in metadata["schema"]["enums"]["class"]["values"]]
    codes = np.frombuffer(view(root, chunk, columns["class"]["values"]), "u1")
    assert [names[code] for code in codes] == [
        features.semantic(row).value for row in range(len(features))
    ]
    parents = np.frombuffer(view(root, chunk, columns["parent"]["values"]), "<i4")
    assert np.array_equal(parents, features.parent)
    widths = np.frombuffer(view(root, chunk, columns["width_m"]["values"]), "<f4")
    assert widths == pytest.approx(np.nan_to_num(features.width_m, nan=-1.0))
    assert {"EXT_structural_metadata", "EXT_mesh_features"} <= set(root["extensionsUsed"])
    assert "EXT_structural_metadata" not in root.get("extensionsRequired", [])


@pytest.mark.parametrize("kind", KINDS)
def test_every_vertex_has_a_row_of_the_table(kind: str) -> None:
    content, data = written(kind)
    root, _ = opened(data)
    rows = len(content.features)
    told = [
        piece["extensions"]["EXT_mesh_features"]
        for mesh in root["meshes"]
        for piece in mesh["primitives"]
        if "_FEATURE_ID_0" in piece["attributes"]
    ]
    told += [
        node["extensions"]["EXT_instance_features"]
        for node in root["nodes"]
        if "EXT_mesh_gpu_instancing" in node.get("extensions", {})
    ]
    assert len(told) == looks(content) > 1
    for one in told:
        assert faults(one, schema("feature_ids")) == []
        assert one == {"featureIds": [{"featureCount": rows, "attribute": 0, "propertyTable": 0}]}


@pytest.mark.parametrize("kind", KINDS)
def test_no_material_is_shared_by_two_classes(kind: str) -> None:
    content, data = written(kind)
    root, chunk = opened(data)
    classes = defaultdict(set)
    for mesh in root["meshes"]:
        for piece in mesh["primitives"]:
            if "_FEATURE_ID_0" not in piece["attributes"]:
                classes[piece["material"]].add("furniture")
                continue
            told = root["accessors"][piece["attributes"]["_FEATURE_ID_0"]]
            start = root["bufferViews"][told["bufferView"]]["byteOffset"]
            rows = np.frombuffer(chunk, "<f4", told["count"], start).astype(int)
            classes[piece["material"]] |= {content.features.semantic(row).value for row in rows}
    assert len(classes) == looks(content) > 1
    assert all(len(found) == 1 for found in classes.values())
    names = [one["name"] for one in root["materials"]]
    if kind == "mesh":
        assert names == ["wall", "unused", "brick", "roof.wall"]
    if kind == "forest":
        assert names == ["ground", "furniture.ground"]


def test_what_looks_alike_is_one_material_again(tmp_path: Path) -> None:
    part = facade()
    write_glb(part, tmp_path / "a.glb")
    back = read_glb(tmp_path / "a.glb")
    used = [part.materials[row].name for row in np.unique(part.polygon_material)]
    assert [one.name for one in back.materials] == used
    write_glb(back, tmp_path / "b.glb")
    again = read_glb(tmp_path / "b.glb")
    assert np.array_equal(again.polygon_material, back.polygon_material)
    (tmp_path / "mesh.glb").write_bytes(mesh_glb_bytes(wall_and_roof()))
    mesh = read_model(tmp_path / "mesh.glb")
    assert isinstance(mesh, Mesh)
    assert [one.name for one in mesh.materials] == ["wall", "unused", "brick"]
    assert sorted(mesh.triangle_material.tolist()) == [0, 0, 2]
    (tmp_path / "forest.glb").write_bytes(glb_bytes(forest()))
    trees = read_glb(tmp_path / "forest.glb").instances
    assert trees is not None
    assert trees.groups[0].materials == (0,)
    assert trees.meshes[0].slots == ("ground",)


NO_NUMBERS = (-1, 99, 10**400, 0.0, True, None, "0", [0], {"0": 0})
"""What another program may write where the number of a material belongs."""


def refused(path: Path, root: dict[str, Any], chunk: bytes) -> bool:
    """Whether the file is refused with its name."""
    path.write_bytes(glb_container(root, chunk))
    try:
        read_model(path)
    except InputError as error:
        return path.name in str(error)
    return False


@pytest.mark.parametrize("kind", KINDS)
def test_what_looks_like_a_material_that_is_not_there_is_refused(kind: str, tmp_path: Path) -> None:
    root, chunk = opened(written(kind)[1])
    path = tmp_path / "of another.glb"
    number, told = next(
        (number, one["extras"]["veduta"])
        for number, one in enumerate(root["materials"])
        if "looks_like" in one.get("extras", {}).get("veduta", {})
    )
    assert not refused(path, root, chunk)
    for wrong in (*NO_NUMBERS, number):  # itself looks like another already
        told["looks_like"] = wrong
        assert refused(path, root, chunk), wrong


@pytest.mark.parametrize("kind", KINDS)
def test_a_surface_of_a_material_that_is_not_there_is_refused(kind: str, tmp_path: Path) -> None:
    root, chunk = opened(written(kind)[1])
    path = tmp_path / "of another.glb"
    piece = root["meshes"][-1]["primitives"][0]
    for wrong in NO_NUMBERS:
        piece["material"] = wrong
        assert refused(path, root, chunk), wrong


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("row", [np.nan, np.inf, 1e30, -1.0, 99.0])
@pytest.mark.parametrize("kind", KINDS)
def test_a_row_that_is_not_in_the_table_is_refused(kind: str, row: float, tmp_path: Path) -> None:
    root, chunk = opened(written(kind)[1])
    told = root["accessors"][root["meshes"][0]["primitives"][0]["attributes"]["_FEATURE_ID_0"]]
    start = root["bufferViews"][told["bufferView"]]["byteOffset"]
    rows = np.full(told["count"], row, dtype="<f4").tobytes()
    wrong = chunk[:start] + rows + chunk[start + len(rows) :]
    assert refused(tmp_path / "of another.glb", root, wrong)
