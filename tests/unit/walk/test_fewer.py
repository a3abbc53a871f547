"""Fewer triangles of a model: no cracks, nothing lost, and no further off than is said."""

from __future__ import annotations

import numpy as np
import pytest

from veduta.walk.build.fewer import FewerSettings, fewer_triangles, grid_shape
from veduta.walk.build.mesh import MorphMesh

ROWS, COLUMNS, STEP_PX, FOCAL_PX = 38, 57, 4, 200.0


def _mesh(depth_m: np.ndarray, torn: np.ndarray | None = None) -> MorphMesh:
    rows, columns = depth_m.shape
    y, x = np.indices(depth_m.shape)
    size = np.array([(columns - 1) * STEP_PX, (rows - 1) * STEP_PX])
    uv = np.stack([x * STEP_PX / size[0], y * STEP_PX / size[1]], axis=-1).reshape(-1, 2)
    across = (x - columns / 2) * STEP_PX / FOCAL_PX
    down = (y - rows / 2) * STEP_PX / FOCAL_PX
    points = np.stack([across * depth_m, down * depth_m, depth_m], axis=-1).reshape(-1, 3)
    number = np.arange(rows * columns).reshape(rows, columns)
    a, b, c, d = number[:-1, :-1], number[:-1, 1:], number[1:, 1:], number[1:, :-1]
    cells = [np.stack([a, b, c], -1).reshape(-1, 3), np.stack([a, c, d], -1).reshape(-1, 3)]
    triangles = np.concatenate(cells).astype(np.uint32)
    return MorphMesh(
        points.astype(np.float32), points.astype(np.float32), uv.astype(np.float32),
        uv.astype(np.float32), np.ones(len(uv), dtype=np.float32), triangles,
        np.zeros(len(triangles), dtype=bool) if torn is None else torn,
    )  # fmt: skip


def _size(mesh: MorphMesh) -> tuple[int, int]:
    rows, columns = grid_shape(mesh)
    return (columns - 1) * STEP_PX, (rows - 1) * STEP_PX


def _areas(mesh: MorphMesh) -> np.ndarray:
    corners = mesh.uv[mesh.triangles].astype(float)
    u, v = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    return np.asarray(0.5 * (u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]))


def _rough(seed: int) -> np.ndarray:
    rng = np.random.default_rng(seed)
    y, x = np.indices((ROWS, COLUMNS))
    wall = 12.0 + 3.0 * np.sin(x / 9.0) + 0.05 * y
    return np.where((x > 30) & (y > 20), wall * rng.uniform(0.9, 1.1, wall.shape), wall)


@pytest.mark.parametrize("seed", range(4))
def test_the_surface_is_covered_once_and_has_no_cracks(seed: int) -> None:
    mesh = _mesh(_rough(seed))
    found = fewer_triangles(mesh, _size(mesh), FOCAL_PX)
    assert len(found.triangles) < len(mesh.triangles)
    areas = _areas(found)
    assert (np.sign(areas) == np.sign(_areas(mesh)[0])).all()
    assert areas.sum() == pytest.approx(_areas(mesh).sum(), rel=1e-5)
    sides = [found.triangles[:, pair] for pair in ([0, 1], [1, 2], [2, 0])]
    ends, count = np.unique(np.sort(np.concatenate(sides), axis=1), axis=0, return_counts=True)
    assert count.max() == 2
    one, other = (found.uv[ends[count == 1][:, k]] for k in (0, 1))
    rim = (one == other) & ((one == 0.0) | (np.abs(one - 1.0) < 1e-6))
    assert rim.any(axis=1).all(), "a side inside the picture has one triangle"


def test_a_slanted_plane_needs_few_and_stays_a_plane() -> None:
    y, x = np.indices((ROWS, COLUMNS))
    mesh = _mesh(1.0 / (0.05 + 0.0004 * x + 0.0006 * y))
    found = fewer_triangles(mesh, _size(mesh), FOCAL_PX)
    assert len(found.triangles) < 0.4 * len(mesh.triangles)
    smooth = fewer_triangles(mesh, _size(mesh), FOCAL_PX, FewerSettings(error_px=1e9))
    assert len(smooth.triangles) <= len(found.triangles)


def test_what_is_left_out_is_no_further_off_than_said() -> None:
    """Each node beside the surface that is left, as a plane through the triangle that it is in."""
    settings = FewerSettings(error_px=0.7)
    mesh = _mesh(_rough(9))
    found = fewer_triangles(mesh, _size(mesh), FOCAL_PX, settings)
    reach = FOCAL_PX * settings.walk_m
    worst = 0.0
    measure = reach / np.linalg.norm(mesh.points.astype(float), axis=1)
    kept = reach / np.linalg.norm(found.points.astype(float), axis=1)
    corners = found.uv[found.triangles].astype(float)
    for uv, true in zip(mesh.uv.astype(float), measure, strict=True):
        edges = np.stack([corners[:, 0] - corners[:, 2], corners[:, 1] - corners[:, 2]], axis=-1)
        shares = np.linalg.solve(edges, (uv - corners[:, 2])[..., None])[..., 0]
        third = 1.0 - shares.sum(axis=1)
        inside = np.flatnonzero((shares >= -1e-6).all(axis=1) & (third >= -1e-6))[0]
        weights = np.array([shares[inside, 0], shares[inside, 1], third[inside]])
        worst = max(worst, abs(float(weights @ kept[found.triangles[inside]]) - true))
    assert worst < 4.0 * settings.error_px
    assert worst > 0.0


def test_breaks_are_kept_as_they_are() -> None:
    depth = np.full((ROWS, COLUMNS), 20.0)
    depth[10:20, 15:30] = 5.0
    plain = _mesh(depth)
    edge = depth.ravel()[plain.triangles]
    mesh = _mesh(depth, edge.max(axis=1) != edge.min(axis=1))
    found = fewer_triangles(mesh, _size(mesh), FOCAL_PX)
    left = found.depth_m[found.triangles]
    across = left.max(axis=1) - left.min(axis=1) > 1.0
    assert across.any()
    assert found.torn[across].all()
    assert not found.torn[~across].any()
    assert len(found.triangles) < 0.7 * len(mesh.triangles)


def test_a_strip_of_two_rows_is_left_alone() -> None:
    mesh = _mesh(np.full((2, 9), 4.0))
    assert fewer_triangles(mesh, _size(mesh), FOCAL_PX) is mesh
