"""Synthetic house plans with known truth, for `veduta plan`.

    python benchmarks plan/plan_sets OUT [--seeds A..B] [--style NAME] [--degradation NAME]

Writes SEED-STOREY.png and SEED-STOREY.json for each storey. Seeds from 10000 on are for the final
measurement: they may have styles and degradations that development is not to see.
"""

from __future__ import annotations

import argparse
import json
from pathlib import Path

from PIL import Image

from veduta.synthetic.plans.canvas import Image as Pixels
from veduta.synthetic.plans.degrade import DEGRADATIONS
from veduta.synthetic.plans.sets import sheets_of
from veduta.synthetic.plans.styles import BY_NAME
from veduta.synthetic.plans.truth_file import SheetTruth, to_json

FAULTS = {fault.name: fault for fault in DEGRADATIONS}


def seeds(text: str) -> range:
    """`3..7` with both ends, or `3`."""
    low, _, high = text.partition("..")
    return range(int(low), int(high or low) + 1)


def save_sheet(path: Path, picture: Pixels, truth: SheetTruth) -> None:
    """Write the picture, with its resolution where the sheet bears a ratio."""
    image = Image.fromarray(picture)
    if truth.dpi:
        image.save(path, dpi=(truth.dpi, truth.dpi))
    else:
        image.save(path)


def write_set(out: Path, chosen: range, style: str | None, fault: str | None) -> int:
    """Write the sheets of these seeds; how many there are."""
    out.mkdir(parents=True, exist_ok=True)
    count = 0
    for seed in chosen:
        for picture, truth in sheets_of(
            seed, BY_NAME[style] if style else None, FAULTS[fault] if fault else None
        ):
            save_sheet(out / truth.file, picture, truth)
            text = json.dumps(to_json(truth), indent=1)
            (out / truth.file).with_suffix(".json").write_text(text + "\n")
            count += 1
    return count


def main() -> None:
    """The command line."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("out", type=Path)
    parser.add_argument("--seeds", type=seeds, default=range(0, 20))
    parser.add_argument("--style", choices=sorted(BY_NAME))
    parser.add_argument("--degradation", choices=sorted(FAULTS))
    arguments = parser.parse_args()
    count = write_set(arguments.out, arguments.seeds, arguments.style, arguments.degradation)
    print(f"{count} sheets in {arguments.out}")


if __name__ == "__main__":
    main()
