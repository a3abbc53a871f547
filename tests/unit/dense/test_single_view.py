"""The mesh of one view's depths, which are those of planes."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from veduta.cameras import Camera
from veduta.dense.build.single_view import SingleViewParameters, chosen_points, single_view
from veduta.dense.options import SurfaceOptions
from veduta.dense.single import require_view
from veduta.run.errors import InputError, NotFoundError

RULE = SingleViewParameters()
WIDTH, HEIGHT = 200, 150
TURN = np.array([[0.8, 0.0, 0.6], [0.0, 1.0, 0.0], [-0.6, 0.0, 0.8]])
CAMERA = Camera(
    "a.jpg", WIDTH, HEIGHT, (180.0, 180.0), (100.0, 75.0),
    np.column_stack([TURN, [0.3, -0.2, 1.0]]),
)  # fmt: skip


def _slant() -> NDArray[np.float32]:
    """The depths of a plane of which one side is nearer."""
    column, row = np.meshgrid(np.arange(WIDTH) + 0.5, np.arange(HEIGHT) + 0.5)
    inverse = 0.1 + 0.0004 * (column - 100) + 0.0001 * (row - 75)
    return np.asarray(1.0 / inverse, dtype=np.float32)


def _step() -> NDArray[np.float32]:
    """A wall at 10 m, and a square before it at 6 m, beside which nothing is known."""
    depths = np.full((HEIGHT, WIDTH), 10.0, dtype=np.float32)
    depths[50:100, 60:120] = 6.0
    depths[50:100, 120:140] = np.nan
    return depths


def test_a_plane_needs_few_triangles_and_keeps_its_place() -> None:
    found = single_view(_slant(), CAMERA, 100_000, RULE)
    assert len(found.triangles) < 3000
    assert found.covered > 0.97
    pixels, depths = CAMERA.project(found.points_m)
    assert np.allclose(pixels, found.pixels, atol=1e-6)
    inverse = 0.1 + 0.0004 * (found.pixels[:, 0] - 100) + 0.0001 * (found.pixels[:, 1] - 75)
    assert np.allclose(1.0 / depths, inverse, rtol=1e-4)
    assert found.within < 1e-4
    # Counter-clockwise seen from the camera.
    a, b, c = (found.points_m[found.triangles[:, corner]] for corner in range(3))
    facing = np.einsum("ij,ij->i", np.cross(b - a, c - a), CAMERA.centre() - a)
    assert (facing > 0).all()


def test_squares_of_planes_are_large_and_each_spot_is_in_one() -> None:
    pixels, inverse = chosen_points(_slant(), RULE.within, RULE)
    assert len(pixels) == len(inverse)
    assert len(pixels) < 0.1 * WIDTH * HEIGHT
    inner = (np.abs(pixels - [100, 75]) < [60, 40]).all(axis=1)
    assert inner.sum() < 40
    outline = np.concatenate([pixels.min(axis=0), pixels.max(axis=0)])
    assert np.allclose(outline, [0.5, 0.5, WIDTH - 0.5, HEIGHT - 0.5])


def test_nothing_bridges_a_step_or_a_hole() -> None:
    found = single_view(_step(), CAMERA, 100_000, RULE)
    _, depths = CAMERA.project(found.points_m)
    assert set(np.round(depths, 4).tolist()) == {6.0, 10.0}
    span = np.ptp(depths[found.triangles], axis=1)
    assert span.max() < 1e-3
    middles = found.pixels[found.triangles].mean(axis=1)
    hole = (np.abs(middles - [130, 75]) < [9, 24]).all(axis=1)
    assert not hole.any()
    assert found.cut > 100
    assert found.covered > 0.95


def test_a_budget_of_triangles_is_kept() -> None:
    draw = np.random.default_rng(1)
    noise = (1.0 + 0.03 * draw.standard_normal((HEIGHT, WIDTH))).astype(np.float32)
    noisy = (_slant() * noise)[:75, :100]
    assert len(single_view(noisy, CAMERA, 100_000, RULE).triangles) > 2500
    assert len(single_view(noisy, CAMERA, 1200, RULE).triangles) <= 1200


def test_a_box_cuts() -> None:
    found = single_view(_slant(), CAMERA, 100_000, RULE)
    low, high = np.quantile(found.points_m, [0.2, 0.9], axis=0)
    cut = found.within_box((*low.tolist(), *high.tolist()))
    assert 0 < len(cut.triangles) < len(found.triangles)
    assert (cut.points_m >= low).all()
    with pytest.raises(NotFoundError, match="box"):
        found.within_box((900.0, 900.0, 900.0, 901.0, 901.0, 901.0))


def test_no_surface_is_told() -> None:
    nothing = np.full((HEIGHT, WIDTH), np.nan, dtype=np.float32)
    with pytest.raises(NotFoundError, match="0 depths"):
        single_view(nothing, CAMERA, 1000, RULE)
    line = nothing.copy()
    line[40, 20:90] = 5.0
    with pytest.raises(NotFoundError, match="line"):
        single_view(line, CAMERA, 1000, RULE)


def test_the_photo_must_be_one_of_the_set() -> None:
    require_view(SurfaceOptions(), [])
    for name in ("a.jpg", "a"):
        require_view(SurfaceOptions(single_view=name), [CAMERA])
    with pytest.raises(InputError, match=r"--single-view b\.jpg.*none of the 1 photos.*a\.jpg"):
        require_view(SurfaceOptions(single_view="b.jpg"), [CAMERA])
    with pytest.raises(InputError, match=r"--no-mesh.*no effect"):
        require_view(SurfaceOptions(single_view="a", no_mesh=True), [CAMERA])
    with pytest.raises(InputError, match=r"--voxel-m.*no effect"):
        require_view(SurfaceOptions(single_view="a", voxel_m=0.1), [CAMERA])
