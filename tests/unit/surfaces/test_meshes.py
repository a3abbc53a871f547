"""Neighbours, directions, fewer triangles, drawing and packing, against brute force."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh
from hypothesis import given
from hypothesis import strategies as st
from surfaces.painted_relief import relief

from veduta.surfaces import face_normals, neighbours, simplify, vertex_normals
from veduta.surfaces.simplification import distance_to_triangles
from veduta.surfaces.texturing.charts import chart
from veduta.surfaces.texturing.drawing import draw_triangles
from veduta.surfaces.texturing.unseen import spread_colours, swatches


def test_neighbours_are_those_with_the_edge() -> None:
    mesh = trimesh.creation.icosphere(subdivisions=2)
    beside = neighbours(mesh.faces)
    pairs = {tuple(sorted(pair)) for pair in mesh.face_adjacency.tolist()}
    rows = np.repeat(np.arange(len(mesh.faces)), 3)
    found = {
        tuple(sorted(pair)) for pair in zip(rows.tolist(), beside.ravel().tolist(), strict=True)
    }
    assert found == pairs
    alone = neighbours(np.array([[0, 1, 2], [1, 0, 3], [0, 1, 4]]))
    assert (alone >= 0).sum() == 2


def test_directions_are_those_of_trimesh() -> None:
    mesh = trimesh.creation.icosphere(subdivisions=2)
    np.testing.assert_allclose(
        face_normals(mesh.vertices, mesh.faces), mesh.face_normals, atol=1e-9
    )
    outwards = mesh.vertices / np.linalg.norm(mesh.vertices, axis=1, keepdims=True)
    found = vertex_normals(mesh.vertices, mesh.faces)
    assert (found * outwards).sum(axis=1).min() > 0.99
    flat = face_normals(np.zeros((3, 3)), np.array([[0, 1, 2]]))
    np.testing.assert_array_equal(flat, 0.0)


def test_fewer_triangles_keep_the_error() -> None:
    mesh = trimesh.creation.icosphere(subdivisions=4)
    made = simplify(mesh.vertices, mesh.faces, error_m=0.01)
    assert len(made.triangles) < 0.4 * len(mesh.faces)
    assert made.error_m <= 0.01
    new = trimesh.Trimesh(made.positions, made.triangles, process=False)
    assert new.is_watertight
    away = [
        distance_to_triangles(np.repeat(vertex[None], len(new.faces), 0), new.triangles).min()
        for vertex in mesh.vertices[::9]
    ]
    assert np.quantile(away, 0.95) == pytest.approx(made.error_m, rel=0.1)


@pytest.mark.parametrize("asked", [{"most": 16}, {"error_m": 0.1}, {"most": 20, "error_m": 0.1}])
def test_a_surface_that_would_vanish_stays(asked: dict[str, float]) -> None:
    positions = np.random.default_rng(2).random((41, 3))
    rows = np.arange(40)
    lines = np.stack([rows, rows, rows + 1], axis=1)  # no area
    fewer = simplify(positions, lines, **asked)  # type: ignore[arg-type]
    assert (fewer.triangles == lines).all()
    assert fewer.error_m == 0.0


def test_as_many_triangles_as_asked() -> None:
    mesh = relief()
    made = simplify(mesh.positions_m, mesh.triangles, most=300)
    assert 200 <= len(made.triangles) <= 300
    same = simplify(mesh.positions_m, mesh.triangles, most=10_000)
    assert len(same.triangles) == len(mesh.triangles)
    with pytest.raises(ValueError, match="how many"):
        simplify(mesh.positions_m, mesh.triangles)


@given(st.integers(0, 10_000))
def test_distances_to_triangles(seed: int) -> None:
    rng = np.random.default_rng(seed)
    corners, points = rng.normal(size=(20, 3, 3)), rng.normal(size=(20, 3))
    nearest = trimesh.triangles.closest_point(corners, points)
    expected = np.linalg.norm(nearest - points, axis=1)
    np.testing.assert_allclose(distance_to_triangles(points, corners), expected, atol=1e-9)


def test_triangles_are_drawn_pixel_by_pixel() -> None:
    rng = np.random.default_rng(1)
    places = rng.uniform(-5.0, 35.0, (6, 3, 2))
    values = rng.normal(size=(6, 3, 2))
    drawn, covered = draw_triangles(places, values, (20, 30))
    for y in range(20):
        for x in range(30):
            expected, at_edge = None, False
            for triangle, value in zip(places, values, strict=True):
                system = np.vstack([triangle.T, np.ones(3)])
                weights = np.linalg.solve(system, [x + 0.5, y + 0.5, 1.0])
                at_edge |= abs(weights.min()) < 2e-3
                if weights.min() >= 0.0:
                    expected = weights @ value
            if at_edge:
                continue
            assert covered[y, x] == (expected is not None)
            if expected is not None:
                np.testing.assert_allclose(drawn[y, x], expected, atol=1e-4)


@given(st.integers(0, 10_000))
def test_charts_lie_apart(seed: int) -> None:
    rng = np.random.default_rng(seed)
    count = int(rng.integers(1, 40))
    labels = rng.integers(-1, 3, count).astype(np.int32)
    places = rng.uniform(0.0, 60.0, (count, 1, 2)) + rng.uniform(0.0, 20.0, (count, 3, 2))
    beside = np.full((count, 3), -1, dtype=np.int32)
    made = chart(labels, beside, places, detail=1.0, largest_px=400, padding_px=2)
    taken = np.zeros((made.height_px, made.width_px), dtype=int)
    boxes = np.concatenate([made.sizes, np.full((len(made.swatches), 2), 3)])
    corners = np.concatenate([made.corners, made.swatches])
    for (x, y), (wide, high) in zip(corners, boxes, strict=True):
        assert x + wide <= made.width_px
        assert y + high <= made.height_px
        taken[y : y + high, x : x + wide] += 1
    assert taken.max() == 1
    assert len(made.swatches) == (labels == -1).sum()


def test_colours_grow_into_the_unknown() -> None:
    mesh = relief(8)
    triangles = mesh.triangles.astype(np.int64)
    known = mesh.positions_m[:, 0] < 0.0
    colours = np.where(known[:, None], [[10.0, 200.0, 30.0]], 0.0)
    spread = spread_colours(triangles, known, colours, len(known))
    np.testing.assert_allclose(spread, np.broadcast_to([10.0, 200.0, 30.0], spread.shape))
    alone = spread_colours(np.array([[0, 1, 2]]), np.zeros(3, bool), np.zeros((3, 3)), 3)
    np.testing.assert_allclose(alone, 128.0)


def test_swatches_have_the_corners_colours() -> None:
    colours = np.random.default_rng(2).uniform(0.0, 255.0, (4, 3, 3))
    squares = swatches(colours)
    np.testing.assert_allclose(squares[:, 0, 0], colours[:, 0])
    np.testing.assert_allclose(squares[:, 0, 2], colours[:, 1])
    np.testing.assert_allclose(squares[:, 2, 0], colours[:, 2])
    np.testing.assert_allclose(squares[:, 1, 1], 0.5 * (colours[:, 1] + colours[:, 2]))
