"""The Poisson equation, and the pose, against what is known in closed form."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from veduta.walk.build.local_model import LocalModel
from veduta.walk.build.matches import Matches
from veduta.walk.build.poisson import extend_destinations
from veduta.walk.build.pose import relative_pose
from veduta.walk.build.screen import Screen
from veduta.walk.rig import Rig


def test_a_border_moved_as_a_whole_takes_the_inside_along() -> None:
    rng = np.random.default_rng(3)
    points = rng.normal(size=(12, 15, 3))
    known = np.ones((12, 15), dtype=bool)
    known[3:9, 4:11] = False
    moved = points + np.array([0.4, -0.2, 1.0])
    ones = np.ones((12, 15))
    found = extend_destinations(points, np.where(known[..., None], moved, 99.0), known, ones, ones)
    assert np.abs(found - moved).max() < 1e-6


def test_what_is_found_minimises_equation_5() -> None:
    """The gradient of the result differs least from that of the points: no change lowers it."""
    rng = np.random.default_rng(4)
    points, wished = rng.normal(size=(2, 7, 8, 1))
    known = rng.random((7, 8)) < 0.4
    right, down = rng.uniform(0.1, 1.0, (2, 7, 8))
    found = extend_destinations(points, wished, known, right, down)
    assert np.abs(found[known] - wished[known]).max() < 1e-12

    def energy(destinations: np.ndarray) -> float:
        correction = (destinations - points)[..., 0]
        across = right[:, :-1] * np.diff(correction, axis=1) ** 2
        return float(across.sum() + (down[:-1] * np.diff(correction, axis=0) ** 2).sum())

    least = energy(found)
    for _ in range(50):
        change = rng.normal(scale=0.01, size=found.shape) * ~known[..., None]
        assert energy(found + change) >= least - 1e-9


def test_without_anything_known_nothing_moves() -> None:
    points = np.arange(24.0).reshape(4, 6, 1)
    nothing = np.zeros((4, 6), dtype=bool)
    ones = np.ones((4, 6))
    assert (extend_destinations(points, points + 5.0, nothing, ones, ones) == points).all()


def _model(screen: Screen, depth_m: np.ndarray) -> LocalModel:
    shape = depth_m.shape
    image = np.zeros((*shape, 3), dtype=np.uint8)
    everywhere = np.ones(shape, dtype=bool)
    return LocalModel("k", screen, image, depth_m.astype(np.float32), everywhere, ~everywhere)


def test_the_pose_of_two_views_of_a_wall_and_a_floor() -> None:
    """Matches of a known motion, a third of them false: the pose is found within their noise."""
    rng = np.random.default_rng(5)
    rig = Rig(640, 360, (500.0, 500.0), (320.0, 180.0), 0.5)
    screen = Screen.of(rig)
    pose = np.column_stack(
        [Rotation.from_rotvec([0.01, -0.03, 0.005]).as_matrix(), [0.1, 0.0, -3.0]]
    )
    rays = screen.points(screen.pixels, np.ones((360, 640)))

    def depth_seen(turn: np.ndarray, centre: np.ndarray) -> np.ndarray:
        """A wall 20 m ahead of the first camera and a floor 1.6 m below it."""
        ahead = rays @ turn
        with np.errstate(divide="ignore"):
            wall = np.where(ahead[..., 2] > 0, (20.0 - centre[2]) / ahead[..., 2], np.inf)
            floor = np.where(ahead[..., 1] > 0, (1.6 - centre[1]) / ahead[..., 1], np.inf)
        return np.minimum(wall, floor)

    first = _model(screen, depth_seen(np.eye(3), np.zeros(3)))
    second = _model(screen, depth_seen(pose[:, :3], -pose[:, :3].T @ pose[:, 3]))
    here = rng.uniform([40, 40], [600, 320], size=(600, 2))
    here = np.floor(here) + 0.5
    columns, rows = here.astype(int).T
    moved = first.points[rows, columns] @ pose[:, :3].T + pose[:, 3]
    there = screen.project(moved)[0]
    inside = (there > 8).all(axis=1) & (there < np.array([632, 352])).all(axis=1)
    here, there = here[inside], there[inside] + rng.normal(scale=0.1, size=(inside.sum(), 2))
    false = rng.random(len(here)) < 0.33
    there[false] = rng.uniform([8, 8], [632, 352], size=(false.sum(), 2))
    found = relative_pose(first, second, rig, Matches(here, there))
    turn = Rotation.from_matrix(found.second_from_first[:, :3] @ pose[:, :3].T).magnitude()
    assert np.rad2deg(turn) < 0.03
    assert np.linalg.norm(found.second_from_first[:, 3] - pose[:, 3]) < 0.02
    assert found.distance_m == pytest.approx(np.linalg.norm(pose[:, 3]), rel=0.005)
