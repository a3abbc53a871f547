"""Whether two versions of Veduta write the same bytes: a fixed set of calls of all verbs.

    .venv/bin/python scripts/same_bytes.py BEFORE [AFTER] [--only NAME]... [--keep DIR] [--result]

BEFORE and AFTER are commits or folders of checkouts; AFTER is this checkout where it is not given.
A commit needs no build where its Rust sources are those of this checkout: the extension is taken
from here. Every file of every result is hashed. What may differ between two runs of the same
version is named in `TIMES` and taken out before; all else that differs is told, file by file, and
the exit code is 1. A call that fails in both is told as failed, with exit code 1, too.

`same_bytes.py HEAD HEAD` compares a version with itself: it must find nothing. With --keep DIR the
inputs and the results of BEFORE in DIR are used again where they are there, which saves half of the
time while one works on AFTER; each result is compared in the state that DIR has it in. --result
keeps what came out in `benchmarks/results/same-bytes.md`.
"""

from __future__ import annotations

import argparse
import hashlib
import os
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

from byte_calls import CALLS, ROOT, Call, command
from byte_inputs import write_inputs

EXTENSION = "python/veduta/_core.abi3.so"
RUST = ("crates", "Cargo.toml", "Cargo.lock")
TIMES = {
    "report.json": rb'"seconds": [0-9.e+-]+',
    "report.html": rb'<td class="number">[0-9.]+</td>\s*</tr>'
    rb'|<td class="number">[0-9]+\.[0-9]{3}</td>|<td[^>]*>[0-9.]+ s</td>'
    rb'|(<rect class="bar"[^>]*/>\s*)?<text class="value"[^>]*>[0-9.]+ s</text>',
    ".veduta/run.json": rb'"seconds": [0-9.e+-]+|"[^"]*report\.(json|html)": "[0-9a-f]{64}"',
}
"""What of a file, by the end of its name, tells how long something took, or is a digest of that."""
LOCK = ".veduta/lock"
"""The number of the process that wrote last."""

FAILED = "FAILED"
"""The file of a call that failed, with its exit code and what it said."""

Hashes = dict[str, str]


def main() -> int:
    """Run all calls in both versions and compare."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("before")
    parser.add_argument("after", nargs="?", default=str(ROOT))
    parser.add_argument("--only", action="append", default=[], help="calls whose names begin so")
    parser.add_argument("--keep", type=Path, help="keep inputs and both results in this folder")
    parser.add_argument("--result", action="store_true", help="keep the table")
    asked = parser.parse_args()
    calls = [one for one in CALLS if one.name.startswith(tuple(asked.only) or "")]
    with tempfile.TemporaryDirectory() as scratch:
        kept = Path(scratch) if asked.keep is None else asked.keep
        if not (kept / "inputs").is_dir():
            write_inputs(kept / "inputs")
        if not (kept / "before").is_dir():
            run_all(calls, asked.before, kept, "before")
        shutil.rmtree(kept / "after", ignore_errors=True)
        run_all(calls, asked.after, kept, "after")
        found = [hashes(kept / name, [call.name for call in calls]) for name in ("before", "after")]
    same, told = compared(*found)
    print("\n".join(told))
    print(f"{same} files are the same in both, {len(told)} are not")
    if asked.result:
        keep(asked.before, asked.after, found, told)
    return 1 if told or not same else 0


def keep(before: str, after: str, found: Sequence[Hashes], told: Sequence[str]) -> None:
    """The table of all calls in `benchmarks/results`."""
    sys.path.insert(0, str(ROOT / "benchmarks"))
    from record import record

    rows = [
        {
            "call": call.name,
            "files": sum(name.split("/")[0] == call.name for name in found[1]),
            "differ": sum(line.split("/")[0] == call.name for line in told),
        }
        for call in CALLS
    ]
    notes = [
        f"`scripts/same_bytes.py`: all files of all calls, made by {before} and by {after}, but for"
        " what tells how long something took.",
        *told,
    ]
    record("same-bytes", rows, notes)


@contextmanager
def checkout(version: str) -> Iterator[Path]:
    """The folder of a version: a checkout that is there, or one made of a commit for the time."""
    if Path(version).is_dir():
        yield Path(version).resolve()
        return
    if subprocess.run(["git", "diff", "--quiet", version, "--", *RUST], cwd=ROOT).returncode:
        sys.exit(f"{version} has other Rust sources: build it in a checkout, and name its folder")
    with tempfile.TemporaryDirectory() as scratch:
        tree = Path(scratch) / "tree"
        git = ["git", "worktree"]
        subprocess.run(
            [*git, "add", "--quiet", "--detach", str(tree), version], cwd=ROOT, check=True
        )
        try:
            shutil.copy(ROOT / EXTENSION, tree / EXTENSION)
            yield tree
        finally:
            subprocess.run([*git, "remove", "--force", str(tree)], cwd=ROOT, check=True)


def run_all(calls: Sequence[Call], version: str, kept: Path, name: str) -> None:
    """The results of all calls by a version, in a folder of that name below `kept`.

    What a call that fails says is in a file beside the results.
    """
    with tempfile.TemporaryDirectory() as scratch, checkout(version) as tree:
        # The same folders and relative paths for both: both versions get the very same words.
        work = Path(scratch)
        (work / "inputs").symlink_to((kept / "inputs").resolve())
        (work / "out").mkdir()
        environment = {**os.environ, "PYTHONPATH": str(tree / "python")}
        for call in calls:
            done = subprocess.run(
                [sys.executable, "-P", "-m", "veduta.cli.main", *command(call, "inputs", "out")],
                cwd=work, env=environment, capture_output=True, text=True,
            )  # fmt: skip
            print(f"{name}: {call.name}: exit code {done.returncode}", file=sys.stderr, flush=True)
            if done.returncode:
                told = f"{done.returncode}: {done.stderr.strip()[-300:]}"
                (work / "out" / call.name).mkdir(exist_ok=True)
                (work / "out" / call.name / FAILED).write_text(told, encoding="utf-8")
        shutil.move(work / "out", kept / name)


def hashes(folder: Path, calls: Sequence[str]) -> Hashes:
    """Digests of all files of the results of the calls, by their paths below the folder."""
    found = {}
    for path in sorted(folder.rglob("*")):
        name = path.relative_to(folder).as_posix()
        if path.is_file() and name.split("/")[0] in calls and not name.endswith(LOCK):
            found[name] = path.read_text("utf-8") if path.name == FAILED else hash_of(path)
    return found


def hash_of(path: Path) -> str:
    """The digest of a file without the times in it."""
    content = path.read_bytes()
    for end, pattern in TIMES.items():
        if path.as_posix().endswith(end):
            content = re.sub(pattern, b"", content)
    return hashlib.sha256(content).hexdigest()


def compared(before: Hashes, after: Hashes) -> tuple[int, list[str]]:
    """How many files are the same, and a line for each that is not, or for a call that failed."""
    told = []
    for name in sorted(before.keys() | after.keys()):
        first, second = before.get(name), after.get(name)
        if name.endswith(FAILED):
            told.append(f"{name}: {first or 'did not fail'} | {second or 'did not fail'}")
        elif first is None or second is None:
            told.append(f"{name}: only {'after' if first is None else 'before'}")
        elif first != second:
            told.append(f"{name}: differs")
    return len(before.keys() | after.keys()) - len(told), told


if __name__ == "__main__":
    sys.exit(main())
