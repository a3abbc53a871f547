"""Ground and plants around a house: areas, heights of a plane, what stands on a slope."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from sample_plan import opening, sample_plan, sample_storey
from shapely.geometry import LineString, Point, Polygon
from shapely.ops import unary_union

from veduta.plan.house.build import House, build_house
from veduta.plan.house.placing import place_of
from veduta.plan.house.space import Space, space_of
from veduta.plan.options import HouseOptions
from veduta.plan.surroundings.build import (
    GROUND,
    add_surroundings,
    build_surroundings,
    ground_part,
)
from veduta.plan.surroundings.plants import body, resting_height
from veduta.plan.surroundings.terrain import DRIVE_M, LEVEL_M, terrain_of

SLOPED = HouseOptions(ground_slope=8.0)


def space(**changes: object) -> Space:
    return space_of(sample_storey(**changes), 2.55)


def test_areas_cover_the_plot_once() -> None:
    terrain = terrain_of(space(), 0.0)
    under = terrain.plot.difference(terrain.house.buffer(-0.1, join_style="mitre"))
    areas = [region for _, region in terrain.areas]
    assert sum(region.area for region in areas) == pytest.approx(under.area, rel=1e-3)
    assert unary_union(areas).area == pytest.approx(under.area, rel=1e-3)
    assert [kind for kind, _ in terrain.areas] == ["path", "gravel", "lawn"]


def test_a_path_leads_from_the_front_door_to_the_end_of_the_plot() -> None:
    """The sample's front door is 1.1 m right of its corner, in the south wall."""
    paths = dict(terrain_of(space(), 0.0).areas)["path"]
    way = LineString([(1.1, -0.2), (1.1, -9.0)])
    assert paths.buffer(1e-6).covers(way)


def test_a_garage_has_a_drive() -> None:
    garage = opening("garage", "east", 1.0, 2.4, type="garage")
    storey = sample_storey()
    terrain = terrain_of(space(openings=[*storey.openings, garage]), 0.0)
    drive = dict(terrain.areas)["drive"]
    _, bottom, right, top = drive.bounds
    assert top - bottom == pytest.approx(DRIVE_M, abs=1e-6)
    assert right == pytest.approx(terrain.plot.bounds[2])


def test_a_slope_falls_before_the_house_and_rises_behind_it() -> None:
    terrain = terrain_of(space(), 8.0)
    fall = math.tan(math.radians(8.0))
    # The front door looks south: y = -0.15 is the front, 5.15 the back.
    heights = terrain.height(np.array([[3.0, 0.0], [3.0, -2.0], [3.0, -9.65], [3.0, 14.65]]))
    front, back = -9.65 + 0.15 + LEVEL_M, 14.65 - 5.15 - LEVEL_M
    assert heights == pytest.approx([0.0, 0.0, fall * front, fall * back])
    assert heights[2] < 0.0 < heights[3]


@pytest.mark.parametrize("options", [HouseOptions(), SLOPED])
def test_the_ground_is_one_surface_that_looks_up(options: HouseOptions) -> None:
    around = build_surroundings(space(), options)
    part = around.ground
    normals = part.triangles.polygon_normal
    assert (normals[:, 2] > 0.9).all()
    corners = part.positions_m.astype(np.float64)
    assert corners[:, 2] == pytest.approx(around.terrain.height(corners[:, :2]), abs=1e-5)
    seen_from_above = (part.triangles.polygon_area_m2 * normals[:, 2]).sum()
    assert seen_from_above == pytest.approx(
        sum(region.area for _, region in around.terrain.areas), rel=1e-4
    )


def test_what_stands_on_a_slope_stands_by_its_lowest_part() -> None:
    """Its foot touches the ground at its lowest side, and is above it nowhere."""
    around = build_surroundings(space(), SLOPED)
    assert any(abs(plant.at_m[2]) > 0.1 for plant in around.plants)
    for plant in around.plants:
        ground = around.terrain.height(np.array([plant.at_m[:2]]))[0]
        assert plant.at_m[2] <= ground + 1e-9
        assert plant.at_m[2] >= ground - plant.foot_m * around.terrain.slope - 1e-9
    wide = resting_height(around.terrain, (3.0, -9.0), 1.0)
    middle = around.terrain.height(np.array([[3.0, -9.0]]))[0]
    assert wide == pytest.approx(middle - around.terrain.slope, rel=1e-6)


def test_plants_leave_the_house_its_paths_and_the_way_around_free() -> None:
    around = build_surroundings(space(), HouseOptions())
    kinds = {plant.kind for plant in around.plants}
    assert kinds >= {"tree", "shrub"}
    path = dict(around.terrain.areas)["path"].difference(around.terrain.house.buffer(0.6))
    for plant in around.plants:
        at = Point(plant.at_m[:2])
        faces = np.concatenate([face for _, part in body(plant) for face in part])
        low = faces[faces[:, 2] < 2.0]
        reach = float(np.hypot(low[:, 0], low[:, 1]).max())
        away = around.terrain.house.distance(at)
        assert away - reach > 0.8
        assert path.distance(at) > reach
        # Once around the house, 5 m from it, 0.6 m to each side.
        assert not 4.4 - reach < away < 5.6 + reach


def test_bodies_of_plants_are_closed_where_they_are_balls() -> None:
    plant = next(p for p in build_surroundings(space(), HouseOptions()).plants if p.kind == "shrub")
    faces = body(plant)[0][1]
    volume = sum(float(np.dot(f[0], np.cross(f[1], f[2]))) / 6.0 for f in faces)
    high = plant.height_m
    ball = 4.0 / 3.0 * math.pi * (0.62 * high) ** 3 * 0.9
    assert 0.6 * ball < volume < ball


def test_the_place_has_ground_to_walk_on() -> None:
    house: House = build_house(sample_plan(), HouseOptions())
    around = build_surroundings(house.spaces[0], HouseOptions())
    place = place_of(house, "house.glb", None, HouseOptions())
    add_surroundings(place, around)
    assert [(part.id, part.standing.ground) for part in place.parts.values()] == [
        ("house", False), (GROUND, True), ("garden", False)
    ]  # fmt: skip
    plot = Polygon(around.terrain.plot.exterior)
    assert place.start is not None
    assert plot.covers(Point(place.start.eye[:2]))


def test_the_same_house_has_the_same_garden() -> None:
    first, second = (build_surroundings(space(), HouseOptions()) for _ in range(2))
    assert first.plants == second.plants


def test_ground_too_thin_for_single_precision_is_left_out_and_said() -> None:
    terrain = terrain_of(space(), 0.0)
    # It has a breadth in double precision alone.
    thin = Polygon([(90.0, 3.0), (95.0, 3.0), (95.0, 3.0 + 1e-9)])
    assert thin.area > 0.0
    ground = ground_part(replace(terrain, areas=(*terrain.areas, ("drive", thin))))
    assert len(ground.triangles.polygon_area_m2) == len(terrain.areas)
    assert "drive" in ground.notes[-1]
