"""Surface nets against balls in closed form, and trimesh's checks of closed meshes."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh
from numpy.typing import NDArray

from veduta.surfaces import surface_nets


def _ball(count: int, radius_m: float) -> tuple[NDArray[np.float32], float]:
    axis = np.linspace(-1.0, 1.0, count)
    x, y, z = np.meshgrid(axis, axis, axis, indexing="ij")
    return np.sqrt(x * x + y * y + z * z).astype(np.float32) - np.float32(radius_m), 2 / (count - 1)


def test_a_ball_has_the_volume_and_area_of_a_ball() -> None:
    values, cell = _ball(48, 0.7)
    positions, triangles = surface_nets(values, 0.0, (-1.0, -1.0, -1.0), cell)
    mesh = trimesh.Trimesh(positions, triangles, process=False)
    assert mesh.is_watertight
    assert mesh.is_winding_consistent
    assert mesh.euler_number == 2
    assert mesh.volume == pytest.approx(4 / 3 * np.pi * 0.7**3, rel=0.01)
    assert mesh.area == pytest.approx(4 * np.pi * 0.7**2, rel=0.01)
    assert np.linalg.norm(positions, axis=1) == pytest.approx(0.7, abs=cell / 10)


def test_axes_origin_and_level_are_those_of_the_grid() -> None:
    x = np.arange(8, dtype=np.float32)[:, None, None]
    values = np.broadcast_to(x, (8, 4, 3)).astype(np.float32)
    positions, triangles = surface_nets(values, 2.5, (10.0, 20.0, 30.0), 0.5, close=False)
    assert positions[:, 0] == pytest.approx(11.25)
    assert set(np.round(positions[:, 1] - 20.0, 6)) == {0.25, 0.75, 1.25}
    corners = positions[triangles]
    turned = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    assert (turned[:, 0] > 0).all()


def test_noise_is_closed() -> None:
    values = np.random.default_rng(3).normal(size=(20, 21, 22)).astype(np.float32)
    positions, triangles = surface_nets(values, 0.0, (0, 0, 0), 1.0)
    mesh = trimesh.Trimesh(positions, triangles, process=False)
    assert mesh.is_watertight
    assert mesh.is_winding_consistent
    assert mesh.volume > 0


def test_the_unknown_leaves_a_rim() -> None:
    values, cell = _ball(24, 0.7)
    values[:12] = np.nan
    positions, _ = surface_nets(values, 0.0, (-1.0, -1.0, -1.0), cell)
    assert positions[:, 0].min() > 0


def test_what_is_no_grid_is_refused() -> None:
    with pytest.raises(ValueError, match="three axes"):
        surface_nets(np.zeros((3, 3)), 0.0, (0, 0, 0), 1.0)
    with pytest.raises(ValueError, match="level is no number"):
        surface_nets(np.zeros((3, 3, 3)), np.inf, (0, 0, 0), 1.0)
