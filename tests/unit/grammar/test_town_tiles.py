"""A derived town as 3D Tiles: its files, its levels, and where it stands."""

from __future__ import annotations

import json
import struct
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from veduta.formats.tiles import contents
from veduta.geometry.ecef import ecef_from_grid, grid_of_crs
from veduta.grammar.options import GrammarOptions
from veduta.grammar.pipeline import run_derive
from veduta.run.progress import Progress

RULES = """
attr LOD = 2
attr height = 6
Lot --> extrude(world.up, height) Sides
Sides --> comp(f) { front : Front | bottom : NIL | top : Roof | all : Wall. }
Front --> set(material.name, "wall") split(x) { { ~2 : Bay }* }
Bay -->
    case LOD < 1 : Wall.
    else : split(x) { ~1 : Wall. | 1 : Column | ~1 : Wall. }
Column --> split(y) { 1 : Wall. | 1 : Window | ~1 : Wall. }
Window --> set(material.name, "window") color("#405060") Panes
Panes -->
    case LOD < 2 : Pane.
    else : split(x) { { ~0.4 : [ Pane. ] extrude(0.05) Frame. }* }
Roof --> set(material.name, "roof") color("#803020") Tiles.
"""
ORIGIN = (450_000.0, 5_410_000.0)


def lots_file(folder: Path, count: int) -> Path:
    features = []
    for number in range(count):
        x, y = ORIGIN[0] + 14.0 * (number % 30), ORIGIN[1] + 25.0 * (number // 30)
        ring = [[x, y], [x + 12, y], [x + 12, y + 10], [x, y + 10], [x, y]]
        shape = {"type": "Polygon", "coordinates": [ring]}
        more = {"id": f"house {number}", "properties": {"height": 5 + number % 4}}
        features.append({"type": "Feature", "geometry": shape} | more)
    crs = {"type": "name", "properties": {"name": "EPSG:32631"}}
    path = folder / "lots.geojson"
    path.write_text(json.dumps({"type": "FeatureCollection", "crs": crs, "features": features}))
    return path


@pytest.fixture(scope="module")
def town(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("town")
    rules = folder / "rules.cga"
    rules.write_text(RULES)
    out = folder / "out"
    result = run_derive(
        str(rules), lots_file(folder, 150), out, GrammarOptions(), Progress(quiet=True), jobs=1
    )
    assert (result.exit_code, result.built.count) == (0, 150)
    return out


def tiles_of(folder: Path, name: str = "tileset.json") -> list[tuple[dict[str, Any], str]]:
    """All tiles of all files, with the folder that their contents are named from."""
    document = json.loads((folder / name).read_text())
    found: list[tuple[dict[str, Any], str]] = []
    waiting = [document["root"]]
    base = name.rpartition("/")[0]
    while waiting:
        tile = waiting.pop()
        found.append((tile, base))
        waiting += tile.get("children", [])
        uri = tile.get("content", {}).get("uri", "")
        if uri.endswith(".json"):
            found += tiles_of(folder, f"{base}/{uri}".lstrip("/"))
    return found


def glb_document(path: Path) -> dict[str, Any]:
    data = path.read_bytes()
    (size,) = struct.unpack_from("<I", data, 12)
    document: dict[str, Any] = json.loads(data[20 : 20 + size])
    return document


def test_the_tree_names_all_files(town: Path) -> None:
    tiles = tiles_of(town)
    errors = {tile["geometricError"] for tile, _ in tiles if "content" in tile}
    assert len(errors) == 4  # boxes, volumes, plain, full
    names = {
        f"{base}/{tile['content']['uri']}".lstrip("/") for tile, base in tiles if "content" in tile
    }
    files = set(contents(town))
    assert files == names | {"tileset.json"}
    assert all((town / name).is_file() for name in files)


def test_every_building_is_in_each_level_once(town: Path) -> None:
    counts: dict[str, int] = {}
    for tile, base in tiles_of(town):
        uri = tile.get("content", {}).get("uri", "")
        if uri.endswith(".glb"):
            tables = glb_document(town / base / uri)["extensions"]["EXT_structural_metadata"]
            level = uri.rpartition("/")[2].rpartition("-")[2]
            counts[level] = counts.get(level, 0) + tables["propertyTables"][1]["count"]
    assert counts == dict.fromkeys(["boxes.glb", "volume.glb", "plain.glb", "full.glb"], 150)


def test_it_stands_on_the_earth(town: Path) -> None:
    place = json.loads((town / "place.json").read_text())
    assert (place["crs"], place["tileset"]) == ("EPSG:32631", "tileset.json")
    root = json.loads((town / "tileset.json").read_text())["root"]
    matrix = np.array(root["transform"]).reshape(4, 4).T
    grid = grid_of_crs("EPSG:32631")
    assert grid is not None
    assert matrix == pytest.approx(ecef_from_grid(grid, tuple(place["origin"])))
    for child in root["children"]:
        at = np.array(child["extras"]["veduta"]["world_m"])
        told = (matrix @ np.array(child["transform"]).reshape(4, 4).T)[:3, 3]
        world = tuple((np.array(place["origin"]) + at).tolist())
        assert told == pytest.approx(ecef_from_grid(grid, world)[:3, 3], abs=1e-6)


def test_cityjson_has_all_buildings(town: Path) -> None:
    city = json.loads((town / "city.city.json").read_text())
    buildings = [one for one in city["CityObjects"].values() if one["type"] == "Building"]
    assert len(buildings) == 150
    house = city["CityObjects"]["house-7"]
    assert house["attributes"]["height"] == 8
    kinds = [surface["type"] for surface in house["geometry"][0]["semantics"]["surfaces"]]
    assert set(kinds) == {"WallSurface", "RoofSurface", "Window"}
    low = np.array(city["vertices"]).min(axis=0) * 0.001 + city["transform"]["translate"]
    assert low == pytest.approx([*ORIGIN, 0.0])


def test_a_few_lots_at_different_heights_have_ground_between_them(tmp_path: Path) -> None:
    """Also where each building has a file of its own."""
    features = []
    for number, z in enumerate((0.0, 8.0)):
        x = 14.0 * number
        ring = [[x, 0, z], [x + 12, 0, z], [x + 12, 10, z], [x, 10, z], [x, 0, z]]
        shape = {"type": "Polygon", "coordinates": [ring]}
        features.append({"type": "Feature", "geometry": shape, "properties": {}})
    lots = tmp_path / "lots.geojson"
    lots.write_text(json.dumps({"type": "FeatureCollection", "features": features}))
    (tmp_path / "rules.cga").write_text(RULES)
    out = tmp_path / "out"
    options, quiet = GrammarOptions(), Progress(quiet=True)
    result = run_derive(str(tmp_path / "rules.cga"), lots, out, options, quiet, jobs=1)
    assert result.exit_code == 0
    children = json.loads((out / "tileset.json").read_text())["root"]["children"]
    shown = {child["content"]["uri"] for child in children}
    assert shown == {"parts/00/tiles/boxes.glb", "ground/00.glb"}
    inner = [one["content"]["uri"] for child in children for one in child.get("children", [])]
    assert inner == ["parts/00/tiles/tileset.json"]
    assert (out / "ground/00.glb").stat().st_size > 0
    assert any("invented" in note for note in result.notes)
