"""How well sheets as strangers bring them are read: a house on its plot, storeys side by side.

    python benchmarks/plan_strangers.py [--seeds A..B]

The sheets are `veduta.synthetic.plans.strangers` (seeds 31000 to 31011 unless told), read to their
document. A run over all seeds is kept as `plan-strangers`.
"""

from __future__ import annotations

import argparse
import tempfile
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from PIL import Image
from plan_scores import Hits, Score, score
from plan_sets import seeds
from plan_truth import found_layout, true_layout
from record import Row, keep_or_print

from veduta.plan.analyse import read_drawings
from veduta.plan.document import Storey
from veduta.plan.options import PlanOptions
from veduta.plan.pages import find_drawings
from veduta.run.errors import NotFoundError
from veduta.synthetic.plans.strangers import FAMILIES, Family, strangers_sheet

SEEDS = range(31_000, 31_012)
TOLERANCE = 0.01
NOTES = (
    "Asked for: rooms right 0.85, openings F1 0.75, scale within 1 % on 0.95 of those that say it.",
    "Rooms right, openings: as in plan-synthetic, counted over all storeys of a family.",
    "The sheets were drawn by who wrote the reader of them, before the reader was run on any.",
)


def judged(seed: int, family: Family) -> list[tuple[Score, bool]]:
    """The score of each storey on a sheet, and whether it says its scale."""
    picture, truths = strangers_sheet(seed, family)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "sheet.png"
        Image.fromarray(picture).save(path)
        try:
            read = read_drawings(find_drawings([path], None), PlanOptions(), [], lambda *_: None)
            storeys = list(read.document.storeys)
        except NotFoundError:
            storeys = []
    if len(storeys) != len(truths):
        storeys = []
    found: list[Storey | None] = [*storeys] or [None for _ in truths]
    return [
        (
            score(
                None
                if one is None
                else found_layout(one, truth.px_from_m, truth.walls_drawn == "single-line"),
                true_layout(truth),
            ),
            truth.says_scale,
        )
        for one, truth in zip(found, truths, strict=True)
    ]


def _all(hits: Sequence[Hits]) -> Hits:
    return Hits(*(sum(getattr(one, name) for one in hits) for name in ("right", "found", "true")))


def row_of(family: Family, scores: Sequence[tuple[Score, bool]]) -> Row:
    """A family in a row."""
    rooms = [one.rooms for one, _ in scores]
    openings = [one.openings for one, _ in scores]
    told = [one.scale_error for one, says in scores if says]
    right = [one is not None and abs(one) <= TOLERANCE for one in told]
    return {
        "family": family,
        "storeys": len(scores),
        "not read": sum(one.wall_iou == 0.0 for one, _ in scores),
        "wall IoU": float(np.mean([one.wall_iou for one, _ in scores])),
        "openings F1": _all(openings).f1,
        "rooms right": _all(rooms).recall,
        "scale within 1 %": float(np.mean(right)) if right else None,
    }


def main() -> None:
    """Read the sheets of all seeds; only a run over all is kept."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seeds", type=seeds, default=SEEDS)
    parser.add_argument("--each", action="store_true", help="print a line for each sheet")
    asked = parser.parse_args()
    rows = []
    for family in FAMILIES:
        scores: list[tuple[Score, bool]] = []
        for seed in asked.seeds:
            found = judged(seed, family)
            scores += found
            if asked.each:
                print(seed, row_of(family, found), flush=True)
        rows.append(row_of(family, scores))
    keep_or_print("plan-strangers", rows, NOTES, keep=list(asked.seeds) == list(SEEDS))


if __name__ == "__main__":
    main()
