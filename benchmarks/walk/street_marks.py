"""What a walk marks in real frames, held against SemanticKITTI's labels of laser points.

`python benchmarks walk/street_marks [--data FOLDER] [--keep]`: frames of `laser/kitti00` that no
limit was chosen on (1, 2, 4, 5, 7, 8; the limits of grass are of 0, 3, 6, 9), each with the next
but one. Of the laser points that a frame shows within 30 m: how many of those in what is marked
as grass are plants, and how many of the low plants are marked; the same for what moves.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from record import Row, keep_or_print
from walk_sets import DATA

from veduta.cameras.rigs import find_calibration
from veduta.walk.build.local_model import LocalModel, build_local_model
from veduta.walk.build.moving import find_moving
from veduta.walk.read.layout import find_pairs
from veduta.walk.read.pairs import make_rectifier, read_pair, read_stereo

FRAMES, ON = (1, 2, 4, 5, 7, 8), 2
VEGETATION, TERRAIN, MOVES = 70, 72, (252, 260)
FARTHEST_M = 30.0
LOW_M = -1.3
"""Of the scanner, which stands 1.7 m above the road."""


def rows_of(path: Path) -> dict[str, NDArray[np.float64]]:
    """The named 3 x 4 matrices of a calibration."""
    lines = [line.partition(":") for line in path.read_text().splitlines() if ":" in line]
    named = {name: np.array(rest.split(), dtype=float) for name, _, rest in lines}
    return {name: row.reshape(3, 4) for name, row in named.items() if row.size == 12}


def laser(
    folder: Path, frame: int, shape: tuple[int, int]
) -> tuple[NDArray[np.intp], NDArray[np.uint32], NDArray[np.bool_]]:
    """(n, 2) columns and rows of the points that the left camera may see, their classes, and
    which are low.
    """
    calibration = rows_of(folder / "calib.txt")
    scan = np.fromfile(folder / "velodyne" / f"{frame:06d}.bin", dtype=np.float32).reshape(-1, 4)
    labels = np.fromfile(folder / "labels" / f"{frame:06d}.label", dtype=np.uint32)
    classes = (labels & 0xFFFF).astype(np.uint32)
    local = scan[:, :3] @ calibration["Tr"][:, :3].T + calibration["Tr"][:, 3]
    seen = local @ calibration["P2"][:, :3].T + calibration["P2"][:, 3]
    before = (seen[:, 2] > 1.0) & (seen[:, 2] < FARTHEST_M)
    px = np.full((len(seen), 2), -1.0)
    px[before] = seen[before, :2] / seen[before, 2:] + 0.5
    height, width = shape
    inside = (px >= 0).all(axis=1) & (px[:, 0] < width) & (px[:, 1] < height)
    return px[inside].astype(np.intp), classes[inside], scan[inside, 2] < LOW_M


def poses(folder: Path) -> list[NDArray[np.float64]]:
    """(4, 4) world_from_camera of each frame."""
    rows = [line.split() for line in (folder / "poses.txt").read_text().splitlines()]
    return [np.vstack([np.array(row, float).reshape(3, 4), [0.0, 0.0, 0.0, 1.0]]) for row in rows]


def measured(folder: Path, frame: int) -> Row:
    """The row of a frame."""
    pairs = find_pairs(folder)
    calibration = find_calibration(folder, None, pairs[0].left.parent.name)
    left, _ = read_pair(pairs[0], None)
    rectifier = make_rectifier(calibration, (left.shape[1], left.shape[0]))
    rig, every = rectifier.rig, poses(folder)
    first, second = (
        build_local_model(read_stereo(pairs[n], rectifier), rig)
        for n in (frame, min(frame + ON, 9))
    )
    moved = np.linalg.inv(every[min(frame + ON, 9)]) @ every[frame]
    moving = find_moving(first, second, moved[:3], rig.focal_px[0] * rig.baseline_m)
    return {"frame": frame, **_against(folder, frame, first, moving)}


def _against(
    folder: Path, frame: int, model: LocalModel, moving: NDArray[np.bool_]
) -> dict[str, float | int | None]:
    px, classes, low = laser(folder, frame, model.depth_m.shape[:2])
    grass = model.marks.grass[px[:, 1], px[:, 0]]
    plants = (classes == TERRAIN) | (classes == VEGETATION)
    goes = (classes >= MOVES[0]) & (classes < MOVES[1])
    found = moving[px[:, 1], px[:, 0]]
    return {
        "grass, share of the view": float(model.marks.grass.mean()),
        "of it plants": float(plants[grass].mean()) if grass.any() else None,
        "of low plants marked": float(grass[plants & low].mean()),
        "water, share": float(model.marks.water.mean()),
        "moving, share": float(moving.mean()),
        "points that move": int(goes.sum()),
        "of them marked": float(found[goes].mean()) if goes.any() else None,
        "still points marked": int(found[~goes].sum()),
    }


def main() -> None:
    """Measure, and keep the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--data", type=Path, default=DATA)
    parser.add_argument("--keep", action="store_true")
    given = parser.parse_args()
    folder = given.data / "laser" / "kitti00"
    rows = [measured(folder, frame) for frame in FRAMES]
    notes = [
        "laser/kitti00, points within 30 m; plants: SemanticKITTI's vegetation and terrain.",
        "No frame of these was chosen on; they are of the street of those that were.",
    ]
    keep_or_print("walk-street-marks", rows, notes, given.keep)


if __name__ == "__main__":
    main()
