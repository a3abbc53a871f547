"""Folders and calibrations: what is read from them, and what is said where they are wrong."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from veduta.cameras.rigs import find_calibration
from veduta.run.errors import InputError
from veduta.walk.read.layout import find_pairs
from veduta.walk.read.pairs import make_rectifier, read_pair

KITTI = (
    "P0: 700 0 600 0 0 700 180 0 0 0 1 0\nP1: 700 0 600 -350 0 700 180 0 0 0 1 0\n"
    "P2: 700 0 600 42 0 700 180 0 0 0 1 0\nP3: 700 0 600 -315 0 700 180 0 0 0 1 0\n"
)
BARE = "7.0e+02 0 600 0 0 700 180 0 0 0 1 0\n700 0 600 -350 0 700 180 0 0 0 1 0\n"
MIDDLEBURY = (
    "cam0=[700 0 599.5; 0 700 179.5; 0 0 1]\ncam1=[700 0 610.5; 0 700 179.5; 0 0 1]\n"
    "doffs=11\nbaseline=500\nwidth=1200\nheight=360\nndisp=128\n"
)
TOML = "focal_px = 700\ncentre_px = [600.0, 180.0]\nbaseline_m = 0.5\n"
OPENCV = """%YAML:1.0
---
M1: !!opencv-matrix
   rows: 3
   cols: 3
   dt: d
   data: [ 700., 0., 599.5, 0., 700., 179.5, 0., 0., 1. ]
D1: !!opencv-matrix
   rows: 1
   cols: 5
   dt: d
   data: [ -0.2, 0.05, 0., 0., 0. ]
M2: !!opencv-matrix
   rows: 3
   cols: 3
   dt: d
   data: [ 705., 0., 602., 0., 705., 181., 0., 0., 1. ]
D2: !!opencv-matrix
   rows: 1
   cols: 5
   dt: d
   data: [ -0.2, 0.05, 0., 0., 0. ]
R: !!opencv-matrix
   rows: 3
   cols: 3
   dt: d
   data: [ 1., 0., 0., 0., 1., 0., 0., 0., 1. ]
T: !!opencv-matrix
   rows: 3
   cols: 1
   dt: d
   data: [ -0.5, 0., 0. ]
"""
HUGE = "rows: 300000\n   cols: 300000"


def _lens(count: int, values: str) -> str:
    """OPENCV with another left lens."""
    lens = "cols: 5\n   dt: d\n   data: [ -0.2, 0.05, 0., 0., 0. ]"
    return OPENCV.replace(lens, f"cols: {count}\n   dt: d\n   data: [ {values} ]", 1)


def _pictures(folder: Path, names: list[str], size: tuple[int, int] = (40, 30)) -> None:
    folder.mkdir(parents=True, exist_ok=True)
    for name in names:
        Image.new("RGB", size, (90, 120, 60)).save(folder / name)


@pytest.mark.parametrize(
    ("left", "right"), [("left", "right"), ("image_2", "image_3"), ("image_l", "image_r")]
)
def test_pairs_of_two_folders_come_in_the_order_of_their_numbers(
    tmp_path: Path, left: str, right: str
) -> None:
    for side in (left, right):
        _pictures(tmp_path / side, ["10.png", "9.png"])
    pairs = find_pairs(tmp_path)
    assert [(one.key, one.left.name, one.right.parent.name) for one in pairs] == [
        ("9", "9.png", right), ("10", "10.png", right),
    ]  # fmt: skip


def test_several_views_of_a_key_position(tmp_path: Path) -> None:
    for key in ("2", "10"):
        _pictures(
            tmp_path / "views" / key, ["a_left.png", "a_right.png", "b_left.png", "b_right.png"]
        )
    assert [(one.key, one.view) for one in find_pairs(tmp_path)] == [
        ("2", "a"), ("2", "b"), ("10", "a"), ("10", "b"),
    ]  # fmt: skip


def test_what_is_missing_is_named(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="no folders of left and right"):
        find_pairs(tmp_path)
    with pytest.raises(InputError, match="there is no such folder"):
        find_pairs(tmp_path / "nowhere")
    _pictures(tmp_path / "left", ["1.png", "2.png"])
    with pytest.raises(InputError, match="holds left/ alone"):
        find_pairs(tmp_path)
    _pictures(tmp_path / "right", ["1.png"])
    with pytest.raises(InputError, match=r"2\.png: the right picture of a pair is missing"):
        find_pairs(tmp_path)
    (tmp_path / "left" / "1.png").unlink()
    (tmp_path / "left" / "2.png").unlink()
    with pytest.raises(InputError, match="holds no pictures"):
        find_pairs(tmp_path)


@pytest.mark.parametrize(
    ("name", "text"),
    [("calib.txt", KITTI), ("calib.txt", BARE), ("calib.txt", MIDDLEBURY), ("walk.toml", TOML)],
)
def test_every_form_says_the_same_rig(tmp_path: Path, name: str, text: str) -> None:
    (tmp_path / name).write_text(text)
    calibration = find_calibration(tmp_path, None, "image_l")
    assert calibration.is_rectified
    rig = make_rectifier(calibration, (1200, 360)).rig
    shift = -11.0 if text == MIDDLEBURY else 0.0
    assert rig.focal_px == (700.0, 700.0)
    assert rig.baseline_m == pytest.approx(0.5)
    assert rig.shift_px == pytest.approx(shift)
    # A point at 10 m: its disparity is f b / z beyond that of infinity.
    assert rig.depth_m(np.array([35.0 + shift]))[0] == pytest.approx(10.0)
    # KITTI and Middlebury count from the centre of the first pixel.
    assert rig.centre_px[0] == pytest.approx(600.0 if text in (TOML, MIDDLEBURY) else 600.5)


def test_colour_cameras_of_kitti(tmp_path: Path) -> None:
    (tmp_path / "calib.txt").write_text(KITTI)
    rig = make_rectifier(find_calibration(tmp_path, None, "image_2"), (1200, 360)).rig
    assert rig.baseline_m == pytest.approx(0.51)


def test_lenses_of_opencv_are_taken_out(tmp_path: Path) -> None:
    (tmp_path / "rig.yml").write_text(OPENCV)
    calibration = find_calibration(tmp_path, None, "left")
    assert not calibration.is_rectified
    rectifier = make_rectifier(calibration, (1200, 360))
    assert rectifier.maps is not None
    assert rectifier.rig.baseline_m == pytest.approx(0.5)
    assert rectifier.rig.shift_px == pytest.approx(0.0)


def test_a_lens_with_no_prism_and_no_tilt_is_the_rational_one(tmp_path: Path) -> None:
    (tmp_path / "rig.yml").write_text(_lens(14, "-0.2, " + "0.01, " * 7 + "0., " * 5 + "0."))
    calibration = find_calibration(tmp_path, None, "left")
    assert calibration.distortion_left == (-0.2, *[0.01] * 7)
    assert make_rectifier(calibration, (1200, 360)).maps is not None


@pytest.mark.parametrize(
    ("name", "text", "words"),
    [
        ("calib.txt", "P0: 1 2 3\nP1: 1 2 3\n", "line 1 has 3 numbers, not 12"),
        ("calib.txt", KITTI.splitlines()[0], "has no matrices P0 and P1"),
        ("calib.txt", "hello = world", "has no camera matrix cam0"),
        ("calib.txt", MIDDLEBURY.replace("baseline=500", "baseline=x"), "no baseline"),
        ("calib.txt", BARE.replace("7.0e+02", "0"), "not that of a camera"),
        ("walk.toml", "focal_px = 700\n", "centre_px"),
        ("walk.toml", "focal_px = ", "is no TOML"),
        ("walk.toml", TOML.replace("0.5", "-0.5"), "baseline_m"),
        ("rig.yml", "%YAML:1.0\n---\nM1: 3\n", "camera matrix of the left"),
        ("rig.yml", OPENCV.replace("[ -0.5, 0., 0. ]", "[ 0., 0., 0. ]"), "translation T"),
        ("rig.yml", _lens(3, "-0.2, 0.05, 0."), "lens has 3 numbers"),
        ("rig.yml", _lens(5, "-0.2, .Nan, 0., 0., 0."), "lens has a value that is no number"),
        ("rig.yml", _lens(12, "0.1, " * 11 + "0.1"), "lens has 12 numbers"),
        ("rig.yml", OPENCV.replace("   dt: d\n", "", 1), "camera matrix of the left"),
        ("rig.yml", OPENCV.replace("rows: 3\n   cols: 3", HUGE, 1), "camera matrix of the left"),
        ("rig.yml", OPENCV.replace("rows: 3", "rows: 4", 1), "a matrix that OpenCV does not"),
        (
            "rig.yml",
            OPENCV.replace("0., 700., 179.5", "0., 0., 179.5"),
            "focal lengths are not above 0",
        ),
        ("rig.yml", OPENCV.replace("[ 1., 0., 0., 0., 1.", "[ .Nan, 0., 0., 0., 1."), "R is no"),
        ("rig.yml", OPENCV.replace("[ 1., 0., 0., 0., 1.", "[ -1., 0., 0., 0., 1."), "R is no"),
        ("rig.yml", "%YAML:1.0\n---\n- 1\n- 2\n", "matri"),
        ("walk.toml", TOML.replace("700", "inf"), "no number"),
        ("walk.toml", TOML.replace("600.0", "nan"), "no number"),
        (
            "calib.txt",
            MIDDLEBURY.replace("0 700 179.5", "0 0 179.5"),
            "focal lengths are not above 0",
        ),
        ("calib.txt", MIDDLEBURY.replace("0 0 1]", "0 1 1]", 1), "does not end 0 0 1"),
        ("calib.txt", MIDDLEBURY.replace("baseline=500", "baseline=inf"), "baseline of inf"),
        ("calib.txt", BARE.replace("0 700 180", "0 -700 180"), "focal lengths are not above 0"),
    ],
)
def test_broken_calibrations_are_named(tmp_path: Path, name: str, text: str, words: str) -> None:
    (tmp_path / name).write_text(text)
    with pytest.raises(InputError, match=words) as raised:
        find_calibration(tmp_path, None, "image_l")
    assert raised.value.subject == str(tmp_path / name)
    assert raised.value.remedy


def test_a_lens_beyond_all_lenses_is_refused(tmp_path: Path) -> None:
    (tmp_path / "rig.yml").write_text(_lens(5, "1e300, 1e300, 0., 0., 0."))
    with pytest.raises(InputError, match="cannot be rectified") as raised:
        make_rectifier(find_calibration(tmp_path, None, "left"), (1200, 360))
    assert raised.value.subject == str(tmp_path / "rig.yml")


def test_calibrations_of_other_pictures_are_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="holds no calibration"):
        find_calibration(tmp_path, None, "left")
    (tmp_path / "calib.txt").write_text(MIDDLEBURY)
    calibration = find_calibration(tmp_path, None, "left")
    with pytest.raises(InputError, match="is for pictures of"):
        make_rectifier(calibration, (600, 180))
    (tmp_path / "calib.txt").write_text(BARE)
    with pytest.raises(InputError, match="principal point outside"):
        make_rectifier(find_calibration(tmp_path, None, "left"), (320, 180))


def test_pictures_of_different_sizes_are_named(tmp_path: Path) -> None:
    _pictures(tmp_path / "left", ["1.png"])
    _pictures(tmp_path / "right", ["1.png"], (50, 30))
    (pair,) = find_pairs(tmp_path)
    with pytest.raises(InputError, match="is 50 x 30, and the left picture"):
        read_pair(pair, None)
