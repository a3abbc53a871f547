"""Files of Veduta's and of other programs as places; those that are broken are named."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
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
