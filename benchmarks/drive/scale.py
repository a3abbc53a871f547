"""Processor time and peak memory of the whole command over the length of a synthetic drive.

    python benchmarks drive/scale FOLDER [--km 0.5 1 2 6.769] [--spacing-m 0.25] [--images-m 0]
        [--minutes 3.5]

The path comes from horizontal scans; there is no surface model. Images are taken on the first
`--images-m`. A drive of the paper's size (section 8): `--km 6.769 --spacing-m 0.0632 --images-m
400`, which is 107,000 vertical scans, and images of 3.5 blocks.

Everything is kept in FOLDER, piece by piece: call it again until it says that all is done. With
`--minutes` a call ends after about so long; the command is killed then, and goes on the next time,
as it does for everybody; what a kill loses counts into its time.
"""

from __future__ import annotations

import argparse
import json
import os
import shutil
import signal
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from record import record

from veduta.drive.command import run_drive
from veduta.drive.options import DriveOptions
from veduta.run.progress import Progress
from veduta.synthetic.drives import (
    DriveScans,
    Fronts,
    Street,
    StreetCamera,
    StreetOptions,
    TruckOptions,
    build_street,
    scan_street,
    take_photos,
    write_drive,
    write_photos,
)

PROGRAMS = Path(__file__).parents[1]
SEED, PIECE_M, PHOTOS_M = 21, 100.0, 20.0
CAMERA = StreetCamera(spacing_m=1.0)
ARRAYS = ("times_s", "world_from_vehicle", "angles_rad", "ranges", "level_ranges")


@dataclass(frozen=True)
class Case:
    """A drive to be measured, in a folder of its own."""

    folder: Path
    km: float
    spacing_m: float
    images_m: float

    @property
    def truck(self) -> TruckOptions:
        """The scanners and how they drive."""
        return TruckOptions(level=True, spacing_m=self.spacing_m, sway_m=0.3, sway_rad=0.03)

    @property
    def log(self) -> Path:
        """Where its log lies once it is whole."""
        return self.folder / "log"


class OutOfTime(Exception):
    """The call has lasted as long as it may."""


@dataclass
class Clock:
    """ends: when a call is over (s of the monotonic clock)."""

    ends: float

    def left(self) -> float:
        """Seconds. OutOfTime where there are none."""
        found = self.ends - time.monotonic()
        if found <= 0.0:
            raise OutOfTime
        return found


def write(case: Case, clock: Clock) -> None:
    """The log: scans in pieces, then images, then all of it as the command reads it."""
    street = build_street(StreetOptions(length_m=1000.0 * case.km), SEED)
    pieces = case.folder / "pieces"
    pieces.mkdir(parents=True, exist_ok=True)
    starts = np.arange(0.0, street.length_m, PIECE_M).tolist()
    for number, low in enumerate(starts):
        path = pieces / f"{number:04d}.npz"
        if not path.is_file():
            clock.left()
            part = (low, min(low + PIECE_M, street.length_m))
            scans = scan_street(street, case.truck, SEED + number, part)
            held = {name: getattr(scans, name) for name in ARRAYS}
            np.savez(pieces / "new.npz", allow_pickle=False, **held)
            (pieces / "new.npz").rename(path)
    photos = case.folder / "photos"
    _photos(case, street, photos, clock)
    write_drive(_joined(pieces, len(starts), case.truck), case.log, poses=False)
    if case.images_m > 0.0:
        _join_photos(photos, case.log)


def _photos(case: Case, street: Street, photos: Path, clock: Clock) -> None:
    fronts = Fronts(street, SEED)
    for number, low in enumerate(np.arange(0.0, case.images_m, PHOTOS_M).tolist()):
        part = photos / f"{number:04d}"
        if (part / "drive.toml").is_file():
            continue
        clock.left()
        new = photos / "new"
        shutil.rmtree(new, ignore_errors=True)
        new.mkdir(parents=True)
        (new / "drive.toml").touch()  # to which what is known of the camera is added
        taken = take_photos(
            street, fronts, case.truck, CAMERA, SEED + number, (low, low + PHOTOS_M)
        )
        write_photos(taken, CAMERA, new)
        new.rename(part)


def _join_photos(photos: Path, log: Path) -> None:
    """One table of all parts; their images as they are, under names of their own."""
    import pyarrow
    import pyarrow.parquet

    times, names = [], []
    for part in sorted(photos.glob("[0-9]*")):
        table = pyarrow.parquet.read_table(part / "images.parquet")
        for time_s, name in zip(
            table["time_s"].to_pylist(), table["file"].to_pylist(), strict=True
        ):
            own = f"{part.name}-{name}"
            os.link(part / name, log / own)
            times.append(time_s)
            names.append(own)
    told = pyarrow.table({"time_s": times, "file": names})
    pyarrow.parquet.write_table(told, log / "images.parquet")
    toml = (log / "drive.toml").read_text() + (photos / "0000/drive.toml").read_text()
    (log / "drive.toml").write_text(toml)


def _joined(pieces: Path, count: int, truck: TruckOptions) -> DriveScans:
    parts = []
    for number in range(count):
        with np.load(pieces / f"{number:04d}.npz") as held:
            parts.append({name: held[name] for name in ARRAYS})
    joined = {name: np.concatenate([part[name] for part in parts]) for name in ARRAYS}
    return DriveScans(
        joined["times_s"], joined["world_from_vehicle"], parts[0]["angles_rad"], joined["ranges"],
        np.zeros((0, 0), np.uint8), np.zeros((0, 0)), truck, joined["level_ranges"],
    )  # fmt: skip


def measured(log: Path, out: Path) -> None:
    """Run the command and keep its measures beside OUT."""
    result = run_drive(log, out, DriveOptions(), Progress(quiet=True))
    out.with_suffix(".json").write_text(json.dumps(dict(result.measures)))


def run(case: Case, clock: Clock) -> None:
    """The command in a process of its own, killed when the time is over; each try is kept."""
    out, kept = case.folder / "out", case.folder / "tries.json"
    tries = json.loads(kept.read_text()) if kept.is_file() else []
    call = [sys.executable, str(PROGRAMS), "drive/scale", "--one", str(case.log), str(out)]
    begin = time.perf_counter()
    child = subprocess.Popen(call)
    while True:
        pid, status, used = os.wait4(child.pid, os.WNOHANG)
        if pid:
            break
        if clock.ends <= time.monotonic():
            os.kill(child.pid, signal.SIGKILL)
        time.sleep(0.2)
    tries.append({
        "processor": used.ru_utime + used.ru_stime, "wall": time.perf_counter() - begin,
        "peak": used.ru_maxrss / 1024, "status": status,
    })  # fmt: skip
    kept.write_text(json.dumps(tries))
    if status == signal.SIGKILL:
        raise OutOfTime
    if status != 0:
        sys.exit(f"the command failed in {case.folder}")
    report = json.loads((out / "report.json").read_text())
    measures = json.loads(out.with_suffix(".json").read_text())
    cpu = sum(one["processor"] for one in tries)
    steps = {step["name"]: step["seconds"] for step in report["steps"]}
    (case.folder / "row.json").write_text(json.dumps({
        "km": case.km, "vertical scans": int(1000 * case.km / case.spacing_m),
        "images": int(case.images_m / CAMERA.spacing_m), "segments": measures["segments"],
        "processor (s)": cpu, "processor per km (s)": cpu / case.km,
        "wall (s)": sum(one["wall"] for one in tries), "kills": len(tries) - 1,
        "peak memory (MB)": max(one["peak"] for one in tries),
        **{f"{name}, last try (s)": steps[name] for name in ("read", "layers", "texture", "place")},
    }))  # fmt: skip


def main() -> None:
    """Measure, print and keep."""
    if len(sys.argv) == 4 and sys.argv[1] == "--one":
        measured(Path(sys.argv[2]), Path(sys.argv[3]))
        return
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--km", type=float, nargs="+", default=[0.5])
    parser.add_argument("--spacing-m", type=float, default=0.25)
    parser.add_argument("--images-m", type=float, default=0.0)
    parser.add_argument("--minutes", type=float, default=1e6)
    called = parser.parse_args()
    clock = Clock(time.monotonic() + 60.0 * called.minutes)
    for km in called.km:
        name = f"{km:g}-{called.spacing_m:g}-{called.images_m:g}"
        case = Case(called.folder / name, km, called.spacing_m, called.images_m)
        try:
            if not (case.folder / "row.json").is_file():
                if not (case.log / "drive.toml").is_file():
                    write(case, clock)
                run(case, clock)
        except OutOfTime:
            print("not done yet: call again", flush=True)
            return
    rows = [json.loads(path.read_text()) for path in sorted(called.folder.glob("*/row.json"))]
    rows.sort(key=lambda row: (float(row["km"]), float(row["images"])))
    record("drive-scale", rows, [
        "Horizontal scans as many as vertical ones; path by matching, layers, filling, meshes, and"
        " where there are images, textures and synthesis; no surface model. Processor time counts:"
        " of all tries, where the command was killed in between and went on. Peak: the highest.",
    ])  # fmt: skip
    print("done", flush=True)


if __name__ == "__main__":
    main()
