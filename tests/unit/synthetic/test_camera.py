"""A camera agrees with itself: points, rays, homographies, and the meaning of its axes."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from veduta.synthetic.camera import Camera, look_at

coordinate = st.floats(-50, 50)
points = st.tuples(coordinate, coordinate, coordinate)


@st.composite
def cameras(draw: st.DrawFn) -> Camera:
    eye, target = draw(points), draw(points)
    assume(np.linalg.norm(np.subtract(eye, target)) > 0.5)
    size = (draw(st.integers(64, 2000)), draw(st.integers(64, 2000)))
    focal = draw(st.floats(50, 4000))
    return look_at(eye, target, size, focal, draw(st.floats(-3, 3)))


@given(cameras(), points)
def test_the_ray_through_a_projected_point_meets_the_point(camera: Camera, at: tuple) -> None:
    point = np.array([at])
    pixels, depth = camera.project(point)
    assume(depth[0] > 0.1 and np.abs(pixels).max() < 1e6)
    met = camera.position_m + camera.rays(pixels) * depth[:, None]
    np.testing.assert_allclose(met, point, atol=1e-5 * max(1.0, np.abs(pixels).max() / 100))


@given(cameras())
def test_the_pose_is_rigid_and_right_handed(camera: Camera) -> None:
    rotation = camera.cam_from_world[:3, :3]
    np.testing.assert_allclose(rotation @ rotation.T, np.eye(3), atol=1e-9)
    assert np.linalg.det(rotation) == pytest.approx(1.0)
    local = camera.cam_from_world @ np.append(camera.position_m, 1.0)
    np.testing.assert_allclose(local[:3], 0.0, atol=1e-9)


@given(cameras(), st.floats(-5, 5), st.floats(-5, 5))
def test_a_plane_homography_projects_like_the_camera(camera: Camera, a: float, b: float) -> None:
    origin, u, v = np.array([1.0, 2.0, 3.0]), np.array([1.0, 0, 0.2]), np.array([0, 0.1, 1.0])
    pixels, depth = camera.project((origin + a * u + b * v)[None])
    base_depth = camera.project(origin[None])[1]
    assume(depth[0] > 0.1 and abs(base_depth[0]) > 0.1 and np.abs(pixels).max() < 1e5)
    mapped = camera.image_from_plane(origin, u, v) @ [a, b, 1.0]
    np.testing.assert_allclose(mapped[:2] / mapped[2], pixels[0], atol=1e-3)


def test_axes_mean_right_and_up() -> None:
    camera = look_at((0, -10, 2), (0, 0, 2), (200, 100), 150.0)
    middle, _ = camera.project(np.array([[0.0, 0, 2], [1, 0, 2], [0, 0, 3]]))
    np.testing.assert_allclose(middle, [[100, 50], [115, 50], [100, 35]], atol=1e-9)


def test_a_positive_roll_turns_the_picture_counter_clockwise() -> None:
    camera = look_at((0, -10, 2), (0, 0, 2), (200, 100), 150.0, roll_rad=np.pi / 2)
    right, _ = camera.project(np.array([[1.0, 0, 2]]))
    np.testing.assert_allclose(right, [[100, 35]], atol=1e-9)


def test_a_point_behind_the_camera_has_no_pixel() -> None:
    camera = look_at((0, 0, 0), (0, 1, 0), (64, 64), 64.0)
    pixels, depth = camera.project(np.array([[0.0, -5.0, 0.0]]))
    assert np.isnan(pixels).all()
    assert depth[0] == pytest.approx(-5.0)
