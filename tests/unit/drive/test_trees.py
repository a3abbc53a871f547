"""Walls are told from crowns by how often their surface turns back."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from veduta.drive.build.frame import ColumnFrame, column_frame
from veduta.drive.build.trees import TreeParameters, direction_changes


def _frame() -> ColumnFrame:
    line = np.column_stack([np.zeros(150), np.arange(150) * 0.2, np.full(150, 3.6)])
    return column_frame(line, "left", np.deg2rad(np.arange(-60.0, 60.0)), np.zeros(150))


def _wall(sigma_m: float) -> NDArray[np.float32]:
    random = np.random.default_rng(1)
    depth = np.full((120, 150), 11.0) + random.normal(0.0, sigma_m, (120, 150))
    depth[:, 40:60] -= 1.0  # a bay
    depth[60:66, 80:120] -= 0.9  # a balcony
    return depth.astype(np.float32)


def test_wall_with_bays_and_noise_does_not_turn_back() -> None:
    assert direction_changes(_wall(0.035), _frame()) < 0.1


def test_crowns_turn_back_everywhere() -> None:
    random = np.random.default_rng(2)
    leaves = random.uniform(6.0, 9.0, (120, 150)).astype(np.float32)
    assert direction_changes(leaves, _frame()) > TreeParameters().most


def test_too_little_tells_nothing() -> None:
    depth = np.full((120, 150), np.nan, dtype=np.float32)
    depth[80, :40] = 9.0
    assert np.isnan(direction_changes(depth, _frame()))
