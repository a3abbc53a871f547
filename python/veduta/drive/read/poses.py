"""Poses of the vehicle: from a table, and at any time between two of them."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from veduta.drive.read.tables import list_column, read_table, time_column
from veduta.run.errors import InputError


def poses_of(path: Path) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """(p,) times in ascending order and (p, 3, 4) world_from_vehicle."""
    table = read_table(path, ("time_s", "matrix"))
    times, rows = time_column(path, table), list_column(path, table, "matrix")
    if rows.shape[1:] != (12,) or len(rows) < 2 or not np.isfinite(rows).all():
        fault = "has not two poses of twelve numbers"
        raise InputError(path, fault, "Each is a 3x4 matrix by rows.")
    order = np.argsort(times, kind="stable")
    return times[order], rows[order].reshape(-1, 3, 4)


def poses_at(
    wanted: NDArray[np.float64], times: NDArray[np.float64], poses: NDArray[np.float64]
) -> NDArray[np.float64]:
    """(n, 4, 4) the poses at some times: positions linearly, turns along the chord."""
    after = np.clip(np.searchsorted(times, wanted), 1, len(times) - 1)
    span = np.maximum(times[after] - times[after - 1], 1e-9)
    share = np.clip((wanted - times[after - 1]) / span, 0.0, 1.0)[:, None, None]
    mixed = (1.0 - share) * poses[after - 1] + share * poses[after]
    left, _, right = np.linalg.svd(mixed[:, :, :3])
    found = np.tile(np.eye(4), (len(wanted), 1, 1))
    found[:, :3, :3] = left @ right
    found[:, :3, 3] = mixed[:, :, 3]
    return found
