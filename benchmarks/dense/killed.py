"""`veduta dense` killed with SIGKILL at ten random moments: how many depth maps are made again.

python benchmarks dense/killed [--keep]: one call on ten rendered photos, killed ten times and
begun again each time. A depth map that is begun and not found on disk after a kill is lost. The
result is compared, byte for byte, with that of a call that nobody killed.
"""

from __future__ import annotations

import argparse
import os
import random
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from growth import write_photos
from record import Row, keep_or_print

KILLS, PHOTOS, WIDTH, SEED = 10, 10, 160, 3
CHILD = """
import sys
from veduta.cli.main import main
from veduta.dense import depths
log = sys.argv[1]
for name in ("match_coarse", "match_fine"):
    def counted(*given, real=getattr(depths, name)):
        with open(log, "ab") as file:
            file.write(b".")
        return real(*given)
    setattr(depths, name, counted)
sys.exit(main(sys.argv[2:]))
"""


def begun(log: Path) -> int:
    """Depth maps, coarse or fine, that were begun."""
    return log.stat().st_size if log.exists() else 0


def on_disk(out: Path) -> int:
    """Those that are kept for resuming."""
    stages = out / ".veduta" / "dense"
    return len([*stages.glob("coarse-*"), *stages.glob("fine-*")])


def killed(folder: Path, scratch: Path) -> tuple[list[Row], Path]:
    """The rows of all kills, and the folder of the result that came after them."""
    out, log, draw = scratch / "killed", scratch / "log", random.Random(SEED)
    call = [sys.executable, "-c", CHILD, str(log), "dense", str(folder), "-o", str(out), "-q"]
    call.append("--no-mesh")
    rows: list[Row] = []
    lost = 0
    for number in range(KILLS):
        before = begun(log)
        child = subprocess.Popen(call)
        aim = before + draw.randint(0, 2 * PHOTOS // 5)
        while begun(log) < aim and child.poll() is None:
            time.sleep(0.001)
        time.sleep(draw.uniform(0.0, 0.5))
        done = child.poll() is not None
        child.send_signal(signal.SIGKILL)
        child.wait()
        again = begun(log) - on_disk(out) - lost
        lost += again
        rows.append(
            {"kill": number + 1, "begun": begun(log), "on disk": on_disk(out), "lost": again}
        )
        if done:
            break
    subprocess.run(call, check=True)
    return rows, out


def main() -> None:
    """Kill, begin again, compare."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--keep", action="store_true")
    given = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        scratch = Path(name)
        write_photos(scratch / "set", PHOTOS, WIDTH)
        rows, out = killed(scratch / "set", scratch)
        whole = scratch / "whole"
        command = [sys.executable, "-m", "veduta.cli.main", "dense", str(scratch / "set")]
        subprocess.run([*command, "-o", str(whole), "-q", "--no-mesh"], check=True)
        maps = sorted((whole / "depth").iterdir())
        same = sum(one.read_bytes() == (out / "depth" / one.name).read_bytes() for one in maps)
    notes = [
        f"{same} of {len(maps)} files of depths are those of a call that nobody killed.",
        f"Load at the end: {os.getloadavg()[0]:.1f}.",
    ]
    keep_or_print("dense-killed", rows, notes, given.keep)


if __name__ == "__main__":
    main()
