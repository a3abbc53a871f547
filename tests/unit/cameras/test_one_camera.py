"""Cameras, lenses and projection matrices against OpenCV and scipy."""

from __future__ import annotations

from dataclasses import replace

import cv2
import numpy as np
import pytest
import scipy.linalg
from cameras.sets_of_cameras import POINTS, ring
from hypothesis import given
from hypothesis import strategies as st

from veduta.cameras import Camera, CameraSet, part_projection, shown, undistorted

LENS = (-0.12, 0.03, 0.002, -0.001, 0.004)


def bent() -> Camera:
    return replace(ring()[1], distortion=LENS)


def test_points_are_projected_as_opencv_does() -> None:
    camera = bent()
    turn, shift = camera.cam_from_world[:, :3], camera.cam_from_world[:, 3]
    expected, _ = cv2.projectPoints(
        POINTS, cv2.Rodrigues(turn)[0], shift, camera.matrix(), np.array(LENS)
    )
    places, depth = camera.project(POINTS)
    np.testing.assert_allclose(places, expected.reshape(-1, 2), atol=1e-9)
    np.testing.assert_allclose(depth, (POINTS @ turn.T + shift)[:, 2])


def test_rays_go_through_the_points_again() -> None:
    camera = replace(bent(), skew_px=1.5)
    origin, directions = camera.rays(camera.project(POINTS)[0])
    along = POINTS - origin
    along /= np.linalg.norm(along, axis=1, keepdims=True)
    np.testing.assert_allclose(directions, along, atol=1e-7)


def test_a_smaller_picture_has_places_in_proportion() -> None:
    camera = bent()
    half = camera.scaled(0.5)
    assert (half.width_px, half.height_px) == (32, 24)
    np.testing.assert_allclose(half.project(POINTS)[0], 0.5 * camera.project(POINTS)[0])


def test_a_moved_world_looks_the_same() -> None:
    turn = scipy.linalg.expm(np.cross(np.eye(3), [0.3, -0.2, 0.5]))
    move = np.eye(4)
    move[:3, :3], move[:3, 3] = 2.5 * turn, [4.0, 5.0, -6.0]
    cameras = CameraSet(tuple(ring()), points=POINTS, up=(0.0, 0.0, 1.0))
    moved = cameras.moved(move)
    assert moved.points is not None
    assert moved.up is not None
    for old, new in zip(cameras.cameras, moved.cameras, strict=True):
        np.testing.assert_allclose(new.project(moved.points)[0], old.project(POINTS)[0], atol=1e-8)
    np.testing.assert_allclose(moved.up, turn @ [0.0, 0.0, 1.0])


@given(st.integers(0, 10_000), st.sampled_from([-3.0, -0.01, 0.2, 40.0]))
def test_a_projection_matrix_is_parted_as_scipy_does(seed: int, factor: float) -> None:
    rng = np.random.default_rng(seed)
    turn = scipy.linalg.expm(np.cross(np.eye(3), rng.normal(size=3)))
    matrix = np.array([[900.0, rng.normal(), 310.0], [0, 950.0, 260.0], [0, 0, 1]])
    pose = np.column_stack([turn, rng.normal(size=3)])
    parted = part_projection(factor * (matrix @ pose))
    assert parted is not None
    np.testing.assert_allclose(parted.matrix, matrix, atol=1e-6)
    np.testing.assert_allclose(parted.cam_from_world, pose, atol=1e-9)
    triangle, _ = scipy.linalg.rq((matrix @ pose)[:, :3])
    np.testing.assert_allclose(np.abs(np.diag(parted.matrix)), np.abs(np.diag(triangle)), rtol=1e-9)


@pytest.mark.parametrize("matrix", [np.zeros((3, 4)), np.full((3, 4), np.nan), np.ones((3, 4))])
def test_what_is_no_camera_is_not_parted(matrix: np.ndarray) -> None:
    assert part_projection(matrix) is None


def test_a_picture_is_straightened_as_opencv_does() -> None:
    camera = bent()
    pixels = np.random.default_rng(0).integers(0, 255, (48, 64, 3)).astype(np.uint8)
    pixels = cv2.GaussianBlur(pixels, (0, 0), 3.0)
    plain, flat = undistorted(camera, pixels)
    matrix = camera.matrix()
    matrix[:2, 2] -= 0.5
    expected = cv2.undistort(pixels, matrix, np.array(LENS))
    assert not plain.distorted
    assert np.abs(flat.astype(int) - expected.astype(int)).max() <= 3  # OpenCV's is in fixed point


def test_a_straight_picture_is_left_alone_and_a_wrong_size_refused() -> None:
    camera = ring()[0]
    pixels = np.zeros((48, 64), np.uint8)
    assert undistorted(camera, pixels)[1] is pixels
    with pytest.raises(ValueError, match="64 x 47"):
        undistorted(camera, pixels[:47])


def test_what_the_photo_does_not_show_is_told() -> None:
    inside = shown(replace(ring()[0], distortion=(0.4, 0.0, 0.0, 0.0)))
    assert inside[24, 32]
    assert not inside[0, 0]


def test_a_pose_of_another_shape_is_refused() -> None:
    with pytest.raises(ValueError, match="pose"):
        Camera("a", 2, 2, (1.0, 1.0), (1.0, 1.0), np.eye(3))
    with pytest.raises(ValueError, match="lens"):
        replace(ring()[0], distortion=(1.0,))
