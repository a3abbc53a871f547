"""Walls, up and the quality of points, on streets of known truth."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from simulated_street import simulated_street
from walls_truth import errors_of, in_world, is_false, visible_facades, world_from

from veduta.photos.cameras.orient import oriented, transformed
from veduta.photos.cameras.upright import refined_up, upright
from veduta.photos.options import WallOptions
from veduta.photos.structure import Structure
from veduta.photos.walls.find_walls import find_walls
from veduta.photos.walls.point_quality import point_covariances
from veduta.photos.walls.spans import filled_height
from veduta.photos.walls.wall import Wall
from veduta.synthetic.streets.simulated import SimulatedStructure

OPTIONS = WallOptions()


@cache
def street(seed: int) -> tuple[SimulatedStructure, Structure]:
    _, simulated, structure = simulated_street(seed)
    structure = upright(oriented(structure).structure)[0]
    return world_from(structure.points, simulated), structure


@cache
def walls(seed: int) -> tuple[Wall, ...]:
    return find_walls(street(seed)[1], OPTIONS, 0)


def test_the_facades_of_a_street_are_found() -> None:
    simulated, _ = street(1)
    found = [in_world(wall, simulated) for wall in walls(1)]
    facades = visible_facades(simulated.walls)
    errors = [errors_of(facade, found) for facade in facades]
    assert len(facades) >= 8
    right = sum(error is not None and error.is_right for error in errors)
    assert right >= 0.8 * len(facades)
    assert sum(is_false(wall, simulated.walls) for wall in found) <= 1


def test_the_same_seed_finds_the_same() -> None:
    few = street(1)[1].sampled(1500, np.random.default_rng(0))
    first, again = (find_walls(few, OPTIONS, 0) for _ in range(2))
    assert len(first) >= 3
    assert all(
        np.array_equal(one.start, two.start) and np.array_equal(one.point_rows, two.point_rows)
        for one, two in zip(first, again, strict=True)
    )


def test_neither_scale_nor_heading_matters() -> None:
    """The same walls in a frame 37 times as large, turned and moved."""
    c, s = np.cos(2.0), np.sin(2.0)
    turn, shift = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1.0]]), np.array([500.0, -90.0, 40.0])
    moved = find_walls(transformed(street(1)[1], 37.0, turn, shift), OPTIONS, 0)
    assert len(moved) == len(walls(1))
    for one, two in zip(walls(1)[:5], moved[:5], strict=True):
        start = 37.0 * turn[:2, :2] @ one.start + shift[:2]
        assert np.linalg.norm(start - two.start) < 0.05 * two.width
        assert two.height == pytest.approx(37.0 * one.height, rel=0.05)


def test_walls_look_at_the_photos() -> None:
    centres = street(1)[1].centres()[:, :2]
    for wall in walls(1):
        assert ((centres - wall.start) @ wall.outward).max() > 0.0
        assert np.linalg.det(np.stack([wall.along, -wall.outward])) == pytest.approx(1.0)


def test_scattered_points_are_no_walls() -> None:
    structure = street(1)[1]
    rng = np.random.default_rng(0)
    low, high = structure.seen_box()
    scattered = replace(structure, points=rng.uniform(low, high, structure.points.shape))
    assert len(find_walls(scattered, OPTIONS, 0)) <= 1


def test_the_ridge_of_a_roof_is_no_wall() -> None:
    """Of the points about a facade, those along its top and on a mast that reaches down."""
    structure = street(1)[1]
    facade = walls(1)[0]
    arm = structure.points - [*facade.start, facade.bottom]
    along, up = arm[:, :2] @ facade.along / facade.width, arm[:, 2] / facade.height
    about = np.abs(arm[:, :2] @ facade.outward) < 0.2 * facade.width
    about &= (np.abs(along - 0.5) < 0.6) & (up < 1.3)
    own = np.isin(np.arange(len(arm)), facade.point_rows)
    ridge = own & (up > 0.92) & (np.abs(along - 0.5) > 0.01)
    kept = ~about | ridge | (own & (np.abs(along - 0.5) < 0.01))
    left = structure.with_points(kept)
    for wall in find_walls(left, OPTIONS, 0):
        assert ridge[kept][wall.point_rows].sum() < 0.5 * ridge.sum()


def test_points_fill_the_height_of_a_wall_and_not_of_a_ridge() -> None:
    rng = np.random.default_rng(2)
    along, up = rng.uniform(0, 12, 400), rng.uniform(0, 9, 400)
    assert filled_height(along, up) > 0.8
    low = np.where(np.abs(along - 6) < 0.5, up, 0.9 * up / 9)
    assert filled_height(along, low) == pytest.approx(0.1, abs=0.02)
    # Two rows, as of a plinth and a cornice, stand for what is between them.
    rows = np.where(rng.random(400) < 0.5, 0.0, 9.0)
    assert filled_height(along, rows) == 1.0


def test_too_few_points_give_no_walls() -> None:
    structure = street(1)[1]
    few = structure.sampled(12, np.random.default_rng(0))
    assert find_walls(few, OPTIONS, 0) == ()


def test_up_is_found_from_walls() -> None:
    for seed in (1, 2, 7):
        simulated, _ = street(seed)
        up = simulated.world_from_model[1].T @ [0.0, 0.0, 1.0]
        assert np.rad2deg(np.arccos(up[2])) < 0.25


def test_refined_up_is_least_squares_among_outliers() -> None:
    rng = np.random.default_rng(4)
    up = np.array([0.03, -0.02, 1.0])
    up /= np.linalg.norm(up)
    turn = rng.uniform(0, 2 * np.pi, 500)
    level = np.column_stack([np.cos(turn), np.sin(turn), np.zeros(500)])
    level -= (level @ up)[:, None] * up
    level += 0.003 * rng.standard_normal(level.shape)
    level[:100, 2] += rng.uniform(0.2, 0.6, 100)
    level /= np.linalg.norm(level, axis=1, keepdims=True)
    found = refined_up(np.array([0.0, 0.0, 1.0]), level, np.ones(500))
    closed = np.linalg.eigh(level[100:].T @ level[100:])[1][:, 0]
    assert np.rad2deg(np.arccos(abs(found.up @ closed))) < 0.02
    assert np.rad2deg(np.arccos(found.up @ up)) < 3 * found.sd_deg + 0.02


def test_up_stays_where_nothing_speaks_of_it() -> None:
    first = np.array([0.0, 0.0, 1.0])
    assert np.array_equal(refined_up(first, np.zeros((0, 3)), np.zeros(0)).up, first)
    one_way = np.tile([1.0, 0.0, 0.02], (80, 1)) / np.hypot(1.0, 0.02)
    found = refined_up(first, one_way, np.ones(80)).up
    assert found[1] == pytest.approx(0.0, abs=1e-9)
    assert found[0] == pytest.approx(-0.02, abs=1e-3)


def test_covariances_are_those_of_the_numbers() -> None:
    """Against derivatives by differences, for points seen by pinhole cameras."""
    structure = street(1)[1]
    rows = np.flatnonzero(np.bincount(structure.point_of) >= 4)[:6]
    kept = np.zeros(len(structure.points), dtype=bool)
    kept[rows] = True
    few = structure.with_points(kept)
    found = point_covariances(few)
    shapes = []
    for number, point in enumerate(few.points):
        information = np.zeros((3, 3))
        for photo in few.image_of[few.point_of == number]:
            pose, focal = few.cam_from_world[photo], few.camera(photo).mean_focal_length()

            def place(at: np.ndarray, pose: np.ndarray = pose, focal: float = focal) -> np.ndarray:
                x, y, z = pose[:, :3] @ at + pose[:, 3]
                return focal * np.array([x / z, y / z])

            step = 1e-5
            slope = np.stack(
                [
                    (place(point + step * axis) - place(point - step * axis)) / (2 * step)
                    for axis in np.eye(3)
                ],
                axis=1,
            )
            information += slope.T @ slope
        shapes.append(found[number] @ information)
    factors = [float(np.trace(shape)) / 3 for shape in shapes]
    assert all(
        np.allclose(shape, factor * np.eye(3), atol=1e-3 * factor)
        for shape, factor in zip(shapes, factors, strict=True)
    )
    assert np.allclose(factors, factors[0], rtol=1e-6)


def test_windows_taken_for_one_another_hide_no_wall() -> None:
    """Points far behind a facade, which two photos see through it: as many as are on it."""
    simulated, structure = street(1)
    wall = walls(1)[0]
    plain = sum(is_false(in_world(one, simulated), simulated.walls) for one in walls(1))
    haunted = _with_ghosts(structure, wall, len(wall.point_rows))
    found = find_walls(haunted, OPTIONS, 0)
    middle = (wall.start + wall.end) / 2
    near = [
        one
        for one in found
        if one.outward @ wall.outward > 0.99
        and abs((middle - one.start) @ one.outward) < 0.01 * wall.width
        and one.width > 0.8 * wall.width
    ]
    assert len(near) == 1
    assert sum(is_false(in_world(one, simulated), simulated.walls) for one in found) <= plain


def _with_ghosts(structure: Structure, wall: Wall, count: int) -> Structure:
    """More points, in a plane as far behind a wall as two photos that see it are before it."""
    seen = np.bincount(
        structure.image_of[np.isin(structure.point_of, wall.point_rows)],
        minlength=len(structure.image_ids),
    )
    photos = np.argsort(seen)[[-1, -2]]
    centres = structure.centres()[photos]
    away = float(((centres[:, :2] - wall.start) @ wall.outward).mean())
    rng = np.random.default_rng(3)
    along, z = rng.uniform(-0.3, 1.3, count), rng.uniform(wall.bottom, 2 * wall.top, count)
    flat = wall.start - away * wall.outward + np.outer(along * wall.width, wall.along)
    ghosts = np.column_stack([flat, z])
    first, rows = len(structure.points), np.arange(count)
    keypoints = list(structure.keypoints_px)
    starts = [len(keypoints[photo]) for photo in photos]
    for photo in photos:
        pose = structure.cam_from_world[photo]
        local = ghosts @ pose[:, :3].T + pose[:, 3]
        pixels = structure.camera(int(photo)).img_from_cam(local)
        keypoints[photo] = np.vstack([keypoints[photo], pixels])
    return replace(
        structure,
        keypoints_px=tuple(keypoints),
        points=np.vstack([structure.points, ghosts]),
        colours=np.vstack([structure.colours, np.zeros((count, 3), np.uint8)]),
        image_of=np.concatenate([structure.image_of, np.repeat(photos, count)]),
        keypoint_of=np.concatenate([structure.keypoint_of, *(rows + start for start in starts)]),
        point_of=np.concatenate([structure.point_of, first + rows, first + rows]),
    )
