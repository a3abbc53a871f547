"""A rig that is calibrated by pictures of a board, rendered by a known one."""

from __future__ import annotations

from pathlib import Path

import cv2
import numpy as np
import pytest
from PIL import Image
from scipy.spatial.transform import Rotation

from veduta.run.errors import InputError
from veduta.run.progress import Progress
from veduta.synthetic.walks.record import GorgeWalk, write_walk
from veduta.walk.command import Sources, run_walk
from veduta.walk.options import BoardOptions, WalkOptions
from veduta.walk.read.board import calibrate_rig

SIZE = (480, 360)
CAMERA = np.array([[420.0, 0.0, 240.0], [0.0, 420.0, 180.0], [0.0, 0.0, 1.0]])
BETWEEN = np.column_stack([Rotation.from_rotvec([0.0, 0.01, 0.0]).as_matrix(), [-0.3, 0.0, 0.0]])
SQUARE_M, DOTS = 0.1, 60.0


def _board(markers: bool) -> np.ndarray:
    """10 x 7 squares with a white rim of one square."""
    side = int(DOTS)
    if markers:
        dictionary = cv2.aruco.getPredefinedDictionary(cv2.aruco.DICT_4X4_50)
        board = cv2.aruco.CharucoBoard((10, 7), SQUARE_M, 0.75 * SQUARE_M, dictionary)
        squares = board.generateImage((10 * side, 7 * side))
    else:
        dark = np.add.outer(np.arange(7), np.arange(10)) % 2 == 0
        squares = np.kron(np.where(dark, 0, 255), np.ones((side, side))).astype(np.uint8)
    return np.pad(squares, side, constant_values=255)


def _shot(picture: np.ndarray, pose: np.ndarray) -> np.ndarray:
    """A board in its plane z = 0, its first inner corner at the origin, seen by a camera."""
    metres = SQUARE_M / DOTS
    from_board = np.array([[metres, 0.0, -2 * SQUARE_M], [0.0, metres, -2 * SQUARE_M], [0, 0, 1.0]])
    seen = CAMERA @ pose[:, [0, 1, 3]] @ from_board
    shift = np.array([[1.0, 0.0, 0.5], [0.0, 1.0, 0.5], [0.0, 0.0, 1.0]])
    moved = np.linalg.inv(shift) @ seen @ shift
    drawn = cv2.warpPerspective(picture, moved, SIZE, borderValue=90, flags=cv2.INTER_AREA)
    return np.repeat(drawn[..., None], 3, axis=2)


def _pictures(folder: Path, count: int, markers: bool = False) -> None:
    rng = np.random.default_rng(7)
    picture = _board(markers)
    for side in ("left", "right"):
        (folder / side).mkdir(parents=True)
    for number in range(count):
        turn = Rotation.from_rotvec(rng.uniform(-0.45, 0.45, 3)).as_matrix()
        middle = np.array([-0.25, -0.25, 1.7]) + rng.uniform(-0.12, 0.12, 3)
        pose = np.column_stack([turn, middle])
        other = np.column_stack([BETWEEN[:, :3] @ turn, BETWEEN[:, :3] @ middle + BETWEEN[:, 3]])
        for side, seen in (("left", pose), ("right", other)):
            Image.fromarray(_shot(picture, seen)).save(folder / side / f"{number:02d}.png")


@pytest.mark.parametrize("markers", [False, True])
def test_the_rig_is_found_again(tmp_path: Path, markers: bool) -> None:
    _pictures(tmp_path, 8, markers)
    options = BoardOptions(board="9x6", square_m=SQUARE_M, markers="4X4_50" if markers else "")
    found = calibrate_rig(tmp_path, options)
    assert found.used >= 6
    assert found.off_px < 0.3
    rig = found.rig
    assert rig.left[0, 0] == pytest.approx(420.0, rel=0.02)
    assert rig.left[:2, 2] == pytest.approx([240.0, 180.0], abs=5.0)
    assert -rig.right_from_left[0, 3] == pytest.approx(0.3, rel=0.01)
    turned = Rotation.from_matrix(rig.right_from_left[:, :3] @ BETWEEN[:, :3].T).magnitude()
    assert np.rad2deg(turned) < 0.3
    assert rig.size_px == SIZE


def test_what_is_wrong_with_boards_is_said(tmp_path: Path) -> None:
    _pictures(tmp_path / "few", 2)
    options = BoardOptions(board="9x6", square_m=SQUARE_M)
    with pytest.raises(InputError, match=r"2 of 2 pairs show a board of 9 x 6 inner corners"):
        calibrate_rig(tmp_path / "few", options)
    with pytest.raises(InputError, match="0 of 2 pairs show a board of 7 x 5"):
        calibrate_rig(tmp_path / "few", BoardOptions(board="7x5"))
    with pytest.raises(InputError, match="a board of '9 by 6' is none"):
        calibrate_rig(tmp_path / "few", BoardOptions(board="9 by 6"))
    with pytest.raises(InputError, match="is no dictionary of markers"):
        calibrate_rig(tmp_path / "few", BoardOptions(markers="NONE"))
    with pytest.raises(InputError, match="there is no such folder"):
        calibrate_rig(tmp_path / "nowhere", options)


def test_a_walk_whose_rig_is_calibrated_by_a_board(tmp_path: Path) -> None:
    """The gorge is taken by another rig than the board: that is refused."""
    _pictures(tmp_path / "board", 6)
    write_walk(tmp_path / "walk", GorgeWalk(keys=2, step_m=1.5, width_px=64, height_px=48))
    options = WalkOptions(board=BoardOptions(board="9x6", square_m=SQUARE_M))
    boards = Sources(boards=tmp_path / "board")
    with pytest.raises(InputError, match=r"is for pictures of \(480, 360\), and these have"):
        run_walk(tmp_path / "walk", tmp_path / "out", options, Progress(quiet=True), sources=boards)
    both = Sources(boards=tmp_path / "board", calibration=tmp_path / "walk" / "walk.toml")
    with pytest.raises(InputError, match="is one of two things"):
        run_walk(tmp_path / "walk", tmp_path / "out", options, Progress(quiet=True), sources=both)
