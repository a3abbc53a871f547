"""Calibrating a rig by pictures of a board: OpenCV's chessboard, or its ChArUco board."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.cameras.rigs import RigCalibration
from veduta.run.errors import InputError
from veduta.walk.options import BoardOptions
from veduta.walk.read.layout import find_pairs
from veduta.walk.read.pairs import read_pair
from veduta.walk.rig import Image

Corners = NDArray[np.float32]
_CENTRE = 0.5
"""OpenCV counts pixels from the centre of the first one."""


@dataclass(frozen=True)
class BoardLimits:
    """fewest: pairs that show the board, corners of one. off_px: root mean square beyond which the
    calibration is refused. odd: pictures whose error is so many times the middle one's are left
    out, once.
    """

    fewest: int = 4
    fewest_corners: int = 8
    off_px: float = 1.0
    odd: float = 3.0


@dataclass(frozen=True, eq=False)
class BoardCalibration:
    """rig; its files; which pairs did not show the board, or were odd; off_px: of the corners."""

    rig: RigCalibration
    files: tuple[Path, ...]
    used: int
    left_out: tuple[str, ...]
    off_px: float


@dataclass(frozen=True, eq=False)
class _Seen:
    """(n, 3) corners on the board (m), and (n, 2) where both cameras see them."""

    name: str
    board: Corners
    left: Corners
    right: Corners


def calibrate_rig(
    folder: Path, options: BoardOptions, limits: BoardLimits = BoardLimits()
) -> BoardCalibration:
    """Calibrate by pairs of pictures in a folder; InputError where they do not say it."""
    columns, rows = _size(options, folder)
    pairs = find_pairs(folder)
    seen: list[_Seen] = []
    left_out: list[str] = []
    size: tuple[int, int] | None = None
    for files in pairs:
        left, right = read_pair(files, None)
        own = (left.shape[1], left.shape[0])
        if size not in {None, own}:
            raise InputError(
                files.left, f"is {own[0]} x {own[1]}, and the first picture {size}",
                "All pictures of the board must have one size.",
            )  # fmt: skip
        size = own
        found = _seen(f"{files.key}/{files.view}", left, right, (columns, rows), options, limits)
        if found is None:
            left_out.append(files.left.name)
        else:
            seen.append(found)
    if size is None or len(seen) < limits.fewest:
        raise InputError(
            folder,
            f"{len(seen)} of {len(pairs)} pairs show a board of {columns} x {rows} inner corners"
            " in both pictures",
            f"Take at least {limits.fewest}, and say its size with --board and --square-m.",
        )
    rig, off, odd = _calibrated(seen, size, folder, limits)
    if off > limits.off_px:
        raise InputError(
            folder, f"the board's corners are {off:.2f} px off after calibration",
            "Take sharp pictures of a flat board from many sides; check --board and --square-m.",
        )  # fmt: skip
    sources = tuple(path for pair in pairs for path in (pair.left, pair.right))
    return BoardCalibration(rig, sources, len(seen) - len(odd), (*left_out, *odd), off)


def _size(options: BoardOptions, folder: Path) -> tuple[int, int]:
    found = re.fullmatch(r"(\d{1,2})x(\d{1,2})", options.board)
    columns, rows = (int(one) for one in found.groups()) if found else (0, 0)
    if columns < 3 or rows < 3:
        raise InputError(
            folder, f"a board of {options.board!r} is none", "Say its inner corners: --board 9x6."
        )
    return columns, rows


def _seen(
    name: str, left: Image, right: Image, size: tuple[int, int], options: BoardOptions,
    limits: BoardLimits,
) -> _Seen | None:  # fmt: skip
    greys = [cv2.cvtColor(image, cv2.COLOR_RGB2GRAY) for image in (left, right)]
    found = [_corners(grey, size, options) for grey in greys]
    if found[0] is None or found[1] is None:
        return None
    both = sorted(set(found[0]) & set(found[1]))
    if len(both) < limits.fewest_corners:
        return None
    numbers = np.array(both)
    board = np.column_stack([numbers % size[0], numbers // size[0], np.zeros(len(both))])
    ends = [np.array([one[n] for n in both], dtype=np.float32) for one in found if one is not None]
    return _Seen(name, (board * options.square_m).astype(np.float32), ends[0], ends[1])


def _corners(
    grey: NDArray[np.uint8] | cv2.typing.MatLike, size: tuple[int, int], options: BoardOptions
) -> dict[int, Corners] | None:
    """Where the inner corners are (px), by their numbers; None where the board is not seen."""
    if options.markers:
        name = f"DICT_{options.markers.upper()}"
        if not hasattr(cv2.aruco, name):
            raise InputError(
                options.markers, "is no dictionary of markers", "Say one: --markers 4X4_50."
            )
        dictionary = cv2.aruco.getPredefinedDictionary(getattr(cv2.aruco, name))
        squares = (size[0] + 1, size[1] + 1)
        marker_m = options.square_m * options.marker_share
        board = cv2.aruco.CharucoBoard(squares, options.square_m, marker_m, dictionary)
        corners, numbers, _, _ = cv2.aruco.CharucoDetector(board).detectBoard(grey)
        if numbers is None or len(numbers) == 0:
            return None
        return {
            int(n): np.asarray(at, np.float32).ravel()
            for n, at in zip(np.ravel(numbers), corners, strict=True)
        }
    there, corners = cv2.findChessboardCornersSB(grey, size, flags=cv2.CALIB_CB_ACCURACY)
    if not there:
        return None
    return {n: np.asarray(at, np.float32).ravel() for n, at in enumerate(corners)}


def _calibrated(
    seen: list[_Seen], size: tuple[int, int], source: Path, limits: BoardLimits
) -> tuple[RigCalibration, float, list[str]]:
    """The rig, how far it is off, and which pictures were odd and left out."""
    rig, off, each = _solved(seen, size, source)
    middle = float(np.median(each))
    kept = [one for one, error in zip(seen, each, strict=True) if error <= limits.odd * middle]
    odd = [one.name for one in seen if one not in kept]
    if odd and len(kept) >= limits.fewest:
        rig, off, _ = _solved(kept, size, source)
        return rig, off, odd
    return rig, off, []


def _solved(
    seen: list[_Seen], size: tuple[int, int], source: Path
) -> tuple[RigCalibration, float, NDArray[np.float64]]:
    boards = [one.board for one in seen]
    sides = [[one.left for one in seen], [one.right for one in seen]]
    try:
        alone = [cv2.calibrateCamera(boards, corners, size, None, None) for corners in sides]
        found = cv2.stereoCalibrateExtended(
            boards, sides[0], sides[1], alone[0][1], alone[0][2], alone[1][1], alone[1][2], size,
            np.eye(3), np.zeros(3), flags=cv2.CALIB_USE_INTRINSIC_GUESS,
        )  # fmt: skip
    except cv2.error as error:
        raise InputError(
            source, "the pictures of the board do not say the rig",
            "Take pictures of the board from more sides.",
        ) from error  # fmt: skip
    off, left, lens, right, lens_right, turn, move = found[:7]
    each = np.asarray(found[-1], dtype=np.float64).reshape(len(seen), -1).mean(axis=1)
    matrices = []
    for matrix in (left, right):
        moved = np.array(matrix, dtype=np.float64)
        moved[:2, 2] += _CENTRE
        matrices.append(moved)
    numbers = [tuple(float(n) for n in np.ravel(one)[:5]) for one in (lens, lens_right)]
    rig = RigCalibration(
        source, matrices[0], matrices[1], np.column_stack([turn, np.ravel(move)]),
        numbers[0], numbers[1], size_px=size,
    )  # fmt: skip
    return rig, float(off), each
