"""Passages through houses, in held-out photos of streets; and openings beside them.

    python benchmarks facade/passages [--kept FILE] [--most 20] [--draft]

`facades/street-cc0-boxes` has boxes of arches: ways through the house, level ones too. Every fifth
photo was held out of the training of the eyes, and no constant was chosen on it. Photos are
rectified and read, what was found is brought back into the photo, its upright box compared. What
was read of each photo is kept in FILE as it comes.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np
from facade_eyes import Boxed, _in_photo, _photos
from facade_measures import Matches, match
from facade_reading import STREET, read_facade
from facade_truth import Boxes
from kept_lines import kept_of
from PIL import Image
from record import Row, keep_or_print

CODE = 2
"""Of arches in the labels."""
Found = dict[str, list[list[float]]]


def main() -> None:
    """Read, compare, print and record."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--kept", type=Path, help="where what was read is kept as it comes")
    parser.add_argument("--most", type=int, help="read no more than so many photos")
    parser.add_argument("--draft", action="store_true", help="keep nothing")
    call = parser.parse_args()
    photos = {one.image.stem: one for one in _photos("boxes")}
    found = kept_of(list(photos), call.kept, call.most, lambda name: _read(photos[name].image))
    rows = [
        _passages(photos, found),
        *(_others(photos, found, kind) for kind in ("window", "door")),
    ]
    notes = [f"{len(found)} photos; IoU 0.5. Doors that are passages count as these alone."]
    keep_or_print("facade-passages", rows, notes, len(found) == len(photos) and not call.draft)


def _read(path: Path) -> Found:
    """Boxes in the photo, by what they are of."""
    document = read_facade(path, STREET).document
    if document is None:
        return {"window": [], "door": [], "passage": []}
    through = [e for e in document.elements if e.passage]
    others = [e for e in document.elements if not e.passage]
    doors = document.model_copy(update={"elements": others})
    passages = document.model_copy(update={"elements": through})
    return {
        "window": _in_photo(document, "window").tolist(),
        "door": _in_photo(doors, "door").tolist(),
        "passage": _in_photo(passages, "door").tolist(),
    }


def _true_passages(path: Path) -> Boxes:
    labels = path.parents[1] / "labels" / f"{path.stem}.txt"
    with Image.open(path) as image:
        size = np.array(image.size * 2)
    found = []
    for line in labels.read_text().splitlines():
        code, x, y, w, h = map(float, line.split())
        if int(code) == CODE:
            found.append([x - w / 2, y - h / 2, x + w / 2, y + h / 2])
    return np.asarray(np.array(found).reshape(-1, 4) * size, np.float64)


def _passages(photos: dict[str, Boxed], found: dict[str, Found]) -> Row:
    total, with_some, false = Matches(0, 0, 0), 0, 0
    for name, boxes in found.items():
        true = _true_passages(photos[name].image)
        total += match(np.array(boxes["passage"]).reshape(-1, 4), true)
        with_some += bool(len(true))
        false += bool(boxes["passage"]) and not len(true)
    return {
        "what": "passage",
        **_measures(total),
        "photos with": with_some,
        "photos without that got one": false,
    }


def _others(photos: dict[str, Boxed], found: dict[str, Found], kind: str) -> Row:
    total = Matches(0, 0, 0)
    for name, boxes in found.items():
        total += match(np.array(boxes[kind]).reshape(-1, 4), photos[name].boxes[kind])
    return {"what": kind, **_measures(total)}


def _measures(total: Matches) -> Row:
    return {
        "F1": total.f1,
        "precision": total.precision,
        "recall": total.recall,
        "true": total.true,
        "found": total.found,
    }


if __name__ == "__main__":
    main()
