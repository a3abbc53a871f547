"""How many plans in hands that the reader was not built for become whole houses to walk in.

    python benchmarks plan/plan_hands FOLDER [--seeds A..B] [--hands agent] [--most N] [--keep]

The sheets are `veduta.synthetic.plans.hands`: a seller's, a builder's, an agent's, a Japanese plan,
an old scan, an ink sketch on a photo. Each goes through `veduta plan` as anybody calls it. They
were drawn by somebody who had not yet looked at how the reader finds walls. What was judged stands
in `judged.jsonl` of FOLDER, so that a run that was broken off, or read N sheets, goes on.
"""

from __future__ import annotations

import argparse
import json
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np
from kept_lines import kept_of
from PIL import Image
from plan_scores import Hits, Score, score
from plan_sets import seeds
from plan_truth import found_layout, true_layout
from record import Row, keep_or_print

from veduta.plan.document import Storey
from veduta.plan.options import PlanOptions
from veduta.plan.pipeline import run_plan
from veduta.plan.tour.stops import is_cupboard
from veduta.run.progress import Progress
from veduta.synthetic.plans.hands import HANDS, hand_drawn

SEEDS = range(52_000, 52_004)
OF_ROOMS = 0.85
MISSED = 1
TOLERANCE = 0.01
NOTES = (
    "Asked for: rooms right 0.85, openings F1 0.75, scale within 1 % on 0.95 of those that say it;"
    " two thirds whole and walkable.",
    "Whole and walkable: rooms as many as are there but for one, 0.85 of them right, and the tour"
    " goes through 0.85 of them.",
    "At the first try on these seeds (rooms right; openings; whole): seller 0.00, 0.59, 0 of 4 (one"
    " not read); builder 0.88, 0.64, 4; agent 1.00, 0.55, 4; madori 0.73, 0.73, 1; scan 0.97, 0.99,"
    " 3; ink 0.94, 0.37, 1 of the first two, the third ended in a traceback, the fourth was not"
    " tried. It was mended on seeds 100 to 103.",
    "A builder's `family / dining` is read as a dining room, of his and the seller's sheets nothing"
    " says the scale. Missed: openings of ink (strokes that waver look like windows), rooms of"
    " madori (baths that stand at walls of two lines look like walls).",
)


@dataclass(frozen=True)
class Judged:
    """A sheet: how it was read, whether it says its scale, and whether the house is whole."""

    score: Score
    says_scale: bool
    whole: bool


def judged(name: str, folder: Path) -> dict[str, object]:
    """Read and build the sheet `HAND-SEED`; what came out stays in FOLDER."""
    hand, _, seed = name.rpartition("-")
    return asdict(_judged(int(seed), hand, folder))


def restored(fields: dict[str, Any]) -> Judged:
    """What `judged` gave."""
    parts: dict[str, Any] = {
        key: Hits(**value) if isinstance(value, dict) else value
        for key, value in fields["score"].items()
    }
    return Judged(Score(**parts), fields["says_scale"], fields["whole"])


def _judged(seed: int, hand: str, folder: Path) -> Judged:
    picture, (truth,) = hand_drawn(seed, hand)
    folder.mkdir(parents=True, exist_ok=True)
    sheet, out = folder / f"{hand}-{seed}.png", folder / f"{hand}-{seed}"
    Image.fromarray(picture).save(sheet)
    layout = true_layout(truth)
    result = run_plan([sheet], out, PlanOptions(), Progress(quiet=True), force=True)
    if result.failure is not None:
        return Judged(score(None, layout), truth.says_scale, whole=False)
    storeys = json.loads((out / "plan.json").read_text())["storeys"]
    storey = Storey.model_validate(storeys[0])
    found = found_layout(storey, truth.px_from_m, truth.walls_drawn == "single-line")
    got = score(found, layout)
    inner = [one for one in storey.rooms if not one.outdoors and not is_cupboard(one)]
    true = len(truth.storey.rooms)
    steps = json.loads((out / "report.json").read_text())["steps"]
    walked = next((step["counts"].get("rooms", 0) for step in steps if step["name"] == "tour"), 0)
    whole = (
        abs(len(inner) - true) <= MISSED
        and got.rooms.recall >= OF_ROOMS
        and walked >= OF_ROOMS * true
    )
    return Judged(got, truth.says_scale, whole)


def row_of(hand: str, every: Sequence[Judged]) -> Row:
    """A hand in a row."""
    rooms = sum((one.score.rooms for one in every), Hits(0, 0, 0))
    openings = sum((one.score.openings for one in every), Hits(0, 0, 0))
    told = [one.score.scale_error for one in every if one.says_scale]
    right = [one is not None and abs(one) <= TOLERANCE for one in told]
    return {
        "hand": hand,
        "sheets": len(every),
        "not read": sum(one.score.wall_iou == 0.0 for one in every),
        "wall IoU": float(np.mean([one.score.wall_iou for one in every])),
        "openings F1": openings.f1,
        "rooms right": rooms.recall,
        "scale within 1 %": float(np.mean(right)) if right else None,
        "whole": sum(one.whole for one in every),
    }


def main() -> None:
    """Read the sheets of all seeds, and print or keep the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--seeds", type=seeds, default=SEEDS)
    parser.add_argument("--hands", nargs="+", choices=HANDS, default=[*HANDS])
    parser.add_argument("--most", type=int, help="so many sheets that were not read yet")
    parser.add_argument("--keep", action="store_true")
    asked = parser.parse_args()
    asked.folder.mkdir(parents=True, exist_ok=True)
    names = [f"{hand}-{seed}" for hand in asked.hands for seed in asked.seeds]
    kept = kept_of(
        names, asked.folder / "judged.jsonl", asked.most, lambda name: judged(name, asked.folder)
    )
    by_hand = {
        hand: [restored(kept[name]) for name in names if name in kept and name.startswith(hand)]
        for hand in asked.hands
    }
    rows = [row_of(hand, every) for hand, every in by_hand.items() if every]
    rows.append(row_of("all", [one for every in by_hand.values() for one in every]))
    keep_or_print("plan-hands", rows, NOTES, asked.keep and len(kept) == len(names))


if __name__ == "__main__":
    main()
