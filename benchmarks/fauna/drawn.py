"""Snakes and fish that code draws: lengths, widths, heights, axes and waves against the truth.

`python benchmarks fauna/drawn [--clips N] [--no-keep]` prints a table and keeps it in
`benchmarks/results/fauna-drawn.md`. Animals with legs are those of `fauna/limbed`.
"""

from __future__ import annotations

import argparse
from typing import Literal

import numpy as np
from numpy.typing import NDArray
from record import Value, keep_or_print

from veduta.fauna.document.schema import Slice, Source
from veduta.fauna.motion.angles import equal_steps
from veduta.fauna.motion.wave import swimming_wave
from veduta.fauna.options import AnimalOptions, FaunaOptions
from veduta.fauna.read.footage import Footage
from veduta.fauna.read.from_side import seen_length, straight_axes
from veduta.fauna.read.limbless import Seen, axes_in, silhouettes_in, tracked_axes
from veduta.fauna.read.side_document import describe_from_side
from veduta.fauna.read.tracked import describe
from veduta.synthetic.animals import Filmed, film_fish_from_side, film_limbless
from veduta.synthetic.animals.limbless import PLACES

Floats = NDArray[np.float64]
Row = dict[str, Value]
FIRST = 304
"""The seed of the first clip: none from here on was looked at while anything was made."""
FRAME_S = 0.04
BOUNDS = (
    ("frames used", "used", "", False),
    ("points of the axis within 5 % of the length", "points", "0.95", False),
    ("points of the axis from the truth, median (of the length)", "point", "", True),
    ("length off by", "length", "0.05", True),
    ("widths off by, mean of three places", "widths", "0.1", True),
    ("cycle off by", "cycle", "0.03", True),
)
SIDE = (
    ("frames used", "used", "", False),
    ("length off by", "length", "0.05", True),
    ("heights off by, mean of three places", "heights", "0.1", True),
    ("beat off by", "beat", "0.03", True),
    ("beat found", "beat found", "", False),
)


def main() -> None:
    """Measure all clips and keep the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--clips", type=int, default=8, help="of each kind; every fourth is odd")
    parser.add_argument("--no-keep", action="store_true")
    given = parser.parse_args()
    rows: list[Row] = []
    kinds: tuple[Literal["snake", "fish"], ...] = ("snake", "fish")
    for kind in kinds:
        found = [measured(_clip(kind, number)) for number in range(given.clips)]
        rows += [_row(kind, found, *bound) for bound in BOUNDS]
    sides = [measured_from_side(_side(number)) for number in range(given.clips)]
    rows += [_row("fish from the side", sides, *bound) for bound in SIDE]
    keels = [measured_from_side(_side(given.clips + n, keeled=True)) for n in range(given.clips)]
    rows += [_row("keeled fish from the side", keels, *bound) for bound in SIDE]
    notes = [
        f"{given.clips} clips of each kind from veduta.synthetic.animals, which shares no function"
        " with what is measured: noise, and a shadow beside the body; nobody gives the background."
        " Every fourth animal is 1.5 to 1.8 times as thick as the others. Nothing was tuned with"
        f" them (seeds from {FIRST}).",
        "Points: 21 along the axis, head first. Widths at a quarter, half and three quarters.",
        "From the side: as many fish that go up to 12 degrees towards the camera or away, every"
        " fourth twice as high, no shadow; the slices of keeled ones are no ellipses about their"
        " spine, their belly reaches three times as far down as the back up; seeds 900 to 929,"
        " others, were looked at while it was made.",
    ]
    keep_or_print("fauna-drawn", rows, notes, not given.no_keep)


def _clip(kind: Literal["snake", "fish"], number: int) -> Filmed:
    return film_limbless(kind, FIRST + number, odd=number % 4 == 3, shadow=True)


def measured(film: Filmed) -> Row:
    """What was found in a clip, against what is known of it."""
    count = len(film.frames)
    footage = Footage(film.frames, np.arange(count), FRAME_S, assumed=False)
    silhouettes, background = silhouettes_in(footage, None, None, "clip")
    seen = tracked_axes(footage, Seen(silhouettes, axes_in(silhouettes), background))
    source = Source(file="", sha256="", frames=count, used=count)
    found = describe(seen, "clip", source, FaunaOptions())
    axes = equal_steps(found.tracked.points, 21)
    axes[..., 1] = footage.size[0] - axes[..., 1]
    truth = equal_steps(film.joints["axis"].reshape(count, -1, 2), 21)[found.tracked.frame]
    away = np.linalg.norm(axes - truth, axis=2) / film.length_px
    long = np.linalg.norm(np.diff(found.tracked.points, axis=1), axis=2).sum(axis=1)
    length_px = float(np.median(long))
    times_s = np.asarray(found.tracked.frame * FRAME_S, dtype=np.float64)
    wave = swimming_wave(found.angles, times_s)
    return {
        "used": len(found.axes) / count, "points": float((away < 0.05).mean()),
        "point": float(np.median(away)), "length": abs(length_px / film.length_px - 1.0),
        "widths": _widths(film, found.animal.body.slices, length_px),
        "cycle": abs(1.0 / (wave.frequency_hz * FRAME_S) / film.cycle - 1.0),
    }  # fmt: skip


def _side(number: int, *, keeled: bool = False) -> Filmed:
    odd, leftwards = number % 4 == 3, number % 2 == 1
    return film_fish_from_side(FIRST + number, odd=odd, leftwards=leftwards, keeled=keeled)


def measured_from_side(film: Filmed) -> Row:
    """The same of a fish that is seen from the side."""
    count = len(film.frames)
    footage = Footage(film.frames, np.arange(count), FRAME_S, assumed=False)
    silhouettes, background = silhouettes_in(footage, None, None, "clip")
    seen = Seen(silhouettes, straight_axes(silhouettes.masks), background)
    tracked = tracked_axes(footage, seen)
    areas = silhouettes.masks.sum(axis=(1, 2)).astype(np.float64)
    source = Source(file="", sha256="", frames=count, used=count)
    options = FaunaOptions(animal=AnimalOptions(kind="fish", view="side"))
    found = describe_from_side(tracked, areas, "clip", source, options)
    length_px = seen_length(found.tracked)
    motion, slices = found.animal.motion, found.animal.body.slices
    at = [one.at for one in slices]
    half = [one.half_height * length_px for one in slices]
    off = [abs(np.interp(PLACES[name], at, half) / one - 1.0) for name, one in film.halves.items()]
    beat_s = film.cycle * FRAME_S
    period_s = motion.frame_s * (len(motion.states) - 1) / 2
    return {
        "used": len(found.axes) / count, "length": abs(length_px / film.length_px - 1.0),
        "heights": float(np.mean(off)), "beat": abs(period_s / beat_s - 1.0),
        "beat found": float(motion.provenance == "inferred"),
    }  # fmt: skip


def _widths(film: Filmed, slices: list[Slice], length_px: float) -> float:
    at = [one.at for one in slices]
    half = [one.half_width * length_px for one in slices]
    off = [abs(np.interp(PLACES[name], at, half) / one - 1.0) for name, one in film.halves.items()]
    return float(np.mean(off))


def _row(kind: str, found: list[Row], what: str, key: str, bound: str, most: bool) -> Row:
    values = [float(one[key] or 0.0) for one in found]
    worst = max(values) if most else min(values)
    return {"what": f"{kind}: {what}", "value": float(np.median(values)), "worst clip": worst,
            "bound": bound}  # fmt: skip


if __name__ == "__main__":
    main()
