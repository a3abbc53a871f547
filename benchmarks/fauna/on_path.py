"""Animals with legs on their paths: feet on slopes, the body on the path, and how long it takes.

`python benchmarks fauna/on_path [ANIMAL.json ...] [--no-keep]` fits the walking cat and a drawn
lizard, or takes documents that `veduta fauna` has made, prints a table and keeps it in
`benchmarks/results/fauna-on-path.md`. Real data is read from `$VEDUTA_DATA`, else from
`../shared/data`.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable
from pathlib import Path

import cv2
import numpy as np
from cat_views import fitted_cat
from numpy.typing import NDArray
from record import Value, keep_or_print

from veduta.fauna.build.limbed import build_limbed
from veduta.fauna.build.walker import limbed_walker
from veduta.fauna.document.limbed import LimbedAnimal
from veduta.fauna.document.load import load_animal
from veduta.fauna.document.plan import load_plan
from veduta.fauna.document.schema import Source
from veduta.fauna.motion.transfer import TransferLooks, Walker, walked
from veduta.fauna.options import FaunaOptions
from veduta.fauna.path.limits import PathLimits
from veduta.fauna.path.terrain import terrain_of_heights
from veduta.fauna.path.through import path_through
from veduta.fauna.read.limbed import LimbedLooks, fit_limbed
from veduta.fauna.read.limbed_document import described_limbs
from veduta.synthetic.animals import film_lizard

Floats = NDArray[np.float64]
Row = dict[str, Value]
LIZARD = 116
"""The seed of the lizard: the first one after those of `limbed.py`."""
STEEP = float(np.tan(np.radians(30.0)))


def main() -> None:
    """Measure all of it and keep the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("animals", type=Path, nargs="*")
    parser.add_argument("--no-keep", action="store_true")
    given = parser.parse_args()
    rows: list[Row] = []
    animals = [load_animal(path) for path in given.animals] or [fitted_cat(), fitted_lizard()]
    for number, animal in enumerate(animals):
        walker = limbed_walker(build_limbed(animal)) if isinstance(animal, LimbedAnimal) else None
        if walker is None:
            raise SystemExit(f"{animal.name} holds no gait")
        rows += on_slopes(animal.kind, walker)
        if number == 0:
            rows.append(million(animal.kind, walker))
    notes = [
        "Slopes: 8 lengths of a sine as wide as the animal is long, on planes and bumps; all"
        " standing feet at all keys. A foot slides by its distance from its spot, and sinks by how"
        " far its sole is under the ground, swinging or standing. The middle is that of"
        " the spine between the legs as it lies in the clip, against the nearest spot of the path.",
        "Million: path through three points of 1,000 x 1,000 heights, and 300 keys of motion with"
        " planted feet, after loading. The quadruped is the walking cat, the lizard a drawn one.",
    ]
    keep_or_print("fauna-on-path", rows, notes, not given.no_keep)


def fitted_lizard() -> LimbedAnimal:
    """A drawn one, from its true silhouettes."""
    film = film_lizard(LIZARD, frames=36)
    plan, rows = load_plan("lizard"), np.arange(len(film.masks))
    seen = fit_limbed(film.masks, rows, plan, LimbedLooks(), lambda: None, pictures=film.frames)
    source = Source(file="", sha256="", frames=len(rows), used=len(rows))
    return described_limbs(seen, plan, "lizard", source, 0.04, np.ones(1), FaunaOptions())


def on_slopes(kind: str, walker: Walker) -> list[Row]:
    """The worst of each ground."""
    long = walker.length_m
    grounds: dict[str, Callable[[Floats], Floats]] = {
        "flat": lambda p: np.zeros(len(p)),
        "30 degrees up": lambda p: STEEP * p[:, 0],
        "30 degrees down": lambda p: -STEEP * p[:, 0],
        "20 degrees aside": lambda p: np.tan(np.radians(20.0)) * p[:, 1],
        "bumps": lambda p: 0.08 * long * np.sin(3 * p[:, 0] / long) * np.cos(2.5 * p[:, 1] / long),
    }
    x = np.linspace(0.0, 8.0, 80)
    flat = np.column_stack([x, np.sin(0.8 * x)]) * long
    rows: list[Row] = []
    for name, ground in grounds.items():
        path = np.column_stack([flat, ground(flat)])
        done = walked(walker, path, ground, closed=False, looks=TransferLooks())
        rows.append(
            {
                "what": f"{kind}, {name}", "slides (of a stride)": done.slides_m / walker.stride_m,
                "sinks (m)": done.sinks_m, "middle from the path (of the length)":
                done.aside_m / long, "bound": "0.01; 0.02; 0.02",
            }
        )  # fmt: skip
    return rows


def million(kind: str, walker: Walker) -> Row:
    """Planning in a million heights, and 300 keys on the way."""
    rough = np.random.default_rng(3).normal(size=(1000, 1000))
    heights = cv2.GaussianBlur(rough, (0, 0), 40.0)
    scaled: Floats = np.asarray(heights * (2.0 / heights.std()), dtype=np.float64)
    terrain = terrain_of_heights(scaled, 0.2, (0.0, 0.0))
    points = np.array([[20.0, 20.0], [150.0, 60.0], [180.0, 180.0]])
    begin = time.perf_counter()
    found = path_through(terrain, points, PathLimits(), walker.length_m)
    keys = 300.0 / 30.0 * walker.stride_m / float(walker.clip.times_s[-1])
    arcs = np.cumsum(np.linalg.norm(np.diff(found.points_m, axis=0), axis=1))
    piece = found.points_m[: int(np.searchsorted(arcs, keys + walker.length_m)) + 2]
    done = walked(walker, piece, terrain.footing, closed=False, looks=TransferLooks())
    seconds = time.perf_counter() - begin
    return {
        "what": f"{kind}, a million heights and {len(done.clip.times_s)} keys (s)",
        "slides (of a stride)": done.slides_m / walker.stride_m, "sinks (m)": done.sinks_m,
        "seconds": seconds, "bound": "2 s",
    }  # fmt: skip


if __name__ == "__main__":
    main()
