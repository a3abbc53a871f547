"""Written tiles against what 3D Tiles 1.1 and its glTF extensions ask, and read by other code."""

from __future__ import annotations

import copy
import json
import shutil
import struct
import subprocess
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from json_schema import SCHEMAS, faults, schema
from numpy.typing import NDArray
from PIL import Image

from veduta.grammar.options import GrammarOptions
from veduta.grammar.pipeline import run_derive
from veduta.run.progress import Progress

RULES = """
attr LOD = 2
attr height = 6
attr provenance = "invented"
Lot --> extrude(world.up, height) comp(f) { front : Front | bottom : NIL | top : Roof | all : Side }
Side --> set(material.name, "wall") set(provenance, "inferred") Wall.
Front --> set(material.name, "wall") setupProjection(0, scope.xy, 2, 2) texture("wall.png")
    projectUV(0) split(x) { { ~2 : Bay }* }
Bay -->
    case LOD < 1 : Wall.
    else : split(x) { ~1 : Wall. | 1 : Column | ~1 : Wall. }
Column --> split(y) { 1 : Wall. | 1.5 : Window | ~1 : Wall. }
Window --> set(material.name, "window") texture("") color("#405060") Panes
Panes -->
    case LOD < 2 : Pane.
    else : split(x) { { ~0.4 : [ Pane. ] extrude(0.05) Frame. }* }
Roof --> set(material.name, "roof") color("#803020") roofHip(30) Tiles.
"""
ORIGIN = (84_000.0, 447_000.0)
"""Delft, in RD New."""
WIDTHS = {"UINT8": 1, "UINT16": 2, "UINT32": 4}
ROUNDING_M = 2e-3


@pytest.fixture(scope="module")
def town(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("standard")
    (folder / "rules.cga").write_text(RULES)
    Image.fromarray(np.full((4, 4, 3), 128, np.uint8)).save(folder / "wall.png")
    features = []
    for number in range(150):
        x, y = ORIGIN[0] + 14.0 * (number % 30), ORIGIN[1] + 25.0 * (number // 30)
        ring = [[x, y], [x + 12, y + 1], [x + 11, y + 11], [x - 1, y + 10], [x, y]]
        shape = {"type": "Polygon", "coordinates": [ring]}
        shape["coordinates"] = [[[*point, 0.1 * (number % 7)] for point in ring]]
        features.append({"type": "Feature", "id": str(number), "geometry": shape, "properties": {}})
    crs = {"type": "name", "properties": {"name": "EPSG:28992"}}
    lots = folder / "lots.geojson"
    lots.write_text(json.dumps({"type": "FeatureCollection", "features": features, "crs": crs}))
    out, rules = folder / "out", str(folder / "rules.cga")
    result = run_derive(rules, lots, out, GrammarOptions(), Progress(quiet=True), jobs=1)
    assert result.built.count == 150
    assert any("RD New" in note for note in result.notes)
    assert any("ground between the lots is invented" in note for note in result.notes)
    return out


def tilesets(town: Path) -> dict[str, dict[str, Any]]:
    paths = [town / "tileset.json", *sorted(town.glob("parts/*/tiles/tileset.json"))]
    return {str(path.relative_to(town)): json.loads(path.read_text()) for path in paths}


def glbs(town: Path) -> list[Path]:
    return sorted([*town.glob("parts/*/tiles/*.glb"), *town.glob("ground/*.glb")])


def opened(path: Path) -> tuple[dict[str, Any], bytes]:
    data = path.read_bytes()
    (size,) = struct.unpack_from("<I", data, 12)
    return json.loads(data[20 : 20 + size]), data[28 + size :]


def test_tilesets_keep_to_the_schema(town: Path) -> None:
    rules = schema("tileset")
    found = tilesets(town)
    assert len(found) > 2
    for name, document in found.items():
        assert (name, faults(document, rules)) == (name, [])


BREAKS: dict[str, Any] = {
    "no version": lambda d: d["asset"].pop("version"),
    "another version": lambda d: d["asset"].update(version="2.0"),
    "no error": lambda d: d.pop("geometricError"),
    "an error below zero": lambda d: d["root"].update(geometricError=-1.0),
    "no refine": lambda d: d["root"].pop("refine"),
    "small letters": lambda d: d["root"].update(refine="replace"),
    "eleven numbers": lambda d: d["root"]["boundingVolume"]["box"].pop(),
    "a text in a box": lambda d: d["root"]["boundingVolume"]["box"].append("1"),
    "no volume": lambda d: d["root"].update(boundingVolume={}),
    "no children": lambda d: d["root"].update(children=[]),
    "a url": lambda d: d["root"]["children"][0].update(content={"url": "a.glb"}),
    "two kinds of content": lambda d: d["root"]["children"][0].update(contents=[{"uri": "a.glb"}]),
    "a word too many": lambda d: d["root"].update(geometricErrors=1),
}


@pytest.mark.parametrize("what", list(BREAKS))
def test_the_schema_sees_what_is_wrong(town: Path, what: str) -> None:
    document = json.loads((town / "tileset.json").read_text())
    BREAKS[what](document)
    assert faults(document, schema("tileset"))


def test_metadata_keeps_to_the_schema(town: Path) -> None:
    rules, ids = schema("structural_metadata"), schema("feature_ids")
    seen = 0
    for path in glbs(town):
        document, _ = opened(path)
        assert faults(document["extensions"]["EXT_structural_metadata"], rules) == []
        tables = document["extensions"]["EXT_structural_metadata"]["propertyTables"]
        for attributes, told in feature_ids(document):
            assert faults(told, ids) == []
            for one in told["featureIds"]:
                assert f"_FEATURE_ID_{one['attribute']}" in attributes
                assert one["featureCount"] == tables[one["propertyTable"]]["count"]
                seen += 1
        used = set(document["extensionsUsed"])
        assert set(document["extensionsRequired"]) <= used
        assert all(name in json.dumps(document) for name in used)
    assert seen > 20


def feature_ids(document: dict[str, Any]) -> Iterator[tuple[dict[str, int], Any]]:
    for mesh in document["meshes"]:
        for primitive in mesh["primitives"]:
            if "EXT_mesh_features" in primitive.get("extensions", {}):
                yield primitive["attributes"], primitive["extensions"]["EXT_mesh_features"]
    for node in document["nodes"]:
        extensions = node.get("extensions", {})
        if extensions:
            shared = extensions["EXT_mesh_gpu_instancing"]["attributes"]
            yield shared, extensions["EXT_instance_features"]


METADATA_BREAKS: dict[str, Any] = {
    "no schema": lambda m: m.pop("schema"),
    "no id": lambda m: m["schema"].pop("id"),
    "an enum of no type": lambda m: m["schema"]["classes"]["surface"]["properties"]["class"].pop(
        "enumType"
    ),
    "a number of no type": lambda m: m["schema"]["classes"]["surface"]["properties"]["width"].pop(
        "componentType"
    ),
    "a scale of whole numbers": lambda m: m["schema"]["classes"]["surface"]["properties"][
        "width"
    ].pop("normalized"),
    "an empty table": lambda m: m["propertyTables"][0].update(count=0),
    "a column of nothing": lambda m: m["propertyTables"][0]["properties"]["class"].pop("values"),
    "a name with a blank": lambda m: m["schema"]["classes"].update({"two words": {}}),
}


@pytest.mark.parametrize("what", list(METADATA_BREAKS))
def test_the_schema_of_metadata_sees_what_is_wrong(town: Path, what: str) -> None:
    document, _ = opened(glbs(town)[0])
    metadata = copy.deepcopy(document["extensions"]["EXT_structural_metadata"])
    METADATA_BREAKS[what](metadata)
    assert faults(metadata, schema("structural_metadata"))


def test_tables_are_as_long_as_they_say(town: Path) -> None:
    """Columns against the classes: every row, whole, aligned, and of the values of its enum."""
    for path in glbs(town):
        document, binary = opened(path)
        metadata = document["extensions"]["EXT_structural_metadata"]
        for table in metadata["propertyTables"]:
            kinds = metadata["schema"]["classes"][table["class"]]["properties"]
            assert set(table["properties"]) <= set(kinds)
            required = {name for name, kind in kinds.items() if kind.get("required")}
            assert required <= set(table["properties"])
            for name, column in table["properties"].items():
                values = bytes_of(document, binary, column["values"], 8)
                kind = kinds[name]
                if kind["type"] == "STRING":
                    offsets = bytes_of(document, binary, column["stringOffsets"], 4)
                    ends = np.frombuffer(offsets, "<u4")
                    assert len(ends) == table["count"] + 1
                    assert (ends[0], ends[-1]) == (0, len(values))
                    assert (np.diff(ends.astype(np.int64)) >= 0).all()
                    values.decode("utf-8")
                    continue
                enum = metadata["schema"]["enums"].get(kind.get("enumType"))
                word = enum["valueType"] if enum else kind["componentType"]
                assert len(values) == table["count"] * WIDTHS[word]
                if enum:
                    known = {one["value"] for one in enum["values"]}
                    assert len(known) == len({one["name"] for one in enum["values"]})
                    found = np.frombuffer(values, f"<u{WIDTHS[word]}")
                    assert set(found.tolist()) <= known
    told, _ = opened(sorted(town.glob("parts/*/tiles/*-full.glb"))[0])
    assert (
        "provenance"
        in told["extensions"]["EXT_structural_metadata"]["propertyTables"][0]["properties"]
    )


def bytes_of(document: dict[str, Any], binary: bytes, view: int, aligned: int) -> bytes:
    told = document["bufferViews"][view]
    start = told["byteOffset"]
    assert told["buffer"] == 0
    assert start % aligned == 0
    found = binary[start : start + told["byteLength"]]
    assert len(found) == told["byteLength"]
    return found


def corners(box: list[float]) -> NDArray[np.float64]:
    signs = np.array(np.meshgrid([-1, 1], [-1, 1], [-1, 1])).reshape(3, -1).T
    found: NDArray[np.float64] = np.array(box[:3]) + signs @ np.array(box[3:]).reshape(3, 3)
    return found


def inside(points: NDArray[np.float64], box: list[float]) -> bool:
    """Whether points lie in an oriented box, by its own axes."""
    axes = np.array(box[3:]).reshape(3, 3)
    shares = np.linalg.solve(axes.T, (points - np.array(box[:3])).T).T
    spare = ROUNDING_M / np.linalg.norm(axes, axis=1)
    return bool((np.abs(shares) <= 1 + spare).all())


def moved(points: NDArray[np.float64], tile: dict[str, Any]) -> NDArray[np.float64]:
    matrix = np.array(tile.get("transform", np.eye(4).ravel())).reshape(4, 4).T
    found: NDArray[np.float64] = points @ matrix[:3, :3].T + matrix[:3, 3]
    return found


def walked(
    town: Path, name: str = "tileset.json"
) -> Iterator[tuple[dict[str, Any], dict[str, Any] | None, str]]:
    """Each tile of all tilesets with the one above it and the folder of its contents.

    The root of a tileset that a tile names is below that tile.
    """
    base = name.rpartition("/")[0]
    waiting: list[tuple[dict[str, Any], dict[str, Any] | None]] = [
        (json.loads((town / name).read_text())["root"], None)
    ]
    while waiting:
        tile, above = waiting.pop()
        yield tile, above, base
        waiting += [(child, tile) for child in tile.get("children", [])]
        uri = tile.get("content", {}).get("uri", "")
        if uri.endswith(".json"):
            for inner, over, folder in walked(town, f"{base}/{uri}".lstrip("/")):
                yield inner, over or tile, folder


def test_children_are_finer_and_lie_in_their_parents(town: Path) -> None:
    below = 0
    for tile, above, _ in walked(town):
        if above is None:
            continue
        below += 1
        assert tile["geometricError"] <= above["geometricError"]
        points = moved(corners(tile["boundingVolume"]["box"]), tile)
        assert inside(points, above["boundingVolume"]["box"])
        if tile.get("children"):
            assert tile["geometricError"] > 0
    assert below > 10
    root = json.loads((town / "tileset.json").read_text())
    assert root["geometricError"] >= root["root"]["geometricError"]


def test_contents_lie_in_their_tiles(town: Path, repository: Path) -> None:
    modules, node = repository / "studio" / "node_modules", shutil.which("node")
    if node is None or not (modules / "three").is_dir():
        pytest.skip("Node or studio/node_modules is missing: run `make studio`")
    tiles = {
        str(town / base / tile["content"]["uri"]): tile
        for tile, _, base in walked(town)
        if tile.get("content", {}).get("uri", "").endswith(".glb")
    }
    assert sorted(tiles) == [str(path) for path in glbs(town)]
    reader = str(SCHEMAS / "read_tiles.mjs")
    done = subprocess.run(
        [node, reader, str(modules), *tiles], capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    for told in json.loads(done.stdout):
        box = tiles[told["file"]]["boundingVolume"]["box"]
        assert inside(np.array([told["low"], told["high"]]), box), told["file"]
        document, _ = opened(Path(told["file"]))
        table = document["extensions"]["EXT_structural_metadata"]["propertyTables"][0]
        assert max(told["features"]) < table["count"]
        if "full" in told["file"]:
            # A leaf's box is that of its content, to what is rounded.
            low, high = np.array(told["low"]), np.array(told["high"])
            assert np.array(box[:3]) == pytest.approx((low + high) / 2, abs=0.05)
