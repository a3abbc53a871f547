"""The calibration of a rig, in whichever of a few forms lies beside its pictures."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np

from veduta.cameras.rigs.calibration import RigCalibration
from veduta.cameras.rigs.kitti import read_kitti, says_kitti
from veduta.cameras.rigs.middlebury import read_middlebury
from veduta.cameras.rigs.opencv import read_opencv
from veduta.cameras.rigs.toml import TOML, read_toml
from veduta.run.errors import InputError
from veduta.run.inputs import require_file

CALIB = "calib.txt"
YAML = (".yml", ".yaml")
LARGEST_BYTES = 1_000_000
REMEDY = (
    f"Put {TOML}, an OpenCV .yml, Middlebury's or KITTI's {CALIB} beside the pictures, or name the"
    " file with --calibration."
)

REMEDY_RIG = "Calibrate the two cameras again, or copy the file again."
LENS_NUMBERS = (0, 4, 5, 8)
"""Of a distortion: none, k1 k2 p1 p2, with k3, with k4 k5 k6 (OpenCV's rational model)."""
LONGEST_FOCAL_PX = 1e7


def find_calibration(folder: Path, given: Path | None, left_folder: str) -> RigCalibration:
    """The calibration given, or else the one in the folder; InputError where there is none.

    left_folder: of the left pictures; KITTI's file has the colour cameras beside the grey ones.
    """
    path = given or _beside(folder)
    require_file(path, LARGEST_BYTES)
    try:
        text = path.read_bytes().decode("utf-8-sig")
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(path, "cannot be read as text", REMEDY) from error
    reader: Callable[[Path, str], RigCalibration]
    if path.suffix == ".toml":
        reader = read_toml
    elif path.suffix.lower() in YAML or text.startswith("%YAML"):
        reader = read_opencv
    elif says_kitti(text):
        colour = left_folder in {"image_2", "left"}
        return require_rig(read_kitti(path, text, colour=colour))
    else:
        reader = read_middlebury
    return require_rig(reader(path, text))


def require_rig(rig: RigCalibration) -> RigCalibration:
    """The same rig; InputError where it has numbers that no two cameras have."""
    lenses = (rig.distortion_left, rig.distortion_right)
    sides = zip(("left", "right"), (rig.left, rig.right), lenses, strict=True)
    for side, matrix, lens in sides:
        if not np.isfinite(matrix).all():
            fault = f"the {side} camera's matrix has a value that is no number"
            raise InputError(rig.source, fault, REMEDY_RIG)
        if not all(0.0 < one < LONGEST_FOCAL_PX for one in (matrix[0, 0], matrix[1, 1])):
            fault = f"the {side} camera's focal lengths are not above 0"
            raise InputError(rig.source, fault, REMEDY_RIG)
        if np.abs(matrix[2] - (0.0, 0.0, 1.0)).max() > 1e-6:
            raise InputError(
                rig.source, f"the {side} camera's matrix does not end 0 0 1", REMEDY_RIG
            )
        if len(lens) not in LENS_NUMBERS:
            fault = f"the {side} camera's lens has {len(lens)} numbers"
            raise InputError(rig.source, fault, "Give 0, 4, 5 or 8: k1 k2 p1 p2 k3 k4 k5 k6.")
        if not np.isfinite(lens).all():
            fault = f"the {side} camera's lens has a value that is no number"
            raise InputError(rig.source, fault, REMEDY_RIG)
    if not np.isfinite(rig.right_from_left).all():
        fault = "the place of the right camera is not finite"
        raise InputError(rig.source, fault, REMEDY_RIG)
    return rig


def _beside(folder: Path) -> Path:
    named = [folder / TOML, *sorted(folder.glob("*.y*ml")), folder / CALIB]
    for path in named:
        if path.is_file():
            return path
    raise InputError(folder, "holds no calibration of the two cameras", REMEDY)
