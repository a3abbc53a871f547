"""Layers of a street whose classes are known, and its filled background against the true planes."""

from __future__ import annotations

import numpy as np
import pytest
from drive.drawn_street import SENSOR_M, WALL_M, grid, path, street

from veduta.drive.build.fill import Source, fill_background
from veduta.drive.build.frame import ColumnFrame, column_frame, sort_into_columns
from veduta.drive.build.layers import Layers, PointClass, split_layers
from veduta.drive.build.objects import find_objects
from veduta.drive.build.solid import solid_below
from veduta.drive.build.surface import build_surface

FARTHEST_M = 20.0


@pytest.fixture(scope="module")
def frame() -> ColumnFrame:
    line = path()
    angles = np.deg2rad(np.arange(-80.0, 60.0, 0.4))
    return column_frame(line, "left", angles, line[:, 2] - SENSOR_M)


@pytest.fixture(scope="module")
def layers(frame: ColumnFrame) -> Layers:
    points, _ = street()
    return split_layers(sort_into_columns(points, frame, 1.0, FARTHEST_M), frame, FARTHEST_M)


def test_columns_are_the_nearest_planes(frame: ColumnFrame) -> None:
    points, _ = street()
    found = sort_into_columns(points, frame, 1.0, FARTHEST_M)
    brute = np.abs(points[found.index][:, 1:2] - frame.origins[:, 1]).argmin(axis=1)
    assert (brute == found.column).mean() > 0.999
    np.testing.assert_allclose(found.depth, -points[found.index][:, 0], atol=1e-5)


def test_main_depth_is_the_wall_not_the_car(layers: Layers) -> None:
    assert np.isfinite(layers.depths.main).all()
    np.testing.assert_allclose(layers.depths.main, WALL_M, atol=0.1)
    assert (layers.depths.split < WALL_M).all()


def test_points_are_of_their_layer(layers: Layers) -> None:
    _, kind = street()
    truth = kind[layers.points.index]
    assert (layers.kind[truth == 2] == PointClass.FOREGROUND).mean() > 0.99
    high = layers.above > 0.2
    assert (layers.kind[(truth == 1) & high] == PointClass.BUILDING).mean() > 0.99
    assert (layers.kind[truth == 0] == PointClass.GROUND).mean() > 0.97


def test_car_and_pole_are_two_objects(layers: Layers) -> None:
    _, count = find_objects(layers.foreground)
    assert count == 2


def test_below_a_car_it_is_solid_down_to_the_road(layers: Layers) -> None:
    below = solid_below(layers)
    x, y, z = below.T
    car = (np.abs(x + 4.0) < 0.1) & (y > 7.9) & (y < 11.1)
    pole = (np.abs(x + 6.0) < 0.1) & (y > 14.9) & (y < 15.3)
    assert (car | pole).all()
    assert z.min() > -0.15
    assert z[car].max() < 1.4
    heights, _ = np.histogram(z[car], np.arange(0.0, 1.3, 0.2))
    assert heights.min() > 0.5 * heights.max()
    assert len(np.unique(np.floor(y[car] / 0.1))) > 28


def test_what_hangs_over_the_pavement_is_not_solid_below(frame: ColumnFrame) -> None:
    """An awning hides no shop window below it."""
    points, _ = street()
    awning = grid(-np.arange(7.0, 8.0, 0.1), np.arange(3.0, 6.0, 0.05), np.array([1.7]))
    sorted_points = sort_into_columns(np.concatenate([points, awning]), frame, 1.0, FARTHEST_M)
    found = split_layers(sorted_points, frame, FARTHEST_M)
    hanging = (found.points.index >= len(points)) & (found.kind == PointClass.FOREGROUND)
    assert hanging.sum() > 100
    below = solid_below(found)
    assert not ((below[:, 1] > 2.9) & (below[:, 1] < 6.1)).any()
    assert ((below[:, 1] > 8.0) & (below[:, 1] < 11.0)).any()


def test_filled_background_lies_in_the_true_planes(layers: Layers, frame: ColumnFrame) -> None:
    background = fill_background(layers, find_objects(layers.foreground)[0], frame)
    vertices = frame.vertices(background.depth)
    filled = background.source == Source.FILLED
    wall, ground = filled & background.wall, filled & ~background.wall
    assert wall.sum() > 100
    assert ground.sum() > 100
    assert np.sqrt(np.mean((vertices[wall][:, 0] + WALL_M) ** 2)) < 0.05
    assert np.sqrt(np.mean(vertices[ground][:, 2] ** 2)) < 0.05


def test_the_road_below_the_vehicle_is_filled() -> None:
    line = path()
    angles = np.deg2rad(np.arange(-89.0, 60.0, 0.4))
    frame = column_frame(line, "left", angles, line[:, 2] - SENSOR_M)
    points, _ = street()  # of the road from 1.5 m on
    sorted_points = sort_into_columns(points, frame, 1.0, FARTHEST_M)
    layers = split_layers(sorted_points, frame, FARTHEST_M)
    background = fill_background(layers, find_objects(layers.foreground)[0], frame)
    lowest = background.depth[0]
    np.testing.assert_allclose(lowest, SENSOR_M * np.tan(np.deg2rad(1.0)), atol=0.01)
    assert (background.source[0] == Source.FILLED).all()
    height = frame.vertices(background.depth)[:20, :, 2]
    np.testing.assert_allclose(height, 0.0, atol=0.03)


def test_surface_faces_the_street(layers: Layers, frame: ColumnFrame) -> None:
    background = fill_background(layers, find_objects(layers.foreground)[0], frame)
    surface = build_surface(background.depth, background.source, background.wall, frame)
    corners = surface.vertices[surface.triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    assert (normals[surface.wall][:, 0] > 0).mean() > 0.95
    assert (normals[~surface.wall][:, 2] > 0).mean() > 0.95


def test_glass_is_told_from_a_gap(frame: ColumnFrame) -> None:
    points, _ = street()
    inside = points[:, 2] > 1.5
    pane = inside & (points[:, 1] > 4.0) & (points[:, 1] < 5.0) & (points[:, 0] < -WALL_M + 0.2)
    points = points.copy()
    points[pane, 0] -= 3.0
    layers = split_layers(sort_into_columns(points, frame, 1.0, FARTHEST_M), frame, FARTHEST_M)
    behind = layers.points.depth > WALL_M + 2.0
    assert behind.sum() > 50
    assert (layers.kind[behind] == PointClass.GLASS).mean() > 0.9
