"""kill -9 in the middle of a run, then the same run again."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

from veduta.drive.command import run_drive
from veduta.drive.options import DriveOptions
from veduta.run.progress import Progress
from veduta.synthetic.drives import (
    StreetOptions,
    TruckOptions,
    build_street,
    scan_street,
    write_drive,
)

PATIENCE_S = 120.0


def kept(out: Path) -> dict[str, int]:
    """What a run has kept of its segments, and when."""
    return {
        path.name: path.stat().st_mtime_ns
        for path in out.glob(".veduta/**/layers-*")
        if path.is_dir()
    }


def test_a_run_goes_on_after_kill_nine(tmp_path: Path) -> None:
    street = build_street(StreetOptions(length_m=25.0), 4)
    write_drive(scan_street(street, TruckOptions(), 4), tmp_path / "log")
    call = [sys.executable, "-m", "veduta.cli.main", "drive", str(tmp_path / "log"), "-q", "-o"]
    with subprocess.Popen([*call, str(tmp_path / "out")]) as run:
        end = time.monotonic() + PATIENCE_S
        while not kept(tmp_path / "out") and run.poll() is None and time.monotonic() < end:
            time.sleep(0.005)
        os.kill(run.pid, signal.SIGKILL)
    made = kept(tmp_path / "out")
    assert made
    assert not (tmp_path / "out" / "place.json").exists()
    quiet = Progress(quiet=True)
    assert run_drive(tmp_path / "log", tmp_path / "out", DriveOptions(), quiet).exit_code == 0
    assert run_drive(tmp_path / "log", tmp_path / "whole", DriveOptions(), quiet).exit_code == 0
    for name in ("drive.json", "place.json", "parts/left-001.glb", "raw/left-001.glb"):
        again, whole = ((tmp_path / one / name).read_bytes() for one in ("out", "whole"))
        assert again == whole
