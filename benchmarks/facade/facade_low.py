"""How many storeys are found of low houses, and whether a wrong count is told as doubtful.

    python benchmarks facade/facade_low [--images N]

The labelled sets hold tall houses. Each picture of `facades/ecp` (val) of $VEDUTA_DATA (else
../shared/data) is made into houses of two to four storeys: the lower upper floors are cut out,
and its roof and highest floors are set on its ground floor. There are no bounds. A run over a part
of the pictures is printed and not kept.
"""

from __future__ import annotations

import argparse
import os
import tempfile
from pathlib import Path

import numpy as np
from facade_reading import Reading, read_facades
from facade_truth import Labelled, ecp, window_rows
from PIL import Image
from record import Row, keep_or_print

DATA = Path(os.environ.get("VEDUTA_DATA", Path(__file__).parents[3] / "shared" / "data"))
STOREYS = (2, 3, 4)


def main() -> None:
    """Cut, read, count, print and record."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--images", type=int, help="no more than N; nothing is kept")
    some = parser.parse_args().images
    examples = ecp(DATA, "val")[:some]
    rows: list[Row] = []
    with tempfile.TemporaryDirectory() as folder:
        for storeys in STOREYS:
            files = [_lowered(example, storeys, Path(folder)) for example in examples]
            rows.append(_row(storeys, read_facades([file for file in files if file])))
    notes = [
        "Paris facades with floors taken out, each with its own roof and ground floor.",
        "Doubtful: the result says so of its storeys, in its line, report and document.",
    ]
    keep_or_print("facade-low", rows, notes, some is None)


def _lowered(example: Labelled, storeys: int, folder: Path) -> Path | None:
    """The picture with so many storeys; None where it has no more than that."""
    rows = window_rows(example.labels)
    if len(rows) + 1 <= storeys:
        return None
    with Image.open(example.image) as image:
        pixels = np.asarray(image.convert("RGB"))
    kept, ground = round(rows[storeys - 2]), round(rows[-1])
    path = folder / f"{example.name}-{storeys}.png"
    Image.fromarray(np.concatenate([pixels[:kept], pixels[ground:]])).save(path)
    return path


def _row(storeys: int, readings: list[Reading]) -> Row:
    found = [reading.document for reading in readings if reading.document]
    wrong = [document for document in found if document.storeys != storeys]
    return {
        "storeys": storeys,
        "images": len(readings),
        "right": len(found) - len(wrong),
        "wrong, told as doubtful": sum(document.storeys_doubtful for document in wrong),
        "wrong, not told": sum(not document.storeys_doubtful for document in wrong),
        "wrong by one": sum(abs(document.storeys - storeys) == 1 for document in wrong),
        "refused": len(readings) - len(found),
    }


if __name__ == "__main__":
    main()
