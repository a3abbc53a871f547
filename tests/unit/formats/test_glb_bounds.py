"""GLB files of a few hundred bytes that ask for gigabytes are refused before memory is taken."""

from __future__ import annotations

import copy
import struct
import tracemalloc
from pathlib import Path
from typing import Any

import pytest
import trimesh

from veduta.formats.glb_mesh import read_glb_mesh
from veduta.formats.gltf_bin import glb_container
from veduta.run.errors import InputError

CONTENT = struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0) + struct.pack("<3H", 0, 1, 2) + b"\0\0"
ROOT: dict[str, Any] = {
    "asset": {"version": "2.0"},
    "scene": 0,
    "scenes": [{"nodes": [0]}],
    "nodes": [{"mesh": 0}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
    "buffers": [{"byteLength": 44}],
    "bufferViews": [
        {"buffer": 0, "byteLength": 36},
        {"buffer": 0, "byteOffset": 36, "byteLength": 6},
    ],
    "accessors": [
        {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
        {"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"},
    ],
}


def written(root: dict[str, Any], folder: Path) -> Path:
    path = folder / "asset.glb"
    path.write_bytes(glb_container(root, CONTENT))
    return path


def refusal(path: Path) -> str:
    tracemalloc.start()
    try:
        with pytest.raises(InputError) as told:
            read_glb_mesh(path)
        assert tracemalloc.get_traced_memory()[1] < 60_000_000
    finally:
        tracemalloc.stop()
    assert told.value.subject == str(path)
    return told.value.fault


def test_a_sound_file_is_read(tmp_path: Path) -> None:
    mesh = read_glb_mesh(written(ROOT, tmp_path))
    assert len(mesh.corners) == 3


def test_counts_beyond_the_file(tmp_path: Path) -> None:
    for number in (0, 1):
        root = copy.deepcopy(ROOT)
        root["accessors"][number]["count"] = 2_000_000_000
        assert "more than its buffer view" in refusal(written(root, tmp_path))


def test_accessors_without_a_view(tmp_path: Path) -> None:
    root = copy.deepcopy(ROOT)
    root["accessors"][0] = {"componentType": 5126, "count": 100_000_000, "type": "VEC3"}
    assert "without a buffer view are 1200000000 bytes" in refusal(written(root, tmp_path))
    sparse = {
        "count": 1,
        "indices": {"bufferView": 1, "componentType": 5123},
        "values": {"bufferView": 0},
    }
    root["accessors"][0]["sparse"] = sparse
    assert "without a buffer view" in refusal(written(root, tmp_path))
    root["accessors"][0] |= {"count": 3, "sparse": sparse | {"count": 4}}
    assert "replaces more items" in refusal(written(root, tmp_path))


@pytest.mark.parametrize("count", [-3, 1.5, "3", None, [3]])
def test_counts_that_are_none(count: object, tmp_path: Path) -> None:
    root = copy.deepcopy(ROOT)
    root["accessors"][0]["count"] = count
    assert "no count" in refusal(written(root, tmp_path))


def test_json_that_is_nested_deep(tmp_path: Path) -> None:
    text = b'{"asset":' + b"[" * 100_000 + b"]" * 100_000 + b"}"
    text += b" " * (-len(text) % 4)
    total = 12 + 8 + len(text)
    path = tmp_path / "asset.glb"
    head = struct.pack("<4sII", b"glTF", 2, total) + struct.pack("<I4s", len(text), b"JSON")
    path.write_bytes(head + text)
    assert "nested too deep" in refusal(path)


def test_trees_that_double(tmp_path: Path) -> None:
    root = copy.deepcopy(ROOT)
    root["nodes"] = [{"children": [row + 1, row + 1]} for row in range(40)] + [{"mesh": 0}]
    assert "hangs below two" in refusal(written(root, tmp_path))


def test_scenes_of_many_nodes(tmp_path: Path) -> None:
    root = copy.deepcopy(ROOT)
    root["nodes"] = [{"mesh": 0} for _ in range(200_000)]
    assert "200000 nodes" in refusal(written(root, tmp_path))


def test_what_is_shown_is_counted_for_each_node(tmp_path: Path) -> None:
    sphere = trimesh.creation.icosphere(subdivisions=4)
    scene = trimesh.Scene()
    for _ in range(60):
        scene.add_geometry(sphere, geom_name="ball")
    path = tmp_path / "balls.glb"
    path.write_bytes(scene.export(file_type="glb"))
    assert "200000 are the most" in refusal(path)
