"""CityJSON: the finest geometry of each building, its classes, and files that are wrong."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from veduta.formats.cityjson_read import read_cityjson
from veduta.place.semantics import SemanticClass
from veduta.run.errors import InputError

CORNERS = [[0, 0, 0], [4, 0, 0], [4, 3, 0], [0, 3, 0], [0, 0, 5], [4, 0, 5], [4, 3, 5], [0, 3, 5]]
FACES = [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]]


def document(version: str = "2.0", **geometry: Any) -> dict[str, Any]:
    solid = {"type": "Solid", "lod": "1.2", "boundaries": [[[face] for face in FACES]]} | geometry
    footprint = {"type": "MultiSurface", "lod": "0", "boundaries": [[FACES[0]]]}
    return {
        "type": "CityJSON",
        "version": version,
        "metadata": {"referenceSystem": "https://www.opengis.net/def/crs/EPSG/0/25832"},
        "transform": {"scale": [0.5, 0.5, 0.5], "translate": [500_000, 5_500_000, 90]},
        "CityObjects": {
            "house": {"type": "Building", "attributes": {"measuredHeight": 2.5},
                      "geometry": [footprint, solid]},
            "road": {"type": "Road", "geometry": [footprint]},
        },
        "vertices": CORNERS,
    }  # fmt: skip


def write(path: Path, content: Any) -> Path:
    path.write_text(json.dumps(content))
    return path


@pytest.mark.parametrize("version", ["1.1", "2.0"])
def test_the_body_is_read_in_the_files_coordinates(tmp_path: Path, version: str) -> None:
    city = read_cityjson(write(tmp_path / "city.json", document(version)))
    assert city.epsg == 25832
    (house,) = city.buildings
    assert (house.id, house.lod, house.solid, len(house.polygons)) == ("house", "1.2", True, 6)
    every = np.concatenate([ring for rings in house.polygons for ring in rings])
    assert every.min(axis=0).tolist() == [500_000, 5_500_000, 90]
    assert every.max(axis=0).tolist() == [500_002, 5_500_001.5, 92.5]
    assert set(house.classes) == {None}


def test_semantics_are_kept(tmp_path: Path) -> None:
    kinds = [{"type": "GroundSurface"}, {"type": "RoofSurface"}, {"type": "WallSurface"}]
    semantics = {"surfaces": kinds, "values": [[0, 1, 2, 2, 2, None]]}
    city = read_cityjson(write(tmp_path / "city.json", document(semantics=semantics)))
    wall = SemanticClass.WALL
    expected = (SemanticClass.GROUND, SemanticClass.ROOF, wall, wall, wall, None)
    assert city.buildings[0].classes == expected


def test_a_sequence_has_the_same_building(tmp_path: Path) -> None:
    whole = document()
    head = {key: whole[key] for key in ("type", "version", "metadata", "transform")}
    feature = {key: whole[key] for key in ("CityObjects", "vertices")}
    lines = [head, {"type": "CityJSONFeature", "id": "house", **feature}]
    path = tmp_path / "city.city.jsonl"
    path.write_text("\n".join(json.dumps(line) for line in lines))
    one, other = read_cityjson(path), read_cityjson(write(tmp_path / "city.json", whole))
    assert one.epsg == other.epsg
    for ours, theirs in zip(one.buildings[0].polygons, other.buildings[0].polygons, strict=True):
        assert np.array_equal(ours[0], theirs[0])


@pytest.mark.parametrize(
    ("change", "fault"),
    [
        ({"type": "Map"}, "is not CityJSON"),
        ({"vertices": [[0, 0]]}, "no vertices"),
        ({"vertices": [[0, 0, "a"]]}, "no vertices"),
        ({"CityObjects": []}, "no CityObjects"),
    ],
)
def test_a_file_that_is_wrong_is_refused(
    tmp_path: Path, change: dict[str, Any], fault: str
) -> None:
    with pytest.raises(InputError, match=fault):
        read_cityjson(write(tmp_path / "city.json", document() | change))


def test_a_building_that_is_wrong_is_left_out(tmp_path: Path) -> None:
    content = document()
    content["CityObjects"]["bad"] = {
        "type": "Building",
        "geometry": [{"type": "Solid", "lod": "1", "boundaries": [[[[0, 1, 99]]]]}],
    }
    city = read_cityjson(write(tmp_path / "city.json", content))
    assert [one.id for one in city.buildings] == ["house"]
    assert city.left == (("bad", "names a vertex that is not there"),)


def test_a_file_that_is_cut_off_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "city.json"
    path.write_text(json.dumps(document())[:-20])
    with pytest.raises(InputError, match="is not JSON"):
        read_cityjson(path)


def test_a_type_that_is_no_word_is_left_out(tmp_path: Path) -> None:
    city = read_cityjson(write(tmp_path / "city.json", document(type=["Solid"])))
    assert city.left == (("house", "has no geometry of LoD1 or above"),)
