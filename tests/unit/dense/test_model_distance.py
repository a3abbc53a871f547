"""A cloud held against a city model of which each distance is known."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import laspy
import numpy as np
import pytest
from numpy.typing import NDArray
from pyproj import Transformer

from veduta.cameras import CameraSet
from veduta.dense.build.cloud import DenseCloud
from veduta.dense.build.composing import compose
from veduta.dense.build.model_distance import (
    FAR,
    DistanceParameters,
    distance_colours,
    histogram,
    legend_picture,
    model_distance,
)
from veduta.dense.read.city_model import read_city_mesh
from veduta.formats.laz import write_laz
from veduta.place.place import Place
from veduta.run.errors import InputError

ORIGIN = (500_000.0, 5_000_000.0, 100.0)
FACES = [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]]
KINDS = ["GroundSurface", "RoofSurface", *["WallSurface"] * 4]


def _cameras(crs: str | None = "EPSG:25832") -> CameraSet:
    return CameraSet((), None, None, None, "metres", crs, ORIGIN, source="test")


def _model(path: Path, change: dict[str, Any] | None = None, turned: bool = False) -> Path:
    """A house 10 m east to west, 8 m deep and 6 m high, its lower corner at the origin."""
    corners = [[0, 0], [10, 0], [10, 8], [0, 8]]
    vertices = [[1000 * x, 1000 * y, z] for z in (0, 6000) for x, y in corners]
    faces = [face[::-1] for face in FACES] if turned else FACES
    solid = {
        "type": "Solid",
        "lod": "2",
        "boundaries": [[[face] for face in faces]],
        "semantics": {
            "surfaces": [{"type": kind} for kind in KINDS],
            "values": [list(range(6))],
        },
    }
    made = {
        "type": "CityJSON",
        "version": "2.0",
        "metadata": {"referenceSystem": "https://www.opengis.net/def/crs/EPSG/0/25832"},
        "transform": {"scale": [0.001] * 3, "translate": list(ORIGIN)},
        "CityObjects": {"house": {"type": "Building", "geometry": [solid]}},
        "vertices": vertices,
    }
    path.write_text(json.dumps({**made, **(change or {})}))
    return path


POINTS: NDArray[np.float64] = np.array([
    [5, -0.3, 3], [5, 0.2, 3], [4, 4, 6.5], [13, 12, 3], [2, 2, 0.9], [40, 0, 0]
])  # fmt: skip
DISTANCES = [0.3, -0.2, 0.5, 5.0, -2.0, np.hypot(30.0, 0.0)]
"""The floor does not count: 0.9 m above it the south wall is nearest."""


@pytest.mark.parametrize("turned", [False, True])
def test_distances_are_signed_and_the_floor_does_not_count(tmp_path: Path, turned: bool) -> None:
    model = read_city_mesh(_model(tmp_path / "m.city.json", turned=turned), _cameras())
    assert (model.buildings, len(model.triangles), model.notes) == (1, 10, ())
    found = model_distance(POINTS, model, 2.0, DistanceParameters())
    assert np.allclose(found.distances_m, DISTANCES)
    assert found.compared.tolist() == [True, True, True, False, True, False]
    assert found.figures() == {
        "compared_share": 0.6667,
        "signed_median_m": 0.05,
        "median_m": 0.4,
        "p90_m": 1.55,
    }
    assert (found.colours[[3, 5]] == FAR).all()
    assert found.range_m == 2.0
    edges, shares = histogram(found)
    assert (edges[0], edges[-1], shares.sum()) == (-2.0, 2.0, pytest.approx(100.0))
    picture = legend_picture(found)
    assert picture.dtype == np.uint8
    assert (picture == distance_colours(np.array([-1.9]), 2.0)[0]).all(axis=2).any()


def test_red_is_before_and_blue_behind() -> None:
    behind, on, before = distance_colours(np.array([-3.0, 0.0, 3.0]), 1.0).astype(int)
    assert behind[2] > behind[0] + 100
    assert before[0] > before[2] + 100
    assert on.min() > 200


def test_a_model_in_another_system_is_converted(tmp_path: Path) -> None:
    plain = read_city_mesh(_model(tmp_path / "m.city.json"), _cameras())
    there = Transformer.from_crs("EPSG:25832", "EPSG:25833", always_xy=True)
    corners = [[0, 0], [10, 0], [10, 8], [0, 8]]
    moved = [
        [*there.transform(x + ORIGIN[0], y + ORIGIN[1]), z + ORIGIN[2]]
        for z in (0, 6)
        for x, y in corners
    ]
    change = {
        "metadata": {"referenceSystem": "urn:ogc:def:crs:EPSG::25833"},
        "transform": {"scale": [1, 1, 1], "translate": [0, 0, 0]},
        "vertices": moved,
    }
    found = read_city_mesh(_model(tmp_path / "n.city.json", change), _cameras())
    assert np.allclose(found.positions_m, plain.positions_m, atol=1e-3)
    assert "converted from EPSG:25833 to EPSG:25832" in found.notes[0]
    nameless = read_city_mesh(_model(tmp_path / "o.city.json", {"metadata": {}}), _cameras())
    assert "names no coordinate system" in nameless.notes[0]


def test_what_cannot_be_compared_is_refused(tmp_path: Path) -> None:
    path = _model(tmp_path / "m.city.json")
    with pytest.raises(InputError, match=r"--model.*coordinate system.*veduta photos DIR --model"):
        read_city_mesh(path, _cameras(None))
    empty = _model(tmp_path / "e.city.json", {"CityObjects": {}})
    with pytest.raises(InputError, match=r"e\.city\.json.*no building.*another model"):
        read_city_mesh(empty, _cameras())
    (tmp_path / "t.json").write_text("{}")
    with pytest.raises(InputError, match=r"t\.json.*is not CityJSON"):
        read_city_mesh(tmp_path / "t.json", _cameras())


def test_no_point_near_the_model_has_no_middle(tmp_path: Path) -> None:
    model = read_city_mesh(_model(tmp_path / "m.city.json"), _cameras())
    found = model_distance(POINTS + 900.0, model, 2.0, DistanceParameters())
    assert found.figures() == {"compared_share": 0.0}
    assert legend_picture(found).shape[2] == 3


def test_the_distances_are_a_layer_of_the_place(tmp_path: Path) -> None:
    count = len(POINTS)
    colours = np.full((count, 3), 7, dtype=np.uint8)
    tints = np.arange(3 * count, dtype=np.uint8).reshape(count, 3)
    normals, views = np.zeros((count, 3), np.float32), np.full(count, 3, np.uint8)
    cloud = DenseCloud(POINTS, normals, colours, views)
    compose("place", _cameras(), cloud, None, 0, tints).save(tmp_path)
    own, shown = Place.load(tmp_path).clouds
    assert (own.layer, shown.layer) == ("points", "distances")
    assert np.array_equal(own.colours, colours)
    assert np.array_equal(shown.colours, tints)


def test_the_distances_are_a_column_of_the_laz(tmp_path: Path) -> None:
    path = tmp_path / "d.laz"
    tints = np.zeros((len(POINTS), 3), dtype=np.uint8)
    column = {"distance_m": np.array(DISTANCES, dtype=np.float32)}
    write_laz(POINTS, tints, path, crs="EPSG:25832", origin_m=ORIGIN, extra=column)
    assert np.allclose(laspy.read(path)["distance_m"], DISTANCES)
