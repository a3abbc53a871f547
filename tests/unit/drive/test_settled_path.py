"""Paths that are slid to where their scans fit edges: back by what they were off, no farther."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy import ndimage

from veduta.drive.read.settle import settled
from veduta.drive.read.surface_model import SurfaceModel

CELL_M = 0.25
Floats = NDArray[np.float64]


def corners() -> NDArray[np.bool_]:
    """A street's two walls along x, with a pier every 7 m on one and 11 m on the other."""
    edge = np.zeros((240, 320), dtype=bool)
    edge[80] = edge[160] = True
    for x in range(12, 320, 28):
        edge[80:88, x] = True
    for x in range(20, 320, 44):
        edge[152:160, x] = True
    return edge


def model_of(edge: NDArray[np.bool_]) -> SurfaceModel:
    distance = ndimage.distance_transform_edt(~edge) * CELL_M
    return SurfaceModel(
        distance.astype(np.float32), (-40.0, -30.0), CELL_M, None, 1, None, float(edge.mean())
    )


def drive(edge: NDArray[np.bool_]) -> tuple[Floats, list[Floats]]:
    """Poses every metre along the middle, and what lies within 12 m along x of each."""
    rows, columns = np.random.default_rng(2).permutation(np.argwhere(edge)).T
    places = np.stack([columns, rows], axis=1) * CELL_M + [-40.0, -30.0] + CELL_M / 2
    poses = np.column_stack([np.linspace(-20.0, 20.0, 41), np.zeros(41), np.zeros(41)])
    scans = [places[np.abs(places[:, 0] - x) < 12.0] - [x, 0.0] for x in poses[:, 0].tolist()]
    return poses, scans


@pytest.mark.parametrize("off", [(0.75, 0.25), (-1.0, 0.5), (0.5, -0.75)])
def test_a_path_that_is_off_comes_back(off: tuple[float, float]) -> None:
    edge = corners()
    poses, scans = drive(edge)
    found = settled(poses + np.array([*off, 0.0]), scans, model_of(edge))
    np.testing.assert_allclose(found, poses, atol=0.13)


def test_a_path_that_fits_stays() -> None:
    edge = corners()
    poses, scans = drive(edge)
    np.testing.assert_allclose(settled(poses, scans, model_of(edge)), poses, atol=0.13)


def test_what_no_edge_tells_is_not_slid() -> None:
    """Two bare walls say nothing of where along them one is."""
    edge = np.zeros((240, 320), dtype=bool)
    edge[80] = edge[160] = True
    poses, scans = drive(edge)
    found = settled(poses + np.array([0.75, 0.5, 0.0]), scans, model_of(edge))
    assert np.abs(found[:, 1]).max() <= 0.13
    assert np.abs(found[:, 0] - poses[:, 0] - 0.75).max() <= 0.13
