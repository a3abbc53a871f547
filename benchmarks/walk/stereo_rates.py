"""Disparities beside the truth: shares of pixels that are wrong, and the time.

`python benchmarks walk/stereo_rates [--draft]` keeps `benchmarks/results/walk-stereo.md`.
"""

from __future__ import annotations

import argparse
import time

import cv2
import numpy as np
from numpy.typing import NDArray
from record import Row, keep_or_print
from walk_sets import DATA

from veduta.cameras.rigs.kitti import read_kitti
from veduta.cameras.rigs.middlebury import read_middlebury
from veduta.imaging.read import read_image
from veduta.walk.build.stereo import StereoSettings, match_stereo
from veduta.walk.read.pairs import make_rectifier
from veduta.walk.rig import Image, Rig

Truth = NDArray[np.float32]
KITTI2015 = Rig(1242, 375, (721.5377, 721.5377), (610.06, 173.35), 0.5327)
"""The rig of those drives; disparities do not depend on it but for the range that is searched."""


def motorcycle() -> tuple[Image, Image, Rig, Truth, NDArray[np.bool_]]:
    """Middlebury 2014: all pixels that have truth, and which of them the right picture shows."""
    folder = DATA / "stereo" / "motorcycle"
    left, right = (read_image(folder / name).pixels for name in ("im0.png", "im1.png"))
    text = (folder / "calib.txt").read_text()
    calibration = read_middlebury(folder / "calib.txt", text)
    rig = make_rectifier(calibration, (left.shape[1], left.shape[0])).rig
    truth = np.asarray(cv2.imread(str(folder / "disp0GT.pfm"), cv2.IMREAD_UNCHANGED), np.float32)
    with (folder / "disp0GT.pfm").open("rb") as file:
        scale = abs(float([file.readline() for _ in range(3)][2]))
    truth = truth * np.float32(scale)  # OpenCV divides by the scale, which Middlebury does not mean
    seen = np.asarray(cv2.imread(str(folder / "mask0nocc.png"), cv2.IMREAD_GRAYSCALE)) == 255
    return left, right, rig, np.where(np.isfinite(truth), truth, np.nan).astype(np.float32), seen


def kitti2015() -> tuple[Image, Image, Rig, Truth, NDArray[np.bool_]]:
    """KITTI 2015, frame 46: with what the right picture does not show."""
    folder = DATA / "stereo" / "kitti2015-000046"
    left, right = (read_image(folder / name).pixels for name in ("left.png", "right.png"))
    stored = cv2.imread(str(folder / "disparity_occ.png"), cv2.IMREAD_UNCHANGED)
    truth = np.asarray(stored, dtype=np.float32) / 256.0
    return left, right, KITTI2015, np.where(truth > 0, truth, np.nan), np.ones(truth.shape, bool)


def kitti00() -> tuple[Image, Image, Rig, Truth, NDArray[np.bool_]]:
    """The first scan of `laser/kitti00`, as the left colour camera sees it."""
    folder = DATA / "laser" / "kitti00"
    name = sorted((folder / "image_2").iterdir())[0].name
    left, right = (read_image(folder / side / name).pixels for side in ("image_2", "image_3"))
    text = (folder / "calib.txt").read_text()
    rig = make_rectifier(
        read_kitti(folder / "calib.txt", text, colour=True), (left.shape[1], left.shape[0])
    ).rig
    rows = {
        line.split(":")[0]: np.array([float(word) for word in line.split(":")[1].split()])
        for line in text.splitlines() if ":" in line
    }  # fmt: skip
    scan = sorted((folder / "velodyne").glob("*.bin"))[0]
    points = np.fromfile(scan, dtype=np.float32).reshape(-1, 4)[:, :3].astype(np.float64)
    moved = points @ rows["Tr"].reshape(3, 4)[:, :3].T + rows["Tr"].reshape(3, 4)[:, 3]
    camera = rows["P2"].reshape(3, 4)
    moved = moved + np.linalg.solve(camera[:, :3], camera[:, 3])
    ahead = moved[moved[:, 2] > 1.0]
    x = np.floor(ahead[:, 0] / ahead[:, 2] * rig.focal_px[0] + rig.centre_px[0]).astype(int)
    y = np.floor(ahead[:, 1] / ahead[:, 2] * rig.focal_px[1] + rig.centre_px[1]).astype(int)
    inside = (x >= 0) & (y >= 0) & (x < rig.width_px) & (y < rig.height_px)
    order = np.argsort(-ahead[inside, 2])
    truth = np.full((rig.height_px, rig.width_px), np.nan, dtype=np.float32)
    disparity = rig.focal_px[0] * rig.baseline_m / ahead[inside, 2]
    truth[y[inside][order], x[inside][order]] = disparity[order] + rig.shift_px
    # The laser stands higher than the camera: what it sees behind an edge the camera does not.
    nearest = cv2.dilate(np.nan_to_num(truth), np.ones((9, 9), np.uint8))
    hidden = np.nan_to_num(truth) < nearest - np.maximum(2.0, 0.1 * nearest)
    return left, right, rig, np.where(hidden, np.nan, truth).astype(np.float32), ~hidden


def row_of(name: str) -> Row:
    """The rates of one pair."""
    left, right, rig, truth, seen = SETS[name]()
    settings = StereoSettings(most=320)
    begin = time.perf_counter()
    found = match_stereo(left, right, rig, settings)
    seconds = time.perf_counter() - begin
    known = np.isfinite(truth)
    off = np.abs(found.filled - truth)
    wrong_3 = (off > 3.0) & (off > 0.05 * truth)
    sure = known & np.isfinite(found.left)

    def share(wrong: NDArray[np.bool_], of: NDArray[np.bool_]) -> float:
        return 100.0 * float(wrong[of].mean())

    return {
        "pair": name, "pixels": f"{left.shape[1]} x {left.shape[0]}",
        "with truth": int(known.sum()),
        "sure %": share(sure, known), "sure: off > 2 px %": share(off > 2.0, sure),
        "sure: off > 3 px, 5 % %": share(wrong_3, sure),
        "all: off > 2 px %": share(off > 2.0, known),
        "all: off > 3 px, 5 % %": share(wrong_3, known),
        "seen by both: off > 2 px %": share(off > 2.0, known & seen), "s": seconds,
    }  # fmt: skip


SETS = {"motorcycle": motorcycle, "kitti2015-000046": kitti2015, "kitti00": kitti00}


def main() -> None:
    """Measure all three."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--draft", action="store_true")
    called = parser.parse_args()
    notes = [
        "OpenCV's semi-global matching with left-right check. sure: what passed the check; all:"
        " with what was carried over gaps.",
        "kitti00: the points of one laser scan that the camera sees.",
    ]
    keep_or_print("walk-stereo", [row_of(name) for name in SETS], notes, not called.draft)


if __name__ == "__main__":
    main()
