"""KITTI's calib.txt: matrices of rectified cameras, with keys P0: to P3: or as bare rows."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from veduta.cameras.readers.kitti import calibration_rows, projections
from veduta.cameras.rigs.calibration import RigCalibration
from veduta.run.errors import InputError

_REMEDY = "Give KITTI's own file: twelve numbers for each camera, P0: to P3: or two bare rows."
CENTRE = 0.5
"""KITTI counts pixels from the centre of the first one; here its centre is at (0.5, 0.5)."""


def says_kitti(text: str) -> bool:
    """Whether a file is one of KITTI's."""
    rows = calibration_rows(text)
    if any(row.camera is not None for row in rows):
        return True
    return bool(rows) and rows[0].key is None and _are_twelve(rows[0].words)


def read_kitti(path: Path, text: str, *, colour: bool) -> RigCalibration:
    """The colour cameras (P2, P3) or the grey ones (P0, P1); of bare rows, the first two."""
    found = projections(path, text)
    wanted = (2, 3) if colour and 2 in found and 3 in found else (0, 1)
    if not all(number in found for number in wanted):
        raise InputError(path, f"has no matrices P{wanted[0]} and P{wanted[1]}", _REMEDY)
    left, right = (found[number] for number in wanted)
    matrices = []
    moves = []
    for matrix in (left, right):
        camera = matrix[:, :3].copy()
        if abs(np.linalg.det(camera)) < 1.0 or abs(camera[2, 2] - 1.0) > 1e-6:
            raise InputError(path, "a matrix is not that of a camera", _REMEDY)
        moves.append(np.linalg.solve(camera, matrix[:, 3]))
        camera[:2, 2] += CENTRE
        matrices.append(camera)
    between = np.column_stack([np.eye(3), moves[1] - moves[0]])
    return RigCalibration(path, matrices[0], matrices[1], between)


def _are_twelve(words: list[str]) -> bool:
    try:
        return bool(np.isfinite([float(word) for word in words]).all()) and len(words) == 12
    except ValueError:
        return False
