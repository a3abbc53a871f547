"""What `scripts/clean_clone.py` reads in what `make` says."""

from __future__ import annotations

import importlib.util
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
LOG = """
== cargo test
test result: ok. 12 passed; 0 failed; 1 ignored; 0 measured; 0 filtered out; finished in 0.03s
test result: FAILED. 5 passed; 2 failed; 0 ignored; 0 measured; 0 filtered out
== cargo test: 31 s

== pytest
2 slow in 1 house
\x1b[32m6554 passed, 3 skipped, 2 errors in 1400.31s (0:23:20)\x1b[0m
== pytest: 1402 s

== vitest
      Tests  450 passed | 6 skipped (456)
== vitest: 20 s

== browser tests
      Tests  130 passed (130)
== browser tests: FAILED (1)
"""


@pytest.fixture(scope="module")
def told() -> dict[str, object]:
    spec = importlib.util.spec_from_file_location("clean_clone", ROOT / "scripts/clean_clone.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    before = list(sys.path)
    spec.loader.exec_module(module)
    sys.path[:] = before
    return module.told_in(LOG)


def test_counts_stand_by_their_stage(told: dict[str, object]) -> None:
    assert told["cargo test"] == "17 passed, 2 failed, 1 ignored"
    assert told["pytest"] == "6554 passed, 3 skipped, 2 errors"
    assert told["vitest"] == "450 passed | 6 skipped (456)"


def test_a_stage_that_did_not_end_has_no_time_and_no_count(told: dict[str, object]) -> None:
    assert "browser tests" not in told
    assert told["stages, s"] == "cargo test 31, pytest 1402, vitest 20"
