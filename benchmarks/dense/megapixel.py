"""Seconds by the clock that a megapixel of a depth map with four neighbours costs.

`python benchmarks dense/megapixel FOUND [--rounds 3] [--keep]`: FOUND is a result of `veduta
photos`. One photo's planes, coarse and fine, as `veduta dense` looks for them, at two sizes: if
the times of a megapixel are alike, the time grows with the pixels alone. A depth map of a run
costs one coarse and one fine search: coarse ones are kept for all who are neighbours of it.
The bound is 15 s on two cores. The least of the rounds counts: other programs only add to it.
"""

from __future__ import annotations

import argparse
import os
import time
from collections.abc import Callable
from pathlib import Path

from record import Row, keep_or_print
from searched_photo import SEED, coarse_planes, middle_photo

from veduta.dense.read.matching import MatchParameters, match_coarse, match_fine
from veduta.run.card import choose_engine

SIZES_PX = (640, 1280)


def least_s(rounds: int, step: Callable[[], object]) -> float:
    """Of so many calls."""
    seconds = []
    for _ in range(rounds):
        began = time.perf_counter()
        step()
        seconds.append(time.perf_counter() - began)
    return min(seconds)


def searched(found: Path, size_px: int, rounds: int) -> Row:
    """The middle one of the photos at this size."""
    views, middle, by_view = middle_photo(found, size_px)
    engine, rule = choose_engine("cpu"), MatchParameters()
    planes = coarse_planes(views, middle, by_view, engine, rule)
    coarse = least_s(rounds, lambda: match_coarse(views, middle, SEED, rule, engine))
    fine = least_s(rounds, lambda: match_fine(views, middle, planes, SEED, rule, engine))
    camera = views.cameras[middle.view]
    pixels = camera.width_px * camera.height_px / 1e6
    return {
        "photo": camera.name,
        "size": f"{camera.width_px} x {camera.height_px}",
        "neighbours": len(middle.neighbours),
        "coarse s": round(coarse, 2),
        "fine s": round(fine, 2),
        "s a megapixel": round((coarse + fine) / pixels, 1),
    }


def main() -> None:
    """Measure both sizes, keep."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("found", type=Path)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--keep", action="store_true")
    given = parser.parse_args()
    before = os.getloadavg()[0]
    rows = [searched(given.found, size, given.rounds) for size in SIZES_PX]
    notes = [
        f"The least of {given.rounds} rounds, by the clock; load {before:.1f} when it began,"
        f" {os.getloadavg()[0]:.1f} at the end. Bound: 15 s a megapixel.",
        "Without what comes before and after: choosing neighbours, holding depths against each"
        " other, fusing.",
    ]
    keep_or_print("dense-megapixel", rows, notes, given.keep)


if __name__ == "__main__":
    main()
