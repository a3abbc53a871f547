"""Houses behind facades: their roofs and ends come from the surface model, and they close."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from city_oracle import faults, mesh_of, points_of, solids_of
from numpy.typing import NDArray

from veduta.drive.build.bodies import bodies_of
from veduta.drive.build.body_file import write_bodies
from veduta.drive.build.body_mesh import houses_mesh
from veduta.drive.build.facade_planes import FacadePlane
from veduta.drive.read.surface_model import read_heights
from veduta.drive.record import HeightGrid
from veduta.place.semantics import SemanticClass
from veduta.synthetic.drives import StreetOptions, build_street
from veduta.synthetic.drives.surface import surface_of, write_surface

FRONT_X, GROUND_M = -10.0, 1.5


def _plane(first_y: float, last_y: float) -> FacadePlane:
    """A front along y at x = -10, seen from the east: north is to the right."""
    left, right = np.array([FRONT_X, first_y, GROUND_M]), np.array([FRONT_X, last_y, GROUND_M])
    return FacadePlane(0, 10, left, right, 5.0)


def _grid(
    houses: list[tuple[float, float, float, NDArray[np.float64]]], sigma_m: float = 0.1
) -> HeightGrid:
    """Houses from y to y, so deep, with (k, 2) profiles of heights over their depth."""
    random = np.random.default_rng(5)
    heights = np.full((80, 60), GROUND_M)
    y, x = np.meshgrid(np.arange(80) + 0.5 - 20.0, np.arange(60) + 0.5 - 45.0, indexing="ij")
    behind = FRONT_X - x
    for begin, end, deep, profile in houses:
        inside = (y > begin) & (y < end) & (behind > 0) & (behind < deep)
        told = GROUND_M + np.interp(behind, profile[:, 0], profile[:, 1])
        heights = np.where(inside, told, heights)
    heights += random.normal(0.0, sigma_m, heights.shape)
    heights[random.uniform(size=heights.shape) < 0.03] = np.nan
    return HeightGrid(heights.astype(np.float32), (-45.0, -20.0), 1.0)


FLAT = np.array([[0.0, 8.0], [12.0, 8.0]])
GABLE = np.array([[0.0, 6.0], [5.0, 10.0], [10.0, 6.0]])


def test_a_flat_roof_ends_where_the_house_does() -> None:
    (body,) = bodies_of("a", _plane(0.0, 14.0), _grid([(0.0, 14.0, 12.0, FLAT)])).found
    np.testing.assert_allclose(body.profile, FLAT, atol=0.3)
    np.testing.assert_allclose(body.inward, [-1.0, 0.0], atol=1e-9)
    assert body.off_m < 0.15


def test_a_gable_is_found() -> None:
    (body,) = bodies_of("a", _plane(0.0, 14.0), _grid([(0.0, 14.0, 10.0, GABLE)])).found
    np.testing.assert_allclose(body.profile, GABLE, atol=0.45)


def test_two_heights_are_two_houses() -> None:
    higher = FLAT + np.array([0.0, 4.0])
    grid = _grid([(0.0, 9.0, 12.0, FLAT), (9.0, 20.0, 12.0, higher)])
    low, high = bodies_of("a", _plane(0.0, 20.0), grid).found
    assert low.front[1, 1] == pytest.approx(9.0, abs=1.01)
    np.testing.assert_array_equal(low.front[1], high.front[0])
    assert high.profile[0, 1] - low.profile[0, 1] == pytest.approx(4.0, abs=0.3)


def test_without_a_roof_there_is_no_house() -> None:
    assert not bodies_of("a", _plane(0.0, 14.0), _grid([])).found
    away = HeightGrid(np.full((5, 5), 9.0, dtype=np.float32), (500.0, 500.0), 1.0)
    assert not bodies_of("a", _plane(0.0, 14.0), away).found


def test_a_house_whose_roof_has_no_heights_is_left_out_and_said() -> None:
    """Known are only the rims of the second roof, 0.5 and 4.5 m behind the front."""
    grid = _grid([(0.0, 9.5, 12.0, FLAT)])
    heights = grid.heights_m.copy()
    heights[29:] = GROUND_M
    heights[29:, [30, 34]] += 12.0
    heights[29:, 31:34] = np.nan
    rimmed = HeightGrid(heights, grid.low, grid.cell_m)
    assert not bodies_of("a", _plane(0.0, 8.0), rimmed).roofless
    houses = bodies_of("a", _plane(10.0, 20.0), rimmed)
    assert not houses.found
    assert houses.roofless == ((0.0, 10.0),)


def test_bodies_are_closed_and_hold_what_the_houses_hold(tmp_path: Path) -> None:
    grid = _grid([(0.0, 9.0, 12.0, FLAT), (9.0, 20.0, 10.0, GABLE + np.array([0.0, 2.0]))])
    bodies = bodies_of("a", _plane(0.0, 20.0), grid).found
    path = tmp_path / "buildings.city.json"
    assert not write_bodies(bodies, path, "Street", "EPSG:25832", (5e5, 5e6, 30.0))
    city = json.loads(path.read_text())
    assert city["metadata"]["referenceSystem"].endswith("EPSG/0/25832")
    points = points_of(city)
    assert points[:, 2].min() == pytest.approx(30.0 + GROUND_M, abs=1e-3)
    volumes = []
    for told in city["CityObjects"].values():
        (geometry,) = told["geometry"]
        assert (geometry["type"], geometry["lod"]) == ("Solid", "2")
        kinds = {one["type"] for one in geometry["semantics"]["surfaces"]}
        assert kinds == {"WallSurface", "RoofSurface", "GroundSurface"}
        (faces,) = solids_of(geometry)
        assert not faults(faces, points)
        volumes.append(mesh_of(faces, points).volume)
    assert volumes[0] == pytest.approx(9.0 * 12.0 * 8.0, rel=0.12)
    assert volumes[1] == pytest.approx(11.0 * 10.0 * 10.0, rel=0.12)


def test_without_bodies_there_is_no_file(tmp_path: Path) -> None:
    assert not write_bodies([], tmp_path / "b.json", "Street", None, (0.0, 0.0, 0.0))
    assert not list(tmp_path.iterdir())


def test_the_surface_of_a_street_has_its_houses(tmp_path: Path) -> None:
    """Read from a GeoTIFF, in a frame of its own; the truth is the street's own boxes."""
    street = build_street(StreetOptions(length_m=60.0, trees=0.0, cars=0.0, lamps=0.0), 11)
    heights, low = surface_of(street, 1.0, 11)
    write_surface(heights, low, tmp_path / "s.tif")
    grid = read_heights(tmp_path / "s.tif", (100.0, 0.0, -GROUND_M))
    assert grid is not None
    for (_, y0, z0), (front, y1, z1) in street.walls.tolist():
        if z0 > 0.0 or y0 < 0.0 or y1 > 60.0:
            continue
        left, right = (np.array([front - 100.0, y, GROUND_M]) for y in (y0 + 0.5, y1 - 0.5))
        (body,) = bodies_of("a", FacadePlane(0, 10, left, right, 5.0), grid).found
        assert body.profile[:, 1].max() == pytest.approx(z1, abs=0.5)
        assert body.profile[-1, 0] == pytest.approx(10.0, abs=1.3)


def test_houses_of_the_place_are_the_bodies_without_fronts() -> None:
    """With the fronts and the ground that are left out each is closed, and turns outwards."""
    grid = _grid([(0.0, 14.0, 10.0, GABLE), (14.0, 30.0, 12.0, FLAT * [1.0, 1.5])])
    bodies = bodies_of("a", _plane(0.0, 30.0), grid).found
    assert len(bodies) == 2
    mesh = houses_mesh(bodies, np.array([-10.0, 15.0, 0.0]))
    corners = mesh.positions_m.astype(float)[mesh.triangles] + [-10.0, 15.0, 0.0]
    areas = 0.5 * np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    whole, missing = np.zeros(3), np.zeros(3)
    for body in bodies:
        for kind, face in body.faces():
            turned = np.cross(face, np.roll(face, -1, axis=0)).sum(axis=0) / 2
            whole += np.abs(turned) if kind in ("roof", "back", "left", "right") else 0.0
            missing += turned if kind in ("front", "ground") else 0.0
    np.testing.assert_allclose(np.abs(areas).sum(axis=0), whole, rtol=1e-4)
    np.testing.assert_allclose(areas.sum(axis=0) + missing, 0.0, atol=0.05)
    walls = mesh.features.class_code[mesh.triangle_feature] == SemanticClass.WALL.code
    assert np.abs(areas[~walls, 2]).sum() > 0.95 * np.abs(areas[:, 2]).sum()
