"""Loose crumbs of a hull: which belong to the object, told by balls whose silhouettes are known."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh
from numpy.typing import NDArray
from ring_of_a_ball import SIZE, ring_camera

from veduta import _core
from veduta.carve.build.measures import measure_mesh
from veduta.carve.build.pieces import without_crumbs
from veduta.carve.views import View, camera_rows

Mesh = tuple[NDArray[np.float64], NDArray[np.uint32]]


def _balls(*balls: tuple[tuple[float, float, float], float]) -> Mesh:
    points, faces, count = [], [], 0
    for centre, radius in balls:
        ball = trimesh.creation.icosphere(4, abs(radius))
        corners = ball.faces if radius > 0 else ball.faces[:, ::-1]
        points.append(ball.vertices + centre)
        faces.append(corners + count)
        count += len(ball.vertices)
    return np.concatenate(points), np.concatenate(faces).astype(np.uint32)


def _views(mesh: Mesh) -> list[View]:
    """A ring, and the mesh's silhouettes in it."""
    cameras = [ring_camera(number, 12) for number in range(12)]
    rows, sizes = camera_rows(cameras), [(SIZE, SIZE)] * 12
    seen = _core.seen_triangles(rows, sizes, *mesh)
    pixels = np.zeros((SIZE, SIZE, 3), dtype=np.uint8)
    return [
        View(camera, pixels, one >= 0, "masks") for camera, one in zip(cameras, seen, strict=True)
    ]


BODY = ((0.0, 0.0, 0.0), 0.5)


def test_crumbs_that_no_silhouette_asks_for_are_left_out() -> None:
    whole = _balls(BODY, ((0.0, 0.0, 0.545), 0.03), ((0.0, 0.0, 0.9), 0.07))
    views = _views(_balls(BODY, ((0.0, 0.0, 0.9), 0.07)))  # what stands free is in them
    found = without_crumbs(*whole, views)
    assert (found.pieces, found.dropped) == (2, 1)
    assert found.dropped_share == pytest.approx((0.03 / 0.5) ** 3, rel=0.02)
    assert found.positions[:, 2].max() == pytest.approx(0.97, abs=1e-3)
    left = trimesh.Trimesh(found.positions, found.triangles, process=False)
    assert left.is_watertight
    assert left.volume == pytest.approx(4 / 3 * np.pi * (0.5**3 + 0.07**3), rel=0.01)


def test_a_closed_hollow_is_no_part_of_the_object() -> None:
    found = without_crumbs(*_balls(BODY, ((0.1, 0.0, 0.0), -0.05)), _views(_balls(BODY)))
    assert (found.pieces, found.dropped) == (1, 1)


def test_two_large_pieces_both_stay() -> None:
    two = _balls(((-0.3, 0.0, 0.0), 0.2), ((0.4, 0.0, 0.0), 0.15))
    found = without_crumbs(*two, _views(two))
    assert (found.pieces, found.dropped) == (2, 0)
    assert np.array_equal(found.triangles, two[1])


def test_volume_and_area_of_a_ball_have_the_errors_of_an_outline() -> None:
    mesh = _balls(BODY)
    found = measure_mesh(*mesh, _views(mesh))
    pixel = 3.0 / 120.0  # at the ball's middle
    assert found.volume == pytest.approx(4 / 3 * np.pi * 0.5**3, rel=0.01)
    assert found.area_error == pytest.approx(8 * np.pi * 0.5 * pixel, rel=0.03)
    assert found.volume_error == pytest.approx(4 * np.pi * 0.5**2 * pixel, rel=0.03)
    assert found.pieces == 1
