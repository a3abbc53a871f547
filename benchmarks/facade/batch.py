"""Twenty facades in one call: wall time, cores at work, peak memory; and how fast help answers.

    python benchmarks facade/batch

Takes the first twenty images of the ECP set from `$VEDUTA_DATA` (or `../shared/data`).
`peak_memory` says how memory is told.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from peak_memory import watched
from record import ROOT, Value, record

IMAGES = 20
BOUND_GIB = 2.0
HELP_BOUND_S = 0.5
HELP_RUNS = 9


def main() -> None:
    """Measure, print and keep the result."""
    data = Path(os.environ.get("VEDUTA_DATA") or ROOT.parent / "shared" / "data")
    images = sorted((data / "facades" / "ecp" / "images").glob("*.jpg"))[:IMAGES]
    if len(images) < IMAGES:
        raise SystemExit(f"needs {IMAGES} images in {data}/facades/ecp: set VEDUTA_DATA")
    rows = [measured_call(images, jobs) for jobs in (None, 1)]
    rows.append(
        {"what": "veduta --help", "wall s": median_help_s(), "bound": f"< {HELP_BOUND_S} s"}
    )
    record("batch", rows, ["cores: processor time of all processes over wall time"])


def measured_call(images: list[Path], jobs: int | None) -> dict[str, Value]:
    """One call with all images."""
    with tempfile.TemporaryDirectory() as folder:
        command = [sys.executable, "-m", "veduta.cli.main", "facade", *map(str, images)]
        command += ["--rectified", "--quiet", "-o", f"{folder}/out"]
        command += [] if jobs is None else ["--jobs", str(jobs)]
        start, before = time.perf_counter(), os.times()
        process = subprocess.Popen(command)
        peak = watched(process)
        wall_s, after = time.perf_counter() - start, os.times()
    if process.returncode != 0:
        raise SystemExit(f"the call ended with exit code {process.returncode}")
    cpu_s = (after.children_user + after.children_system) - (
        before.children_user + before.children_system
    )
    return {
        "what": f"{len(images)} images, {'one job per core' if jobs is None else f'{jobs} job'}",
        "wall s": wall_s,
        "s per image": wall_s / len(images),
        "cores": cpu_s / wall_s,
        "processes": peak.processes,
        "peak PSS GiB": peak.pss / 2**30,
        "peak RSS GiB": peak.rss / 2**30,
        "bound": f"<= {BOUND_GIB:g} GiB",
    }


def median_help_s() -> float:
    """Wall time of `veduta --help` in a new process."""
    times = []
    for _ in range(HELP_RUNS):
        start = time.perf_counter()
        subprocess.run(
            [Path(sys.executable).parent / "veduta", "--help"],
            stdout=subprocess.DEVNULL,
            check=True,
        )
        times.append(time.perf_counter() - start)
    return sorted(times)[HELP_RUNS // 2]


if __name__ == "__main__":
    main()
