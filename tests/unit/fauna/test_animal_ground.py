"""Ground without a place: grids of heights, meshes, and animals that keep out of each other's
way.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import rasterio
from rasterio.transform import from_origin

from veduta.fauna.build.going import first_view, round_path
from veduta.fauna.path.ground import around_others, ground_of, local_points
from veduta.fauna.path.limits import PathLimits
from veduta.fauna.path.terrain import terrain_of_heights
from veduta.fauna.path.through import path_through
from veduta.place.manifest import AnimalClip, PlaceAnimal
from veduta.place.mesh import Mesh
from veduta.place.place import Place
from veduta.run.errors import InputError


def _tiff(
    path: Path, heights: np.ndarray, *, crs: str = "EPSG:32631", cell: float = 0.5,
    nodata: float | None = -9999.0, unit: str | None = None,
) -> Path:  # fmt: skip
    """Row 0 is the northernmost."""
    with rasterio.open(
        path, "w", driver="GTiff", width=heights.shape[1], height=heights.shape[0], count=1,
        dtype="float32", crs=crs, nodata=nodata, transform=from_origin(500.0, 900.0, cell, cell),
    ) as file:  # fmt: skip
        file.write(heights.astype(np.float32), 1)
        if unit is not None:
            file.units = [unit]
    return path


def test_heights_become_a_place_whose_ground_is_where_they_say(tmp_path: Path) -> None:
    rows, columns = np.indices((60, 80))
    heights = 100.0 + 0.05 * (60 - 1 - rows) + 0.02 * columns
    heights[0, 0] = -9999.0
    place, terrain = ground_of(_tiff(tmp_path / "hill.tif", heights), 0.8)
    assert place.crs == "EPSG:32631"
    assert place.origin_m == (500.0, 870.0, 100.0)
    at = np.array([[10.25, 5.25], [0.25, 29.75]])
    np.testing.assert_allclose(terrain.footing(at)[0], 0.05 * 10 + 0.02 * 20, atol=1e-4)
    assert terrain.blocked[-1, 0]
    (part,) = place.parts.values()
    assert part.standing.ground
    points, _ = part.triangles()
    wanted = 0.05 * (points[:, 1] / 0.5 - 0.5) + 0.02 * (points[:, 0] / 0.5 - 0.5)
    np.testing.assert_allclose(points[:, 2], wanted, atol=1e-4)


def test_points_of_the_crs_are_those_of_the_place(tmp_path: Path) -> None:
    place, terrain = ground_of(_tiff(tmp_path / "flat.tif", np.full((60, 80), 4.0)), 0.8)
    points = np.array([[510.0, 880.0], [530.0, 890.0]])
    np.testing.assert_allclose(local_points(points, place, terrain), [[10, 10], [30, 20]])
    own = np.array([[10.0, 10.0], [30.0, 20.0]])
    np.testing.assert_array_equal(local_points(own, place, terrain), own)


def test_a_mesh_that_is_all_ground_is_one(tmp_path: Path) -> None:
    path = tmp_path / "slope.obj"
    path.write_text("v 0 0 0\nv 20 1 0\nv 20 1 -10\nv 0 0 -10\nf 1 2 3\nf 1 3 4\n")
    _, terrain = ground_of(path, 0.8)
    np.testing.assert_allclose(terrain.footing(np.array([[10.0, 5.0]])), [0.5], atol=1e-5)
    assert not terrain.blocked.any()


@pytest.mark.parametrize(
    ("crs", "cell", "heights", "fault"),
    [
        ("EPSG:4326", 0.5, np.zeros((9, 9)), "has degrees"),
        ("EPSG:32631", 0.5, np.full((9, 9), -9999.0), "has no heights"),
        ("EPSG:2229", 0.5, np.zeros((9, 9)), "has lengths in US survey foot"),
        ("EPSG:32631", 0.5, np.zeros((1, 9)), "has 1 rows and 9 columns"),
        ("EPSG:32631", 0.5, np.zeros((9, 1)), "has 9 rows and 1 columns"),
    ],
)
def test_heights_that_are_none_are_refused(
    tmp_path: Path, crs: str, cell: float, heights: np.ndarray, fault: str
) -> None:
    with pytest.raises(InputError, match=fault):
        ground_of(_tiff(tmp_path / "x.tif", heights, crs=crs, cell=cell), 0.8)


def test_what_stands_for_no_height_is_no_ground(tmp_path: Path) -> None:
    heights = np.full((9, 9), 12.0)
    heights[2, 3] = -9999.0
    with pytest.raises(InputError, match="has 1 heights such as -9999 m") as raised:
        ground_of(_tiff(tmp_path / "x.tif", heights, nodata=None), 0.8)
    assert "nodata" in str(raised.value)


@pytest.mark.parametrize(("unit", "refused"), [("ft", True), ("metre", False)])
def test_heights_in_feet_are_refused(tmp_path: Path, unit: str, refused: bool) -> None:
    path = _tiff(tmp_path / "x.tif", np.full((9, 9), 12.0), unit=unit)
    if refused:
        with pytest.raises(InputError, match="has lengths in ft"):
            ground_of(path, 0.8)
    else:
        assert ground_of(path, 0.8)[0].origin_m[2] == 12.0


def test_a_file_that_is_no_grid_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "x.tif"
    path.write_text("heights")
    with pytest.raises(InputError, match="is no GeoTIFF"):
        ground_of(path, 0.8)
    with pytest.raises(InputError, match="no such file"):
        ground_of(tmp_path / "none.tif", 0.8)


def test_houses_without_ground_stand_on_a_level_one(tmp_path: Path) -> None:
    square = np.array([[0, 0, 2.0], [4, 0, 2.0], [4, 4, 2.0], [0, 4, 5.0]])
    place = Place()
    for name, east in (("one", 0.0), ("two", 20.0)):
        faces = np.array([[0, 1, 2], [0, 2, 3]])
        place.add(Mesh.simple(name, square + np.array([east, 0.0, 0.0]), faces))
    place.save(tmp_path)
    found, terrain = ground_of(tmp_path, 0.8)
    assert found.parts["level-ground"].standing.ground
    np.testing.assert_allclose(terrain.footing(np.array([[10.0, 2.0]])), [2.0], atol=1e-4)
    assert terrain.blocked.any()
    assert not terrain.blocked.all()


def test_animals_keep_out_of_each_other_s_way() -> None:
    terrain = terrain_of_heights(np.zeros((80, 80)), 0.25, (0.0, 0.0))
    wall = np.column_stack([np.full(30, 10.0), np.linspace(0.0, 14.0, 30), np.zeros(30)])
    other = PlaceAnimal(
        id="cow", name="cow", part="cow", length=2.0, path=wall.tolist(),
        clips=[AnimalClip(name="walk", seconds=1.0, stride=1.0, loops=True)],
    )  # fmt: skip
    place = Place()
    place.animals.append(other)
    clear = around_others(terrain, place, "goat", 1.0)
    assert not around_others(terrain, place, "cow", 1.0).blocked.any()
    points = np.array([[4.0, 5.0], [16.0, 5.0]])
    straight = path_through(terrain, points, PathLimits(), 1.0).points_m
    around = path_through(clear, points, PathLimits(), 1.0).points_m

    def nearest(path: np.ndarray) -> float:
        return float(np.linalg.norm(path[:, None, :2] - wall[None, :, :2], axis=2).min())

    assert nearest(straight) < 0.3
    assert nearest(around) > 0.6


@pytest.mark.parametrize("length_m", [0.05, 3.0])
def test_the_first_view_is_as_near_as_the_animal_is_small(length_m: float) -> None:
    far = np.column_stack([np.linspace(0.0, 90.0, 400), np.zeros(400), np.zeros(400)])
    for path in (far, round_path(length_m)):
        start = first_view(path, length_m)
        eye, target = np.array(start.eye), np.array(start.target)
        assert 1.5 * length_m < np.linalg.norm(eye - target) < 5.0 * length_m
        assert np.linalg.norm(target[:2] - path[:, :2], axis=1).min() < 1.5 * length_m
