"""Reading pairs: undistorted, rectified, checked for what goes wrong with rigs."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.cameras.rigs import RigCalibration
from veduta.imaging.read import read_image
from veduta.run.errors import InputError
from veduta.walk.rig import Image, PairFiles, Rig, StereoPair

_AGAIN = "Calibrate the two cameras again: lens or rotation are far from any camera's."


@dataclass(frozen=True)
class Rectifier:
    """How pictures of a rig become rectified ones. maps: left and right; None: as they are."""

    rig: Rig
    size_px: tuple[int, int]
    maps: tuple[tuple[NDArray[np.float32], NDArray[np.float32]], ...] | None = None

    def rectified(self, left: Image, right: Image) -> tuple[Image, Image]:
        """Both pictures, rows on rows."""
        if self.maps is None:
            return left, right
        pair = [
            cv2.remap(image, *maps, cv2.INTER_LINEAR)
            for image, maps in zip((left, right), self.maps, strict=True)
        ]
        return np.asarray(pair[0], dtype=np.uint8), np.asarray(pair[1], dtype=np.uint8)


def make_rectifier(calibration: RigCalibration, size_px: tuple[int, int]) -> Rectifier:
    """The rectification of pictures of this size; InputError if the calibration is of another."""
    if calibration.size_px not in {None, size_px}:
        raise InputError(
            calibration.source,
            f"is for pictures of {calibration.size_px}, and these have {size_px}",
            "Give the calibration of these pictures.",
        )
    width, height = size_px
    left, right = calibration.left, calibration.right
    if not (0.0 < left[0, 2] < width and 0.0 < left[1, 2] < height):
        raise InputError(
            calibration.source, "has its principal point outside of the pictures",
            "Give the calibration of these pictures.",
        )  # fmt: skip
    if calibration.is_rectified:
        rig = Rig(
            width, height, (left[0, 0], left[1, 1]), (left[0, 2], left[1, 2]),
            -float(calibration.right_from_left[0, 3]), float(right[0, 2]),
        )  # fmt: skip
        return Rectifier(rig, size_px)
    return _made(calibration, size_px)


def _made(calibration: RigCalibration, size_px: tuple[int, int]) -> Rectifier:
    cameras = []
    for matrix in (calibration.left, calibration.right):
        corner = matrix.copy()
        corner[:2, 2] -= 0.5
        cameras.append(corner)
    lenses = [
        np.array(one or (0.0,) * 5)
        for one in (calibration.distortion_left, calibration.distortion_right)
    ]
    turn, move = (
        np.ascontiguousarray(part) for part in np.split(calibration.right_from_left, [3], axis=1)
    )
    try:
        found = cv2.stereoRectify(
            cameras[0], lenses[0], cameras[1], lenses[1], size_px, turn, move,
            flags=cv2.CALIB_ZERO_DISPARITY, alpha=0.0,
        )  # fmt: skip
    except cv2.error as error:
        raise InputError(calibration.source, "cannot be rectified", _AGAIN) from error
    if not all(np.isfinite(one).all() for one in found[:4]):
        raise InputError(calibration.source, "cannot be rectified", _AGAIN)
    turns, projections = found[0:2], found[2:4]
    maps = tuple(
        cv2.initUndistortRectifyMap(camera, lens, own, projection, size_px, cv2.CV_32FC1)
        for camera, lens, own, projection in zip(cameras, lenses, turns, projections, strict=True)
    )
    left, right = (np.asarray(one, dtype=np.float64) for one in projections)
    baseline_m = -float(right[0, 3]) / float(right[0, 0])
    if abs(right[1, 3]) > abs(right[0, 3]) or baseline_m <= 0.0:
        raise InputError(
            calibration.source, "has the right camera not on the right of the left one",
            "Exchange the cameras, or give T from the left to the right one.",
        )  # fmt: skip
    centre = (float(left[0, 2]) + 0.5, float(left[1, 2]) + 0.5)
    focal = (float(left[0, 0]), float(left[1, 1]))
    rig = Rig(*size_px, focal, centre, baseline_m, float(right[0, 2]) + 0.5)
    return Rectifier(rig, size_px, maps)  # type: ignore[arg-type]


def read_pair(files: PairFiles, rectifier: Rectifier | None) -> tuple[Image, Image]:
    """The two pictures, not yet rectified; InputError where their sizes differ."""
    left, right = (read_image(path).pixels for path in (files.left, files.right))
    if left.shape != right.shape:
        raise InputError(
            files.right, f"is {_size(right)}, and the left picture {files.left.name} {_size(left)}",
            "The two pictures of a pair must have one size.",
        )  # fmt: skip
    if rectifier is not None and (left.shape[1], left.shape[0]) != rectifier.size_px:
        width, height = rectifier.size_px
        raise InputError(
            files.left, f"is {_size(left)}, and the first picture {width} x {height}",
            "All pictures of a walk must have one size.",
        )  # fmt: skip
    return left, right


def read_stereo(files: PairFiles, rectifier: Rectifier) -> StereoPair:
    """A rectified pair."""
    left, right = rectifier.rectified(*read_pair(files, rectifier))
    return StereoPair(files.key, files.view, left, right)


def _size(image: Image) -> str:
    return f"{image.shape[1]} x {image.shape[0]}"
