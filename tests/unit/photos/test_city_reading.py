"""City models of all formats as parts in metres; reference systems said, converted or asked for."""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import Any

import numpy as np
import pyproj
import pytest

from veduta.photos.city.crs import metres_of
from veduta.photos.city.facades import facades_of
from veduta.photos.city.model import CityModel
from veduta.photos.city.reading import read_city_model
from veduta.photos.options import ModelOptions
from veduta.place.semantics import SemanticClass
from veduta.run.errors import InputError

DATA = Path(os.environ.get("VEDUTA_DATA", Path(__file__).parents[4] / "shared" / "data"))
OUTLINE = [[0.0, 0.0], [10.0, 0.0], [10.0, 6.0], [0.0, 6.0], [0.0, 0.0]]


def outlines(tmp_path: Path, crs: str | None = "EPSG:25832", **properties: Any) -> Path:
    ring = [[500_000 + x, 5_500_000 + y] for x, y in OUTLINE]
    feature = {
        "type": "Feature",
        "properties": properties,
        "geometry": {"type": "Polygon", "coordinates": [ring]},
    }
    content: dict[str, Any] = {"type": "FeatureCollection", "features": [feature]}
    if crs is not None:
        content["crs"] = {"type": "name", "properties": {"name": crs}}
    path = tmp_path / "lots.geojson"
    path.write_text(json.dumps(content))
    return path


def box_of(model: CityModel) -> tuple[list[float], list[float]]:
    """In the model's CRS."""
    every = np.concatenate(
        [one.part.positions_m.astype(float) + one.offset_m for one in model.buildings]
    ) + np.array(model.origin_m)
    return every.min(axis=0).round(3).tolist(), every.max(axis=0).round(3).tolist()


@pytest.mark.parametrize(
    ("properties", "height"),
    [({"height": 7.5}, 7.5), ({"building:levels": "4"}, 12.0), ({"Hoehe": "8,5 m"}, 8.5)],
)
def test_outlines_become_prisms(tmp_path: Path, properties: dict[str, Any], height: float) -> None:
    model = read_city_model(outlines(tmp_path, **properties), ModelOptions())
    assert model.crs == "EPSG:25832"
    assert box_of(model) == ([500_000, 5_500_000, 0], [500_010, 5_500_006, height])
    facades = facades_of(model)
    assert sorted(facades.width.round(3).tolist()) == [6.0, 6.0, 10.0, 10.0]
    # Outward is away from the middle.
    middle = facades.middle.mean(axis=0)
    assert ((facades.outward * (facades.middle - middle)).sum(axis=1) > 0.0).all()


def test_the_attribute_of_heights_can_be_named(tmp_path: Path) -> None:
    path = outlines(tmp_path, top=9.0, height=3.0)
    model = read_city_model(path, ModelOptions(height_attribute="top"))
    assert box_of(model)[1][2] == 9.0
    with pytest.raises(InputError, match="--height-attribute"):
        read_city_model(path, ModelOptions(height_attribute="missing"))


def test_ground_heights_of_outlines(tmp_path: Path) -> None:
    model = read_city_model(outlines(tmp_path, height=5, ground_elevation=112.5), ModelOptions())
    assert (box_of(model)[0][2], box_of(model)[1][2]) == (112.5, 117.5)


def test_a_model_without_a_crs_is_refused_and_a_given_one_is_taken(tmp_path: Path) -> None:
    path = outlines(tmp_path, None, height=5)
    with pytest.raises(InputError, match="--crs"):
        read_city_model(path, ModelOptions())
    assert read_city_model(path, ModelOptions(crs="EPSG:25832")).crs == "EPSG:25832"
    with pytest.raises(InputError, match="says that it is in EPSG:25832"):
        read_city_model(outlines(tmp_path, height=5), ModelOptions(crs="EPSG:31467"))


OBJ = """o one
v 0 0 0
v 8 0 0
v 8 0 5
v 0 0 5
v 0 3 0
v 8 3 0
v 8 3 5
v 0 3 5
f 1 2 3 4
f 5 8 7 6
f 1 5 6 2
f 2 6 7 3
f 3 7 8 4
f 4 8 5 1
"""


@pytest.mark.parametrize("up", ["auto", "y", "z"])
def test_obj_has_the_least_axis_up_unless_told(tmp_path: Path, up: str) -> None:
    path = tmp_path / "town.obj"
    path.write_text(OBJ)
    options = ModelOptions.model_validate({"crs": "EPSG:25832", "model_up": up})
    model = read_city_model(path, options)
    low, high = box_of(model)
    # y is 3, z is 5: y is up by itself; then -z is north.
    expected = ([0, 0, 0], [8, 3, 5]) if up == "z" else ([0, -5, 0], [8, 0, 3])
    assert (low, high) == expected
    normals = model.buildings[0].part.triangles.polygon_normal
    wall = model.buildings[0].part.features.class_code == SemanticClass.WALL.code
    assert wall.sum() == 4
    # The faces of the file look inwards: they are turned round.
    facades = facades_of(model)
    away = facades.middle - facades.middle.mean(axis=0)
    assert ((facades.outward * away).sum(axis=1) > 0.0).all()
    assert len(normals) == 6


def test_degrees_become_metres(tmp_path: Path) -> None:
    way = pyproj.Transformer.from_crs("EPSG:32632", "EPSG:4326", always_xy=True)
    corners = np.array(OUTLINE[:4]) + np.array([650_000.0, 5_480_000.0])
    flat = np.column_stack(way.transform(corners[:, 0], corners[:, 1]))
    vertices = [[*place, height] for height in (0.0, 5.0) for place in flat.tolist()]
    faces = [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]]
    solid = {"type": "Solid", "lod": "1", "boundaries": [[[face] for face in faces]]}
    content = {
        "type": "CityJSON",
        "version": "2.0",
        "metadata": {"referenceSystem": "https://www.opengis.net/def/crs/EPSG/0/4979"},
        "CityObjects": {"a": {"type": "Building", "geometry": [solid]}},
        "vertices": vertices,
    }
    path = tmp_path / "degrees.json"
    path.write_text(json.dumps(content))
    model = read_city_model(path, ModelOptions())
    assert model.crs == "EPSG:32632"
    assert any("converted from EPSG:4979" in note for note in model.notes)
    low, high = box_of(model)
    assert np.allclose([*low, *high], [650_000, 5_480_000, 0, 650_010, 5_480_006, 5], atol=0.01)


def test_metres_of_the_webs_maps_are_none(tmp_path: Path) -> None:
    """At 60 degrees north they are half as long."""
    metadata = {"referenceSystem": "https://www.opengis.net/def/crs/EPSG/0/3857"}
    north = pyproj.Transformer.from_crs("EPSG:4326", "EPSG:3857", always_xy=True)
    east, up = north.transform(9.0, 60.0)
    place = {"scale": [1, 1, 1], "translate": [east, up, 0]}
    path = houses(tmp_path, ["a"], metadata=metadata, transform=place)
    model = read_city_model(path, ModelOptions())
    assert model.crs == "EPSG:32632"
    low, high = box_of(model)
    assert np.allclose(np.subtract(high, low), [5.0, 3.0, 5.0], atol=0.05)


def houses(tmp_path: Path, names: list[str], **changed: Any) -> Path:
    """CityJSON with boxes of these names, one beside the other."""
    faces = [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]]
    vertices, objects = [], {}
    for number, name in enumerate(names):
        own = [[[[8 * number + corner for corner in face]] for face in faces]]
        solid = {"type": "Solid", "lod": "1", "boundaries": own}
        attributes = {"area": "AREA"}
        objects[name] = {"type": "Building", "attributes": attributes, "geometry": [solid]}
        for height in (0, 5):
            vertices += [[20 * number + x, y, height] for x, y in OUTLINE[:4]]
    content = {
        "type": "CityJSON",
        "version": "2.0",
        "transform": {"scale": [1, 1, 1], "translate": [500_000, 5_500_000, 0]},
        "metadata": {"referenceSystem": "https://www.opengis.net/def/crs/EPSG/0/25832"},
        "CityObjects": objects,
        "vertices": vertices,
    } | changed
    path = tmp_path / "houses.json"
    path.write_text(json.dumps(content).replace('"AREA"', "1e999"))
    return path


def test_every_building_has_a_name_of_its_own(tmp_path: Path) -> None:
    """Two features of a sequence may have one name, and a name may look like ours."""
    whole = json.loads(houses(tmp_path, ["a#2", ""]).read_text())
    again = json.loads(houses(tmp_path, ["a"]).read_text())
    head = {key: whole[key] for key in ("type", "version", "transform", "metadata")}
    lines = [head] + [
        {"type": "CityJSONFeature", **{key: one[key] for key in ("CityObjects", "vertices")}}
        for one in (again, again, whole)
    ]
    path = tmp_path / "houses.city.jsonl"
    path.write_text("\n".join(json.dumps(line).replace("Infinity", "0") for line in lines))
    model = read_city_model(path, ModelOptions())
    assert [one.id for one in model.buildings] == ["a", "a#2", "a#2#2", "building"]


def test_numbers_that_json_cannot_write_are_left_out(tmp_path: Path) -> None:
    model = read_city_model(houses(tmp_path, ["a"]), ModelOptions())
    assert model.buildings[0].part.attributes == {}


def test_models_that_are_no_town_are_refused(tmp_path: Path) -> None:
    """Coordinates about the middle of the Earth, and a corner beyond the Moon."""
    geocentric = {"referenceSystem": "https://www.opengis.net/def/crs/EPSG/0/4978"}
    with pytest.raises(InputError, match="EPSG:4978"):
        read_city_model(houses(tmp_path, ["a"], metadata=geocentric), ModelOptions())
    corners = [[0, 0, 0], [9, 0, 0], [9, 9, 0], [0, 9, 0]]
    high = corners + [[x, y, 1e300] for x, y, _ in corners]
    with pytest.raises(InputError, match="reaches over"):
        read_city_model(houses(tmp_path, ["a"], vertices=high), ModelOptions())


def test_neighbours_hide_the_walls_between_them(tmp_path: Path) -> None:
    features = []
    for x in (0.0, 10.0):
        ring = [[500_000 + a + x, 5_500_000 + b] for a, b in OUTLINE]
        geometry = {"type": "Polygon", "coordinates": [ring]}
        features.append({"type": "Feature", "properties": {"height": 6}, "geometry": geometry})
    crs = {"type": "name", "properties": {"name": "EPSG:25832"}}
    path = tmp_path / "two.geojson"
    path.write_text(json.dumps({"type": "FeatureCollection", "crs": crs, "features": features}))
    facades = facades_of(read_city_model(path, ModelOptions()))
    assert facades.hidden.sum() == 2
    assert np.allclose(facades.middle[facades.hidden][:, 0], 10.0)


@pytest.mark.regression
def test_delft() -> None:
    path = DATA / "city" / "delft.json"
    if not path.exists():
        pytest.skip(f"{path} is not there")
    model = read_city_model(path, ModelOptions())
    assert (model.crs, len(model.buildings)) == ("EPSG:7415", 160)
    facades = facades_of(model)
    assert 800 < len(facades) < 1300
    assert 0.1 < facades.hidden.mean() < 0.4


def test_a_crs_without_a_way_to_metres_is_named() -> None:
    """EPSG:5832 (zone 2, whose eastings begin at 2,500 km) where it is not used."""
    sample = np.array([[500_000.0, 5_000_000.0, 80.0]])
    with pytest.raises(InputError, match=r"EPSG:5832.*not known how to make metres"):
        metres_of("points.txt", "EPSG:5832", sample)
