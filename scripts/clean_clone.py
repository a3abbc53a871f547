"""What a stranger's first hour is: a clean clone, `make demo` and `make test` in it, timed.

    .venv/bin/python scripts/clean_clone.py [--only demo] [--at FOLDER] [--no-keep]

The commit that is checked out is cloned into FOLDER (one that goes away again, unless told), and
what `make` says lies there in `demo.log` and `test.log`. Packages come from the caches of the
machine where it has any: the times are with them. The table is `benchmarks/results/clean-clone.md`;
with `--only` the other row stays as it was, with its own commit.
"""

from __future__ import annotations

import argparse
import json
import os
import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "benchmarks"))
from record import RESULTS, ROOT, Value, keep_or_print

NAME = "clean-clone"
STEPS = ("demo", "test")
_STAGE = re.compile(r"^== (.+)\n((?:(?!^== ).*\n)*?)== \1: (\d+) s$", re.MULTILINE)
_PYTEST = re.compile(r"^=* ?((?:\d+ \w+(?:, )?)+) in [\d.]+s", re.MULTILINE)
_VITEST = re.compile(r"^\s*Tests\s+(.+)$", re.MULTILINE)
_CRATE = re.compile(r"^test result: \w+\. (\d+) passed; (\d+) failed; (\d+) ignored", re.MULTILINE)
_COLOURS = re.compile(r"\x1b\[[\d;]*m")


def main() -> int:
    """Clone, make, keep the table; 1 where a step failed."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--only", choices=STEPS)
    parser.add_argument("--at", type=Path)
    parser.add_argument("--no-keep", action="store_true")
    asked = parser.parse_args()
    with tempfile.TemporaryDirectory() as passing:
        folder = asked.at or Path(passing)
        folder.mkdir(parents=True, exist_ok=True)
        clone = folder / "veduta"
        subprocess.run(["git", "clone", "--quiet", "--no-local", ROOT, clone], check=True)
        rows = {step: row_of(step, clone, folder) for step in STEPS if asked.only in (None, step)}
    notes = [
        "A clone without anything built, by `scripts/clean_clone.py`; `test` builds what `demo` has"
        " not. Packages come from the machine's caches where they are there.",
        "Load: what else the machine did, as the mean of the last quarter of an hour at the end.",
    ]
    whole = before() | rows
    keep_or_print(NAME, [whole[step] for step in STEPS if step in whole], notes, not asked.no_keep)
    return 1 if any(row["exit"] for row in rows.values()) else 0


def before() -> dict[str, dict[str, Value]]:
    """The rows of the run before, by step."""
    file = RESULTS / f"{NAME}.json"
    runs = json.loads(file.read_text())["runs"] if file.exists() else [{"rows": []}]
    return {row["make"]: row for row in runs[-1]["rows"]}


def row_of(step: str, clone: Path, logs: Path) -> dict[str, Value]:
    """Run `make STEP` in the clone; its row."""
    log = logs / f"{step}.log"
    begun = time.monotonic()
    with log.open("wb") as out:
        done = subprocess.run(
            ["make", step], cwd=clone, env=_environment(), stdin=subprocess.DEVNULL,
            stdout=out, stderr=subprocess.STDOUT, check=False,
        )  # fmt: skip
    took_s = time.monotonic() - begun
    row: dict[str, Value] = {"make": step, "exit": done.returncode, "minutes": took_s / 60}
    row |= told_in(log.read_text("utf-8", "replace"))
    of = ["git", "rev-parse", "--short=12", "HEAD"]
    commit = subprocess.run(of, cwd=clone, capture_output=True, text=True, check=True)
    return row | {"load": os.getloadavg()[2], "commit": commit.stdout.strip()}


def told_in(log: str) -> dict[str, Value]:
    """What each stage counted and how long it took; nothing of what did not run or end."""
    told: dict[str, Value] = {}
    stages = _STAGE.findall(_COLOURS.sub("", log))
    for name, said, _ in stages:
        counted = [found for pattern in (_PYTEST, _VITEST) for found in pattern.findall(said)]
        crates = [tuple(int(count) for count in found) for found in _CRATE.findall(said)]
        if crates:
            passed, failed, ignored = (sum(column) for column in zip(*crates, strict=True))
            counted = [f"{passed} passed, {failed} failed, {ignored} ignored"]
        if counted:
            told[name] = counted[-1].strip()
    if stages:
        told["stages, s"] = ", ".join(f"{name} {seconds}" for name, _, seconds in stages)
    return told


def _environment() -> dict[str, str]:
    """As a stranger's, but for where the real data lies, which stands beside the checkout."""
    known = {name: value for name, value in os.environ.items() if name != "VIRTUAL_ENV"}
    data = ROOT.parent / "shared" / "data"
    if data.is_dir():
        known.setdefault("VEDUTA_DATA", str(data))
    return known | {"CI": known.get("CI", "true")}


if __name__ == "__main__":
    sys.exit(main())
