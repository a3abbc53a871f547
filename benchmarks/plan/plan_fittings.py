"""How many drawn fittings are found: baths, toilets, basins, hobs, sinks, beds.

    python benchmarks plan/plan_fittings [--seeds A..B] [--families brochure] [--each]

On sheets of `plan_strangers` that say what is drawn in their rooms, each with its rectangle: a
fitting is right that is of the kind and whose middle lies within the true rectangle, or 0.15 m
beside it. Sheets are read to their documents. Of real plans, what stands there was counted by eye
once; what of it is found is counted, too, where the folder of real data is there. A run over all
seeds is kept as `plan-fittings`.
"""

from __future__ import annotations

import argparse
import tempfile
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

import numpy as np
from PIL import Image
from plan_data import PLANS
from plan_scores import NONE, Hits, matched
from plan_sets import seeds
from plan_strangers import FAMILIES
from plan_truth import scan_from_found
from record import Row, keep_or_print

from veduta.plan.analyse import read_drawings
from veduta.plan.document import Fitting as Found
from veduta.plan.document import Storey
from veduta.plan.options import PlanOptions
from veduta.plan.pages import find_drawings
from veduta.run.errors import NotFoundError
from veduta.synthetic.plans.house import Fitting as True_
from veduta.synthetic.plans.truth_file import SheetTruth

SEEDS = range(32_000, 32_008)
DRAWN = ("brochure", "measured", "working")
KINDS = ("toilet", "basin", "bathtub", "shower", "washer", "hob", "kitchen-sink", "bed")
BESIDE_M = 0.15
BY_EYE: Mapping[str, Mapping[str, int]] = {
    "cases/plan/tf2_123.jpg": {
        "toilet": 1, "basin": 1, "bathtub": 1, "hob": 1, "kitchen-sink": 1,
    },
    "cases/plan/b3d_5.png": {"toilet": 1, "basin": 1, "shower": 1, "hob": 1, "kitchen-sink": 1},
}  # fmt: skip
"""What a person counts on real plans. What is found of a kind counts as right up to so many."""
NOTES = (
    "Right: of the kind, and its middle within the true rectangle or 0.15 m beside it.",
    "By eye: fittings that a person counts on real plans; found ones of a kind are right up to so"
    " many, as nobody noted their places.",
)


def _read(path: Path) -> list[Storey]:
    try:
        read = read_drawings(find_drawings([path], None), PlanOptions(), [], lambda *_: None)
    except NotFoundError:
        return []
    return list(read.document.storeys)


def judged(family: str, seed: int) -> dict[str, Hits]:
    """The fittings of a sheet by kind."""
    picture, truths = FAMILIES[family](seed)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "sheet.png"
        Image.fromarray(picture).save(path)
        storeys = _read(path)
    if len(storeys) != len(truths):
        storeys = []
    hits = dict.fromkeys(KINDS, NONE)
    for place, truth in enumerate(truths):
        found = _in_truth(storeys[place], truth) if storeys else []
        for kind in KINDS:
            own = [at for one, at in found if one.kind == kind]
            true = [one for one in truth.fittings or () if one.kind == kind]
            pairs = [[_at(at, one) for one in true] for at in own]
            right = len(matched(range(len(own)), range(len(true)), _of(pairs)))
            hits[kind] += Hits(right, len(own), len(true))
    return hits


def _in_truth(storey: Storey, truth: SheetTruth) -> list[tuple[Found, np.ndarray]]:
    """What was found, with its middle in metres of the truth."""
    to_truth = np.linalg.inv(truth.px_from_m) @ scan_from_found(storey)
    return [(one, (to_truth @ np.array([*one.at_m, 1.0]))[:2]) for one in storey.fittings]


def _of(table: Sequence[Sequence[float]]) -> Callable[[int, int], float]:
    return lambda row, column: table[row][column]


def _at(found: np.ndarray, true: True_) -> float:
    left, bottom, right, top = true.box_m
    x, y = found.tolist()
    inside = left - BESIDE_M <= x <= right + BESIDE_M and bottom - BESIDE_M <= y <= top + BESIDE_M
    return float(inside)


def by_eye(name: str) -> dict[str, Hits] | None:
    """The fittings of a real plan by kind; None without the data."""
    path = PLANS.parent / name
    if not path.is_file():
        return None
    found = [str(one.kind) for storey in _read(path) for one in storey.fittings]
    true = BY_EYE[name]
    return {
        kind: Hits(min(found.count(kind), true.get(kind, 0)), found.count(kind), true.get(kind, 0))
        for kind in KINDS
    }


def row_of(name: str, sheets: Sequence[Mapping[str, Hits]]) -> Row:
    """A family in a row: all kinds, and the recall of each."""
    by_kind = {kind: sum((one[kind] for one in sheets), NONE) for kind in KINDS}
    whole = sum(by_kind.values(), NONE)
    row: dict[str, str | int | float | bool | None] = {
        "sheets": name, "drawn": whole.true, "recall": whole.recall,
        "precision": whole.precision,
    }  # fmt: skip
    for kind, one in by_kind.items():
        row[kind] = f"{one.right}/{one.true}" if one.true or one.found else None
    return row


def main() -> None:
    """Read the sheets of all seeds; only a run over all is kept."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seeds", type=seeds, default=SEEDS)
    parser.add_argument("--families", nargs="+", choices=DRAWN, default=[*DRAWN])
    parser.add_argument("--each", action="store_true", help="print a line for each sheet")
    asked = parser.parse_args()
    rows = []
    for family in asked.families:
        sheets = []
        for seed in asked.seeds:
            sheets.append(judged(family, seed))
            if asked.each:
                print(seed, row_of(family, sheets[-1:]), flush=True)
        rows.append(row_of(family, sheets))
    whole = list(asked.seeds) == list(SEEDS) and asked.families == [*DRAWN]
    real = [hits for name in BY_EYE if whole and (hits := by_eye(name)) is not None]
    if real:
        rows.append(row_of(f"by eye, {len(real)} real plans", real))
    keep_or_print("plan-fittings", rows, NOTES, keep=whole)


if __name__ == "__main__":
    main()
