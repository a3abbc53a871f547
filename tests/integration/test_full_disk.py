"""A disk without room: said so, nothing half-written, and the next run goes on.

A limit on the size of files stands in for the full disk: the system refuses to write in the same
way, and a test may set it.
"""

from __future__ import annotations

import resource
import subprocess
from pathlib import Path

import pytest
from command_line import (
    FILES,
    TIMEOUT_S,
    command,
    facade,
    items_done,
    running_facade,
    tree,
    wait_for,
)

SMALL_BYTES = 20_000
"""Less than a result needs, more than the run record does."""


def test_no_room_for_the_first_result(tmp_path: Path, photo: Path, one_house: Path) -> None:
    out = tmp_path / "out"
    done = subprocess.run(
        command("facade", "--rectified", photo, "-o", out),
        capture_output=True,
        text=True,
        timeout=TIMEOUT_S,
        check=False,
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (SMALL_BYTES, SMALL_BYTES)),
    )
    assert done.returncode == 2, done.stderr
    assert done.stderr == (
        f"error: {out}: cannot be written (File too large). Make room there: what is finished is"
        " on disk, and the same command goes on from there.\n"
    )
    assert {file.name for file in out.iterdir()} == {".veduta"}
    assert {file.name for file in (out / ".veduta").iterdir()} == {"run.json", "lock"}
    assert facade(photo, "-o", out).returncode == 0
    assert tree(out) == tree(one_house)


@pytest.mark.slow
def test_no_room_in_the_middle(tmp_path: Path, photos: list[Path], all_houses: Path) -> None:
    out = tmp_path / "out"
    with running_facade(*photos, "-o", out, "--jobs", "2") as run:
        wait_for(lambda: items_done(out))
        _, hard = resource.prlimit(run.pid, resource.RLIMIT_FSIZE)
        resource.prlimit(run.pid, resource.RLIMIT_FSIZE, (0, hard))
        _, error = run.communicate(timeout=TIMEOUT_S)
    assert run.returncode == 2, error
    assert f"error: {out}: cannot be written (File too large). Make room there" in error
    assert "Traceback" not in error

    done = items_done(out)
    assert 1 <= len(done) < len(photos)
    for folder in out.iterdir():
        if folder.name != ".veduta":
            assert {file.name for file in folder.iterdir()} == FILES  # whole, or not there
    again = facade(*photos, "-o", out)
    assert again.returncode == 0, again.stderr
    assert again.stdout.count("(was done)") >= len(done)
    assert tree(out) == tree(all_houses)
