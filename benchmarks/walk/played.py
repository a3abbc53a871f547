"""Walks played in Chromium from end to end: what their frames cost, and which are hitches.

`python benchmarks walk/played WALK... [--rounds 3] [--ahead] [--keep]`: results of
`veduta walk` and `veduta demo --walk`, each as often.
A hitch is a frame of over 100 ms; at_keys: within 0.08 of a key position, where models come and
go. `walk/preparing` prepares the paper's walk and plays it; this one plays what there is.

A machine with a graphics card may have nothing but a browser: there, serve what `veduta export
--web` wrote, call `node playing.mjs STUDIO ADDRESS --card > FILE`, and keep the files here by
`walk/played --told NAME=FILE ... --machine "the card" --keep` as `walk-played-card`.
"""

from __future__ import annotations

import argparse
import os
from pathlib import Path

from preparing import AHEAD, of_played, play
from record import keep_or_print

MEANING = (
    "at_keys: within 0.08 of a key position, where models change; after_keys: up to 0.5 beyond"
    " one, while what comes next is read; between: all but the first, the start of the walk too;"
    " hitches: frames of over 100 ms.",
    "processor: time of all processes and threads of the browser in a frame, on all cores.",
)


def main() -> None:
    """Play each, and keep the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("walks", type=Path, nargs="*")
    parser.add_argument("--rounds", type=int, default=1)
    parser.add_argument("--ahead", action="store_true", help=AHEAD)
    parser.add_argument("--told", nargs="*", metavar="NAME=FILE", default=[])
    parser.add_argument("--machine", help="where --told was measured")
    parser.add_argument("--keep", action="store_true")
    given = parser.parse_args()
    if given.told:
        kept = [name.split("=", 1) for name in given.told]
        rows = [of_played(f"play {name}", Path(path).read_text()) for name, path in kept]
        where = f"On another machine: {given.machine}. Played at 960 x 540 CSS px, half as many"
        keep_or_print("walk-played-card", rows, [f"{where} drawn.", *MEANING], given.keep)
        return
    before = os.getloadavg()[0]
    rows = [
        play(walk.resolve().parent.name, walk, None, ahead=given.ahead)
        for walk in given.walks
        for _ in range(given.rounds)
    ]
    notes = [
        f"Load when it began: {before:.1f}, at the end {os.getloadavg()[0]:.1f}, on"
        f" {os.cpu_count()} cores.",
        "Played at 960 x 540 CSS px, half as many drawn, by a software renderer."
        + (" The browser went before all other programs." if given.ahead else ""),
        *MEANING,
    ]
    keep_or_print("walk-played", rows, notes, given.keep)


if __name__ == "__main__":
    main()
