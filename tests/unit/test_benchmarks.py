"""Benchmarks are listed and run by their names."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[2]


def run(*call: str) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, str(ROOT / "benchmarks"), *call]
    return subprocess.run(command, capture_output=True, text=True, check=False)


def test_each_program_is_listed_with_what_it_measures() -> None:
    listed = run()
    assert listed.returncode == 0
    rows = [line.split(maxsplit=1) for line in listed.stdout.splitlines()]
    assert all(len(row) == 2 and row[1][-1] in ".?" for row in rows), rows
    names = [row[0] for row in rows]
    assert {"dense/linking", "facade/facade", "plan/plan", "photos/photos"} <= set(names)
    assert not any(name.startswith("measuring/") for name in names)
    assert {name for name in names if "/" not in name} <= {"gpu"}


def test_a_program_has_its_own_options_and_what_it_shares() -> None:
    """`grammar/grammar_lots` takes options, and `record` from above its folder."""
    told = run("grammar/grammar_lots", "--help")
    assert told.returncode == 0
    assert "--read" in told.stdout


def test_another_name_is_refused() -> None:
    told = run("dense/nothing")
    assert told.returncode == 2
    assert "there is no benchmark dense/nothing" in told.stderr
