"""Cameras of photos that show a printed board of markers: pose, lens and metres."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import cv2
import numpy as np

from veduta.cameras.board import MARKERS, Board, Floats
from veduta.cameras.camera import Camera, CameraSet
from veduta.imaging.read import read_image
from veduta.run.errors import InputError
from veduta.run.progress import StepProgress, no_progress


@dataclass(frozen=True)
class BoardRule:
    """least_markers: that a photo must show. least_photos: that must show them. poor_px: of a
    corner (root mean square), beyond which a photo is left out: its board was bent, or another.
    """

    least_markers: int = 4
    least_photos: int = 3
    poor_px: float = 3.0


@dataclass(frozen=True, eq=False)
class BoardCameras:
    """cameras: in metres, z out of the sheet. left_out: photos, with the reason. error_px: root
    mean square of the markers' corners. markers: (n,) that each camera's photo shows.
    """

    cameras: CameraSet
    left_out: tuple[str, ...]
    error_px: float
    markers: tuple[int, ...]


def cameras_of_board(
    bare: Sequence[Camera],
    board: Board,
    rule: BoardRule | None = None,
    progress: StepProgress = no_progress,
) -> BoardCameras:
    """One camera's photos, calibrated and placed by the board that they show.

    bare: photos with their sizes, and a guess of the focal length. InputError where they have
    several sizes, or too few show the board.
    """
    rule = rule or BoardRule()
    if len({(camera.width_px, camera.height_px) for camera in bare}) > 1:
        fault = "the photos have several sizes, but one camera is calibrated"
        raise InputError("--board", fault, "Give the photos of one camera, uncropped, at one zoom.")
    seen: list[tuple[Camera, Floats, Floats]] = []
    left_out = []
    for number, camera in enumerate(bare):
        places, corners = _corners(camera, board)
        if len(places) < 4 * rule.least_markers:
            left_out.append(f"{camera.name}: shows {len(places) // 4} markers of the board")
        else:
            seen.append((camera, places, corners))
        progress("board", (number + 1) / len(bare))
    _require(len(seen), len(bare), rule)
    found = _calibrated(seen)
    poor = [error > rule.poor_px for _, error in found]
    if any(poor):
        left_out += [
            f"{camera.name}: the markers are {error:.1f} px from where a flat board has them"
            for (camera, error), bad in zip(found, poor, strict=True)
            if bad
        ]
        seen = [one for one, bad in zip(seen, poor, strict=True) if not bad]
        _require(len(seen), len(bare), rule)
        found = _calibrated(seen)
    errors = np.array([error for _, error in found])
    counts = tuple(len(places) // 4 for _, places, _ in seen)
    weights = np.array(counts, dtype=np.float64)
    error_px = float(np.sqrt((weights * np.square(errors)).sum() / weights.sum()))
    cameras = CameraSet(
        tuple(camera for camera, _ in found),
        scale="metres",
        source="a marker board",
        up=(0.0, 0.0, 1.0),
    )
    return BoardCameras(cameras, tuple(left_out), error_px, counts)


def _require(seen: int, photos: int, rule: BoardRule) -> None:
    if seen < rule.least_photos:
        raise InputError(
            "--board",
            f"{seen} of {photos} photos show {rule.least_markers} markers of the board or more",
            "Print it with `veduta carve --print-board board.pdf`, lay it flat under the object,"
            " and take sharp photos that show most of it.",
        )


def _corners(camera: Camera, board: Board) -> tuple[Floats, Floats]:
    """(4 m, 3) places on the board and (4 m, 2) px of the markers' corners in a photo."""
    if camera.picture is None:
        return np.zeros((0, 3)), np.zeros((0, 2))
    grey = cv2.cvtColor(read_image(camera.picture).pixels, cv2.COLOR_RGB2GRAY)
    settings = cv2.aruco.DetectorParameters()
    settings.cornerRefinementMethod = cv2.aruco.CORNER_REFINE_SUBPIX
    detector = cv2.aruco.ArucoDetector(cv2.aruco.getPredefinedDictionary(MARKERS), settings)
    corners, numbers, _ = detector.detectMarkers(grey)
    if numbers is None or not len(numbers):
        return np.zeros((0, 3)), np.zeros((0, 2))
    on_board = [
        (board.corners_m[number], one[0])
        for number, one in zip(numbers.ravel().astype(int).tolist(), corners, strict=True)
        if number < len(board.corners_m)
    ]
    if not on_board:
        return np.zeros((0, 3)), np.zeros((0, 2))
    places = np.concatenate([place for place, _ in on_board])
    # OpenCV's first pixel has its middle at (0, 0).
    return places, np.concatenate([one for _, one in on_board]).astype(np.float64) + 0.5


def _calibrated(seen: Sequence[tuple[Camera, Floats, Floats]]) -> list[tuple[Camera, float]]:
    """Each camera with its pose, the lens that they share, and its error (px)."""
    first = seen[0][0]
    fixed = (
        cv2.CALIB_USE_INTRINSIC_GUESS
        | cv2.CALIB_FIX_ASPECT_RATIO
        | cv2.CALIB_FIX_PRINCIPAL_POINT
        | cv2.CALIB_ZERO_TANGENT_DIST
        | cv2.CALIB_FIX_K2
        | cv2.CALIB_FIX_K3
    )
    _, matrix, lens, turns, shifts, _, _, errors = cv2.calibrateCameraExtended(
        [places.astype(np.float32) for _, places, _ in seen],
        [corners.astype(np.float32) for _, _, corners in seen],
        (first.width_px, first.height_px),
        first.matrix(),
        np.zeros(5),
        flags=fixed,
    )
    found = []
    for (camera, _, _), turn, shift, error in zip(seen, turns, shifts, errors, strict=True):
        pose = np.column_stack([cv2.Rodrigues(turn)[0], shift.ravel()]).astype(np.float64)
        made = replace(
            camera,
            focal_px=(float(matrix[0, 0]), float(matrix[1, 1])),
            centre_px=(float(matrix[0, 2]), float(matrix[1, 2])),
            cam_from_world=pose,
            distortion=tuple(float(one) for one in np.ravel(lens)),
        )
        found.append((made, float(np.ravel(error)[0])))
    return found
