"""Elevations with depth, surface model and orthophoto of clouds that are known in closed form."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from veduta.cameras import Camera
from veduta.dense.build.cloud import DenseCloud
from veduta.dense.build.elevation import ElevationParameters, wall_depth, wall_detail_m
from veduta.dense.build.ground_map import ground_map, write_maps
from veduta.dense.document import Elevation
from veduta.dense.read.walls import read_elevations
from veduta.run.errors import InputError

RULE = ElevationParameters()


def _wall(turn: float = 0.0) -> Elevation:
    """8 m wide and 4 m high, from (10, 20), seen from its right hand side; pixels of 2 cm."""
    along = np.array([np.cos(turn), np.sin(turn), 0.0])
    outward = np.array([np.sin(turn), -np.cos(turn), 0.0])
    return Elevation(
        "w1", np.array([10.0, 20, 0]), along, outward, -0.2, 4.2, 0.02, (220, 420), 4.0
    )


def _points(wall: Elevation, spacing: float) -> np.ndarray[tuple[int, ...], np.dtype[np.float64]]:
    """The wall with a window that lies 0.3 m behind it, and a balcony 0.6 m before."""
    x, z = np.meshgrid(np.arange(0, 8, spacing), np.arange(0.1, 4, spacing))
    out = np.where((x > 2) & (x < 3) & (z > 1) & (z < 2.5), -0.3, 0.0)
    out = np.where((x > 5) & (x < 7) & (z > 2) & (z < 3), 0.6, out)
    along = wall.start_m + x[..., None] * wall.along + out[..., None] * wall.outward
    along[..., 2] = z
    return np.asarray(along.reshape(-1, 3))


@pytest.mark.parametrize(("turn", "spacing"), [(0.0, 0.01), (0.7, 0.035), (-2.0, 0.035)])
def test_windows_lie_behind_the_wall_and_balconies_before(turn: float, spacing: float) -> None:
    wall = _wall(turn)
    far = np.array([[11.0, 20.0, 2.0]]) + 3.0 * wall.outward  # a tree in the street
    found = wall_depth(np.concatenate([_points(wall, spacing), far]), wall, RULE)
    assert found.depths_m.shape == wall.shape

    def at(x: float, z: float) -> float:
        return float(found.depths_m[int((4.2 - z) / 0.02), int((x + 0.2) / 0.02)])

    assert at(2.5, 1.8) == pytest.approx(-0.3, abs=1e-5)
    assert at(6.0, 2.5) == pytest.approx(0.6, abs=1e-5)
    assert at(1.0, 3.0) == pytest.approx(0.0, abs=1e-5)
    assert np.isnan(at(-0.15, 4.15))
    assert np.isfinite(found.depths_m[20:200, 20:400]).mean() > 0.99


def test_detail_is_how_long_a_window_is_on_the_wall() -> None:
    wall = Elevation(
        "w", np.zeros(3), np.array([1.0, 0, 0]), np.array([0.0, -1, 0]),
        0.0, 4.0, 0.02, (200, 400), 4.0,
    )  # fmt: skip
    spot = np.array([[4.0, 0.0, 2.0]])
    for aside, far in ((0.0, 5.0), (8.0, 6.0)):
        eye = np.array([4.0 - aside, -far, 2.0])
        ahead = (spot[0] - eye) / np.hypot(aside, far)
        right = np.cross(ahead, [0.0, 0, 1])
        turn = np.stack([right, [0.0, 0, -1], ahead])
        camera = Camera("a", 640, 480, (500.0, 500.0), (320.0, 240.0), np.c_[turn, -turn @ eye])
        behind = Camera("b", 640, 480, (9.0, 9.0), (320.0, 240.0), np.c_[-turn, turn @ eye])
        found = wall_detail_m(spot, wall, [camera, behind], 9.0, RULE)
        away = np.hypot(aside, far)
        assert found == pytest.approx(9.0 * away / 500.0 / (far / away))


def test_a_wall_without_points_has_no_depth() -> None:
    wall = _wall()
    assert np.isnan(wall_depth(np.array([[0.0, 0.0, 0.0]]), wall, RULE).depths_m).all()


def test_walls_are_read_from_the_result_of_photos(tmp_path: Path) -> None:
    assert read_elevations(tmp_path) == []
    picture = {
        "file": "walls/w0.png",
        "units_per_px": 0.01,
        "width_px": 30,
        "height_px": 20,
        "left": -0.1,
        "upper": 3.0,
    }
    wall = {
        "id": "w0",
        "start": [0, 0],
        "end": [0, 3],
        "height": 2.5,
        "outward": [2, 0],
        "picture": picture,
    }
    path = tmp_path / "walls.json"
    path.write_text(json.dumps({"walls": [wall, {**wall, "picture": None}]}))
    (found,) = read_elevations(tmp_path)
    assert (found.id, found.shape, found.upper_m) == ("w0", (20, 30), 3.0)
    assert np.allclose(found.along, [0, 1, 0])
    assert np.allclose(found.outward, [1, 0, 0])
    path.write_text(json.dumps({"walls": [{**wall, "id": "../w0"}]}))
    with pytest.raises(InputError, match=r"walls\.json.*is no file of walls"):
        read_elevations(tmp_path)


def test_the_highest_points_make_the_surface_model(tmp_path: Path) -> None:
    rasterio = pytest.importorskip("rasterio")
    x, y = np.meshgrid(np.arange(0, 20, 0.1), np.arange(0, 10, 0.1))
    ground = np.stack([x.ravel(), y.ravel(), np.zeros(x.size)], axis=1)
    roof = ground[(ground[:, 0] > 12) & (ground[:, 1] > 6)] + [0, 0, 5.0]
    points = np.concatenate([roof, ground])
    colours = np.repeat([[200, 0, 0], [0, 90, 0]], [len(roof), len(ground)], axis=0)
    normals = np.zeros((len(points), 3), dtype=np.float32)
    views = np.full(len(points), 3, dtype=np.uint8)
    found = ground_map(DenseCloud(points, normals, colours.astype(np.uint8), views), 0)
    dsm, ortho = tmp_path / "dsm.tif", tmp_path / "ortho.tif"
    write_maps(found, "EPSG:25832", (500_000.0, 5_000_000.0, 100.0), dsm, ortho)
    with rasterio.open(dsm) as file, rasterio.open(ortho) as painted:
        assert file.crs.to_epsg() == 25832
        for place, height, colour in (((16, 8), 105.0, [200, 0, 0]), ((5, 5), 100.0, [0, 90, 0])):
            at = file.index(500_000.0 + place[0], 5_000_000.0 + place[1])
            assert file.read(1)[at] == pytest.approx(height)
            assert painted.read()[:3, at[0], at[1]].tolist() == colour
        assert file.tags(ns="IMAGE_STRUCTURE")["LAYOUT"] == "COG"
