"""Whole runs of `veduta photos` on rendered streets: what is found, and what it takes.

    python benchmarks photos/photos_street [--seeds N] [--sets DIR]
    python benchmarks photos/photos_street --growth [--sets DIR]
    python benchmarks photos/photos_street --towers [--seeds N] [--sets DIR]

Streets of 40 photos, with radial lenses, changing exposure, noise, and a GPS that is wrong by 5 m.
`--growth` runs 50, 100, 200 and 300 photos of a block instead, without GPS; the smaller sets are
the first photos of the largest. `--towers`: 32 photos round a tower with four identical sides,
where a map that is folded fails. Rendered sets are kept in `--sets` and used again.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pycolmap
from photos_truth import Centres, centre_errors, extent
from record import Row, record
from street_sets import IMAGES, StreetSet, write_set

from veduta.run.atomic import same_file

SEEDS = 3
GROWTH = (50, 100, 200, 300)
BOUND_GIB = 16.0
NEAR = 0.02
"""Of a tower's size: how far off a camera that is right may lie."""
RIGHT = 0.9
FEWEST = 4
"""Photos of a component: a similarity fits any three positions too well."""
TOWER = 32
TOWER_NOTES = (
    "A tower whose four sides are the same; other houses fill at least 15 % of each photo.",
    f"`right`: cameras within {NEAR:.0%} of the largest distance between two of them, after the"
    f" similarity that fits their component best; components of fewer than {FEWEST} have none."
    f" {RIGHT:.0%} are wanted.",
)
NOTES = (
    "Errors are distances of the camera positions from the known ones after the similarity that"
    " fits best.",
    "`all processes GiB`: largest sum of resident sizes of the command and its children, looked at"
    " twice a second; pages that they share count in each.",
    "Times are of a machine that may have had other work.",
)


def prepared(made: StreetSet, folder: Path) -> Path:
    """The set's folder; rendered if it is not there whole."""
    place = folder / f"{made.place}-{made.seed}-{made.photos}"
    if not (place / "outlines.geojson").exists():
        write_set(made, place)
    return place


def first_of(whole: Path, photos: int) -> Path:
    """A folder with the first photos of a set."""
    place = whole.with_name(f"{whole.name}-first-{photos}")
    if (place / "truth.json").exists():
        return place
    (place / IMAGES).mkdir(parents=True, exist_ok=True)
    truth = json.loads((whole / "truth.json").read_text())
    truth["photos"] = truth["photos"][:photos]
    for photo in truth["photos"]:
        if not (photo_path := place / IMAGES / photo["name"]).exists():
            same_file(whole / IMAGES / photo["name"], photo_path)
    (place / "truth.json").write_text(json.dumps(truth))
    return place


@dataclass(frozen=True)
class Run:
    """One call of the command. components: camera centres found, of each; peak: GiB."""

    report: dict[str, Any]
    components: list[Centres]
    seconds: float
    peak: float


def called(place: Path) -> Run:
    """Put the photos of a set through the command."""
    with tempfile.TemporaryDirectory() as work:
        out = Path(work) / "out"
        seconds, peak = _measured(place / IMAGES, out)
        report = json.loads((out / "report.json").read_text())
        maps = sorted((out / "sparse").iterdir(), key=lambda folder: int(folder.name))
        return Run(report, [_centres(folder) for folder in maps], seconds, peak)


def run(made: StreetSet, place: Path) -> Row:
    """One set through the command, with its time and memory."""
    done = called(place)
    measures, steps = done.report["measures"], done.report["steps"]
    true, found = _true_centres(place), done.components[0]
    errors = centre_errors(found, true)
    return {
        "set": f"{made.place} {made.seed}",
        "photos": measures["photos"],
        "calibrated": measures["calibrated"],
        "in the largest component": len(found),
        "mean error m": float(errors.mean()),
        "largest error m": float(errors.max()),
        "mean error, ‰ of the cameras' extent": 1000 * float(errors.mean()) / extent(true),
        "reprojection px": measures["error_px"],
        "points": measures["points"],
        "lens": f"{measures['lens']}, {measures['cameras']}, {measures['principal_point']}",
        "s per photo": done.seconds / measures["photos"],
        **{f"{step['name']} s": step["seconds"] for step in steps},
        "all processes GiB": done.peak,
    }


def tower(made: StreetSet, place: Path) -> Row:
    """A tower: how many cameras lie where they were, each component aligned by itself."""
    done, true = called(place), _true_centres(place)
    size = extent(true)
    right = sum(
        int((centre_errors(found, true) <= NEAR * size).sum())
        for found in done.components
        if len(found) >= FEWEST
    )
    share = right / len(true)
    return {
        "set": f"{made.place} {made.seed}",
        "photos": len(true),
        "components": ", ".join(str(len(found)) for found in done.components),
        "doubtful pairs": done.report["measures"]["pairs_doubtful"],
        "right": right,
        "right %": 100 * share,
        "met": "yes" if share >= RIGHT else "**no**",
        "s": done.seconds,
    }


def _measured(images: Path, out: Path) -> tuple[float, float]:
    """Seconds and GiB of one call of the command."""
    command = [sys.executable, "-m", "veduta.cli.main", "photos", str(images), "-o", str(out)]
    started, peak = time.perf_counter(), 0.0
    process = subprocess.Popen([*command, "--quiet"])
    while process.poll() is None:
        peak = max(peak, _resident_gib(process.pid))
        time.sleep(0.5)
    if process.returncode:
        raise RuntimeError(f"veduta photos ended with status {process.returncode} on {images}")
    return time.perf_counter() - started, peak


def _resident_gib(pid: int) -> float:
    """Of a process and all that it started (Linux)."""
    pages, waiting = 0, [pid]
    while waiting:
        one = waiting.pop()
        try:
            pages += int(Path(f"/proc/{one}/statm").read_text().split()[1])
            for task in Path(f"/proc/{one}/task").iterdir():
                waiting += [int(word) for word in (task / "children").read_text().split()]
        except (FileNotFoundError, ProcessLookupError):
            continue
    return pages * os.sysconf("SC_PAGE_SIZE") / 2**30


def _true_centres(place: Path) -> Centres:
    truth = json.loads((place / "truth.json").read_text())
    return {photo["name"]: np.array(photo["position_m"]) for photo in truth["photos"]}


def _centres(sparse: Path) -> Centres:
    model = pycolmap.Reconstruction(sparse)
    images = [model.images[number] for number in model.reg_image_ids()]
    return {image.name: image.projection_center() for image in images}


def grow(folder: Path) -> None:
    """More and more photos of one block; what is measured is kept after each size."""
    made = StreetSet(0, "block", GROWTH[-1], gps=False)
    whole = prepared(made, folder)
    rows: list[Row] = []
    for photos in GROWTH:
        rows.append(run(made, whole if photos == GROWTH[-1] else first_of(whole, photos)))
        largest = max(float(str(row["all processes GiB"])) for row in rows)
        met = "met" if largest < BOUND_GIB else "**missed**"
        notes = (*NOTES, f"Bound on memory {BOUND_GIB:.0f} GiB: {met}.")
        record("photos-growth", rows, notes)


def main() -> None:
    """Measure streets, or how a block grows."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--seeds", type=int, default=SEEDS)
    parser.add_argument("--growth", action="store_true")
    parser.add_argument("--towers", action="store_true")
    parser.add_argument("--sets", type=Path)
    given = parser.parse_args()
    with tempfile.TemporaryDirectory() as own:
        folder = given.sets or Path(own)
        if given.growth:
            grow(folder)
        elif given.towers:
            towers = [StreetSet(seed, "tower", TOWER, gps=False) for seed in range(given.seeds)]
            rows = [tower(made, prepared(made, folder)) for made in towers]
            record("photos-towers", rows, TOWER_NOTES)
        else:
            sets = [StreetSet(seed) for seed in range(given.seeds)]
            record("photos-street", [run(made, prepared(made, folder)) for made in sets], NOTES)


if __name__ == "__main__":
    main()
