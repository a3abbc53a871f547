"""Cameras in OpenCV's YAML or XML: `camera_matrix`, distortion, and `extrinsic` per view.

A file for each photo (named after it), or one for all: with `extrinsic_parameters` (n x 6, a
rotation vector and a shift, as OpenCV's calibration example writes them), or with `views`, a list
of maps of `name`, `rvec` or `R`, and `t`.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.cameras.camera import LENS_NUMBERS, Camera, CameraSet
from veduta.cameras.files import picture_size, read_opencv, read_text
from veduta.cameras.pictures import Pictures, at_picture_size, natural_order, near, require_picture
from veduta.cameras.projection import nearest_turn
from veduta.run.errors import InputError

Floats = NDArray[np.float64]
SUFFIXES = (".yml", ".yaml", ".xml")
MATRIX = ("camera_matrix", "cameraMatrix", "Camera_Matrix", "K", "M1", "intrinsic")
LENS = ("distortion_coefficients", "Distortion_Coefficients", "distCoeffs", "dist_coeffs", "D")
TURN = ("R", "rotation", "rvec", "rotation_vector")
SHIFT = ("t", "T", "tvec", "translation")
WIDTH = ("image_width", "image_Width", "width")
HEIGHT = ("image_height", "image_Height", "height")
EXTRINSIC = ("extrinsic_parameters", "Extrinsic_Parameters")
_WRITE = (
    "Write camera_matrix (3 x 3), distortion_coefficients, and for each photo R (3 x 3, camera from"
    " world) and t, or extrinsic_parameters (n x 6)."
)


def find(folder: Path) -> Path | None:
    """The file of a folder, or the folder where each photo has one."""
    found = [path for path in _files(folder) if is_one(path)]
    return found[0] if len(found) == 1 else folder if found else None


def is_one(path: Path) -> bool:
    """Whether a file has a matrix of a camera."""
    if path.suffix.lower() not in SUFFIXES:
        return False
    text = read_text(path)
    return any(f"{name}:" in text or f"<{name}" in text for name in MATRIX)


def read(found: Path, images: Path | None) -> CameraSet:
    """The cameras of a file, or of all files of a folder."""
    pictures = near(found, images)
    files = [path for path in _files(found) if is_one(path)] if found.is_dir() else [found]
    cameras: list[Camera] = []
    for path in files:
        cameras += _of_file(path, pictures)
    return CameraSet(cameras=tuple(cameras), source=str(found))


def _files(folder: Path) -> list[Path]:
    found = [path for path in folder.iterdir() if path.suffix.lower() in SUFFIXES]
    return sorted(found, key=lambda path: natural_order(path.name))


def _of_file(path: Path, pictures: Pictures) -> list[Camera]:
    record = read_opencv(path)
    poses = _poses(path, record, pictures)
    return [_camera(path, record, name, pose, pictures) for name, pose in poses]


def _poses(path: Path, record: dict[str, Any], pictures: Pictures) -> list[tuple[str, Floats]]:
    """Name and cam_from_world (3, 4) of each view."""
    views = record.get("views")
    if isinstance(views, list) and all(isinstance(view, dict) for view in views):
        return [(str(view.get("name", "")), _pose(path, view)) for view in views]
    table = _first(record, EXTRINSIC)
    if table is None:
        return [(str(record.get("image", path.stem)), _pose(path, record))]
    rows = _matrix(path, "extrinsic_parameters", table)
    if rows.ndim != 2 or rows.shape[1] != 6:
        raise InputError(path, "its extrinsic_parameters are not n x 6", _WRITE)
    if len(rows) > len(pictures.paths):
        fault = f"has poses of {len(rows)} photos, but there are {len(pictures.paths)}"
        raise InputError(path, fault, "Name the folder of the photos.")
    names = [picture.name for picture in pictures.paths[: len(rows)]]
    return [
        (name, np.column_stack([cv2.Rodrigues(row[:3])[0], row[3:]]))
        for name, row in zip(names, rows, strict=True)
    ]


def _pose(path: Path, record: dict[str, Any]) -> Floats:
    turn, shift = _first(record, TURN), _first(record, SHIFT)
    if turn is None or shift is None:
        raise InputError(path, "has no pose (R and t)", _WRITE)
    rotation = _matrix(path, "R", turn)
    if rotation.size == 3:
        rotation = np.asarray(cv2.Rodrigues(rotation.ravel())[0], dtype=np.float64)
    moved = _matrix(path, "t", shift).ravel()
    if rotation.size != 9 or moved.size != 3:
        raise InputError(path, "its R is not 3 x 3, or its t has not 3 numbers", _WRITE)
    found = nearest_turn(rotation.reshape(3, 3), 1e-3)
    if found is None:
        raise InputError(path, "its R is no turn", _WRITE)
    return np.column_stack([found, moved])


def _camera(
    path: Path, record: dict[str, Any], name: str, pose: Floats, pictures: Pictures
) -> Camera:
    k = _matrix(path, "camera_matrix", _first(record, MATRIX))
    if k.shape != (3, 3) or k[0, 0] <= 0.0 or k[1, 1] <= 0.0:
        raise InputError(path, "its camera_matrix is no 3 x 3 matrix of a camera", _WRITE)
    lens = _first(record, LENS)
    bends = (
        tuple(float(v) for v in _matrix(path, "distortion", lens).ravel())
        if lens is not None
        else ()
    )
    if len(bends) not in LENS_NUMBERS:
        fault = f"has {len(bends)} distortion coefficients; 4, 5 or 8 are followed"
        raise InputError(path, fault, "Undistort the photos first.")
    width, height = _first(record, WIDTH), _first(record, HEIGHT)
    picture = pictures.find(name)
    if width is None or height is None:
        picture, width, height = require_picture(pictures, name, path)
    size = picture_size(path, width, height)
    camera = Camera(
        name=picture.name if picture else name,
        width_px=size[0],
        height_px=size[1],
        focal_px=(float(k[0, 0]), float(k[1, 1])),
        centre_px=(float(k[0, 2]) + 0.5, float(k[1, 2]) + 0.5),
        cam_from_world=pose,
        distortion=bends if any(bends) else (),
        picture=picture,
        skew_px=float(k[0, 1]),
    )
    return at_picture_size(camera, path)


def _first(record: dict[str, Any], names: tuple[str, ...]) -> Any:
    return next((record[name] for name in names if record.get(name) is not None), None)


def _matrix(path: Path, name: str, value: Any) -> Floats:
    try:
        found = np.asarray(value, dtype=np.float64)
    except (ValueError, TypeError):
        raise InputError(path, f"its {name} has no numbers", _WRITE) from None
    if not np.isfinite(found).all():
        raise InputError(path, f"its {name} has numbers that are not finite", _WRITE)
    return found
