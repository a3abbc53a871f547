"""What `veduta dense` cuts away: outside of the box, and points that stand alone."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from veduta.dense.build.cloud import CloudParameters, DenseCloud, without_strays
from veduta.dense.build.surface import (
    RawSurface,
    SurfaceParameters,
    _without_crumbs,
    cut_surface,
)
from veduta.run.errors import NotFoundError


def _grid() -> RawSurface:
    """A square of 5 x 5 corners, a metre apart, in two triangles a cell."""
    x, y = np.meshgrid(np.arange(5.0), np.arange(5.0))
    points = np.stack([x.ravel(), y.ravel(), np.zeros(25)], axis=1)
    corner = (np.arange(4)[:, None] * 5 + np.arange(4)).ravel()
    lower = np.stack([corner, corner + 1, corner + 6], axis=1)
    upper = np.stack([corner, corner + 6, corner + 5], axis=1)
    return RawSurface(points, np.concatenate([lower, upper]).astype(np.uint32), 0.5, 7)


def test_the_mesh_ends_at_the_box() -> None:
    cut = cut_surface(_grid(), (0.5, -1.0, -1.0, 3.5, 2.5, 1.0))
    # Corners 1 to 3 by 0 to 2 are inside: 2 x 2 cells.
    assert len(cut.points_m) == 9
    assert len(cut.triangles) == 8
    assert cut.points_m[:, 0].min() == 1.0
    assert cut.points_m[:, 1].max() == 2.0
    sides = cut.points_m[cut.triangles]
    across = np.cross(sides[:, 1] - sides[:, 0], sides[:, 2] - sides[:, 0])
    assert np.allclose(across, [0.0, 0.0, 1.0])
    assert (cut.voxel_m, cut.dropped) == (0.5, 7)


def test_a_box_beside_the_mesh_is_told() -> None:
    with pytest.raises(NotFoundError, match="none lies in the box"):
        cut_surface(_grid(), (10.0, 10.0, 10.0, 11.0, 11.0, 11.0))


def _cloud(points: NDArray[np.float64]) -> DenseCloud:
    count = len(points)
    return DenseCloud(
        points,
        np.zeros((count, 3), dtype=np.float32),
        np.zeros((count, 3), dtype=np.uint8),
        np.arange(count).astype(np.uint8),
    )


def test_points_that_stand_alone_are_left_out_and_sparse_walls_are_not() -> None:
    x, y = np.meshgrid(np.arange(20.0), np.arange(20.0))
    near = np.stack([0.1 * x.ravel(), 0.1 * y.ravel(), np.zeros(400)], axis=1)
    far = np.stack([50.0 + x.ravel(), y.ravel(), np.full(400, 30.0)], axis=1)
    alone = np.array([[1.0, 1.0, 2.0], [-3.0, 0.0, 0.0]])
    left = without_strays(_cloud(np.concatenate([near, alone, far])), CloudParameters())
    assert np.array_equal(left.points_m, np.concatenate([near, far]))
    assert len(left.views) == len(left.normals) == len(left.colours) == 800


def test_a_cloud_of_a_few_points_stays() -> None:
    few = _cloud(np.arange(9.0).reshape(3, 3))
    assert without_strays(few, CloudParameters()) is few


def test_rags_that_hang_loose_are_dropped_and_two_walls_are_not() -> None:
    wall = _grid()
    apart = np.array([10.0, 0.0, 0.0])
    rag = np.array([[30.0, 0.0, 5.0], [31.0, 0.0, 5.0], [30.0, 1.0, 5.0]])
    points = np.concatenate([wall.points_m, wall.points_m + apart, rag])
    triangles = np.concatenate([wall.triangles, wall.triangles + 25, [[50, 51, 52]]])
    rule = SurfaceParameters(least_share=0.02, least_triangles=1)
    left = _without_crumbs(RawSurface(points, triangles.astype(np.uint32), 0.5), rule)
    assert left.dropped == 1
    assert np.array_equal(left.points_m, points[:50])
    assert np.array_equal(left.triangles, triangles[:64])
    large = SurfaceParameters(least_share=0.02, least_triangles=1, large_triangles=1)
    every = _without_crumbs(RawSurface(points, triangles.astype(np.uint32), 0.5), large)
    assert every.dropped == 0
