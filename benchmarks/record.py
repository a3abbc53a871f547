"""Keeping what a benchmark measured: when, where, on which commit.

`record("rectify", rows, notes)` writes `benchmarks/results/rectify.json` (all runs, newest last;
a run of the same commit and machine replaces the one before) and `rectify.md` (the newest run as
a table), and prints the table.
"""

from __future__ import annotations

import json
import os
import platform
import subprocess
from collections.abc import Mapping, Sequence
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

RESULTS = Path(__file__).parent / "results"
ROOT = Path(__file__).parent.parent

Value = str | int | float | bool | None
Row = Mapping[str, Value]


def record(name: str, rows: Sequence[Row], notes: Sequence[str] = ()) -> Path:
    """Write and print one run; rows may have different keys. Returns the markdown file."""
    RESULTS.mkdir(exist_ok=True)
    run = _run(rows, notes)
    history = RESULTS / f"{name}.json"
    runs = json.loads(history.read_text())["runs"] if history.exists() else []
    same = ("cpu", "commit", "changed")
    if runs and all(runs[-1].get(key) == run[key] for key in same):
        runs.pop()
    runs.append(run)
    history.write_text(json.dumps({"benchmark": name, "runs": runs}, indent=1) + "\n")
    table = markdown(name, run)
    path = RESULTS / f"{name}.md"
    path.write_text(table)
    print(table)
    return path


def keep_or_print(name: str, rows: Sequence[Row], notes: Sequence[str], keep: bool) -> None:
    """Record a run, or only print it: one over a part of the data is not for the history."""
    if keep:
        record(name, rows, notes)
    else:
        print(markdown(name, _run(rows, notes)))


def _run(rows: Sequence[Row], notes: Sequence[str]) -> dict[str, Any]:
    return {
        "date": datetime.now(UTC).strftime("%Y-%m-%d %H:%M UTC"),
        **machine(),
        **commit(),
        "rows": [{key: _rounded(value) for key, value in row.items()} for row in rows],
        "notes": list(notes),
    }


def machine() -> dict[str, Value]:
    """The processor's name and how many cores this process may use."""
    cpu = platform.processor() or platform.machine()
    info = Path("/proc/cpuinfo")
    if info.exists():
        names = [line for line in info.read_text().splitlines() if line.startswith("model name")]
        cpu = names[0].split(":", 1)[1].strip() if names else cpu
    return {"cpu": cpu, "cores": len(os.sched_getaffinity(0)), "python": platform.python_version()}


def commit() -> dict[str, Value]:
    """The checked-out commit, and whether the package's own sources differ from it."""
    hash_ = _git("rev-parse", "--short=12", "HEAD")
    changed = _git("status", "--porcelain", "--", "python", "crates", "benchmarks/*.py")
    return {"commit": hash_ or "unknown", "changed": bool(changed)}


def markdown(name: str, run: Mapping[str, object]) -> str:
    """The run as a markdown page."""
    rows = run["rows"]
    notes = run["notes"]
    if not isinstance(rows, list) or not isinstance(notes, list):
        raise TypeError("rows and notes of a run are lists")
    columns = list(dict.fromkeys(key for row in rows for key in row))
    suffix = " with changes" if run["changed"] else ""
    lines = [
        f"# {name}",
        "",
        f"{run['date']}, {run['cpu']}, {run['cores']} cores, commit {run['commit']}{suffix}",
        "",
        "| " + " | ".join(columns) + " |",
        "|" + "---|" * len(columns),
    ]
    for row in rows:
        cells = ("" if row.get(column) is None else str(row[column]) for column in columns)
        lines.append("| " + " | ".join(cells) + " |")
    lines += [""] + [f"- {note}" for note in notes]
    return "\n".join(lines).rstrip() + "\n"


def _rounded(value: Value) -> Value:
    return float(f"{value:.4g}") if isinstance(value, float) else value


def _git(*arguments: str) -> str:
    done = subprocess.run(
        ["git", *arguments], cwd=ROOT, capture_output=True, text=True, check=False
    )
    return done.stdout.strip()
