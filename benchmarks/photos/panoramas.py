"""Panoramas carried along rendered streets, alone and on a rig with two cameras.

    python benchmarks photos/panoramas FOLDER [--seeds N ...] [--frames N] [--keep]

Each street is rendered into FOLDER once. Places are against the true ones after the best
similarity. A panorama stands in the middle of its views, and is turned as they say; how far these
are from each other is its own column.
"""

from __future__ import annotations

import argparse
import json
import time
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from record import Row, keep_or_print
from rig_ties import angle_deg, places_off, ties_off

from veduta.formats.place_json import read_place
from veduta.photos.options import CameraOptions, MatchOptions, PhotosOptions
from veduta.photos.pipeline import run_photos
from veduta.run.progress import Progress
from veduta.synthetic.streets.panorama import panoramas_of
from veduta.synthetic.streets.photos import Kit, photos_of
from veduta.synthetic.streets.plan import plan_street
from veduta.synthetic.streets.rig_walk import PAIR, Mounted, walk_rig
from veduta.synthetic.streets.scenery import street_scenery

SIZE_PX = (720, 540)
WIDTH_PX = 2400
AROUND = Mounted("around", 0.0, -0.1, 0.35, 20.0, 0.0)
"""The panorama's camera: above the two others, turned against them."""
NOTES = (
    "Panoramas of 2400 x 1200 px, no GPS, and on the rig with them two cameras of 720 x 540 px half"
    " a metre apart whose focal lengths EXIF tells; the body nods and rolls by 1.5 degrees. Each is"
    " cut into views of 600 px. Turned off: against the others, after the turn that fits all."
    " Spread: of the views of one panorama about its place, the worst. Base and turn: of the"
    " cameras beside the panorama from it, in the median of all frames.",
    "With each view placed for itself, as it was before (commit 5ce719bc), those of street-1"
    " fell into four components, with views of one panorama 4.8 m apart and places 4.5 m off; those"
    " of street-2 were 1.1 cm off, and their views 8 cm apart.",
)

Floats = NDArray[np.float64]


def write_street(folder: Path, seed: int, frames: int) -> None:
    """Photos in a folder per camera and the true poses; kept where they are there."""
    if (folder / "truth.json").exists():
        return
    street = plan_street(seed)
    mounted = walk_rig(street, frames, SIZE_PX, (*PAIR, AROUND))
    scene, light = street_scenery(street, [one for cameras in mounted.values() for one in cameras])
    truth: dict[str, list[list[float]]] = {}
    for name, cameras in mounted.items():
        (folder / "rig" / name).mkdir(parents=True, exist_ok=True)
        poses = [camera.cam_from_world for camera in cameras]
        shots = (
            panoramas_of(scene, light, poses, WIDTH_PX, seed)
            if name == AROUND.name
            else photos_of(scene, light, cameras, Kit("pinhole"), None, seed)
        )
        for row, (jpeg, _) in enumerate(shots):
            (folder / "rig" / name / f"{row:04d}.jpg").write_bytes(jpeg)
            truth[f"{name}/{row:04d}"] = poses[row].tolist()
    (folder / "truth.json").write_text(json.dumps(truth))


def measured(folder: Path, *, rig: bool) -> Row:
    """One street, by the panoramas alone or by all cameras of the rig."""
    every = json.loads((folder / "truth.json").read_text())
    truth = {
        name: np.array(pose)
        for name, pose in every.items()
        if rig or name.startswith(f"{AROUND.name}/")
    }
    photos = folder / "rig" if rig else folder / "rig" / AROUND.name
    out = folder / ("found-rig" if rig else "found")
    options = PhotosOptions(match=MatchOptions(max_features=4000), camera=CameraOptions(rig=rig))
    started = time.process_time()
    result = run_photos(photos, out, options, Progress(quiet=True), force=True)
    seconds = time.process_time() - started
    found, spread = _bodies(out, "" if rig else f"{AROUND.name}/")
    fit, apart = places_off(found, truth)
    names = sorted(found)
    world = np.array([truth[name][:3, :3].T @ found[name][:3, :3].T for name in names])
    left, _, right = np.linalg.svd(world.sum(axis=0))
    turns = [angle_deg((left @ right).T @ one) for one in world]
    base, turn = ties_off(_pairs(found), found, truth, fit.scale) if rig else (None, None)
    return {
        "street": folder.name,
        "photos": "panoramas and two cameras" if rig else "panoramas",
        "placed": f"{len(found)} of {len(truth)}",
        "components": len(result.measures["components"]),
        "places off, median m": float(np.median(apart)),
        "worst m": float(apart.max()),
        "turned off, median degrees": float(np.median(turns)),
        "spread of views, m": fit.scale * spread,
        "base off, cm": base,
        "turn off, degrees": turn,
        "s of processor time": seconds,
    }


def _bodies(out: Path, prefix: str) -> tuple[dict[str, Floats], float]:
    """(4, 4) world from camera by CAMERA/FRAME, and how far views are from their panorama."""
    views: dict[str, list[Floats]] = {}
    for camera in read_place(out / "place.json").cameras:
        stem, _, number = camera.name.rsplit(".", 1)[0].partition("_view")
        pose = np.array(camera.transform).reshape(4, 4).T
        if number:
            angle = 2.0 * np.pi * int(number) / 8
            c, s = np.cos(angle), np.sin(angle)
            pose[:3, :3] = pose[:3, :3] @ np.array([[c, 0, -s], [0, 1, 0], [s, 0, c]])
        views.setdefault(prefix + stem, []).append(pose)
    found, spread = {}, 0.0
    for name, poses in views.items():
        centres = np.array([pose[:3, 3] for pose in poses])
        left, _, right = np.linalg.svd(np.sum([pose[:3, :3] for pose in poses], axis=0))
        found[name] = np.eye(4)
        found[name][:3, :3], found[name][:3, 3] = left @ right, centres.mean(axis=0)
        far = np.linalg.norm(centres - centres.mean(axis=0), axis=1).max()
        spread = max(spread, float(far))
    return found, spread


def _pairs(found: dict[str, Floats]) -> list[tuple[str, str]]:
    """Photos of the other cameras, each with the panorama of its frame."""
    pairs = [(name, f"{AROUND.name}/{name.partition('/')[2]}") for name in found]
    return [(name, middle) for name, middle in pairs if name != middle and middle in found]


def main() -> None:
    """Render what is not there, place it both ways, and print or keep the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--seeds", type=int, nargs="+", default=[1, 2])
    parser.add_argument("--frames", type=int, default=7)
    parser.add_argument("--keep", action="store_true")
    arguments = parser.parse_args()
    rows = []
    for seed in arguments.seeds:
        folder = arguments.folder / f"street-{seed}"
        write_street(folder, seed, arguments.frames)
        rows += [measured(folder, rig=rig) for rig in (False, True)]
    keep_or_print("photos-panoramas", rows, NOTES, arguments.keep)


if __name__ == "__main__":
    main()
