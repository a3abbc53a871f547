"""Animals with legs that turn round: joints on either side of the turn, against the truth.

`python benchmarks fauna/turned [--clips N] [--kept FILE] [--no-keep]` prints a table, kept in
`benchmarks/results/fauna-turned.md`. Each clip that is done is kept in FILE.
"""

from __future__ import annotations

import numpy as np
from kept_clips import Row, rows_of_clips
from limbed import joints_near
from record import keep_or_print

from veduta.fauna.document.plan import load_plan
from veduta.fauna.read.limbed import LimbedLooks, fit_limbed
from veduta.fauna.read.silhouettes import SilhouetteLooks, silhouettes_of
from veduta.fauna.read.ways import WayLooks, stretches_of
from veduta.synthetic.animals import film_quadruped, turned_round

FIRST = 771
"""The seed of the first clip: none from here on was looked at."""
FRAMES = 60


def main() -> None:
    """Measure all clips and keep the table."""
    rows, keep = rows_of_clips(__doc__, 4, "every fourth", measured)
    notes = [
        "Drawn quadrupeds, flat, that turn round in ten to sixteen frames of sixty and go back;"
        " their silhouettes are the true ones. Beside: the same frames with the turn in them, as of"
        " an animal that does not turn. Sides of legs are compared the way that fits better: what"
        " is drawn is the one side of the animal.",
    ]
    keep_or_print("fauna-turned", rows, notes, keep)


def measured(clip: int) -> list[Row]:
    """The row of a clip."""
    turn = (22, 32 + 2 * clip)
    film = turned_round(
        film_quadruped(FIRST + clip, frames=FRAMES, cycle=18.0 + clip, odd=clip % 4 == 3), *turn
    )
    found = silhouettes_of(film.masks, SilhouetteLooks(), str(clip), with_cut=True)
    parted = stretches_of(found, film.frames[found.rows], WayLooks(), {})
    row: Row = {"clip": clip, "told": parted.right is not None,
                "left out": int(parted.turning.sum())}  # fmt: skip
    for name, apart in (("told", True), ("as one plane", False)):
        rows = np.flatnonzero(~parted.turning) if apart else np.arange(len(found.rows))
        used = found.of(rows)
        ways = parted.right[rows] if apart and parted.right is not None else None
        seen = fit_limbed(
            used.masks, used.rows, load_plan("quadruped"), LimbedLooks(), lambda: None,
            pictures=film.frames[used.rows], ways=ways,
        )  # fmt: skip
        joints = seen.windows.in_picture(seen.fitted.joints(), seen.fitted.px_per_length)
        near = joints_near(film, seen, joints, used.rows)
        for side, frames in (("before", used.rows < turn[0]), ("after", used.rows > turn[1])):
            row[f"{name}: joints within 5 %, {side}"] = float((near[frames] < 0.05).mean())
    return [{**row, "bound": "0.95"}]


if __name__ == "__main__":
    main()
