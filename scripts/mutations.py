"""What each reader does with files that have faults: results, refusals, tracebacks, memory.

    .venv/bin/python scripts/mutations.py [--cases 5000] [--only NAME]... [--keep FOLDER] [--table]

Each kind of file (`tests/unit/formats/faulty_inputs.py`) is read in a process of its own, so that
its memory is its own; that of the process with limits, where one reads, is told beside it. A case
is made from its number alone. With --keep what is done lies in FOLDER, and another call goes on;
--table makes the table of what lies there already.
"""

from __future__ import annotations

import argparse
import json
import multiprocessing
import resource
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).parents[1]
_TESTS = [f"tests/unit{name}" for name in ("", "/formats", "/cameras")]
sys.path[:0] = [str(ROOT / name) for name in ("benchmarks", *_TESTS)]
MOST_MB = 500


def main() -> int:
    """Measure and keep the table; 1 where a reader failed."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--cases", type=int, default=5000)
    parser.add_argument("--only", action="append", default=[])
    parser.add_argument("--keep", type=Path)
    parser.add_argument("--table", action="store_true")
    asked = parser.parse_args()
    from faulty_inputs import CLASSES

    kept = asked.keep or Path(tempfile.mkdtemp())
    kept.mkdir(parents=True, exist_ok=True)
    files = {kind: kept / f"{kind}-{asked.cases}.json" for kind in CLASSES}
    for kind in () if asked.table else asked.only or CLASSES:
        if not files[kind].exists():
            _measured_apart(kind, asked.cases, files[kind])
        if files[kind].exists():
            print(files[kind].read_text(), flush=True)
    if asked.only:
        return 0
    done = {kind: sorted(kept.glob(f"{kind}-*.json"), key=_files_of) for kind in CLASSES}
    rows = [json.loads(paths[-1].read_text()) for paths in done.values() if paths]
    missing = [kind for kind, paths in done.items() if not paths]
    bad = [
        row for row in rows if row["tracebacks"] or max(row["MB"], row["MB of limits"]) > MOST_MB
    ]
    notes = [
        "Each file has one to four faults: bits turned, bytes cut out, said twice or drawn anew,"
        " brackets and quotes, numbers that are none.",
        f"MB: by how much the process grew beyond reading the sound file; {MOST_MB} are the most."
        " MB of limits: the same of the process with limits, where one reads.",
    ]
    notes += [f"Not run this time: {', '.join(missing)}."] if missing else []
    from record import record

    record("mutations", rows, notes)
    return 1 if bad else 0


def _files_of(path: Path) -> int:
    return int(path.stem.rpartition("-")[2])


def _measured_apart(kind: str, cases: int, path: Path) -> None:
    process = multiprocessing.get_context("spawn").Process(target=measure, args=(kind, cases, path))
    process.start()
    process.join()
    if process.exitcode:  # it has crashed: that is what is measured
        row = {"kind": kind, "files": cases, "tracebacks": process.exitcode, "MB": 0.0}
        path.write_text(json.dumps(row | {"MB of limits": 0.0}))


def measure(kind: str, cases: int, path: Path) -> None:
    """Read so many files of a kind, if there is a sound one; the row goes to `path`."""
    from faulty_inputs import CLASSES, mutated
    from record import commit

    from veduta.run import limits
    from veduta.run.errors import InputError, NotFoundError

    write, read = CLASSES[kind]
    with tempfile.TemporaryDirectory() as folder:
        try:
            file = write(Path(folder))
        except FileNotFoundError as error:  # its sound files are real data
            print(f"{kind} is left out: {error}", file=sys.stderr)
            return
        sound = file.read_bytes()
        read(file)
        before, beside = _peak_mb(None), _reader_mb(limits)
        most_beside = beside
        fine = refused = failed = 0
        told: list[str] = []
        begun_at = commit()["commit"]  # not where the checkout is by the end
        started = time.perf_counter()
        for number in range(cases):
            file.write_bytes(mutated(sound, number))
            try:
                read(file)
                fine += 1
            except (InputError, NotFoundError):
                refused += 1
            except Exception as error:  # noqa: BLE001  what is counted
                failed += 1
                told.append(f"{number}: {error!r}"[:200])
            if number % 50 == 0:
                most_beside = max(most_beside, _reader_mb(limits))
        row = {
            "kind": kind, "commit": begun_at, "files": cases,
            "read": fine, "refused": refused, "tracebacks": failed,
            "MB": round(_peak_mb(None) - before, 1),
            "MB of limits": round(max(most_beside, _reader_mb(limits)) - beside, 1),
            "ms a file": round(1000.0 * (time.perf_counter() - started) / cases, 2),
        }  # fmt: skip
    if told:
        print("\n".join(told[:5]), file=sys.stderr)
    path.write_text(json.dumps(row))


def _peak_mb(process: int | None) -> float:
    if process is None:
        return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0
    try:
        for line in Path(f"/proc/{process}/status").read_text("ascii").splitlines():
            if line.startswith("VmHWM:"):
                return int(line.split()[1]) / 1024.0
    except OSError:  # it has just ended
        pass
    return 0.0


def _reader_mb(limits: object) -> float:
    """The peak of the process that reads under limits; 0 where there is none."""
    workers = getattr(limits, "_kept", {}).values()
    return max((_peak_mb(one.process.pid) for one in workers), default=0.0)


if __name__ == "__main__":
    sys.exit(main())
