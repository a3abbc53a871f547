"""How long a run took, as the paper's table 3 tells it for 3.5 blocks of Berkeley."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from veduta.drive.build.outcome import Outcome
from veduta.run.page import Table
from veduta.run.report import Count

_PAPER_MIN = {
    "path, with the reading of the log": 14 + 70, "path segmentation": 1, "geometry": 6,
    "texture mapping and atlas": 27, "texture synthesis": 20 * 60 + 51,
    "meshes made lighter, and written": 19,
}  # fmt: skip


def times_table(steps: Mapping[str, float], outcomes: Sequence[Outcome]) -> Table:
    """steps: seconds of the recipe's steps. What segments took is added up: they are made side by
    side, so that it may be more than the run took.
    """
    geometry, atlas, fill, join = (sum(one.seconds[row] for one in outcomes) for row in range(4))
    look = max(steps.get("texture", 0.0) - atlas - fill - join, 0.0)
    own = dict(zip(
        _PAPER_MIN,
        (steps.get("read", 0.0), steps.get("segments", 0.0), geometry, atlas + look, fill,
         join + steps.get("place", 0.0)),
        strict=True,
    ))  # fmt: skip
    rows: list[list[Count | None]] = [
        [name, _PAPER_MIN[name], round(seconds, 1)] for name, seconds in own.items()
    ]
    rows.append(["all of it", sum(_PAPER_MIN.values()), round(sum(own.values()), 1)])
    return Table(
        "Times", ["step", "the paper's 3.5 blocks (min)", "this run (s)"], rows,
        note="The paper's table 3: a Pentium 4 of 2 GHz, 29 segments with images.",
    )  # fmt: skip
