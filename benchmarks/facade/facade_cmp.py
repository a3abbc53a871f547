"""How well facades of many countries and ages are read: the CMP set.

    python benchmarks facade/facade_cmp [--images N]

Reads every third picture of `facades/cmp` of $VEDUTA_DATA (else ../shared/data). No part of the set
is held out: the cues for windows were chosen with this third in view, others with the rest.
There are no bounds: the project asks for none here, and the table shows how far the reading carries
beyond Paris. A run over a part of the pictures is printed and not kept.
"""

from __future__ import annotations

import argparse
import os
from pathlib import Path

import numpy as np
from facade_measures import Matches, accuracy, confusion, match
from facade_reading import Reading, boxes_of, read_facades
from facade_truth import SPECK_PX, cmp, components
from record import Row, keep_or_print

from veduta.facade.document import CLASSES, FacadeClass

DATA = Path(os.environ.get("VEDUTA_DATA", Path(__file__).parents[3] / "shared" / "data"))
KINDS: tuple[FacadeClass, ...] = ("window", "balcony", "door", "shop")


def main() -> None:
    """Read, compare, print and record."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--images", type=int, help="no more than N; nothing is kept")
    some = parser.parse_args().images
    examples = cmp(DATA)[:some]
    readings = read_facades([example.image for example in examples])
    counts = [confusion(r.labels, e.labels) for r, e in zip(readings, examples, strict=True)]
    rows: list[Row] = [
        {
            "measure": "pixel accuracy, mean of images",
            "F1": float(np.mean([accuracy(c) for c in counts])),
        },
        {"measure": "pixel accuracy, all pixels", "F1": accuracy(np.sum(counts, axis=0))},
    ]
    for kind in KINDS:
        total = Matches(0, 0, 0)
        for reading, example in zip(readings, examples, strict=True):
            true = components(example.labels, CLASSES.index(kind), SPECK_PX)
            total += match(_boxes(reading, kind), true)
        rows.append(
            {
                "measure": f"{kind}, IoU 0.5",
                "F1": total.f1,
                "precision": total.precision,
                "recall": total.recall,
                "true": total.true,
                "found": total.found,
            }
        )
    refused = [e.name for e, r in zip(examples, readings, strict=True) if r.document is None]
    notes = [
        f"{len(examples)} images of cmp; refused as no facade: {', '.join(refused) or 'none'}.",
        "Accuracy (in the column F1) is over wall, window, balcony, door and shop alone: the set "
        "does not tell sky and roof. Blinds and shutters are left open.",
        f"A true rectangle is a connected component (4 neighbours) of {SPECK_PX} px and more.",
    ]
    keep_or_print("facade-cmp", rows, notes, some is None)


def _boxes(reading: Reading, kind: FacadeClass) -> np.ndarray:
    return boxes_of(reading.document, kind) if reading.document else np.zeros((0, 4))


if __name__ == "__main__":
    main()
