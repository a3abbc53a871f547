"""Cameras and vanishing points: closed forms and projections of real points."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from veduta.geometry import homography, vanishing
from veduta.geometry.rectangle import aspect_of_rectangle
from veduta.geometry.vanishing import FacadeView

yaws = st.floats(-1.2, 1.2)
pitches = st.floats(-0.7, 0.7)
rolls = st.floats(-0.5, 0.5)
focals = st.floats(300.0, 4000.0)


@given(yaws, pitches, rolls)
def test_angles_and_rotation_are_inverse(yaw: float, pitch: float, roll: float) -> None:
    rotation = vanishing.rotation_from_angles(yaw, pitch, roll)
    assert np.allclose(rotation @ rotation.T, np.eye(3), atol=1e-12)
    assert np.linalg.det(rotation) == pytest.approx(1.0)
    assert vanishing.angles_from_rotation(rotation) == pytest.approx((yaw, pitch, roll), abs=1e-9)


@given(yaws, pitches, rolls, focals, st.floats(0.3, 3.0))
def test_a_wall_seen_by_a_camera_comes_back(
    yaw: float, pitch: float, roll: float, focal: float, aspect: float
) -> None:
    """Project the corners of a w x h rectangle; plane_from_image and the aspect undo it."""
    view = FacadeView(yaw, pitch, roll, focal, 640.0, 480.0)
    wall = np.array([[0, 0], [aspect, 0], [aspect, 1], [0, 1.0]]) - (aspect / 2, 0.5)
    in_camera = np.column_stack([wall, np.zeros(4)]) @ view.rotation().T + (0.1, -0.2, 6.0)
    assume(in_camera[:, 2].min() > 0.5)
    pixels = in_camera @ view.camera().T
    pixels = pixels[:, :2] / pixels[:, 2:]
    # Nearly edge on, the four corners are nearly on one line.
    assume(abs(view.rotation()[2, 2]) > 0.15)
    back = homography.apply(vanishing.plane_from_image(view), pixels)
    moved = (back - back.mean(axis=0)) * np.ptp(wall[:, 0]) / np.ptp(back[:, 0])
    assert np.allclose(np.abs(moved), np.abs(wall), atol=1e-6)
    found = aspect_of_rectangle(pixels, focal, (640.0, 480.0))
    assert found == pytest.approx(aspect, rel=1e-5)


@given(yaws, pitches, rolls, focals)
def test_vanishing_points_give_rotation_and_focal_length(
    yaw: float, pitch: float, roll: float, focal: float
) -> None:
    view = FacadeView(yaw, pitch, roll, focal, 0.0, 0.0)
    points = view.camera() @ view.rotation()
    found = vanishing.rotation_from_vanishing_points(
        view.camera(), -3.0 * points[:, 0], 2.0 * points[:, 1]
    )
    assert found is not None
    assert np.allclose(found, view.rotation(), atol=1e-9)
    assume(abs(yaw) > 0.05 and abs(pitch) > 0.05)
    estimate = vanishing.focal_from_orthogonal(points[:, 0], points[:, 1], (0.0, 0.0))
    assert estimate == pytest.approx(focal, rel=1e-6)


def test_degenerate_pairs_give_nothing() -> None:
    camera = vanishing.camera_matrix(1000.0, 0.0, 0.0)
    up = np.array([0.0, 1.0, 0.0])
    assert vanishing.rotation_from_vanishing_points(camera, up, up) is None
    assert vanishing.focal_from_orthogonal(up, np.array([1.0, 0.0, 0.0]), (0.0, 0.0)) is None
    same_side = np.array([500.0, 300.0, 1.0]), np.array([400.0, 200.0, 1.0])
    assert vanishing.focal_from_orthogonal(*same_side, (0.0, 0.0)) is None


@given(st.floats(-math.pi, math.pi), st.floats(-500, 500), st.floats(-500, 500))
def test_segments_point_at_their_vanishing_point(heading: float, x: float, y: float) -> None:
    direction = np.array([[math.cos(heading), math.sin(heading)]])
    middle = np.array([[x, y]])
    ahead = np.append(middle[0] + 900 * direction[0], 1.0)
    assert abs(vanishing.angles_to_vanishing_point(middle, direction, ahead)[0]) < 1e-9
    at_infinity = np.append(-direction[0], 0.0)
    assert abs(vanishing.angles_to_vanishing_point(middle, direction, at_infinity)[0]) < 1e-9
    turned = np.array([[math.cos(heading + 0.3), math.sin(heading + 0.3)]])
    angle = vanishing.angles_to_vanishing_point(middle, turned, ahead)[0]
    assert abs(angle) == pytest.approx(0.3, abs=1e-9)


def test_axis_angles() -> None:
    degrees = np.array([0.0, 10.0, 45.0, 80.0, 90.0, 100.0, 181.0])
    directions = np.column_stack([np.cos(np.deg2rad(degrees)), np.sin(np.deg2rad(degrees))])
    expected = [0.0, 10.0, 45.0, 10.0, 0.0, 10.0, 1.0]
    assert np.allclose(np.rad2deg(vanishing.axis_angles(directions)), expected)
