"""Shutters and blinds of windows, on labelled pictures that nothing was trained or chosen on.

    python benchmarks facade/shutters [--kept FILE] [--most 20] [--first N --last M] [--draft]

CMP labels what closes windows ("blind"); pictures from b0241 on were held out of the training of
the eyes. Shutters that lie side by side are one there, so what is found is joined where it touches,
and matched at an intersection over union of 0.5; beside it the shares of the pixels. What was read
of each picture is kept in FILE as it comes. Other numbers of pictures are for choosing constants.
"""

from __future__ import annotations

import argparse
import os
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from facade_measures import Matches, match
from facade_truth import SPECK_PX, components
from kept_lines import kept_of
from numpy.typing import NDArray
from PIL import Image
from record import Row, keep_or_print

from veduta.facade.analyse_seen import analyse_seen
from veduta.facade.document import Source
from veduta.facade.eyes import look
from veduta.facade.options import FacadeOptions, RectifyOptions
from veduta.facade.rectify import rectify
from veduta.facade.seen_shutters import seen_shutters
from veduta.imaging.read import read_image
from veduta.run.errors import NotFoundError

DATA = Path(os.environ.get("VEDUTA_DATA", Path(__file__).parents[3] / "shared" / "data"))
HELD_FROM, LAST = 241, 300
CMP_BLIND = 8
OPTIONS = FacadeOptions(rectify=RectifyOptions(rectified=True))
Found = dict[str, list[list[float]]]
"""Boxes (left, top, right, bottom) by kind of shutter."""


def main() -> None:
    """Read, compare, print and record."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--kept", type=Path, help="where what was read is kept as it comes")
    parser.add_argument("--most", type=int, help="read no more than so many pictures")
    parser.add_argument("--first", type=int, default=HELD_FROM, help="number of the first picture")
    parser.add_argument("--last", type=int, default=LAST)
    parser.add_argument("--draft", action="store_true", help="keep nothing")
    call = parser.parse_args()
    names = [f"cmp_b{number:04d}" for number in range(call.first, call.last + 1)]
    found = kept_of(names, call.kept, call.most, _read)
    is_whole = (call.first, call.last, len(found)) == (HELD_FROM, LAST, len(names))
    keep_or_print("facade-shutters", [_row(found)], [_told(found)], is_whole and not call.draft)


def _read(name: str) -> Found:
    """What is found in a picture."""
    path = DATA / "facades/cmp" / f"{name}.jpg"
    photo = read_image(path)
    height, width = photo.pixels.shape[:2]
    source = Source(image=path.name, sha256=photo.sha256, width_px=width, height_px=height)
    rectified = rectify(photo, OPTIONS.rectify)
    seen = look(rectified.pixels)
    boxes: Found = {"open": [], "closed": []}
    try:
        document, _ = analyse_seen(rectified, source, OPTIONS, seen=seen)
    except NotFoundError:
        return boxes
    for one in seen_shutters(seen, document):
        right, foot = one.x_px + one.width_px, one.y_px + one.height_px
        boxes[one.kind].append([one.x_px, one.y_px, right, foot])
    return boxes


def _labels(name: str) -> NDArray[np.uint8]:
    """(h, w) 1 where CMP has a blind."""
    with Image.open(DATA / "facades/cmp" / f"{name}.png") as image:
        return np.asarray(np.array(image) == CMP_BLIND, np.uint8)


def _drawn(boxes: Sequence[Sequence[float]], shape: tuple[int, ...]) -> NDArray[np.uint8]:
    """(h, w) 1 inside of the boxes."""
    mask = np.zeros(shape, np.uint8)
    for x0, y0, x1, y1 in boxes:
        mask[round(y0) : round(y1), round(x0) : round(x1)] = 1
    return mask


def _row(found: dict[str, Found]) -> Row:
    total, shared, drawn, labelled = Matches(0, 0, 0), 0, 0, 0
    with_some, without, false = 0, 0, 0
    for name, boxes in found.items():
        true = _labels(name)
        mask = _drawn([*boxes["open"], *boxes["closed"]], true.shape)
        total += match(components(mask, 1, SPECK_PX), components(true, 1, SPECK_PX), 0.5)
        shared += int((mask & true).sum())
        drawn, labelled = drawn + int(mask.sum()), labelled + int(true.sum())
        with_some += bool(true.any())
        without += not true.any()
        false += bool(mask.any()) and not true.any()
    return {
        "pictures": len(found),
        "with shutters": with_some,
        "true": total.true,
        "found": total.found,
        "F1": total.f1,
        "precision": total.precision,
        "recall": total.recall,
        "pixels precision": shared / max(1, drawn),
        "pixels recall": shared / max(1, labelled),
        "without": without,
        "of these with some found": false,
        "open": sum(len(boxes["open"]) for boxes in found.values()),
        "closed": sum(len(boxes["closed"]) for boxes in found.values()),
    }


def _told(found: dict[str, Found]) -> str:
    return (
        f"CMP {min(found)} to {max(found)}. Labels have blinds, open and closed shutters, and"
        " awnings as one class; only those of windows that were read are looked for."
    )


if __name__ == "__main__":
    main()
