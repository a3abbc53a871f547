"""`fountain-P11` from photos to a textured mesh, with one command each, unattended.

`python benchmarks dense/fountain [--data FOLDER] [--out FOLDER] [--keep]`: `veduta photos` on the
eleven photos alone, then `veduta dense` on its result, both as they come. The bound is 12 minutes
on two cores, and 4 GB. Where the machine has other work, seconds of the processors count: no
program can take longer on its own two cores than both of these together.
"""

from __future__ import annotations

import argparse
import json
import os
import resource
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from peak_memory import watched
from record import Row, keep_or_print

HERE = Path(__file__).resolve()
DATA = HERE.parents[3] / "shared" / "data" / "photos" / "fountain-P11"
CHILD = "import sys; from veduta.cli.main import main; sys.exit(main(sys.argv[1:]))"
MEASURES = ("photos", "points", "triangles", "known_share", "voxel_m", "seen_share", "texel_m")


def run(verb: str, given: Path, out: Path) -> Row:
    """One command as a user types it: its times, its height, and what its report says."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    began = time.perf_counter()
    call = [sys.executable, "-c", CHILD, verb, str(given), "-o", str(out), "-q"]
    process = subprocess.Popen(call)
    peak = watched(process)
    seconds = time.perf_counter() - began
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if process.returncode:
        raise SystemExit(f"{verb} ended with {process.returncode}")
    spent = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    told = json.loads((out / "report.json").read_text())["measures"]
    row: dict[str, str | int | float | bool | None] = {
        "command": f"veduta {verb}",
        "wall s": round(seconds),
        "processor s": round(spent),
        "GB": round(peak.pss / 1e9, 2),
    }
    return row | {name: told[name] for name in MEASURES if name in told}


def main() -> None:
    """Run both, add them up, keep."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--data", type=Path, default=DATA)
    parser.add_argument("--out", type=Path, default=None, help="where the results are left")
    parser.add_argument("--keep", action="store_true")
    given = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        folder, left = Path(scratch) / "photos", given.out or Path(scratch)
        folder.mkdir()
        for photo in sorted(given.data.rglob("*.jpg")):
            shutil.copy(photo, folder / photo.name)
        rows = [run("photos", folder, left / "cameras")]
        rows.append(run("dense", left / "cameras", left / "dense"))
    both = [sum(float(str(row[name])) for row in rows) for name in ("wall s", "processor s")]
    most = max(float(str(row["GB"])) for row in rows)
    rows.append({"command": "both", "wall s": both[0], "processor s": both[1], "GB": most})
    notes = [
        f"Load at the end: {os.getloadavg()[0]:.1f} on {os.cpu_count()} cores, as the wall says.",
        "Bounds: 720 s on two cores, 4 GB. GB: all processes of a command, shared pages once.",
        "Default options; the photos are 1536 x 1024. Lengths are of cameras without a scale.",
    ]
    keep_or_print("dense-fountain", rows, notes, given.keep)


if __name__ == "__main__":
    main()
