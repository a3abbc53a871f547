"""Ctrl-C, SIGTERM and kill -9 in the middle: nothing half-written, and the next run goes on."""

from __future__ import annotations

import json
import signal
import subprocess
import time
from collections.abc import Callable
from pathlib import Path

import pytest
from command_line import FILES, command, facade, is_running, read_json, started_by, tree

DEADLINE_S = 120


def items_done(out: Path) -> list[str]:
    """The names of the finished images, as the run record has them."""
    try:
        record = read_json(out / ".veduta" / "run.json")
    except (FileNotFoundError, json.JSONDecodeError):
        return []
    items = record["items"].items()
    return [name for name, item in items if item["state"] == "done" and name != "."]


def wait_for(condition: Callable[[], object]) -> None:
    end = time.monotonic() + DEADLINE_S
    while not condition():
        assert time.monotonic() < end, "the run did not come that far"
        time.sleep(0.02)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("number", "code"),
    [(signal.SIGINT, 130), (signal.SIGTERM, 143), (signal.SIGKILL, -signal.SIGKILL)],
)
def test_killed_in_the_middle(
    tmp_path: Path, photos: list[Path], number: signal.Signals, code: int
) -> None:
    out = tmp_path / "out"
    run = subprocess.Popen(
        command("facade", "--rectified", *photos, "-o", out, "--jobs", "2"),
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        text=True,
    )
    try:
        wait_for(lambda: items_done(out))
        children = started_by(run.pid)
        assert len(children) >= 2
        run.send_signal(number)
        start = time.monotonic()
        _, error = run.communicate(timeout=DEADLINE_S)
        assert time.monotonic() - start < 20
    finally:
        run.kill()
        run.wait()
    assert run.returncode == code
    assert "Traceback" not in error
    if number != signal.SIGKILL:
        assert "goes on" in error
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
    assert facade(*photos, "-o", tmp_path / "fresh").returncode == 0
    assert tree(out) == tree(tmp_path / "fresh")
    assert {file.name for file in (out / ".veduta").iterdir()} == {"run.json", "lock"}


@pytest.mark.parametrize(("number", "code"), [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
def test_stopped_at_a_single_photo(
    tmp_path: Path, photo: Path, number: signal.Signals, code: int
) -> None:
    """It is worked on without another process: nothing of it is a failed image."""
    out = tmp_path / "out"
    run = subprocess.Popen(
        command("facade", "--rectified", photo, "-o", out),
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        text=True,
    )
    try:
        wait_for(lambda: (out / ".veduta" / "work" / f"item-{photo.stem}").exists())
        time.sleep(0.2)  # the photo is being read by then
        run.send_signal(number)
        _, error = run.communicate(timeout=DEADLINE_S)
    finally:
        run.kill()
        run.wait()
    assert run.returncode == code, error
    assert "the same command goes on" in error
    assert {file.name for file in out.iterdir()} == {".veduta"}
    assert facade(photo, "-o", out).returncode == 0


def test_two_runs_into_one_folder(tmp_path: Path, photos: list[Path]) -> None:
    out = tmp_path / "out"
    first = subprocess.Popen(
        command("facade", "--rectified", *photos, "-o", out),
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    try:
        wait_for(lambda: (out / ".veduta" / "run.json").exists())
        second = facade(*photos, "-o", out)
    finally:
        first.kill()
        first.wait()
    assert second.returncode == 2
    assert f"process {first.pid}" in second.stderr
