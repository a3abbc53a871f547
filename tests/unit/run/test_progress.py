"""Progress: plain lines where nobody watches, a bar on a terminal, silence when asked."""

from __future__ import annotations

import re
import time

import pytest
from rich.progress import TaskProgressColumn

from veduta.run import progress as progress_module
from veduta.run.pool import Task
from veduta.run.progress import Progress
from veduta.run.report import Failure


def work(progress: Progress, names: list[str], pause_s: float = 0.0) -> None:
    with progress.over(len(names)):
        for name in names:
            progress.started(Task(name, None))
            progress.step("read", 0.5)
            time.sleep(pause_s)
            failure = Failure(subject=name, kind="input", reason="x") if name == "b" else None
            progress.finished(name, failure)


def test_lines(capsys: pytest.CaptureFixture[str]) -> None:
    work(Progress(), ["a", "b"])
    assert capsys.readouterr().err == "[1/2] a: done\n[2/2] b: failed\n"


def test_a_long_item_says_where_it_is(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(progress_module, "LINE_EVERY_S", 0.0)
    work(Progress(), ["a"])
    assert capsys.readouterr().err == "a: read 50%\n"
    work(Progress(quiet=True), ["a"])
    assert capsys.readouterr().err == ""


def test_quiet(capsys: pytest.CaptureFixture[str]) -> None:
    work(Progress(quiet=True), ["a", "b"])
    assert capsys.readouterr() == ("", "")


def test_bar(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("FORCE_COLOR", "1")
    monkeypatch.setenv("TERM", "xterm")
    work(Progress(), ["a", "[red]b"], pause_s=0.3)
    shown = capsys.readouterr().err
    assert "2/2" in shown
    assert "[red]b" in shown  # a file's name is no markup


def test_the_bar_of_one_item_moves_with_its_steps(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("FORCE_COLOR", "1")
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.setattr("rich.progress.BarColumn", lambda _: TaskProgressColumn())
    progress = Progress()
    with progress.over(1, steps=4):
        progress.started(Task("a", None))
        for step, fraction in (("read", 0.0), ("read", 0.5), ("build", 0.0), ("write", 0.0)):
            progress.step(step, fraction)
            time.sleep(0.25)
        progress.finished("a", None)
    shown = re.sub(r"\x1b\[[0-9;?]*[A-Za-z]", "", capsys.readouterr().err)
    assert [share for share in ("0%", "12%", "25%", "50%") if share not in shown] == []
    assert "0/1" not in shown
