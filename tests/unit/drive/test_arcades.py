"""Walls behind open ground floors and behind balconies are kept; rooms behind panes are not."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pytest
from numpy.typing import NDArray

from veduta.drive.build.fill import fill_background
from veduta.drive.build.frame import ColumnFrame, column_frame, sort_into_columns
from veduta.drive.build.layers import Layers, PointClass, split_layers
from veduta.drive.build.objects import find_objects

SENSOR_M, FRONT_M, BACK_M, HIGH_M, OPEN_M, PIER_M, LENGTH_M = 3.6, 11.0, 14.3, 9.0, 3.8, 1.0, 24.0
Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Front:
    """pane: share of beams that what stands in the openings takes. sill_m: they begin above it."""

    pane: float = 0.0
    sill_m: float = 0.0


def frame() -> ColumnFrame:
    along = np.arange(0.0, LENGTH_M, 0.2)
    line = np.column_stack([np.zeros(len(along)), along, np.full(len(along), SENSOR_M)])
    angles = np.deg2rad(np.arange(-80.0, 60.0, 0.4))
    return column_frame(line, "left", angles, line[:, 2] - SENSOR_M)


def is_open(along: Floats) -> NDArray[np.bool_]:
    """Openings of 2 m between piers, in the middle of the street."""
    inside = (along > 4.0) & (along < LENGTH_M - 4.0)
    return inside & ((along - 4.0) % (2.0 + PIER_M) < 2.0)


def scanned(front: Front, seed: int = 1) -> Floats:
    """(n, 3) what a scanner of one degree measures, sigma 2 cm."""
    random = np.random.default_rng(seed)
    own = frame()
    along, angle = np.meshgrid(own.origins[:, 1], np.deg2rad(np.arange(-80.0, 60.0, 1.0)))
    along, angle = along.ravel(), angle.ravel()
    rise = np.tan(angle)
    height = SENSOR_M + FRONT_M * rise
    hole = is_open(along) & (height < OPEN_M) & (height > front.sill_m)
    low = SENSOR_M + FRONT_M * rise < 0.0
    hole |= is_open(along) & low & (front.sill_m == 0.0)
    depth = np.where(hole, BACK_M, FRONT_M)
    depth = np.where(SENSOR_M + depth * rise < 0.0, -SENSOR_M / np.minimum(rise, -1e-6), depth)
    behind = hole & (depth > FRONT_M)
    kept = (SENSOR_M + depth * rise < HIGH_M) & ~(behind & (random.random(len(depth)) < front.pane))
    depth = depth + random.normal(0.0, 0.02, len(depth))
    points = np.column_stack([-depth, along, SENSOR_M + depth * rise])
    return np.asarray(points[kept])


def layers_of(points: Floats) -> Layers:
    own = frame()
    return split_layers(sort_into_columns(points, own, 1.0, 25.0), own, 25.0)


def filled_depth(layers: Layers) -> Floats:
    own = frame()
    return fill_background(layers, find_objects(layers.foreground)[0], own).depth.astype(float)


def window(low_m: float, high_m: float, depth_m: float) -> NDArray[np.bool_]:
    """(r,) beams that meet a depth between two heights."""
    height = SENSOR_M + depth_m * np.tan(frame().angles_rad)
    return (height > low_m) & (height < high_m)


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_the_wall_behind_an_arcade_is_kept_and_filled(seed: int) -> None:
    layers = layers_of(scanned(Front(), seed))
    behind = layers.points.depth > FRONT_M + 2.0
    upright = behind & (layers.above > 0.3)
    assert upright.sum() > 200
    assert (layers.kind[upright] == PointClass.BUILDING).mean() > 0.98
    depth = filled_depth(layers)
    middle = is_open(frame().origins[:, 1] - 0.4) & is_open(frame().origins[:, 1] + 0.4)
    inside = depth[np.ix_(window(0.3, 3.0, BACK_M), middle)]
    assert np.sqrt(np.mean((inside - BACK_M) ** 2)) < 0.05
    piers = ~is_open(frame().origins[:, 1] - 0.4) & ~is_open(frame().origins[:, 1] + 0.4)
    between = depth[np.ix_(window(0.3, 3.0, FRONT_M), piers)]
    assert np.sqrt(np.mean((between - FRONT_M) ** 2)) < 0.05
    above = depth[np.ix_(window(OPEN_M + 0.4, HIGH_M - 0.5, FRONT_M), middle)]
    assert np.sqrt(np.mean((above - FRONT_M) ** 2)) < 0.05


def test_its_floor_is_ground() -> None:
    layers = layers_of(scanned(Front()))
    background = fill_background(layers, find_objects(layers.foreground)[0], frame())
    middle = is_open(frame().origins[:, 1] - 0.4) & is_open(frame().origins[:, 1] + 0.4)
    height = frame().vertices(background.depth)[..., 2]
    # The last beam that reaches the floor comes down at 13 m.
    floor = (background.depth > FRONT_M + 0.5) & (background.depth < BACK_M - 1.3) & middle
    assert floor.sum() > 100
    assert not background.wall[floor].any()
    assert np.abs(height[floor]).max() < 0.1


@pytest.mark.parametrize("seed", [1, 2, 3])
@pytest.mark.parametrize(
    "front", [Front(pane=0.15), Front(pane=0.6), Front(sill_m=0.8)], ids=["pane", "dark", "sill"]
)
def test_a_room_behind_panes_or_a_sill_is_glass(front: Front, seed: int) -> None:
    layers = layers_of(scanned(front, seed))
    assert np.isnan(layers.behind.arcades.depth).all()
    upright = (layers.points.depth > FRONT_M + 2.0) & (layers.above > 1.0)
    assert (layers.kind[upright] == PointClass.BUILDING).mean() < 0.02


def test_a_gap_between_houses_is_no_arcade() -> None:
    """Without a front above it, what lies behind is another house."""
    points = scanned(Front())
    height_at_front = SENSOR_M + (points[:, 2] - SENSOR_M) * FRONT_M / -points[:, 0]
    lintel = is_open(points[:, 1]) & (height_at_front > OPEN_M)
    layers = layers_of(points[~lintel])
    assert np.isnan(layers.behind.arcades.depth).all()


def boxed(low_m: float, high_m: float, between: float, *, framed: bool) -> Floats:
    """(n, 3) a wall with a stack of boxes, 1 m deep, before 3 m of it: every second metre of height
    is one, so that the wall shows between; framed: but for 0.5 m at both ends of the stack.
    """
    random = np.random.default_rng(5)
    own = frame()
    along, angle = np.meshgrid(own.origins[:, 1], np.deg2rad(np.arange(-80.0, 60.0, 1.0)))
    along, angle = along.ravel(), angle.ravel()
    rise = np.tan(angle)
    before = FRONT_M - 1.0
    height = SENSOR_M + before * rise
    stack = (along > 10.0) & (along < 13.0) & (height > low_m) & (height < high_m)
    edge = framed & ((along < 10.5) | (along > 12.5))
    box = stack & (edge | ((height - low_m) % 2.0 < between))
    depth = np.where(box, before, FRONT_M)
    depth = np.where(SENSOR_M + depth * rise < 0.0, -SENSOR_M / np.minimum(rise, -1e-6), depth)
    kept = SENSOR_M + depth * rise < HIGH_M
    depth = depth + random.normal(0.0, 0.02, len(depth))
    return np.asarray(np.column_stack([-depth, along, SENSOR_M + depth * rise])[kept])


def test_the_wall_between_balconies_is_kept() -> None:
    layers = layers_of(boxed(0.3, 8.3, 1.3, framed=False))
    inside = (layers.points.points[:, 1] > 10.1) & (layers.points.points[:, 1] < 12.9)
    main = layers.depths.main[(frame().origins[:, 1] > 10.3) & (frame().origins[:, 1] < 12.7)]
    np.testing.assert_allclose(main, FRONT_M - 1.0, atol=0.1)
    wall = inside & (np.abs(layers.points.depth - FRONT_M) < 0.1) & (layers.above > 0.6)
    assert wall.sum() > 30
    assert (layers.kind[wall] == PointClass.BUILDING).mean() > 0.95
    depth = filled_depth(layers)
    columns = (frame().origins[:, 1] > 10.3) & (frame().origins[:, 1] < 12.7)
    between = depth[np.ix_(window(3.9, 4.1, FRONT_M), columns)]
    np.testing.assert_allclose(between, FRONT_M, atol=0.1)


def test_what_is_seen_through_a_bay_is_not() -> None:
    layers = layers_of(boxed(0.3, 8.3, 1.3, framed=True))
    inside = (layers.points.points[:, 1] > 10.7) & (layers.points.points[:, 1] < 12.3)
    wall = inside & (np.abs(layers.points.depth - FRONT_M) < 0.1) & (layers.above > 0.6)
    assert wall.sum() > 20
    assert np.isnan(layers.behind.set_back).all()
