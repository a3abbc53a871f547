"""What verbs do where nobody reads what they say, or where there is no room for what they write.

    .venv/bin/python scripts/no_room.py [NAME]... [--kept FILE]

NAME begins the name of a call of `byte_calls.py`; without one, one call of each verb is tried. Each
writes into a pipe whose reader has gone, as in `veduta ... | head -1`; tells the same result to
`/dev/full`; shows its help to both; and writes into another folder where no file may grow beyond
`SMALL_BYTES`, as on a full disk, and once more where it may. Nothing of it is a bug: the exit code
is the usual one, or 2 with one line that says what cannot be written, and in the end there lies the
same as in the first folder. `--kept` keeps what was tried in a JSON file, to go on from; when
all calls were tried, `benchmarks/results/no-room.md` is written.
"""

from __future__ import annotations

import argparse
import json
import os
import resource
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path

from byte_calls import CALLS, ROOT, Call, command
from byte_inputs import write_inputs
from same_bytes import compared, hashes

sys.path.insert(0, str(ROOT / "benchmarks"))
from record import Value, commit, record

USUAL = (
    "facade-one", "grammar-three", "plan-document", "photos-corner", "carve-ball", "dense-wall",
    "drive-street", "walk-gorge", "fauna-eel",
)  # fmt: skip
SMALL_BYTES = 20_000
"""Less than a result needs, more than the record of a run does."""
FULL = Path("/dev/full")
BUGS = ("Traceback", "a bug in veduta", "Exception ignored")


def main() -> int:
    """Try and compare; 1 where anything is not as it should be."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("names", nargs="*")
    parser.add_argument("--kept", type=Path, help="JSON of what was tried, to go on from")
    asked = parser.parse_args()
    wanted = tuple(asked.names) or USUAL
    kept: Path | None = asked.kept
    rows: dict[str, dict[str, Value]] = (
        json.loads(kept.read_text()) if kept is not None and kept.exists() else {}
    )
    with tempfile.TemporaryDirectory() as scratch:
        work = Path(scratch)
        write_inputs(work / "inputs")
        for call in (one for one in CALLS if one.name.startswith(wanted)):
            if call.name not in rows:
                rows[call.name] = tried(call, work)
                print(rows[call.name], flush=True)
                if kept is not None:
                    kept.write_text(json.dumps(rows, indent=1))
    if set(USUAL) <= rows.keys():
        _keep(rows)
    return 1 if any("wrong" in str(row) for row in rows.values()) else 0


def tried(call: Call, work: Path) -> dict[str, Value]:
    """What came of a call: a word for each way, `right` or what was wrong."""
    verb = call.words[0]
    told: dict[str, Value] = {"call": call.name, "commit": commit()["commit"]}
    told["reader gone"] = _judged(_into_nobody(_words(call, "whole"), work), (0,))
    told["/dev/full"] = _judged(_into_full(_words(call, "whole"), work), (2,))
    help_codes = [_into_nobody([verb, "--help"], work), _into_full([verb, "--help"], work)]
    words = [_judged(one, codes) for one, codes in zip(help_codes, ((0,), (2,)), strict=True)]
    told["help"] = "right" if set(words) == {"right"} else "; ".join(words)
    told["no room"] = _judged(_limited(_words(call, "small"), work), (2, 3))
    told["and again"] = _judged(_run(_words(call, "small"), work), (0,))
    name = call.name
    _, differs = compared(hashes(work / "whole", [name]), hashes(work / "small", [name]))
    told["left"] = "the same" if not differs else f"wrong: {'; '.join(differs[:3])}"
    for folder in ("whole", "small"):
        shutil.rmtree(work / folder, ignore_errors=True)
    return told


def _words(call: Call, out: str) -> list[str]:
    """Its words; what it has to say is said."""
    return [word for word in command(call, "inputs", out) if word != "--quiet"]


Ended = tuple[int, str]
"""Exit code, and what was said on standard error."""


def _into_nobody(words: Sequence[str], work: Path) -> Ended:
    reads, writes = os.pipe()
    os.close(reads)
    try:
        return _run(words, work, writes)
    finally:
        os.close(writes)


def _into_full(words: Sequence[str], work: Path) -> Ended:
    with FULL.open("w") as full:
        return _run(words, work, full.fileno())


def _limited(words: Sequence[str], work: Path) -> Ended:
    return _run(words, work, limit=SMALL_BYTES)


def _run(words: Sequence[str], work: Path, out: int = subprocess.DEVNULL, limit: int = 0) -> Ended:
    def small() -> None:
        resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))

    done = subprocess.run(
        [sys.executable, "-P", "-m", "veduta.cli.main", *words],
        cwd=work, stdout=out, stderr=subprocess.PIPE, text=True, errors="replace", check=False,
        preexec_fn=small if limit else None,
    )  # fmt: skip
    return done.returncode, done.stderr


def _judged(ended: Ended, codes: Sequence[int]) -> str:
    code, said = ended
    if code not in codes or any(bug in said for bug in BUGS):
        return f"wrong: exit code {code}, {said.strip()[-200:]}"
    return "right"


def _keep(rows: dict[str, dict[str, Value]]) -> None:
    record(
        "no-room",
        [rows[name] for name in USUAL],
        (
            "Calls of `scripts/byte_calls.py` by `scripts/no_room.py`: into a pipe without a reader"
            " (exit code 0), told to a full device (2), help into both, no file larger than"
            f" {SMALL_BYTES} bytes (2 or 3, without a traceback), and the same again with room.",
        ),
    )


if __name__ == "__main__":
    sys.exit(main())
