"""Files of Veduta's and of other programs as places; those that are broken are named."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely
import trimesh
from place_sample import ball, corners_of, sample_place

import veduta
from veduta.formats.gltf import write_glb
from veduta.formats.mesh_glb import write_mesh_glb
from veduta.place.place import Cloud, Place
from veduta.place.semantics import SemanticClass
from veduta.run.errors import InputError


@pytest.mark.parametrize("suffix", [".glb", ".obj", ".stl", ".ply", ".gml", ".3.gml", ".city.json"])
def test_what_is_written_is_read(suffix: str, tmp_path: Path) -> None:
    place = sample_place("EPSG:25833")
    path = tmp_path / f"place{suffix}"
    place.write(path)
    back = veduta.load(path)
    found = corners_of(back)
    if back.crs is not None:
        assert back.crs == place.crs
        found = found + np.array(back.origin_m) - np.array(place.origin_m)
    expected = corners_of(place)
    if suffix.endswith((".gml", ".json")):  # buildings alone
        expected = corners_of(Place(parts={"house": place.parts["house"]}))
        matching = [one for one in back.parts.values() if one.id == "house"]
        assert matching
        assert matching[0].standing.name == "The house"
        found = corners_of(Place(parts={"house": matching[0]}))
        found = found + np.array(back.origin_m) - np.array(place.origin_m)
    # Balconies and chimneys are objects of their own in CityJSON: not read with their building.
    apart = 1.0 if suffix == ".city.json" else 2e-4
    np.testing.assert_allclose(found.min(axis=0), expected.min(axis=0), atol=apart)
    np.testing.assert_allclose(found.max(axis=0), expected.max(axis=0), atol=apart)


def test_materials_named_after_classes_give_them(tmp_path: Path) -> None:
    sample_place().write(tmp_path / "place.obj")
    (part,) = veduta.load(tmp_path / "place.obj").parts.values()
    features = part.content.features
    classes = {features.semantic(row) for row in range(len(features))}
    assert {SemanticClass.WINDOW, SemanticClass.WALL, SemanticClass.ROOF} <= classes


def test_a_model_of_veduta_keeps_its_features(tmp_path: Path) -> None:
    house = sample_place().parts["house"].content
    write_glb(house, tmp_path / "model.glb")
    write_mesh_glb(ball(), tmp_path / "ball.glb")
    (back,) = veduta.load(tmp_path / "model.glb").parts.values()
    assert back.content.features.id == house.features.id
    (sphere,) = veduta.load(tmp_path / "ball.glb").parts.values()
    assert sphere.content.colours[0].tolist() == [200, 100, 50]


def test_glb_of_another_program(tmp_path: Path) -> None:
    scene = trimesh.Scene(trimesh.creation.box((1.0, 2.0, 3.0)))
    (tmp_path / "box.glb").write_bytes(scene.export(file_type="glb"))
    low, high = veduta.load(tmp_path / "box.glb").bounds_m()
    np.testing.assert_allclose(high - low, [1.0, 3.0, 2.0], atol=1e-6)  # y up there


def test_points_are_read(tmp_path: Path) -> None:
    points = np.random.default_rng(1).normal(size=(50, 3))
    colours = np.random.default_rng(2).integers(0, 256, (50, 3)).astype(np.uint8)
    Place(clouds=[Cloud("p", points, colours)]).write(tmp_path / "points.ply")
    (cloud,) = veduta.load(tmp_path / "points.ply").clouds
    np.testing.assert_allclose(cloud.points_m, points, atol=1e-5)
    assert np.array_equal(cloud.colours, colours)


@pytest.mark.parametrize(
    ("name", "content"),
    [
        ("x.stl", b"solid nothing\nendsolid"),
        ("x.ply", b"ply\nformat ascii 1.0\nend_header\n"),
        ("x.ply", b"no ply"),
        ("x.obj", b"f 1 2 3\n"),
        ("x.glb", b"glTF"),
        ("x.gml", b"<a/>"),
        ("x.city.json", b"{}"),
    ],
)
def test_broken_files_are_named(name: str, content: bytes, tmp_path: Path) -> None:
    (tmp_path / name).write_bytes(content)
    with pytest.raises(InputError) as told:
        veduta.load(tmp_path / name)
    assert told.value.subject.endswith(name)
    assert told.value.remedy


def test_what_is_only_written_is_refused(tmp_path: Path) -> None:
    (tmp_path / "x.gpkg").write_bytes(b"")
    with pytest.raises(InputError, match=r"x\.gpkg: is a file that Veduta writes and does not"):
        veduta.load(tmp_path / "x.gpkg")


L_SHAPE = [(0, 0), (4, 0), (4, 1), (1, 1), (1, 4), (0, 4)]
WARPED = [(x * 100, y * 100, 2 * (k % 2)) for k, (x, y) in enumerate(L_SHAPE)]
"""cm: 7 m2 seen from above, 1 cm off its mean plane."""
YARD = [(0, 0, 0), (400, 0, 3), (400, 400, 0), (0, 400, 3)]
SHAFT = [(100, 100, 0), (100, 300, 3), (300, 300, 0), (300, 100, 3)]


def city(path: Path, boundaries: Any, vertices: Any, **more: Any) -> Path:
    house = {
        "type": "Building",
        "geometry": [{"type": "MultiSurface", "lod": "2", "boundaries": boundaries}],
    }
    document = {
        "type": "CityJSON",
        "version": "2.0",
        "transform": {"scale": [0.01] * 3, "translate": [0, 0, 0]},
        "CityObjects": {"house": house} | more,
        "vertices": vertices,
    }
    path.write_text(json.dumps(document))
    return path


@pytest.mark.parametrize("turn", range(len(WARPED)))
@pytest.mark.parametrize(("rings", "area"), [([WARPED], 7.0), ([YARD, SHAFT], 12.0)])
def test_warped_polygons_keep_their_shape_and_heights(
    rings: list[list[tuple[int, int, int]]], area: float, turn: int, tmp_path: Path
) -> None:
    """From whichever corner: nothing overlaps, nothing lies outside, no corner moves."""
    turned = [ring[turn % len(ring) :] + ring[: turn % len(ring)] for ring in rings]
    numbers = np.split(np.arange(sum(map(len, rings))), np.cumsum([len(r) for r in rings])[:-1])
    vertices = [corner for ring in turned for corner in ring]
    place = veduta.load(city(tmp_path / "a.city.json", [[n.tolist() for n in numbers]], vertices))
    corners, triangles = place.parts["house"].triangles()
    first, second, third = (corners[triangles[:, k]] for k in range(3))
    seen = np.cross(second - first, third - first)[:, 2] / 2
    assert seen.min() > 0
    assert seen.sum() == pytest.approx(area, abs=1e-4)
    flat = [[(x, y) for x, y, _ in ring] for ring in rings]
    outline = shapely.Polygon(flat[0], flat[1:]).buffer(0.1)
    for triangle in corners[triangles][:, :, :2] * 100:
        assert outline.covers(shapely.Polygon(triangle))
    found = {tuple(corner) for corner in np.round(corners * 100).astype(int).tolist()}
    assert found == set(vertices)
    np.testing.assert_allclose(corners * 100, np.round(corners * 100), atol=1e-3)


BOX = [(0, 0, 0), (400, 0, 0), (400, 300, 0), (0, 300, 0), (0, 0, 500), (400, 0, 500)]
FLOOR, WALL = [[0, 3, 2, 1]], [[0, 1, 5, 4]]
CROSSED = [[0, 1, 3, 2]]


def installation(kind: str, lod: str, boundaries: Any) -> dict[str, Any]:
    geometry = {"type": kind, "lod": lod, "boundaries": boundaries}
    return {"type": "BuildingInstallation", "parents": ["house"], "geometry": [geometry]}


def test_installations_that_cannot_be_used_are_told(tmp_path: Path) -> None:
    """The building stands without them, and with those that can."""
    parts = {
        "rail": installation("MultiLineString", "2", [[0, 1]]),
        "copy": installation("GeometryInstance", "2", [0]),
        "trace": installation("MultiSurface", "0", [FLOOR]),
        "torn": installation("MultiSurface", "2", [WALL, [[0, 1, 99]]]),
        "sill": installation("MultiSurface", "2", [WALL]),
    }
    place = veduta.load(city(tmp_path / "a.city.json", [FLOOR], BOX, **parts))
    house = place.parts["house"].content
    assert len(house.polygon_offsets) - 1 == 2
    coarse = "that has no geometry of LoD1 or above"
    assert place.notes == [
        f"left out: rail: an installation of house {coarse}",
        f"left out: copy: an installation of house {coarse}",
        f"left out: trace: an installation of house {coarse}",
        "left out: torn: an installation of house that names a vertex that is not there",
    ]


def test_polygons_that_cannot_be_drawn_are_told(tmp_path: Path) -> None:
    lost = {"type": "Building", "geometry": []}
    lost["geometry"] = [{"type": "MultiSurface", "lod": "2", "boundaries": [CROSSED]}]
    path = city(tmp_path / "a.city.json", [FLOOR, CROSSED, CROSSED], BOX, lost=lost)
    content = json.loads(path.read_text())
    content["CityObjects"]["house"]["attributes"] = {"polygons_left_out": 7}
    path.write_text(json.dumps(content))
    place = veduta.load(path)
    assert list(place.parts) == ["house"]
    assert place.parts["house"].content.attributes["polygons_left_out"] == 2
    assert place.notes == [
        "left out: house: 2 of 3 polygons cannot be drawn",
        "left out: lost: has no polygon that can be drawn",
    ]
    assert place.merge(place).notes == place.notes


def test_many_that_are_left_out_are_counted(tmp_path: Path) -> None:
    parts = {f"p{k}": installation("MultiLineString", "2", [[0, 1]]) for k in range(25)}
    place = veduta.load(city(tmp_path / "a.city.json", [FLOOR], BOX, **parts))
    assert len(place.notes) == 21
    assert place.notes[-1] == "left out: 5 more"


def test_a_city_without_a_polygon_that_can_be_drawn_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="has no polygon that can be drawn") as told:
        veduta.load(city(tmp_path / "a.city.json", [CROSSED], BOX))
    assert told.value.remedy


@pytest.mark.parametrize("name", ["none.tif", "none.city.json", "none.glb"])
def test_a_file_that_is_not_there_is_no_folder(name: str, tmp_path: Path) -> None:
    with pytest.raises(InputError, match="there is no such file"):
        veduta.load(tmp_path / name)
    with pytest.raises(InputError, match="there is no such folder"):
        veduta.load(tmp_path / "none")


def test_points_that_lie_out_of_all_reach_are_refused(tmp_path: Path) -> None:
    path = tmp_path / "far.obj"
    path.write_text("v 0 0 0\nv 1 0 0\nv 0 1e39 0\nf 1 2 3\n")
    with pytest.raises(InputError, match=r"far\.obj: has a point farther than 1e\+12 m"):
        Place.load(path)
    path.write_text("v 0 0 0\nv 1 0 0\nv 0 1e7 0\nf 1 2 3\n")
    assert Place.load(path).parts["far"].triangles()[0][:, 2].max() == 1e7
