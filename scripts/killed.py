"""What kill -9 leaves: calls killed at moments all over their run, run again, and compared.

    .venv/bin/python scripts/killed.py [NAME]... [--times 12] [--kept FILE [--minutes 4]]

NAME begins the name of a call of `byte_calls.py`; without one, one call of each verb is killed. It
runs to its end first; then it is killed so many times, each in a new folder, at moments spread
evenly over the time that it took, and run again. What lies there then must be what the run that
nobody disturbed has left, but for times (`same_bytes.TIMES`), and nothing else. With `--kept` what
was tried is kept in a JSON file after each kill: a call that is stopped, or has used its
`--minutes`, goes on from there, and writes `benchmarks/results/killed.md` when nothing is left.
"""

from __future__ import annotations

import argparse
import json
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

from byte_calls import CALLS, ROOT, Call, command
from byte_inputs import write_inputs
from same_bytes import compared, hashes

sys.path.insert(0, str(ROOT / "benchmarks"))
from record import Value, record
from record import commit as commit_now

USUAL = (
    "facade-one", "grammar-three", "grammar-tiled", "plan-document", "photos-corner", "carve-ball",
    "dense-wall", "drive-street", "walk-gorge", "fauna-eel", "fauna-film",
)  # fmt: skip


TRIES = 4
"""How often a call is begun that is done before it is killed."""
COMMIT = "commit"
"""Beside the kills of a call: what it was tried on."""
FAILS = "fails"
"""A call that ends badly without being killed."""


@dataclass
class Tried:
    """What came of each kill, by the call's name and the kill's number: `killed`, `done` or `bad`.

    file: where it is kept, if anywhere. until: no kill begins later (`time.monotonic`, s).
    """

    file: Path | None
    until: float
    known: dict[str, dict[str, str]]

    @classmethod
    def of(cls, file: Path | None, minutes: float | None) -> Tried:
        """With what was kept; minutes: for how long kills begin, where that is bounded."""
        known = json.loads(file.read_text()) if file is not None and file.exists() else {}
        known = {
            name: {number: word for number, word in rows.items() if word != FAILS}
            for name, rows in known.items()
        }
        until = float("inf") if minutes is None else time.monotonic() + 60 * minutes
        return cls(file, until, known)

    def left(self, call: Call, times: int) -> list[int]:
        """The numbers of the kills that have not been tried."""
        return [
            number for number in range(times) if str(number) not in self.known.get(call.name, {})
        ]

    def add(self, call: Call, number: int, word: str) -> None:
        """Keep what came of one."""
        self.known.setdefault(call.name, {}).update(
            {str(number): word, COMMIT: str(commit_now()["commit"])}
        )
        if self.file is not None:
            self.file.write_text(json.dumps(self.known, indent=1))

    def count(self, call: Call, word: str) -> int:
        """How often that came of it."""
        return sum(one == word for one in self.known.get(call.name, {}).values())

    @property
    def is_late(self) -> bool:
        """Whether the time is used."""
        return time.monotonic() > self.until


def main() -> int:
    """Kill and compare; 1 where anything differs, 2 where the time did not suffice."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("names", nargs="*")
    parser.add_argument("--times", type=int, default=12)
    parser.add_argument("--kept", type=Path, help="JSON of what was tried, to go on from")
    parser.add_argument("--minutes", type=float, help="no kill begins later")
    asked = parser.parse_args()
    wanted = tuple(asked.names) or USUAL
    calls = [one for one in CALLS if one.name.startswith(wanted)]
    tried = Tried.of(asked.kept, asked.minutes)
    with tempfile.TemporaryDirectory() as scratch:
        work = Path(scratch)
        write_inputs(work / "inputs")
        for call in calls:
            if tried.left(call, asked.times) and not tried.is_late:
                killed(call, work, asked.times, tried)
    if any(tried.count(call, FAILS) for call in calls):
        return 1
    if any(tried.left(call, asked.times) for call in calls):
        return 2
    if asked.kept is not None:
        _keep(calls, tried, asked.times)
    return 1 if any(tried.count(call, "bad") for call in calls) else 0


def killed(call: Call, work: Path, times: int, tried: Tried) -> None:
    """Kill it at the moments that are left, run it again each time, and keep what came of it."""
    out, kept = work / "out", work / "whole"
    for folder in (out, kept):
        shutil.rmtree(folder, ignore_errors=True)
    started = time.perf_counter()
    if _start(call, work).wait():
        print(f"{call.name}: fails without being disturbed")
        tried.known.setdefault(call.name, {})["whole"] = FAILS  # not kept: it is to be mended
        return
    seconds = time.perf_counter() - started
    shutil.move(out, kept)
    whole = hashes(kept, [call.name])
    for number in tried.left(call, times):
        if tried.is_late:
            return
        share, word = (number + 0.5) / times, "killed"
        for _ in range(TRIES):
            shutil.rmtree(out, ignore_errors=True)
            took = _killed_after(seconds * share, call, work)
            if took is None:
                break
            seconds = min(seconds, took)  # the machine was busier when it was measured
        else:
            word = "done"
        code = _start(call, work).wait()
        _, told = compared(whole, hashes(out, [call.name]))
        if code or told:
            word = "bad"
            moment = f"{100 * share:.0f} % of its time"
            print(f"{call.name}, killed at {moment}: exit code {code}; {'; '.join(told[:5])}")
        tried.add(call, number, word)
    bad, ended = tried.count(call, "bad"), tried.count(call, "done")
    print(f"{call.name}: {times - ended} of {times} killed, {bad} left something else", flush=True)


def _keep(calls: list[Call], tried: Tried, times: int) -> None:
    rows: list[dict[str, Value]] = [
        {
            "call": call.name,
            "killed": times - tried.count(call, "done"),
            "of": times,
            "left something else": tried.count(call, "bad"),
            "commit": tried.known.get(call.name, {}).get(COMMIT, ""),
        }
        for call in calls
    ]
    record(
        "killed",
        rows,
        (
            "Calls of `scripts/byte_calls.py`, killed by SIGKILL at moments spread over their run,"
            " and run again: what lies there then against a run that nobody disturbed"
            " (`scripts/killed.py`).",
            "Where fewer were killed than tried, runs were done before their moment came.",
        ),
    )


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
