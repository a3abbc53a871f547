"""The calibration of a rig, in whichever of a few forms lies beside its pictures."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from veduta.run.errors import InputError
from veduta.run.inputs import require_file
from veduta.walk.read.calib_kitti import read_kitti, says_kitti
from veduta.walk.read.calib_middlebury import read_middlebury
from veduta.walk.read.calib_opencv import read_opencv
from veduta.walk.read.calib_toml import TOML, read_toml
from veduta.walk.rig import RigCalibration

CALIB = "calib.txt"
YAML = (".yml", ".yaml")
LARGEST_BYTES = 1_000_000
REMEDY = (
    f"Put {TOML}, an OpenCV .yml, Middlebury's or KITTI's {CALIB} beside the pictures, or name the"
    " file with --calibration."
)


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
        return read_kitti(path, text, colour=left_folder in {"image_2", "left"})
    else:
        reader = read_middlebury
    return reader(path, text)


def _beside(folder: Path) -> Path:
    named = [folder / TOML, *sorted(folder.glob("*.y*ml")), folder / CALIB]
    for path in named:
        if path.is_file():
            return path
    raise InputError(folder, "holds no calibration of the two cameras", REMEDY)
