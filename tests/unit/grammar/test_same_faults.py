"""A fault of the rules that all lots meet is told once: in the report, its page, the terminal."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from rows_of_houses import write_row

from veduta.cli.main import main
from veduta.grammar.same_faults import told_once
from veduta.run.report import Failure, FailureKind

RULES = """
attr n = 1
Lot --> case n > 3 : s(1, "wide", 1) else : extrude(3) X.
"""


def failure(subject: str, reason: str, kind: FailureKind = "input") -> Failure:
    return Failure(subject=subject, kind=kind, reason=reason)


def test_failures_with_one_reason_are_one() -> None:
    lots = [failure(f"a: b.json: house {n}", "no area") for n in range(5)]
    other = failure("a: b.json: barn", "too large")
    found = told_once([lots[0], other, *lots[1:]])
    assert [(one.subject, one.reason) for one in found] == [
        ("a: b.json: 5 lots (house 0, house 1, house 2, ...)", "no area"),
        ("a: b.json: barn", "too large"),
    ]
    assert [one.subject for one in told_once(lots[:2])] == ["a: b.json: 2 lots (house 0, house 1)"]
    assert told_once([other]) == [other]
    assert told_once([]) == []


def test_bugs_are_all_told() -> None:
    bugs = [failure(f"blocks/0{n}", "a bug in veduta", "bug") for n in range(3)]
    assert told_once(bugs) == bugs


def test_a_fault_of_the_rules_is_told_once(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("signal.signal", lambda *_: None)
    rules, lots, out = (tmp_path / name for name in ("a.cga", "lots.geojson", "out"))
    rules.write_text(RULES)
    write_row(lots, 5)
    call = ["grammar", "derive", rules, "--lots", lots, "-o", out, "--attr", "n=9", "--jobs", "1"]
    assert main([str(word) for word in call]) == 2
    (told,) = [line for line in capsys.readouterr().err.splitlines() if "error" in line]
    subject = f"{lots}: 5 lots (house-0, house-1, house-2, ...)"
    assert told.startswith(f"error: {subject}: a.cga:3:")
    report = json.loads((out / "report.json").read_text())
    assert [one["subject"] for one in report["failures"]] == [subject]
    assert report["measures"]["lots"] == 5
    page = (out / "report.html").read_text()
    assert page.count("house-1") == 1
