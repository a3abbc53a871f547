"""What kill -9 leaves: calls killed at moments all over their run, run again, and compared.

    .venv/bin/python scripts/killed.py [NAME]... [--times 12]

NAME begins the name of a call of `byte_calls.py`; without one, one call of each verb is killed. It
runs to its end first; then it is killed so many times, each in a new folder, at moments spread
evenly over the time that it took, and run again. What lies there then must be what the run that
nobody disturbed has left, but for times (`same_bytes.TIMES`), and nothing else.
"""

from __future__ import annotations

import argparse
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from byte_calls import CALLS, Call, command
from byte_inputs import write_inputs
from same_bytes import compared, hashes

USUAL = (
    "facade-one", "grammar-three", "grammar-tiled", "plan-document", "photos-corner", "carve-ball",
    "dense-wall", "drive-street", "walk-gorge", "fauna-eel", "fauna-film",
)  # fmt: skip


TRIES = 4
"""How often a call is begun that is done before it is killed."""


def main() -> int:
    """Kill and compare; 1 where anything differs."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("names", nargs="*")
    parser.add_argument("--times", type=int, default=12)
    asked = parser.parse_args()
    wanted = tuple(asked.names) or USUAL
    bad = 0
    with tempfile.TemporaryDirectory() as scratch:
        work = Path(scratch)
        write_inputs(work / "inputs")
        for call in (one for one in CALLS if one.name.startswith(wanted)):
            bad += killed(call, work, asked.times)
    return 1 if bad else 0


def killed(call: Call, work: Path, times: int) -> int:
    """How many of the second runs left something else than the undisturbed one."""
    out, kept = work / "out", work / "whole"
    for folder in (out, kept):
        shutil.rmtree(folder, ignore_errors=True)
    started = time.perf_counter()
    if _start(call, work).wait():
        print(f"{call.name}: fails without being disturbed")
        return 1
    seconds = time.perf_counter() - started
    shutil.move(out, kept)
    whole, bad, ended = hashes(kept, [call.name]), 0, 0
    for number in range(times):
        share = (number + 0.5) / times
        for _ in range(TRIES):
            shutil.rmtree(out, ignore_errors=True)
            took = _killed_after(seconds * share, call, work)
            if took is None:
                break
            seconds = min(seconds, took)  # the machine was busier when it was measured
        else:
            ended += 1
        code = _start(call, work).wait()
        _, told = compared(whole, hashes(out, [call.name]))
        if code or told:
            bad += 1
            moment = f"{100 * share:.0f} % of its time"
            print(f"{call.name}, killed at {moment}: exit code {code}; {'; '.join(told[:5])}")
    print(f"{call.name}: {times - ended} of {times} killed, {bad} left something else", flush=True)
    return bad


def _killed_after(seconds: float, call: Call, work: Path) -> float | None:
    """None where the run was killed; how long it took where it was done before."""
    started = time.perf_counter()
    run = _start(call, work)
    try:
        run.wait(timeout=seconds)
    except subprocess.TimeoutExpired:
        os.killpg(run.pid, signal.SIGKILL)
        run.wait()
        return None
    return time.perf_counter() - started


def _start(call: Call, work: Path) -> subprocess.Popen[bytes]:
    (work / "out").mkdir(exist_ok=True)
    words = command(call, "inputs", "out")
    return subprocess.Popen(
        [sys.executable, "-P", "-m", "veduta.cli.main", *words],
        cwd=work, start_new_session=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
    )  # fmt: skip


if __name__ == "__main__":
    sys.exit(main())
