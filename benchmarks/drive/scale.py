"""Processor time and peak memory of the whole command over the length of a synthetic drive.

The path comes from horizontal scans; there are no images. Each length runs in a process of its own.

    python benchmarks/drive/scale.py [KM ...]
"""

from __future__ import annotations

import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from veduta.drive import DriveOptions, run_drive
from veduta.run.progress import Progress
from veduta.synthetic.drives import (
    StreetOptions,
    TruckOptions,
    build_street,
    scan_street,
    write_drive,
)

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from record import record

LENGTHS_KM = (0.1, 0.2, 0.4)
SPACING_M = 0.25


def write(folder: Path, km: float) -> None:
    """A log of this length with a second scanner, without poses."""
    street = build_street(StreetOptions(length_m=1000.0 * km), 21)
    truck = TruckOptions(level=True, spacing_m=SPACING_M, sway_m=0.3, sway_rad=0.03)
    write_drive(scan_street(street, truck, 21), folder, poses=False)


def measured(log: Path, out: Path) -> None:
    """Run the command and print segments, seconds of processor and wall, and the peak in MB."""
    begin = time.perf_counter()
    result = run_drive(log, out, DriveOptions(), Progress(quiet=True))
    used = resource.getrusage(resource.RUSAGE_SELF)
    cpu = used.ru_utime + used.ru_stime
    print(result.measures["segments"], cpu, time.perf_counter() - begin, used.ru_maxrss / 1024)


def main() -> None:
    """Measure, print and keep."""
    if len(sys.argv) == 4 and sys.argv[1] == "--one":
        measured(Path(sys.argv[2]), Path(sys.argv[3]))
        return
    lengths = [float(word) for word in sys.argv[1:]] or list(LENGTHS_KM)
    rows = []
    for km in lengths:
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            write(folder / "log", km)
            call = [sys.executable, __file__, "--one", str(folder / "log"), str(folder / "out")]
            done = subprocess.run(call, capture_output=True, text=True, check=True)
        segments, cpu, wall, peak = (float(word) for word in done.stdout.split())
        rows.append({
            "km": km, "vertical scans": int(1000 * km / SPACING_M), "segments": int(segments),
            "processor (s)": cpu, "processor per km (s)": cpu / km, "wall (s)": wall,
            "peak memory (MB)": peak,
        })  # fmt: skip
        print(rows[-1], flush=True)
    record("drive-scale", rows, [
        f"Vertical and horizontal scans every {SPACING_M} m; path by matching, layers, filling,"
        " meshes; no images, no surface model. On a loaded machine: processor time counts.",
    ])  # fmt: skip


if __name__ == "__main__":
    main()
