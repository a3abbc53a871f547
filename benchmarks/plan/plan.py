"""How well plans are read: walls, openings, rooms and scale, on drawn and on real ones.

    python benchmarks plan/plan [synthetic] [mlstruct] [zind] [uk] [cubicasa] [dxf]
                              [--seeds A..B] [--jobs N] [--pictures DIR] [--house] [--work DIR]

The synthetic plans are `veduta.synthetic.plans` (seeds 10000 to 10199 unless told), read to their
document; with `--house` they go through the whole verb. The real ones are `plans/` of $VEDUTA_DATA
(else ../shared/data) and always go through the whole verb, whose time is given. A run over exactly
the synthetic plans of all seeds is kept as `plan-synthetic`, one over all the real sets as
`plan-real`. `--pictures` writes sheets of overlays: of other people's pixels, so never into the
repository. `--work` keeps the synthetic readings, from which a later call on the same commit goes
on.
"""

from __future__ import annotations

import argparse
import statistics
import tempfile
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import plan_cubicasa
import plan_dxf
import plan_mlstruct
import plan_uk
import plan_zind
from PIL import Image
from plan_pictures import Image as Pixels
from plan_pictures import contact_sheets, overlay
from plan_reading import Reading, read_plans
from plan_scores import NONE, Score, score
from plan_sets import save_sheet, seeds
from plan_truth import Layout, found_layout, true_layout
from record import Row, keep_or_print

from veduta.synthetic.plans.sets import FIRST_TEST_SEED, sheets_of
from veduta.synthetic.plans.truth_file import SheetTruth

TEST_SEEDS = range(FIRST_TEST_SEED, FIRST_TEST_SEED + 200)
SCALE_TOLERANCE = 0.01
REAL = {
    "mlstruct": plan_mlstruct.rows,
    "zind": plan_zind.rows,
    "uk": plan_uk.rows,
    "cubicasa": plan_cubicasa.rows,
    "dxf": plan_dxf.rows,
}
NOTES = (
    "Asked for on synthetic plans: wall IoU 0.90, openings F1 0.90, rooms right 0.95, scale within"
    " 1 % wherever sizes are printed.",
    "Wall IoU is the mean over sheets of the walls' material, openings cut out; walls drawn as one"
    " line count as 15 cm thick on both sides. Openings and rooms are counted over all sheets.",
    "An opening is right that overlaps the true one by half along its wall and is of its kind"
    " (door, window, gap). A room is right with IoU 0.8 and the same use; hall and corridor are"
    " one use. A sheet that cannot be read has none of all.",
    "Unseen: its style or its damage is kept back from development.",
)

REAL_NOTES = (
    "Asked for: mlstruct wall recall 0.90, and IoU 0.90 where the truth is complete (7db30954);"
    " zind rooms F1 0.9, openings F1 0.80, areas within 3 %; uk-dimensions each size and the gross"
    " area within 3 %; cubicasa counts of rooms within one on 3 of 4, adjacency F1 0.7.",
    "The picture of the DXF file says nothing of its scale: it is assumed from doors.",
)


@dataclass(frozen=True)
class Judged:
    """One sheet, read and scored."""

    truth: SheetTruth
    reading: Reading
    score: Score


def judge_synthetic(
    chosen: Sequence[int], jobs: int, pictures: Path | None, house: bool, kept: Path | None
) -> list[Judged]:
    """Draw the plans of these seeds, read and score them."""
    with tempfile.TemporaryDirectory() as folder:
        truths: list[SheetTruth] = []
        for seed in chosen:
            for picture, truth in sheets_of(seed):
                save_sheet(Path(folder) / truth.file, picture, truth)
                truths.append(truth)
        paths = [Path(folder) / truth.file for truth in truths]
        readings = read_plans(paths, jobs, house, kept)
        judged: list[Judged] = []
        cells: list[tuple[str, Pixels]] = []
        for path, truth, reading in zip(paths, truths, readings, strict=True):
            found, true = _found(truth, reading), true_layout(truth)
            judged.append(Judged(truth, reading, score(found, true)))
            if pictures is not None:
                cells.append(_cell(path, judged[-1], found, true))
    if pictures is not None:
        contact_sheets(cells, pictures, "synthetic")
    return judged


def _found(truth: SheetTruth, reading: Reading) -> Layout | None:
    if reading.storey is None:
        return None
    single = truth.walls_drawn == "single-line"
    return found_layout(reading.storey, truth.px_from_m, single)


def _cell(path: Path, one: Judged, found: Layout | None, true: Layout) -> tuple[str, Pixels]:
    truth, result = one.truth, one.score
    with Image.open(path) as image:
        pixels = np.asarray(image.convert("RGB"))
    scale = "-" if result.scale_error is None else f"{result.scale_error:+.3f}"
    words = (
        f"{truth.seed} {truth.style} {truth.degradation}: walls {result.wall_iou:.2f}"
        f" op {result.openings.f1:.2f} rooms {result.rooms.recall:.2f} scale {scale}"
    )
    return words, overlay(pixels, found, true, truth.px_from_m)


def synthetic_rows(judged: Sequence[Judged]) -> list[Row]:
    """All, known and unseen, then by style and by damage."""

    def known(one: Judged) -> bool:
        return not one.truth.unseen

    groups: list[tuple[str, Callable[[Judged], bool]]] = [
        ("all", lambda _: True),
        ("known styles and damage", known),
        ("unseen style or damage", lambda one: not known(one)),
    ]
    for style in sorted({one.truth.style for one in judged}):
        groups.append((f"style {style}", lambda one, style=style: one.truth.style == style))  # type: ignore[misc]
    for damage in sorted({one.truth.degradation for one in judged}):
        groups.append(
            (f"damage {damage}", lambda one, damage=damage: one.truth.degradation == damage)  # type: ignore[misc]
        )
    rows = [(name, [one for one in judged if test(one)]) for name, test in groups]
    return [group_row(name, group) for name, group in rows if group]


def group_row(name: str, group: Sequence[Judged]) -> Row:
    """The measures of one group of sheets."""
    scores = [one.score for one in group]
    told = [one.score.scale_error for one in group if one.truth.says_scale]
    near = [error is not None and abs(error) <= SCALE_TOLERANCE for error in told]
    rooms = sum((one.rooms for one in scores), NONE)
    return {
        "set": "synthetic",
        "part": name,
        "sheets": len(group),
        "not read": sum(one.reading.storey is None for one in group),
        "wall IoU": statistics.fmean(one.wall_iou for one in scores),
        "wall recall": statistics.fmean(one.wall_recall for one in scores),
        "openings F1": sum((one.openings for one in scores), NONE).f1,
        "of any kind": sum((one.any_kind for one in scores), NONE).f1,
        "doors F1": sum((one.doors for one in scores), NONE).f1,
        "windows F1": sum((one.windows for one in scores), NONE).f1,
        "rooms right": rooms.recall,
        "rooms' shapes": sum((one.shapes for one in scores), NONE).recall,
        "rooms F1": rooms.f1,
        "scale within 1 %": statistics.fmean(near) if near else None,
        "seconds": statistics.median(one.reading.seconds for one in group),
    }


def _timed(jobs: int) -> str:
    at_once = "one plan at a time" if jobs == 1 else f"{jobs} plans at a time"
    return f"Seconds: of the whole verb, {at_once}. Asked for: 20 with one at a time on two cores."


def main() -> None:
    """The command line."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("sets", nargs="*", help=f"synthetic, {', '.join(REAL)}")
    parser.add_argument("--seeds", type=seeds, default=TEST_SEEDS)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--pictures", type=Path)
    parser.add_argument("--work", type=Path)
    parser.add_argument(
        "--house", action="store_true", help="synthetic: the house too, not only plan.json"
    )
    arguments = parser.parse_args()
    every = ["synthetic", *REAL]
    unknown = set(arguments.sets) - set(every)
    if unknown:
        parser.error(f"no such set: {', '.join(sorted(unknown))}")
    chosen = arguments.sets or every
    rows: list[Row] = []
    if "synthetic" in chosen:
        judged = judge_synthetic(
            arguments.seeds, arguments.jobs, arguments.pictures, arguments.house, arguments.work
        )
        rows += synthetic_rows(judged)
    for name, measure in REAL.items():
        if name in chosen:
            rows += measure(arguments.jobs, arguments.pictures)
    if set(chosen) == set(REAL):
        keep_or_print("plan-real", rows, (*REAL_NOTES, _timed(arguments.jobs)), keep=True)
    elif chosen == ["synthetic"]:
        keep_or_print("plan-synthetic", rows, NOTES, keep=arguments.seeds == TEST_SEEDS)
    else:
        keep_or_print("plan", rows, (*NOTES, *REAL_NOTES), keep=False)


if __name__ == "__main__":
    main()
