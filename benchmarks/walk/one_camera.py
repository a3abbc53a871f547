"""A drive ahead by one camera: its cameras beside the true ones, and frames that are left out.

`python benchmarks walk/one_camera [SET:FIRST:COUNT[:known] ...] [--keep]`: the left pictures of a
set alone (`known`: with its focal length), by `veduta photos`; then every second frame is left out
and made from those beside it. Keeps `benchmarks/results/walk-one-camera.md`.
"""

from __future__ import annotations

import argparse
import tempfile
import time
from dataclasses import replace
from pathlib import Path

import numpy as np
from leave_one_out import measures
from numpy.typing import NDArray
from record import Row, keep_or_print
from walk_peers import cross_fade
from walk_sets import PathSet, load_set

from veduta.photos.options import CameraOptions, PhotosOptions, WallOptions
from veduta.photos.pipeline import run_photos
from veduta.run.progress import Progress
from veduta.walk.build.local_model import LocalModel, model_of_depth
from veduta.walk.build.photo_depth import FramePlanes
from veduta.walk.build.render import Transition, draw_between
from veduta.walk.build.screen import Screen
from veduta.walk.build.way import find_way
from veduta.walk.read.photo_path import PhotoPath, read_photo_path

SETS = ("kitti-seq1:0:12:known", "kitti-seq1:0:12", "kitti03:0:10:known", "kitti-seq1:13:13")
LARGEST_PX = 1400


def degrees_between(found: NDArray[np.float64], true: NDArray[np.float64]) -> float:
    """The angle of the rotation (3, 3) from one to the other."""
    cosine = (np.trace(found @ true.T) - 1.0) / 2.0
    return float(np.rad2deg(np.arccos(np.clip(cosine, -1.0, 1.0))))


def pose_errors(path: PhotoPath, data: PathSet, numbers: list[int]) -> Row:
    """Of neighbours: lengths against their mean ratio (%), turns and directions (degrees)."""
    lengths, turns, ways = [], [], []
    for one in range(len(numbers) - 1):
        found, true = path.pose(one, one + 1), data.true_pose(numbers[one], numbers[one + 1])
        shifts = [-pose[:, :3].T @ pose[:, 3] for pose in (found, true)]
        sizes = [float(np.linalg.norm(shift)) for shift in shifts]
        lengths.append(sizes[0] / sizes[1])
        turns.append(degrees_between(found[:, :3], true[:, :3]))
        cosine = float(shifts[0] @ shifts[1]) / (sizes[0] * sizes[1])
        ways.append(float(np.rad2deg(np.arccos(np.clip(cosine, -1.0, 1.0)))))
    off = 100.0 * np.abs(np.array(lengths) / np.mean(lengths) - 1.0)
    return {
        "lengths off %": float(off.mean()), "most %": float(off.max()),
        "turns off deg": float(np.median(turns)), "directions off deg": float(np.median(ways)),
    }  # fmt: skip


def left_out(path: PhotoPath) -> Row:
    """Every second frame made from those beside it, which alone gave depth."""
    kept = list(range(0, len(path.cameras), 2))
    some = replace(
        path, given=tuple(path.given[n] for n in kept), cameras=[path.cameras[n] for n in kept],
        visible=tuple(path.visible[n] for n in kept),
    )  # fmt: skip
    planes = FramePlanes(some.cameras, some.picture, some.span)
    models: dict[int, LocalModel] = {}
    found, faded = [], []
    for one in range(len(kept) - 1):
        for number in (one, one + 1):
            if number not in models:
                depth, sure = planes.depth(number)
                models[number] = model_of_depth(
                    str(number), some.picture(number), depth, sure, some.rig
                )
        way = find_way(models[one], models[one + 1], some.rig, given=some.pose(one, one + 1))
        if way.forth is None or way.back is None:
            raise RuntimeError("nothing in common")
        camera = path.pose(kept[one], kept[one] + 1)
        share = float(np.linalg.norm(camera[:, 3]) / np.linalg.norm(way.second_from_first[:, 3]))
        images = models[one].image, models[one + 1].image
        transition = Transition(way.forth, way.back, way.second_from_first, *images)
        made = draw_between(transition, share, camera, Screen.of(some.rig))[0]
        truth = path.picture(kept[one] + 1)
        found.append(measures(made, truth))
        faded.append(measures(cross_fade(*images, share), truth)[0])
    decibels, similar, gradient = (float(column) for column in np.mean(found, axis=0))
    return {
        "views": len(found), "walk dB": decibels, "SSIM": similar, "gradient": gradient,
        "cross-fade dB": float(np.mean(faded)),
    }  # fmt: skip


def row_of(told: str) -> Row:
    """Of SET:FIRST:COUNT, or of that with `:known`."""
    name, first, count, *known = told.split(":")
    data = load_set(name)
    numbers = list(range(int(first), min(int(first) + int(count), len(data.pairs))))
    camera = CameraOptions(focal_px=data.rig.focal_px[0]) if known else CameraOptions()
    options = PhotosOptions(camera=camera, walls=WallOptions(no_walls=True))
    with tempfile.TemporaryDirectory() as made:
        frames = Path(made) / "frames"
        frames.mkdir()
        for number in numbers:
            left = data.pairs[number].left
            (frames / left.name).symlink_to(left.resolve())
        begin = time.process_time()
        result = run_photos(frames, Path(made) / "photos", options, Progress(quiet=True), jobs=1)
        seconds = time.process_time() - begin
        row: Row = {
            "set": told, "frames": len(numbers), "placed": result.measures.get("calibrated", 0),
            "photos: processor s": seconds,
        }  # fmt: skip
        if result.exit_code:
            return row
        path = read_photo_path(frames, Path(made) / "photos", LARGEST_PX)
        names = {data.pairs[number].left.name: number for number in numbers}
        placed = [names[one.left.name] for one in path.pairs]
        focal: Row = {"focal px": path.given[0].focal_px[0]}
        made_of = left_out(path) if placed == numbers else {}
        return {**row, **focal, **pose_errors(path, data, placed), **made_of}


def main() -> None:
    """Measure, and keep."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("sets", nargs="*", default=list(SETS))
    parser.add_argument("--keep", action="store_true")
    given = parser.parse_args()
    rows = [row_of(told) for told in given.sets]
    notes = [
        "SET:FIRST:COUNT are left pictures of `shared/data/stereo`; known: with the focal length of"
        " the set's calibration (`--focal-px`), else it is found.",
        "Lengths of steps against the true ones, by their mean ratio (the scale is not known)."
        " Directions are off by what the axis of the lens is off the middle of the picture, which"
        " one camera on a straight way does not tell.",
        "Every second frame is made from those beside it, which alone gave depth; it is drawn where"
        " `veduta photos` says that it stands.",
    ]
    keep_or_print("walk-one-camera", rows, notes, given.keep)


if __name__ == "__main__":
    main()
