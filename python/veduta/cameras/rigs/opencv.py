"""OpenCV's YAML of a stereo calibration: M1, D1, M2, D2, R, T, as its samples write it."""

from __future__ import annotations

from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.cameras.rigs.calibration import RigCalibration
from veduta.run.errors import InputError

_NAMES = {
    "left": ("M1", "K1", "cameraMatrix1", "camera_matrix_left"),
    "right": ("M2", "K2", "cameraMatrix2", "camera_matrix_right"),
    "left lens": ("D1", "distCoeffs1", "dist_coeffs_left"),
    "right lens": ("D2", "distCoeffs2", "dist_coeffs_right"),
    "rotation": ("R",),
    "translation": ("T",),
}
_REMEDY = "Give OpenCV's matrices M1, D1, M2, D2, R and T (T in metres) in one YAML file."
_CENTRE = 0.5
"""OpenCV counts pixels from the centre of the first one."""
_MOST_NUMBERS = 16
"""Of one matrix: OpenCV's longest lens has 14. Larger ones are not unpacked."""
_RATIONAL = 8


def read_opencv(path: Path, text: str) -> RigCalibration:
    """The rig in a YAML file; InputError where a matrix is missing or broken."""
    try:
        storage = cv2.FileStorage(text, cv2.FILE_STORAGE_READ | cv2.FILE_STORAGE_MEMORY)
    except (cv2.error, SystemError) as error:
        raise InputError(path, "is no YAML of OpenCV", _REMEDY) from error
    try:
        found = {role: _matrix(storage, names) for role, names in _NAMES.items()}
    except (cv2.error, SystemError) as error:
        raise InputError(path, "has a matrix that OpenCV does not write", _REMEDY) from error
    finally:
        storage.release()
    left, right = (_camera(path, found[side], side) for side in ("left", "right"))
    turn, move = found["rotation"], found["translation"]
    if move is None or move.size != 3 or not 1e-4 < float(np.linalg.norm(move)) < 100.0:
        raise InputError(path, "has no translation T of three numbers in metres", _REMEDY)
    turn = np.eye(3) if turn is None else turn
    if turn.shape != (3, 3) or not (
        np.abs(turn @ turn.T - np.eye(3)).max() <= 1e-4 and np.linalg.det(turn) > 0.0
    ):
        raise InputError(path, "R is no rotation", _REMEDY)
    lens, lens_right = (_lens(found[side]) for side in ("left lens", "right lens"))
    return RigCalibration(
        path, left, right, np.column_stack([turn, move.ravel()]), lens, lens_right
    )


def _lens(matrix: NDArray[np.float64] | None) -> tuple[float, ...]:
    """The numbers of a lens; those of a prism and a tilt, if they are 0, are left out."""
    numbers = () if matrix is None else tuple(matrix.ravel().tolist())
    return numbers if any(numbers[_RATIONAL:]) else numbers[:_RATIONAL]


def _matrix(storage: cv2.FileStorage, names: tuple[str, ...]) -> NDArray[np.float64] | None:
    for name in names:
        node = storage.getNode(name)
        if not node.empty() and node.isMap():
            rows, columns = (node.getNode(side).real() for side in ("rows", "cols"))
            plain = node.getNode("dt").string() in ("d", "f")
            if not (plain and rows >= 1 and columns >= 1 and rows * columns <= _MOST_NUMBERS):
                return None
            return np.asarray(node.mat(), dtype=np.float64)
    return None


def _camera(path: Path, matrix: NDArray[np.float64] | None, side: str) -> NDArray[np.float64]:
    if (
        matrix is None
        or matrix.shape != (3, 3)
        or not np.isfinite(matrix).all()
        or matrix[0, 0] <= 0.0
    ):
        raise InputError(path, f"has no camera matrix of the {side} camera", _REMEDY)
    matrix = matrix.copy()
    matrix[:2, 2] += _CENTRE
    return matrix
