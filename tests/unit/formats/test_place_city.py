"""A place as CityGML, CityJSON, GeoJSON and GeoPackage, opened again by other readers."""

from __future__ import annotations

import json
import shutil
import subprocess
from collections import Counter
from dataclasses import replace
from pathlib import Path

import numpy as np
import pyogrio
import pytest
import shapely
from place_sample import MOVE_M, area_of, sample_place
from pyproj import Transformer

from veduta.formats.citygml_read import read_citygml
from veduta.formats.cityjson_read import read_cityjson
from veduta.formats.rings import faces_of
from veduta.formats.shapes import shapes
from veduta.place.mesh import Mesh
from veduta.place.place import Cloud, Place, Standing
from veduta.place.registry import formats
from veduta.place.semantics import SemanticClass
from veduta.run.errors import InputError

CRS = "EPSG:25833"
ROOT = Path(__file__).resolve().parents[3]


@pytest.fixture(scope="module")
def place() -> Place:
    return sample_place(CRS)


def area_of_rings(rings: tuple[np.ndarray, ...]) -> float:
    """Newell's formula: the outline's area less those of its holes."""
    sums = [np.cross(ring - ring[0], np.roll(ring, -1, axis=0) - ring[0]).sum(0) for ring in rings]
    return float(np.linalg.norm(np.sum(sums, axis=0)) / 2.0)


def test_polygons_come_back_from_triangles(place: Place) -> None:
    """The same area and far fewer faces; walls have their windows as holes."""
    for shape in shapes(place):
        faces = list(faces_of(shape))
        found = np.zeros(len(shape.features))
        for face in faces:
            found[face.feature] += area_of_rings(face.rings)
        np.testing.assert_allclose(found, shape.content.feature_area_m2, rtol=1e-4, atol=1e-6)
        if shape.placed.id == "house":
            assert len(faces) < 0.7 * len(shape.triangles.corners)
            assert max(len(face.rings) for face in faces) > 3


@pytest.mark.parametrize("suffix", [".gml", ".3.gml"])
def test_citygml_is_read_again(place: Place, suffix: str, tmp_path: Path) -> None:
    path = tmp_path / f"place{suffix}"
    place.write(path)
    city = read_citygml(path)
    assert city.epsg == 25833
    (house, *_) = city.buildings
    assert house.id == "house"
    assert house.lod == "3"
    classes = Counter(house.classes)
    features = place.parts["house"].content.features
    count = int((features.class_code == SemanticClass.WINDOW.code).sum())
    assert classes[SemanticClass.WINDOW] >= count
    corners = np.concatenate([ring for rings in house.polygons for ring in rings])
    middle = corners.mean(axis=0) - place.origin_m
    assert np.abs(middle - MOVE_M).max() < 15.0
    layers = {name for name, _ in pyogrio.list_layers(path)}
    assert "Building" in layers


def test_citygml_leaves_no_surface_out(place: Place, tmp_path: Path) -> None:
    place.write(tmp_path / "place.gml")
    text = (tmp_path / "place.gml").read_text("utf-8")
    ids = [word.split('"')[1] for word in text.split("gml:id=")[1:]]
    assert len(ids) == len(set(ids))
    for placed in place.parts.values():
        assert placed.id in ids
    polygons = sum(len(list(faces_of(shape))) for shape in shapes(place))
    assert text.count("<gml:Polygon ") == polygons


def test_cityjson_is_read_again(place: Place, tmp_path: Path) -> None:
    path = tmp_path / "place.city.json"
    place.write(path)
    city = read_cityjson(path)
    assert city.epsg == 25833
    house = city.buildings[0]
    assert (house.id, house.solid) == ("house", True)
    document = json.loads(path.read_bytes())
    assert document["CityObjects"]["ball"]["type"] == "GenericCityObject"
    used = {texture["image"] for texture in document["appearance"]["textures"]}
    assert used
    assert all((tmp_path / name).is_file() for name in used)
    geometry = document["CityObjects"]["house"]["geometry"][0]
    surfaces = geometry["semantics"]["surfaces"]
    for row, surface in enumerate(surfaces):
        if "parent" in surface:
            assert row in surfaces[surface["parent"]]["children"]
    assert any("parent" in surface for surface in surfaces)


def test_cityjson_is_valid(place: Place, tmp_path: Path) -> None:
    installed = ROOT / "build" / "cjval" / "bin" / "cjval"
    program = str(installed) if installed.is_file() else shutil.which("cjval")
    if program is None:
        pytest.skip("no cjval: cargo install cjval --features build-binary --root build/cjval")
    for made in (place, sample_place()):
        path = tmp_path / "place.city.json"
        made.write(path)
        done = subprocess.run(
            [program, "-r", str(path)], capture_output=True, text=True, check=True
        )
        report = json.loads(done.stdout)
        assert (report["valid"], report["has_warnings"]) == (True, False), report["checks"]


def test_outlines_are_where_the_parts_are(place: Place, tmp_path: Path) -> None:
    place.write(tmp_path / "place.gpkg")
    meta, _, shapes_read, columns = pyogrio.raw.read(tmp_path / "place.gpkg")
    assert meta["crs"] == CRS
    rows = dict(zip(meta["fields"], columns, strict=True))
    assert list(rows["id"]) == list(place.parts)
    outlines = shapely.from_wkb(shapes_read)
    ball = outlines[1]
    # Of a ball of 2 m with 320 faces, seen from above.
    assert ball.area == pytest.approx(np.pi * 4.0, rel=0.03)
    assert ball.centroid.x == pytest.approx(place.origin_m[0], abs=0.01)
    assert rows["height_m"][1] == pytest.approx(4.0, abs=0.01)
    assert list(rows["outline"]) == ["ground", "silhouette", "silhouette", "ground"]


def test_geojson_is_in_degrees(place: Place, tmp_path: Path) -> None:
    place.write(tmp_path / "place.geojson")
    place.write(tmp_path / "place.gpkg")
    turn = Transformer.from_crs(CRS, "EPSG:4326", always_xy=True)
    meta, _, found, _ = pyogrio.raw.read(tmp_path / "place.geojson")
    assert meta["crs"] == "EPSG:4326"
    metric = shapely.from_wkb(pyogrio.raw.read(tmp_path / "place.gpkg")[2])
    for degrees, metres in zip(shapely.from_wkb(found), metric, strict=True):
        expected = turn.transform(metres.centroid.x, metres.centroid.y)
        np.testing.assert_allclose((degrees.centroid.x, degrees.centroid.y), expected, atol=1e-7)


def test_geojson_in_no_crs_says_so(tmp_path: Path) -> None:
    sample_place().write(tmp_path / "place.geojson")
    document = json.loads((tmp_path / "place.geojson").read_bytes())
    assert document["crs"] is None
    assert len(document["features"]) == 4


def test_outlines_of_an_unknown_scale_are_refused(tmp_path: Path) -> None:
    place = Place(scale="unknown")
    with pytest.raises(InputError, match="no known scale"):
        place.write(tmp_path / "x.gpkg")


def _sheet(attributes: dict[str, object], crs: str | None = None) -> Place:
    place = Place(crs=crs)
    corners = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]])
    mesh = Mesh.simple("sheet", corners, np.array([[0, 1, 2]]))
    place.add(replace(mesh, attributes=attributes), Standing())
    return place


def test_columns_alike_but_for_their_case_have_their_own_names(tmp_path: Path) -> None:
    told = {"Name": "one", "NAME_": "two", "FID": 3, "geom": "four", "a\0b": 5, "": 6}
    _sheet(told).write(tmp_path / "x.gpkg")
    meta, _, _, columns = pyogrio.raw.read(tmp_path / "x.gpkg")
    rows = {name: column[0] for name, column in zip(meta["fields"], columns, strict=True)}
    assert (rows["name"], rows["Name_"], rows["NAME__"]) == ("sheet", "one", "two")
    assert (rows["FID_"], rows["geom_"], rows["a?b"], rows["_"]) == (3, "four", 5, 6)


def test_integers_over_64_bits_keep_their_digits(tmp_path: Path) -> None:
    _sheet({"large": 2**70, "small": -(2**63)}).write(tmp_path / "x.gpkg")
    meta, _, _, columns = pyogrio.raw.read(tmp_path / "x.gpkg")
    rows = {name: column[0] for name, column in zip(meta["fields"], columns, strict=True)}
    assert (rows["large"], rows["small"]) == (str(2**70), -(2**63))


@pytest.mark.parametrize("suffix", [".gpkg", ".geojson"])
def test_outlines_in_no_known_crs_are_refused(suffix: str, tmp_path: Path) -> None:
    path = tmp_path / f"x{suffix}"
    with pytest.raises(InputError, match="'EPSG:nothing', which is no coordinate") as raised:
        _sheet({}, "EPSG:nothing").write(path)
    assert raised.value.remedy
    assert not path.exists()


def test_values_that_json_cannot_hold(tmp_path: Path) -> None:
    told = {"nan": float("nan"), "inf": float("inf"), "half": "a\ud800", "count": np.int64(3)}
    place = _sheet(told)
    place.title = "b\ud800"
    for suffix in (".geojson", ".gpkg"):
        place.write(tmp_path / f"x{suffix}")
    document = json.loads((tmp_path / "x.geojson").read_bytes())
    found = document["features"][0]["properties"]
    assert [found[name] for name in told] == [None, None, "a?", 3]
    assert document["title"] == "b?"


@pytest.mark.parametrize("suffix", [".city.json", ".gml", ".glb", ".usda"])
def test_values_that_are_no_numbers_are_left_out(suffix: str, tmp_path: Path) -> None:
    path = tmp_path / f"x{suffix}"
    _sheet({"no_height": float("nan"), "no_end": -np.inf, "count": np.int64(3)}).write(path)
    text = path.read_bytes()
    assert b"count" in text
    assert all(word not in text for word in (b"no_height", b"no_end", b"NaN", b"Infinity"))


def test_a_place_outside_of_its_crs_has_no_degrees(tmp_path: Path) -> None:
    place = _sheet({}, CRS)
    place.origin_m = (1e12, 1e12, 0.0)
    with pytest.raises(InputError, match="outside of its coordinate system"):
        place.write(tmp_path / "x.geojson")


def test_a_backdrop_is_no_building(tmp_path: Path) -> None:
    place = Place()
    corners = np.array([[0, 0, 0], [1, 0, 0], [0, 0, 1]])
    place.add(Mesh.simple("sky", corners, np.array([[0, 1, 2]])), Standing(backdrop=True))
    place.write(tmp_path / "x.city.json")
    assert json.loads((tmp_path / "x.city.json").read_bytes())["CityObjects"] == {}
    with pytest.raises(InputError, match="no part with an outline"):
        place.write(tmp_path / "x.gpkg")


@pytest.mark.parametrize("suffix", sorted(formats()))
def test_the_same_place_gives_the_same_bytes(place: Place, suffix: str, tmp_path: Path) -> None:
    made = []
    if suffix == ".laz":
        place.clouds.append(Cloud("points", np.eye(3), np.full((3, 3), 9, dtype=np.uint8)))
    for name in ("one", "two"):
        folder = tmp_path / name
        folder.mkdir()
        place.write(folder / f"x{suffix}")
        made.append({file.name: file.read_bytes() for file in sorted(folder.iterdir())})
    assert made[0] == made[1]
    assert area_of(place) > 0.0
