"""Preparing a gorge's walk of several views at each key position, and playing it in Chromium.

`python benchmarks walk/preparing FOLDER [--keys 5] [--width-px 1184]`: shoots the record into
FOLDER/record unless it is there, prepares it into FOLDER/walk, plays that, and keeps
`benchmarks/results/walk-preparing.md`. With `--play` FOLDER is a walk, and only played.
"""

from __future__ import annotations

import argparse
import json
import shutil
import subprocess
import sys
import time
from pathlib import Path

HERE = Path(__file__).parent
ROOT = HERE.parent.parent
sys.path.insert(0, str(HERE.parent / "studio"))

from loading import served  # noqa: E402
from record import Row, keep_or_print  # noqa: E402

from veduta.run.progress import Progress  # noqa: E402
from veduta.synthetic.walks.record import GorgeWalk, write_walk  # noqa: E402
from veduta.walk.command import run_walk  # noqa: E402
from veduta.walk.options import WalkOptions  # noqa: E402

AHEAD = "play with the browser before all other programs (needs root)"
VIEWS = 3
PAPER_VIEWS = 45


def prepare(folder: Path, keys: int, width_px: int) -> Row:
    """A row of what `veduta walk` takes; the processor's time, for the machine may be shared."""
    record = folder / "record"
    height_px = round(width_px / 1.4)
    if not (record / "walk.toml").is_file():
        shutil.rmtree(record, ignore_errors=True)
        gorge = GorgeWalk(
            keys=keys, step_m=3.0, width_px=width_px, height_px=height_px, views=VIEWS, seed=5,
            samples=1,
        )  # fmt: skip
        write_walk(record, gorge)
    begin, clock = time.process_time(), time.perf_counter()
    result = run_walk(record, folder / "walk", WalkOptions(), Progress(), force=True)
    seconds, wall = time.process_time() - begin, time.perf_counter() - clock
    return {
        "what": "prepare", "views": keys * VIEWS, "megapixels": width_px * height_px / 1e6,
        "processor s": seconds, "wall s": wall,
        f"processor s for {PAPER_VIEWS} views of 1 MP": (
            seconds * (PAPER_VIEWS / VIEWS - 1) / (keys - 1) / (width_px * height_px / 1e6)
        ),
        "summary": result.summary,
    }  # fmt: skip


def play(name: str, place: Path, picture: Path | None, *, ahead: bool = False) -> Row:
    """A row of what its frames cost, or of why there is none: what was prepared is kept anyway.
    ahead: the browser goes before other programs.
    """
    with served(place) as address:
        call: list[str | Path] = ["node", HERE / "playing.mjs", ROOT / "studio", address]
        more: list[str | Path] = [*([picture] if picture else []), *(["--ahead"] if ahead else [])]
        done = subprocess.run([*call, *more], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        last = done.stderr.strip().splitlines()[-1:] or ["no word"]
        return {"what": f"play {name}", "not played to its end": f"{done.returncode}: {last[0]}"}
    return of_played(f"play {name}", done.stdout)


def of_played(what: str, told: str) -> Row:
    """The row of what playing.mjs says."""
    values: dict[str, float] = json.loads(told)
    return {"what": what, **{key: round(value, 1) for key, value in values.items()}}


def main() -> None:
    """Measure and keep."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--keys", type=int, default=5)
    parser.add_argument("--width-px", type=int, default=1184)
    parser.add_argument("--play", action="store_true")
    parser.add_argument("--picture", type=Path)
    parser.add_argument("--ahead", action="store_true", help=AHEAD)
    parser.add_argument("--draft", action="store_true")
    called = parser.parse_args()
    rows: list[Row] = []
    notes = [
        "Three views at each key position, joined to mosaics; 3 m from one to the next. One"
        " process; what OpenCV does on a second core counts into its processor time.",
        "Played at 960 x 540 CSS px, half as many drawn, by a software renderer on two shared"
        " cores. at_keys: within 0.08 of a key position, where models come and go; hitches: frames"
        " of over 100 ms; longest_task: of the page's own thread; processor: of all of the browser,"
        " in a frame.",
        "draw_calls: what was seen and what spans breaks of both models, and their mixture."
        " card_MB: all models, pictures, and the two pictures that are mixed.",
    ]
    walk = called.folder if called.play else called.folder / "walk"
    if not called.play:
        rows.append(prepare(called.folder, called.keys, called.width_px))
        # Playing may be cut off.
        keep_or_print("walk-preparing", rows, [*notes, "Not played yet."], not called.draft)
    rows.append(play(called.folder.name, walk, called.picture, ahead=called.ahead))
    keep_or_print("walk-preparing", rows, notes, not called.draft)


if __name__ == "__main__":
    main()
