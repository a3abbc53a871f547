"""The demo of a walk: what it makes, and that it says how far the truth is."""

from __future__ import annotations

from pathlib import Path

import pytest

from veduta.cli.demo import run
from veduta.run.progress import Progress
from veduta.synthetic.walks.record import GorgeWalk
from veduta.walk import demo
from veduta.walk.demo import WalkDemo, run_walk_demo

SMALL = GorgeWalk(keys=2, step_m=2.0, width_px=256, height_px=160)


def _made(out: Path) -> WalkDemo:
    return run_walk_demo(out, 1, Progress(quiet=True), force=False, gorge=SMALL)


def test_a_gorge_is_made_walked_and_compared(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    done = _made(tmp_path)
    (way,) = done.transitions
    assert (way.names, way.how) == ("000 to 001", "morph")
    assert way.found_m == pytest.approx(way.true_m, rel=0.03)
    assert way.true_m == pytest.approx(2.0, rel=0.1)
    assert (tmp_path / "stereo" / "left" / "001.png").is_file()
    assert (tmp_path / "walk" / "place.json").is_file()
    picture = (tmp_path / "stereo" / "left" / "000.png").stat().st_mtime_ns
    again = _made(tmp_path)
    assert again.call.up_to_date
    assert again.transitions == done.transitions
    assert (tmp_path / "stereo" / "left" / "000.png").stat().st_mtime_ns == picture
    monkeypatch.setattr(demo, "GORGE", SMALL)
    assert run(["--walk", "--seed", "1", "-o", str(tmp_path)]) == 0
    printed = capsys.readouterr().out
    assert f"000 to 001    morph   {way.found_m:>8.3f} m found, {way.true_m:.3f} m true" in printed
    assert f"view {tmp_path}/walk" in printed
