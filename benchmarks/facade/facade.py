"""How well real facades are read: pixels, windows, storeys, and the time of every step.

    python benchmarks facade/facade [ecp] [artdeco] [time] [--split train|val] [--images N]
                                [--pictures DIR]

Reads `facades/ecp` and `facades/artdeco` of $VEDUTA_DATA (else ../shared/data). A run over a part
of a set, or over the train split, is printed and not kept. `--pictures` writes a sheet for every
image (photo, what was found, the truth): of other people's pixels, so never into the repository.
"""

from __future__ import annotations

import argparse
import os
import statistics
import tempfile
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from facade_measures import (
    Counts,
    Matches,
    accuracy,
    class_table,
    confusion,
    match,
)
from facade_reading import OPTIONS, Reading, read_facades
from facade_sheets import write_sheet
from facade_truth import (
    SPECK_PX,
    WINDOW,
    Labelled,
    Labels,
    artdeco,
    components,
    ecp,
    horizontal_bands,
    position_template,
    resized,
    true_storeys,
)
from record import Row, keep_or_print

from veduta.facade.document import FacadeClass
from veduta.facade.pipeline import reconstruct, write_building
from veduta.run.report import StepRecord

DATA = Path(os.environ.get("VEDUTA_DATA", Path(__file__).parents[3] / "shared" / "data"))
TIME_BOUND_S = 2.0


@dataclass(frozen=True)
class Judged:
    """One image's measures; `counts` by baseline are under the baselines' names."""

    name: str
    counts: dict[str, Counts]
    windows: dict[str, Matches]
    storeys: tuple[int, int]
    reason: str


@dataclass(frozen=True)
class Bounds:
    """The least values that the project asks of a set; None where it asks for none."""

    accuracy: float
    window_f1: float | None = None
    storeys: float | None = None


FOUND, TEMPLATE, BANDS, ROWS = "found", "position template", "perfect bands", "perfect rows"
BASELINES = (TEMPLATE, BANDS, ROWS)
BAND_CLASSES: tuple[FacadeClass, ...] = ("sky", "roof", "wall", "shop")
ELEMENTS = "windows of facade.json"
ALSO = {
    "windows of labels.png": (1, "connected components on both sides"),
    f"windows, truth of {SPECK_PX} px and more": (SPECK_PX, "without slivers beside balconies"),
}


def judge(example: Labelled, reading: Reading, template: Labels) -> Judged:
    """Compare one reading with its truth."""
    true = example.labels
    labels = {
        FOUND: reading.labels,
        TEMPLATE: resized(template, true.shape[1::-1]),
        BANDS: horizontal_bands(true, BAND_CLASSES),
        ROWS: horizontal_bands(true),
    }
    windows = components(true, WINDOW)
    seen = [reading.windows, components(reading.labels, WINDOW), reading.windows]
    against = [windows, windows, components(true, WINDOW, SPECK_PX)]
    names = [ELEMENTS, *ALSO]
    return Judged(
        example.name,
        {name: confusion(found, true) for name, found in labels.items()},
        {n: match(f, t) for n, f, t in zip(names, seen, against, strict=True)},
        (reading.document.storeys if reading.document else 0, true_storeys(true)),
        reading.reason,
    )


def judge_all(examples: Sequence[Labelled], pictures: Path | None) -> list[Judged]:
    """Read all images in two processes and judge them."""
    template = position_template(ecp(DATA, "train"))
    readings = read_facades([example.image for example in examples])
    judged = []
    for example, reading in zip(examples, readings, strict=True):
        judged.append(judge(example, reading, template))
        if pictures is not None:
            write_sheet(pictures / f"{example.name}.jpg", example, reading)
    return judged


def number_rows(judged: Sequence[Judged], bounds: Bounds) -> list[Row]:
    """The whole set's numbers beside the bounds and the baselines."""
    means, pooled = {}, {}
    for name in (FOUND, *BASELINES):
        each = [j.counts[name] for j in judged]
        means[name] = float(np.mean([accuracy(counts) for counts in each]))
        pooled[name] = accuracy(np.sum(each, axis=0))
    rows: list[Row] = [
        {**_number(f"pixel accuracy, {how}", values.pop(FOUND), bounds.accuracy), **values}
        for how, values in (("mean of images", means), ("all pixels", pooled))
    ]
    for name in (ELEMENTS, *ALSO):
        total = sum((j.windows[name] for j in judged), Matches(0, 0, 0))
        rows.append(_number(f"{name}: F1", total.f1, bounds.window_f1))
        right = f"{total.matched} of"
        rows.append(_number(f"{name}: precision ({right} {total.found})", total.precision))
        rows.append(_number(f"{name}: recall ({right} {total.true})", total.recall))
    counted = sum(found == true for found, true in (j.storeys for j in judged))
    needed = None if bounds.storeys is None else bounds.storeys * len(judged)
    rows.append(_number(f"storey counts right, of {len(judged)}", counted, needed))
    return rows


def _number(name: str, value: float, bound: float | None = None) -> Row:
    if bound is None:
        return {"measure": name, FOUND: value}
    verdict = "met" if value >= bound else "missed"
    return {"measure": name, FOUND: value, "at least": bound, "bound": verdict}


def class_rows(judged: Sequence[Judged]) -> list[Row]:
    """The per-class table over all pixels, with the baselines' recall."""
    totals = {n: np.sum([j.counts[n] for j in judged], axis=0) for n in (FOUND, *BASELINES)}
    recall = {n: {r.name: r.recall for r in class_table(totals[n])} for n in BASELINES}
    return [
        {
            "class": row.name,
            "share": row.share,
            "recall": row.recall,
            "precision": row.precision,
            "IoU": row.iou,
            "taken for": row.taken_for,
            **{f"recall, {name}": recall[name][row.name] for name in BASELINES},
        }
        for row in class_table(totals[FOUND])
    ]


def image_rows(judged: Sequence[Judged]) -> list[Row]:
    """One row for each image."""
    return [
        {
            "image": j.name,
            "accuracy": accuracy(j.counts[FOUND]),
            "window F1": j.windows[ELEMENTS].f1,
            "windows right": j.windows[ELEMENTS].matched,
            "windows found": j.windows[ELEMENTS].found,
            "windows true": j.windows[ELEMENTS].true,
            "storeys found": j.storeys[0],
            "storeys true": j.storeys[1],
            "not found": j.reason or None,
        }
        for j in judged
    ]


def report(name: str, what: str, judged: Sequence[Judged], bounds: Bounds, keep: bool) -> None:
    """Print and keep the three tables of a set."""
    notes = [
        f"{len(judged)} images of {what}, read by default: with the learned eyes, no template.",
        "A chimney counts as roof, on both sides; pixels that the truth leaves open are out.",
        f"{TEMPLATE}: the most frequent label at each place of ecp's train split. {BANDS}: each "
        f"row of the truth all of one class, the best of {', '.join(BAND_CLASSES)}; {ROWS}: the "
        "best of all classes, so balconies that run through and rows of windows are right.",
        "Windows: bounding boxes, matched greedily one to one at an intersection over union of "
        "0.5; a true window is a connected component (4 neighbours), however small.",
        *(f"{also}: {how}." for also, (_, how) in ALSO.items()),
        "True storeys: the ground floor and the rows of windows between it and the eaves; the rule "
        "is `true_storeys` in facade_truth.py.",
    ]
    keep_or_print(name, number_rows(judged, bounds), notes, keep)
    keep_or_print(f"{name}-classes", class_rows(judged), notes[:3], keep)
    keep_or_print(f"{name}-images", image_rows(judged), notes[:2], keep)


def times(examples: Sequence[Labelled], keep: bool) -> None:
    """Wall seconds per step, one image after the other in this process, files and all."""
    seconds: dict[str, list[float]] = {}
    load = os.getloadavg()[0]
    with tempfile.TemporaryDirectory() as folder:
        for i, example in enumerate([examples[0], *examples]):
            steps: list[StepRecord] = []
            place = Path(folder) / str(i)
            place.mkdir()
            cpu = time.process_time()
            building = reconstruct(example.image, OPTIONS, example.name, steps)
            write_building(building, place, steps)
            if i == 0:
                continue  # start-up: what libraries do once
            for step in steps:
                seconds.setdefault(step.name, []).append(step.seconds)
            cpu = time.process_time() - cpu
            seconds.setdefault("processor time, all threads", []).append(cpu)
            seconds.setdefault("in all", []).append(sum(step.seconds for step in steps))
    rows: list[Row] = [
        {"step": name, "median s": statistics.median(values), "max s": max(values)}
        for name, values in seconds.items()
    ]
    slowest = max(seconds["in all"])
    verdict = "met" if slowest < TIME_BOUND_S else "missed"
    rows[-1] = {**rows[-1], "less than": TIME_BOUND_S, "bound": verdict}
    notes = [
        f"{len(examples)} images of ecp (val), one after the other in one process after start-up, "
        "from the file to all files of the result but the report.",
        f"Bound: the slowest image. The machine's load average at the start was {load:.1f}: other "
        "work on the same cores lengthens the wall times, not the processor time.",
    ]
    keep_or_print("facade-time", rows, notes, keep)


def main() -> None:
    """Run the named parts, all by default."""
    parser = argparse.ArgumentParser(description=__doc__)
    parts = ["ecp", "artdeco", "time"]
    parser.add_argument("parts", nargs="*", choices=[*parts, []], default=[])
    parser.add_argument("--split", choices=["train", "val"], default="val", help="of ecp")
    parser.add_argument("--images", type=int, help="no more than N of each set; nothing is kept")
    parser.add_argument("--pictures", type=Path, help="folder for sheets to look at")
    arguments = parser.parse_args()
    wanted = arguments.parts or parts
    if arguments.pictures is not None:
        arguments.pictures.mkdir(parents=True, exist_ok=True)
    some = slice(arguments.images)
    whole = arguments.images is None
    if "ecp" in wanted:
        bounds = Bounds(accuracy=0.72, window_f1=0.55, storeys=17 / 20)
        judged = judge_all(ecp(DATA, arguments.split)[some], arguments.pictures)
        keep = whole and arguments.split == "val"
        report("facade-ecp", f"ecp, {arguments.split} split", judged, bounds, keep)
    if "artdeco" in wanted:
        judged = judge_all(artdeco(DATA)[some], arguments.pictures)
        report("facade-artdeco", "artdeco", judged, Bounds(accuracy=0.65), whole)
    if "time" in wanted:
        times(ecp(DATA, "val")[some], whole)


if __name__ == "__main__":
    main()
