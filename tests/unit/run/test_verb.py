"""One run of a verb: what is made, kept, resumed, refused and told."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import numpy as np
import pytest

from veduta.cli.told import tell_result
from veduta.run.errors import InputError, NotFoundError
from veduta.run.options import Options
from veduta.run.progress import Progress
from veduta.run.verb import VerbCall, VerbResult, run_verb
from veduta.run.work import Work


class _Options(Options):
    level: int = 1


def _call(level: int = 1) -> VerbCall:
    return VerbCall("carve", "1", "dino", _Options(level=level), ["digest"])


def _run(out: Path, make: object, level: int = 1, *, force: bool = False) -> VerbResult:
    return run_verb(_call(level), out, make, Progress(quiet=True), force=force)  # type: ignore[arg-type]


def _carve(work: Work) -> None:
    with work.step("silhouettes") as step:
        step.counts["frames"] = 3
        step.rejected.append("b.png: empty")
    (work.folder / "model.glb").write_bytes(b"model")
    work.measure("volume_m3", 1.5)
    work.doubt("the scale is a guess")
    work.note("one view was left out")
    work.picture("Silhouettes", "of each frame", np.zeros((4, 4, 3), np.uint8))
    work.file("model.glb", "the object")
    work.summary = "An object of 1.5 m3."


def test_a_run_leaves_its_files_and_a_report(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    result = _run(tmp_path / "out", _carve)
    assert result.exit_code == 0
    assert result.measures == {"volume_m3": 1.5}
    assert (tmp_path / "out/model.glb").read_bytes() == b"model"
    report = json.loads((tmp_path / "out/report.json").read_text())
    assert report["state"] == "done"
    assert report["steps"][0]["counts"] == {"frames": 3}
    assert report["notes"] == ["the scale is a guess", "one view was left out"]
    page = (tmp_path / "out/report.html").read_text()
    assert "data:image/jpeg" in page
    assert "An object of 1.5 m3." in page
    assert tell_result(result) == 0
    said = capsys.readouterr().out
    assert "An object of 1.5 m3." in said
    assert "warning: the scale is a guess" in said


def test_the_same_call_is_up_to_date_and_another_is_refused(tmp_path: Path) -> None:
    out = tmp_path / "out"
    _run(out, _carve)

    def never(work: Work) -> None:
        raise RuntimeError("it was made again")

    again = _run(out, never)
    assert again.up_to_date
    assert again.doubts == ["the scale is a guess"]
    assert again.summary == "An object of 1.5 m3."
    with pytest.raises(InputError, match="other inputs or options"):
        _run(out, never, level=2)
    assert not _run(out, _carve, level=2, force=True).up_to_date


def test_what_is_not_found_is_a_failure_with_a_report(tmp_path: Path) -> None:
    out = tmp_path / "out"

    def fails(work: Work) -> None:
        (work.folder / "half.glb").write_bytes(b"half")
        raise NotFoundError("the silhouettes", "all are empty", "Give masks.")

    result = _run(out, fails)
    assert result.exit_code == 3
    assert not (out / "half.glb").exists()
    report = json.loads((out / "report.json").read_text())
    assert report["state"] == "failed"
    reason = report["failures"][0]["reason"]
    assert reason == "the silhouettes not found: all are empty. Give masks."
    assert "all are empty" in (out / "report.html").read_text()


def test_a_killed_run_goes_on_from_what_was_kept(tmp_path: Path) -> None:
    out = tmp_path / "out"
    made: list[str] = []

    def step(work: Work, name: str, value: int) -> np.ndarray:
        def make() -> dict[str, np.ndarray]:
            made.append(name)
            return {"values": np.full(3, value)}

        return work.kept_arrays(name, [name, value], make)["values"]

    def killed(work: Work) -> None:
        step(work, "first", 1)
        raise KeyboardInterrupt

    def whole(work: Work) -> None:
        total = step(work, "first", 1) + step(work, "second", 2)
        work.measure("total", int(total.sum()))

    with pytest.raises(KeyboardInterrupt):
        _run(out, killed)
    result = _run(out, whole)
    assert made == ["first", "second"]
    assert result.measures == {"total": 9}
    assert not (out / ".veduta/carve").exists()


def test_who_is_killed_while_tidying_up_leaves_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    out = tmp_path / "out"
    whole = shutil.rmtree

    def half(path: Path, ignore_errors: bool = False) -> None:
        if list(Path(path).glob("one-*")):  # what was kept
            (next(Path(path).glob("one-*")) / "text").unlink()
            raise KeyboardInterrupt
        whole(path, ignore_errors=ignore_errors)

    def make(work: Work) -> None:
        work.kept("one", [1], lambda: "some", _write_text, _read_text)

    monkeypatch.setattr(shutil, "rmtree", half)
    with pytest.raises(KeyboardInterrupt):
        _run(out, make)
    monkeypatch.undo()
    assert _run(out, make, force=True).exit_code == 0  # no half is taken for a whole
    assert _run(out, make).up_to_date
    assert sorted(path.name for path in (out / ".veduta").iterdir()) == ["lock", "run.json"]


def test_stages_of_a_finished_run_are_dropped_by_the_next(tmp_path: Path) -> None:
    out = tmp_path / "out"
    _run(out, lambda work: None)
    (out / ".veduta/carve/one-0123").mkdir(parents=True)
    assert _run(out, lambda work: None).up_to_date
    assert not (out / ".veduta/carve").exists()


def test_what_was_kept_is_read_again_and_missed_where_it_is_gone(tmp_path: Path) -> None:
    def reads_again(work: Work) -> None:
        made = work.kept("one", [1], lambda: "some", _write_text, _read_text)
        assert work.kept_again("one", [1], _read_text) == made
        shutil.rmtree(work.stages)
        work.kept_again("one", [1], _read_text)

    with pytest.raises(InputError) as told:
        _run(tmp_path / "out", reads_again)
    assert "has lost one while it was in use" in str(told.value)
    assert "call again" in str(told.value)


def _write_text(text: str, folder: Path) -> None:
    (folder / "text").write_text(text)


def _read_text(folder: Path) -> str:
    return (folder / "text").read_text()


def test_an_edited_file_is_left_and_named(tmp_path: Path) -> None:
    out = tmp_path / "out"
    _run(out, _carve)
    (out / "model.glb").write_bytes(b"mine")
    result = _run(out, _carve, force=True)
    assert (out / "model.glb").read_bytes() == b"mine"
    assert result.edited == ["model.glb"]
