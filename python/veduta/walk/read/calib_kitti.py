"""KITTI's calib.txt: matrices of rectified cameras, with keys P0: to P3: or as bare rows."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from veduta.run.errors import InputError
from veduta.walk.rig import RigCalibration

_KEY = re.compile(r"^\s*(P(?:_rect_)?0?(\d))\s*:\s*(.*)$")
_REMEDY = "Give KITTI's own file: twelve numbers for each camera, P0: to P3: or two bare rows."
CENTRE = 0.5
"""KITTI counts pixels from the centre of the first one; here its centre is at (0.5, 0.5)."""


def says_kitti(text: str) -> bool:
    """Whether a file is one of KITTI's."""
    rows = [line for line in text.splitlines() if line.strip()]
    return any(_KEY.match(line) for line in rows) or (bool(rows) and _numbers(rows[0]) is not None)


def read_kitti(path: Path, text: str, *, colour: bool) -> RigCalibration:
    """The colour cameras (P2, P3) or the grey ones (P0, P1); of bare rows, the first two."""
    found = _matrices(path, text)
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


def _matrices(path: Path, text: str) -> dict[int, NDArray[np.float64]]:
    found: dict[int, NDArray[np.float64]] = {}
    bare = 0
    for line in text.splitlines():
        keyed = _KEY.match(line)
        if keyed is not None:
            values = _numbers(keyed[3])
            if values is None:
                raise InputError(path, f"{keyed[1]} has not twelve numbers", _REMEDY)
            found[int(keyed[2])] = values
        elif (values := _numbers(line)) is not None:
            found[bare] = values
            bare += 1
    return found


def _numbers(line: str) -> NDArray[np.float64] | None:
    try:
        values = np.array([float(word) for word in line.split()])
    except ValueError:
        return None
    return values.reshape(3, 4) if len(values) == 12 and np.isfinite(values).all() else None
