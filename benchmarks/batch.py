"""Twenty facades in one call: wall time, cores at work, peak memory; and how fast help answers.

    python benchmarks/batch.py

Takes the first twenty images of the ECP set from `$VEDUTA_DATA` (or `../shared/data`). Memory is
summed over the process and all that it started, 20 times a second, as the kernel accounts it:
proportional set size (pages that several processes share are counted once) and resident set size
(they are counted for each).
"""

from __future__ import annotations

import os
import re
import subprocess
import sys
import tempfile
import threading
import time
from dataclasses import dataclass
from pathlib import Path

from record import ROOT, Value, record

IMAGES = 20
BOUND_GIB = 2.0
HELP_BOUND_S = 0.5
HELP_RUNS = 9
SAMPLE_S = 0.05


@dataclass
class Peak:
    """The largest sums seen, in bytes, and the most processes that were at work."""

    pss: int = 0
    rss: int = 0
    processes: int = 0


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


def watched(process: subprocess.Popen[bytes]) -> Peak:
    """The peak memory of a process and its descendants until it ends."""
    peak, over = Peak(), threading.Event()

    def sample() -> None:
        while not over.is_set():
            family = [memory(pid) for pid in descendants(process.pid)]
            peak.pss = max(peak.pss, sum(pss for pss, _ in family))
            peak.rss = max(peak.rss, sum(rss for _, rss in family))
            peak.processes = max(peak.processes, len(family))
            over.wait(SAMPLE_S)

    sampler = threading.Thread(target=sample)
    sampler.start()
    try:
        process.wait()
    finally:
        over.set()
        sampler.join()
    return peak


def descendants(pid: int) -> list[int]:
    """The process and all that it started."""
    children = Path(f"/proc/{pid}/task/{pid}/children")
    try:
        found = [int(child) for child in children.read_text().split()]
    except (FileNotFoundError, ProcessLookupError):
        return [pid]
    return [pid, *(other for child in found for other in descendants(child))]


def memory(pid: int) -> tuple[int, int]:
    """Proportional and resident set size in bytes; zero for a process that has gone."""
    try:
        text = Path(f"/proc/{pid}/smaps_rollup").read_text()
    except (FileNotFoundError, ProcessLookupError, PermissionError):
        return 0, 0
    sizes = dict(re.findall(r"^(Pss|Rss):\s+(\d+) kB", text, re.MULTILINE))
    return int(sizes.get("Pss", 0)) * 1024, int(sizes.get("Rss", 0)) * 1024


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
