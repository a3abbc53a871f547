"""Distances of points from meshes, against trimesh's corresponding points on every triangle."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh

from veduta.surfaces import distances_from_mesh


def test_each_point_is_measured_from_the_nearest_triangle() -> None:
    draw = np.random.default_rng(3)
    body = trimesh.creation.torus(major_radius=3.0, minor_radius=1.0)
    points = draw.uniform(-5.0, 5.0, (200, 3))
    found, triangle = distances_from_mesh(points, body.vertices, body.faces)
    every = np.repeat(points, len(body.faces), axis=0)
    spots = trimesh.triangles.closest_point(np.tile(body.triangles, (len(points), 1, 1)), every)
    lengths = np.linalg.norm(spots - every, axis=1).reshape(len(points), -1)
    assert np.allclose(np.abs(found), lengths.min(axis=1), atol=1e-9)
    assert np.allclose(lengths[np.arange(len(points)), triangle], lengths.min(axis=1), atol=1e-6)
    inside = body.contains(points)
    assert 10 < inside.sum() < 190
    assert np.array_equal(found < 0.0, inside)


def test_what_is_no_mesh_is_refused() -> None:
    points, faces = np.zeros((1, 3)), np.array([[0, 1, 2]])
    with pytest.raises(ValueError, match="no triangle with an area"):
        distances_from_mesh(points, np.zeros((3, 3)), faces)
    with pytest.raises(ValueError, match="corner 2, and there are 2"):
        distances_from_mesh(points, np.zeros((2, 3)), faces)
    with pytest.raises(ValueError, match="no finite number"):
        distances_from_mesh(points * np.nan, np.eye(3), faces)
    with pytest.raises(ValueError, match="three columns"):
        distances_from_mesh(np.zeros((1, 2)), np.eye(3), faces)
