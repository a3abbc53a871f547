"""How well sheets as strangers bring them are read: a house on its plot, storeys side by side.

    python benchmarks plan/plan_strangers [--seeds A..B] [--families brochure] [--each]

`plot` and `storeys` are `veduta.synthetic.plans.strangers`, drawn by who wrote the reader, before
it was run on any. `brochure` and `measured` are a page of a letting agent and a survey, drawn
from what such sheets look like by somebody who had not read the reader's code, and so is `working`,
a German working drawing of a flat in a block with chains of sizes. `japanese` and `labelled` were
drawn by somebody who had read how openings are told, before the reader was run on any: a flat with
doors of panels, and sheets whose windows words tell. `ranch` and `gallery` are pages of a
builder's catalogue, drawn before anything of the reader's code was read. Each is read to its
document. A run over all seeds of all families is kept as `plan-strangers`.
"""

from __future__ import annotations

import argparse
import tempfile
from collections.abc import Callable, Mapping, Sequence
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
from veduta.synthetic.plans.brochure import brochure_page
from veduta.synthetic.plans.canvas import Image as Picture
from veduta.synthetic.plans.japanese import japanese_flat
from veduta.synthetic.plans.labelled import labelled_sheet
from veduta.synthetic.plans.measured import measured_sheet
from veduta.synthetic.plans.stock_plan import stock_plan
from veduta.synthetic.plans.strangers import strangers_sheet
from veduta.synthetic.plans.truth_file import SheetTruth
from veduta.synthetic.plans.working_drawing import working_drawing

Make = Callable[[int], tuple[Picture, list[SheetTruth]]]
Families = Mapping[str, Make]
FAMILIES: Families = {
    "plot": lambda seed: strangers_sheet(seed, "plot"),
    "storeys": lambda seed: strangers_sheet(seed, "storeys"),
    "brochure": brochure_page,
    "measured": measured_sheet,
    "working": working_drawing,
    "japanese": japanese_flat,
    "labelled": labelled_sheet,
    "ranch": lambda seed: stock_plan(seed, "ranch"),
    "gallery": lambda seed: stock_plan(seed, "gallery"),
}
SEEDS = range(31_000, 31_012)
TOLERANCE = 0.01
NOTES = (
    "Asked for: rooms right 0.85, openings F1 0.75, scale within 1 % on 0.95 of those that say it.",
    "Rooms right, openings: as in plan-synthetic, counted over all storeys of a family.",
    "plot and storeys were drawn by who wrote the reader, before the reader was run on any;"
    " brochure and measured by somebody who had not read the reader's code.",
    "At the first try on these seeds: brochure 0.93 of the rooms, openings 0.84, scale 0.92;"
    " measured 0.32, 0.47, 0.42, five of twelve not read. It was mended on seeds 41000 to 41006,"
    " and brochure again on 50 to 57 (the scale was right on .75 of its storeys before).",
    "working at the first try on these seeds: rooms 0.97, openings 0.78, scale 1.00, wall IoU 0.81"
    " (the truth has no neighbours' walls); mended on 52 to 65.",
    "japanese and labelled on 31000 to 31003, means of four sheets each: at the first try openings"
    " 0.65 and 0.74, rooms 0.66 and 0.97; after mending on 100 to 107 openings 0.85 and 0.98, rooms"
    " 0.70 (missed: 0.85) and 1.00. On 31002 walls lost, IoU 0.75 to 0.66. Scale: 4 of 4, 3 of 4.",
    "japanese once more, after leaves and lines of furniture were told from walls on 100 to 107:"
    " rooms 0.77 on 31000 to 31003; 1.00 on 31004 to 31007, which nobody had seen (0.95 before);"
    " of all eight 0.89 (0.83).",
    "ranch and gallery at the first try on 31000 to 31003: rooms 0.86 and 0.84, openings 0.74 and"
    " 0.85, wall IoU 0.88 and 0.84, scale 1.00; after mending on 100 to 105 of each, on all twelve:"
    " rooms 0.98 and 0.87, openings 0.88 and 0.93. What is missed of gallery is the landing, which"
    " is one room with the void behind its railing.",
)


def judged(seed: int, make: Make) -> list[tuple[Score, bool]]:
    """The score of each storey on a sheet, and whether it says its scale."""
    picture, truths = make(seed)
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


def row_of(family: str, scores: Sequence[tuple[Score, bool]]) -> Row:
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


def measure(
    benchmark: str, families: Families, usual: range, notes: Sequence[str], about: str | None
) -> None:
    """Read the sheets that the call names; only a run over all families and seeds is kept."""
    parser = argparse.ArgumentParser(description=about)
    parser.add_argument("--seeds", type=seeds, default=usual)
    parser.add_argument("--families", nargs="+", choices=families, default=[*families])
    parser.add_argument("--each", action="store_true", help="print a line for each sheet")
    asked = parser.parse_args()
    rows = []
    for family in asked.families:
        scores: list[tuple[Score, bool]] = []
        for seed in asked.seeds:
            found = judged(seed, families[family])
            scores += found
            if asked.each:
                print(seed, row_of(family, found), flush=True)
        rows.append(row_of(family, scores))
    whole = list(asked.seeds) == list(usual) and asked.families == [*families]
    keep_or_print(benchmark, rows, notes, keep=whole)


def main() -> None:
    """Measure, and print or keep the table."""
    measure("plan-strangers", FAMILIES, SEEDS, NOTES, __doc__)


if __name__ == "__main__":
    main()
