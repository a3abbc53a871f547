"""The house as 3D Tiles: what the tree names, and what tiles say of their surfaces."""

from __future__ import annotations

import json
import struct
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from sample_plan import sample_plan, sample_storey

from veduta.formats.tiles import contents
from veduta.place.semantics import Provenance, SemanticClass
from veduta.plan.document import Furniture
from veduta.plan.house.build import House, build_house
from veduta.plan.lights.lighting import light_house
from veduta.plan.options import HouseOptions
from veduta.plan.outputs.tiles import write_tiles

SOFA = Furniture(
    id="f1", object="sofa-slim", room="living", at_m=(2.0, 1.5), size_m=(2.1, 0.9, 0.8)
)


@pytest.fixture(scope="module")
def house() -> House:
    document = light_house(sample_plan(sample_storey(furniture=[SOFA])), HouseOptions()).document
    return build_house(document, HouseOptions())


@pytest.fixture(scope="module")
def folder(house: House, tmp_path_factory: pytest.TempPathFactory) -> Path:
    out = tmp_path_factory.mktemp("tiles")
    moved = np.eye(4)
    moved[2, 3] = 0.04
    write_tiles(house, moved, out)
    return out


def opened(path: Path) -> tuple[dict[str, Any], bytes]:
    data = path.read_bytes()
    (size,) = struct.unpack_from("<I", data, 12)
    return json.loads(data[20 : 20 + size]), data[28 + size :]


def column(root: dict[str, Any], content: bytes, name: str, kind: str) -> np.ndarray:
    (table, _) = root["extensions"]["EXT_structural_metadata"]["propertyTables"]
    view = root["bufferViews"][table["properties"][name]["values"]]
    assert view["byteOffset"] % 8 == 0
    return np.frombuffer(content, kind, table["count"], view["byteOffset"])


def test_the_tree_names_its_tiles_and_adds_what_stands_in_the_house(folder: Path) -> None:
    assert contents(folder) == ["tileset.json", "tiles/house.glb", "tiles/storey-1.glb"]
    root = json.loads((folder / "tileset.json").read_text())["root"]
    assert root["refine"] == "ADD"
    assert root["transform"][12:15] == [0.0, 0.0, 0.04]
    (child,) = root["children"]
    assert root["geometricError"] > child["geometricError"] == 0.0
    outer, inner = (np.array(tile["boundingVolume"]["box"]) for tile in (root, child))
    reach = outer[[3, 7, 11]] - inner[[3, 7, 11]]
    assert (np.abs(outer[:3] - inner[:3]) <= reach + 1e-6).all()


def test_tiles_tell_class_and_provenance_of_each_surface(house: House, folder: Path) -> None:
    features = house.part.features
    seen: set[float] = set()
    for name in ("house", "storey-1"):
        root, content = opened(folder / "tiles" / f"{name}.glb")
        assert (column(root, content, "class", "u1") == features.class_code).all()
        assert (column(root, content, "provenance", "u1") == features.provenance_code).all()
        for mesh in root["meshes"]:
            for primitive in mesh["primitives"]:
                number = primitive["attributes"].get("_FEATURE_ID_0")
                if number is None:
                    continue
                accessor = root["accessors"][number]
                view = root["bufferViews"][accessor["bufferView"]]
                seen |= set(
                    np.frombuffer(content, "<f4", accessor["count"], view["byteOffset"]).tolist()
                )
                (told,) = primitive["extensions"]["EXT_mesh_features"]["featureIds"]
                assert told["propertyTable"] == 0
        seen |= {
            feature
            for node in root["nodes"]
            for feature in _instanced(root, content, node.get("extensions", {}))
        }
    assert seen == set(range(len(features)))
    row = features.name.index("ground floor sofa-slim f1")
    assert features.class_code[row] == SemanticClass.FURNITURE.code
    assert features.provenance(row) is Provenance.INVENTED


def test_shadows_come_and_go_with_what_they_lie_under(house: House, folder: Path) -> None:
    """From afar there is no furniture, and no dark spot where it stands."""
    rows = set(np.flatnonzero(house.part.features.class_code == SemanticClass.SHADOW.code))
    assert rows
    assert rows & _surfaces(folder, "house") == set()
    assert rows <= _surfaces(folder, "storey-1")


def _surfaces(folder: Path, name: str) -> set[float]:
    """The features whose surfaces a tile has, instances apart."""
    root, content = opened(folder / "tiles" / f"{name}.glb")
    found: set[float] = set()
    for primitive in (one for mesh in root["meshes"] for one in mesh["primitives"]):
        if (number := primitive["attributes"].get("_FEATURE_ID_0")) is not None:
            accessor = root["accessors"][number]
            start = root["bufferViews"][accessor["bufferView"]]["byteOffset"]
            found |= set(np.frombuffer(content, "<f4", accessor["count"], start).tolist())
    return found


def _instanced(root: dict[str, Any], content: bytes, extensions: dict[str, Any]) -> list[float]:
    if "EXT_mesh_gpu_instancing" not in extensions:
        return []
    number = extensions["EXT_mesh_gpu_instancing"]["attributes"]["_FEATURE_ID_0"]
    accessor = root["accessors"][number]
    view = root["bufferViews"][accessor["bufferView"]]
    found: list[float] = np.frombuffer(
        content, "<f4", accessor["count"], view["byteOffset"]
    ).tolist()
    return found


def test_an_empty_house_is_one_tile(tmp_path: Path) -> None:
    house = build_house(sample_plan(), HouseOptions())
    write_tiles(house, np.eye(4), tmp_path)
    assert contents(tmp_path) == ["tileset.json", "tiles/house.glb"]
