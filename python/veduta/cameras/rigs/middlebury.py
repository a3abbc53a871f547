"""Middlebury's calib.txt: cam0=[f 0 cx; 0 f cy; 0 0 1], cam1, baseline (mm), width, height."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from veduta.cameras.rigs.calibration import RigCalibration
from veduta.run.errors import InputError

_REMEDY = "Give Middlebury's own calib.txt, with cam0, cam1 and baseline (mm), or another form."
_CENTRE = 0.5


def read_middlebury(path: Path, text: str) -> RigCalibration:
    """The rig of a Middlebury pair; InputError where a line is missing or broken."""
    said = dict(re.findall(r"^\s*(\w+)\s*=\s*(.+?)\s*$", text, flags=re.MULTILINE))
    left, right = (_camera(path, said, name) for name in ("cam0", "cam1"))
    try:
        baseline_m = float(said["baseline"]) / 1000.0
        size = (int(said["width"]), int(said["height"])) if "width" in said else None
    except (KeyError, ValueError) as error:
        raise InputError(path, "says no baseline in millimetres", _REMEDY) from error
    if not 0.0 < baseline_m <= 100.0:
        raise InputError(path, f"has a baseline of {baseline_m} m", _REMEDY)
    between = np.column_stack([np.eye(3), [-baseline_m, 0.0, 0.0]])
    return RigCalibration(path, left, right, between, size_px=size)


def _camera(path: Path, said: dict[str, str], name: str) -> NDArray[np.float64]:
    try:
        rows = said[name].strip("[]").split(";")
        matrix = np.array([[float(word) for word in row.split()] for row in rows])
    except (KeyError, ValueError) as error:
        raise InputError(path, f"has no camera matrix {name}", _REMEDY) from error
    if matrix.shape != (3, 3) or not np.isfinite(matrix).all() or matrix[0, 0] <= 0.0:
        raise InputError(path, f"{name} is no camera matrix", _REMEDY)
    matrix[:2, 2] += _CENTRE
    return matrix
