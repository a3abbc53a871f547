"""How well facades with known truth are rebuilt: photos of synthetic streets, every style.

    python benchmarks facade/synthetic [--seeds N] [--corners] [--detached] [--pictures DIR]

Photos are made anew in each run (deterministic); `--pictures` keeps photo, truth and result of
each beside each other. What the verb is told is what `veduta demo` tells it.
"""

from __future__ import annotations

import argparse
import tempfile
from pathlib import Path

from record import Row, record

from veduta.facade.compare import Comparison, compare
from veduta.facade.compare_picture import comparison_png
from veduta.facade.demo import what_the_user_knows
from veduta.facade.demo_options import DemoOptions
from veduta.facade.pipeline import reconstruct
from veduta.run.errors import NotFoundError
from veduta.run.report import StepRecord
from veduta.synthetic.facade import SyntheticFacade, make_facade
from veduta.synthetic.layout import STYLES
from veduta.synthetic.options import SyntheticOptions


def row_of(name: str, made: SyntheticFacade, options: DemoOptions, pictures: Path | None) -> Row:
    """One photo through the pipeline, beside its truth."""
    steps: list[StepRecord] = []
    with tempfile.TemporaryDirectory() as folder:
        photo = Path(folder) / "street.jpg"
        photo.write_bytes(made.jpeg)
        try:
            building = reconstruct(photo, what_the_user_knows(made, options), name, steps)
        except NotFoundError as error:
            return {"facade": name, "not found": error.evidence}
    comparison = compare(building.document, made.truth)
    if pictures is not None:
        png = comparison_png(made.photo, made.truth, building.document)
        (pictures / f"{name}.png").write_bytes(png)
    slowest = max(steps, key=lambda step: step.seconds)
    return {
        "facade": name,
        **measures(comparison),
        "seconds": sum(step.seconds for step in steps),
        "slowest step": f"{slowest.name} {slowest.seconds:.1f}",
    }


def measures(comparison: Comparison) -> dict[str, str | int | float]:
    """The columns of the table; pairs are found/true."""
    windows = comparison.windows
    return {
        "windows": f"{windows.matched}/{windows.true}",
        "found": windows.found,
        "off house": windows.elsewhere,
        "precision": windows.precision,
        "recall": windows.recall,
        "storeys": f"{comparison.storeys.found:.0f}/{comparison.storeys.true:.0f}",
        "columns": f"{comparison.columns.found:.0f}/{comparison.columns.true:.0f}",
        "width m": f"{comparison.width_m.found:.1f}/{comparison.width_m.true:.1f}",
        "corners off m": comparison.off_m(0.5) if comparison.corners_off_m else -1.0,
        "pixels": comparison.accuracy,
        **{name: value for name, value in comparison.class_recall.items() if name != "sky"},
    }


def main() -> None:
    """Measure, print and record."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("--corners", action="store_true")
    parser.add_argument("--detached", action="store_true")
    parser.add_argument("--pictures", type=Path)
    given = parser.parse_args()
    if given.pictures is not None:
        given.pictures.mkdir(parents=True, exist_ok=True)
    rows = []
    for style in STYLES:
        for seed in range(1, given.seeds + 1):
            made = make_facade(seed, SyntheticOptions(style=style, detached=given.detached))
            options = DemoOptions(seed=seed, corners=given.corners)
            rows.append(row_of(f"{style}-{seed}", made, options, given.pictures))
            print(rows[-1], flush=True)
    name = "synthetic" + ("-corners" if given.corners else "")
    name += "-detached" if given.detached else ""
    record(name, rows, ["windows: IoU 0.5; pairs are found/true; classes: share of true pixels"])


if __name__ == "__main__":
    main()
