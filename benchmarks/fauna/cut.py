"""Animals with legs that leave the frame: joints where the border cuts them, against the truth.

`python benchmarks fauna/cut [--clips N] [--kept FILE] [--no-keep]` prints a table and keeps it in
`benchmarks/results/fauna-cut.md`. Each clip that is done is kept in FILE.
"""

from __future__ import annotations

import numpy as np
from kept_clips import Row, rows_of_clips
from limbed import joints_near
from record import keep_or_print

from veduta.fauna.document.plan import load_plan
from veduta.fauna.read.limbed import LimbedLooks, fit_limbed
from veduta.fauna.read.silhouettes import SilhouetteLooks, silhouettes_of
from veduta.synthetic.animals import film_quadruped

FIRST = 731
"""The seed of the first clip: none from here on was looked at."""
FRAMES, LEFT, RIGHT = 52, 60, 330
"""Of a film of 640 columns these are seen: the animal is whole in the first third of it."""


def main() -> None:
    """Measure all clips and keep the table."""
    rows, keep = rows_of_clips(__doc__, 6, "every third", measured)
    notes = [
        "Drawn quadrupeds (veduta.synthetic.animals, which shares no function with the fit) that"
        f" walk out of a frame of {RIGHT - LEFT} columns; their silhouettes are the true ones.",
        "What lies beyond the border is neither animal nor ground for the fit.",
    ]
    keep_or_print("fauna-cut", rows, notes, keep)


def measured(clip: int) -> list[Row]:
    """The row of a clip."""
    film = film_quadruped(FIRST + clip, frames=FRAMES, cycle=18.0 + clip, odd=clip % 3 == 2)
    found = silhouettes_of(
        film.masks[:, :, LEFT:RIGHT], SilhouetteLooks(), str(clip), with_cut=True
    )
    cut = np.zeros(len(found.rows), dtype=np.bool_) if found.cut is None else found.cut
    seen = fit_limbed(
        found.masks, found.rows, load_plan("quadruped"), LimbedLooks(), lambda: None,
        pictures=film.frames[found.rows, :, LEFT:RIGHT], shown=found.shown(),
    )  # fmt: skip
    joints = seen.windows.in_picture(seen.fitted.joints(), seen.fitted.px_per_length)
    near = joints_near(film, seen, joints + np.array([LEFT, 0.0]), found.rows)
    least = found.masks.sum(axis=(1, 2)) / film.masks[found.rows].sum(axis=(1, 2))
    return [{
        "clip": clip, "frames": len(found.rows), "cut": int(cut.sum()),
        "least shown": float(least.min()),
        "joints within 5 %, whole": float((near[~cut] < 0.05).mean()),
        "joints within 5 %, cut": float((near[cut] < 0.05).mean()), "bound": "0.95",
    }]  # fmt: skip


if __name__ == "__main__":
    main()
