"""Ctrl-C, SIGTERM and kill -9: nothing half-written, and the next run goes on."""

from __future__ import annotations

import signal
import time
from pathlib import Path

import pytest
from command_line import (
    DEADLINE_S,
    FILES,
    facade,
    is_running,
    items_done,
    read_json,
    running_facade,
    started_by,
    tree,
    wait_for,
)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("number", "code"),
    [(signal.SIGINT, 130), (signal.SIGKILL, -signal.SIGKILL)],
)
def test_killed_in_the_middle(
    tmp_path: Path, photos: list[Path], all_houses: Path, number: signal.Signals, code: int
) -> None:
    out = tmp_path / "out"
    with running_facade(*photos, "-o", out, "--jobs", "2") as run:
        wait_for(lambda: items_done(out))
        children = started_by(run.pid)
        assert len(children) >= 2
        run.send_signal(number)
        start = time.monotonic()
        _, error = run.communicate(timeout=DEADLINE_S)
        assert time.monotonic() - start < 20
    assert run.returncode == code
    assert "Traceback" not in error
    if number != signal.SIGKILL:
        assert "the same command does the rest" in error
    wait_for(lambda: not any(is_running(child) for child in children))

    done = items_done(out)
    assert 1 <= len(done) < len(photos)
    for folder in out.iterdir():
        if folder.name != ".veduta":
            assert {file.name for file in folder.iterdir()} == FILES  # whole, or not there
    stamps = {name: (out / name / "model.glb").stat().st_mtime_ns for name in done}

    again = facade(*photos, "-o", out)
    assert again.returncode == 0, again.stderr
    assert again.stdout.count("(was done)") >= len(done)
    for name, stamp in stamps.items():
        assert (out / name / "model.glb").stat().st_mtime_ns == stamp
    assert tree(out) == tree(all_houses)
    assert {file.name for file in (out / ".veduta").iterdir()} == {"run.json", "lock"}


@pytest.mark.parametrize(("number", "code"), [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
def test_stopped_at_a_single_photo(
    tmp_path: Path, photo: Path, number: signal.Signals, code: int
) -> None:
    """It is worked on without another process: nothing of it is a failed image."""
    out = tmp_path / "out"
    with running_facade(photo, "-o", out) as run:
        wait_for(lambda: (out / ".veduta" / "work" / f"item-{photo.stem}").exists())
        time.sleep(0.2)  # the photo is being read by then
        run.send_signal(number)
        _, error = run.communicate(timeout=DEADLINE_S)
    assert run.returncode == code, error
    assert "the same command does the rest" in error
    assert {file.name for file in out.iterdir()} == {".veduta"}
    assert facade(photo, "-o", out).returncode == 0
    # A rebuild knows by them what else belongs to the place.
    assert read_json(out / ".veduta" / "run.json")["inputs"] == [photo.stem]


def test_two_runs_into_one_folder(tmp_path: Path, photos: list[Path]) -> None:
    out = tmp_path / "out"
    with running_facade(*photos, "-o", out) as first:
        wait_for(lambda: (out / ".veduta" / "run.json").exists())
        second = facade(*photos, "-o", out)
    assert second.returncode == 2
    assert f"process {first.pid}" in second.stderr
