"""What is lost when `veduta photos` is killed: fountain-P11, kill -9 at random moments.

    python benchmarks photos/photos_killed [--kills 10] [--seed 0]

Reads `photos/fountain-P11` of $VEDUTA_DATA (else ../shared/data). One run is not disturbed; each of
the others is killed once, at a moment drawn evenly from the time that the first one took, and run
again. The table has what was kept at the kill, and how far the cameras are from the known ones.
"""

from __future__ import annotations

import argparse
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from contextlib import suppress
from pathlib import Path

import numpy as np
from photos_truth import centre_errors, fountain_centres
from record import Row, record

from veduta.formats.place_json import read_place

DATA = Path(os.environ.get("VEDUTA_DATA", Path(__file__).parents[3] / "shared" / "data")) / "photos"
FOLDER = DATA / "fountain-P11"
NOTES = (
    "`kept`: files of features, and photos in the latest snapshot of the map, at the kill. `made"
    " again`: files of features that the second run wrote although they were there.",
    "Errors are distances of the camera positions from the surveyed ones after the similarity that"
    " fits best. Times are of a machine that may have had other work.",
)


def command(out: Path) -> list[str]:
    """The run, with the options as they come."""
    program = [sys.executable, "-m", "veduta.cli.main", "photos", str(FOLDER / "images")]
    return [*program, "-o", str(out), "--quiet"]


def whole_run(out: Path) -> float:
    """Run to the end; the seconds that it took."""
    started = time.perf_counter()
    subprocess.run(command(out), check=True)
    return time.perf_counter() - started


def features(out: Path) -> dict[str, int]:
    """The files of features with the times at which they were written."""
    stages = out / ".veduta" / "photos"
    found = {}
    for path in stages.glob("features-*.npz"):
        with suppress(FileNotFoundError):  # a run that ends takes its files away
            found[path.name] = path.stat().st_mtime_ns
    return found


def mapped(out: Path) -> int:
    """The latest snapshot's number: one a photo, from the first pair on."""
    names = (out / ".veduta" / "photos").glob("*.mapping/round-*/growing-*/*")
    return max((int(path.name) + 1 for path in names if path.name.isdigit()), default=0)


def mean_error_mm(out: Path) -> float:
    """Of the cameras, against the surveyed ones."""
    cameras = read_place(out / "place.json").cameras
    found = {camera.name: np.array(camera.transform[12:15]) for camera in cameras}
    return 1000 * float(centre_errors(found, fountain_centres(FOLDER / "cameras")).mean())


def killed(out: Path, after_s: float) -> Row:
    """One run that is killed and run again."""
    process = subprocess.Popen(command(out))
    try:
        process.wait(timeout=after_s)
    except subprocess.TimeoutExpired:
        process.send_signal(signal.SIGKILL)
        process.wait()
    stopped = process.returncode == -signal.SIGKILL
    kept, photos = features(out), mapped(out)
    started = time.perf_counter()
    again = subprocess.Popen(command(out))
    written: dict[str, int] = {}
    while again.poll() is None:
        written |= features(out)
        time.sleep(0.05)
    if again.returncode:
        raise RuntimeError(f"the run after a kill at {after_s:.1f} s ended with {again.returncode}")
    return {
        "killed after s": after_s,
        "killed": "yes" if stopped else "had ended",
        "features kept": len(kept),
        "made again": sum(written.get(name, stamp) != stamp for name, stamp in kept.items()),
        "mapped photos kept": photos,
        "second run s": time.perf_counter() - started,
        "calibrated": len(read_place(out / "place.json").cameras),
        "mean error mm": mean_error_mm(out),
    }


def main() -> None:
    """The runs and the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--kills", type=int, default=10)
    parser.add_argument("--seed", type=int, default=0)
    asked = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "out"
        seconds = whole_run(out)
        rows: list[Row] = [
            {
                "killed after s": None,
                "killed": "no",
                "second run s": seconds,
                "calibrated": len(read_place(out / "place.json").cameras),
                "mean error mm": mean_error_mm(out),
            }
        ]
        for moment in np.sort(np.random.default_rng(asked.seed).uniform(0, seconds, asked.kills)):
            shutil.rmtree(out)
            rows.append(killed(out, float(moment)))
    record("photos-killed", rows, NOTES)


if __name__ == "__main__":
    main()
