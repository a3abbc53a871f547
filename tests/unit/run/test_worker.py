"""Workers of a script: it is not run again, and they do not outlive it."""

from __future__ import annotations

import os
import subprocess
import sys
import time
from pathlib import Path

import pytest

from veduta.run.worker import Worker

SCRIPT = """
import time
from veduta.run.worker import Worker
print("once", flush=True)
worker = Worker(time.sleep, threads=1)
worker.send(0.0)
assert worker.receive().done
worker.send(60.0)
print(worker.process.pid, flush=True)
time.sleep(60)
"""


def test_a_worker_ends_with_its_script_which_runs_once(tmp_path: Path) -> None:
    path = tmp_path / "script.py"
    path.write_text(SCRIPT)
    (tmp_path / "traceback.py").write_text("raise RuntimeError('not the standard module')")
    with subprocess.Popen(
        [sys.executable, "-P", path], cwd=tmp_path, stdout=subprocess.PIPE, text=True
    ) as script:
        assert script.stdout is not None
        assert script.stdout.readline() == "once\n"
        worker = script.stdout.readline().strip()
        script.kill()
        assert script.stdout.read() == ""
    deadline = time.monotonic() + 30.0
    while _runs(worker) and time.monotonic() < deadline:
        time.sleep(0.05)
    assert not _runs(worker)


def test_a_worker_says_nothing_if_nobody_waits_for_its_answer(
    capfd: pytest.CaptureFixture[str],
) -> None:
    """Who gave it the work was killed: that is seen as its pipe breaks, or by its other one."""
    worker = Worker(time.sleep, threads=1)
    worker.send(0.5)
    worker.pipe.close()
    assert worker.process.wait(timeout=30) == 0
    assert capfd.readouterr().err == ""
    os.close(worker._life)


def _runs(process: str) -> bool:
    """Whether a process is there, and is not one that ended but was not asked how."""
    status = Path("/proc", process, "stat")
    try:
        return status.read_text().rsplit(")", 1)[1].split()[0] != "Z"
    except (FileNotFoundError, ProcessLookupError):
        return False
