"""Photos whose true boxes do not lie where the openings are: to be left out of what is measured.

    python benchmarks facade/shifted_boxes [--kept FILE] [--most 20] [--draft]

Of each held-out photo of `facades/street-cc0-boxes`, and of `facades/street-cc0`, the true windows
and doors are laid over the boxes that the eyes mark in the photo as it is, moved by up to 1.2 of
their median sizes either way. A photo is told as shifted where another place has more than a
quarter more of them than their own place, at an intersection over union of 0.4; and as doubtful
where less than half of them match anywhere.
"""

from __future__ import annotations

import argparse
from itertools import product
from pathlib import Path

import numpy as np
from facade_eyes import _photos
from facade_measures import match
from facade_truth import Boxes
from kept_lines import kept_of
from record import Row, keep_or_print

from veduta.facade.eyes import look, seen_elements
from veduta.imaging.read import read_image

SETS = ("boxes", "street")
LEAST, GAIN, FEW = 0.4, 0.25, 0.5
STEPS = np.linspace(-1.2, 1.2, 13)
SURE = 0.3
Counted = dict[str, int | float]


def main() -> None:
    """Look, move, print and record."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--kept", type=Path, help="where what was counted is kept as it comes")
    parser.add_argument("--most", type=int, help="look at no more than so many photos")
    parser.add_argument("--draft", action="store_true", help="keep nothing")
    call = parser.parse_args()
    photos = {f"{name} {one.image.stem}": one for name in SETS for one in _photos(name, True)}

    def counted(key: str) -> Counted:
        one = photos[key]
        return _counted(one.image, np.concatenate([one.boxes["window"], one.boxes["door"]]))

    found = kept_of(list(photos), call.kept, call.most, counted)
    rows = [_row(name, {k: v for k, v in found.items() if k.startswith(name)}) for name in SETS]
    is_whole = len(found) == len(photos)
    keep_or_print("facade-shifted-boxes", rows, _named(found), is_whole and not call.draft)


def _counted(path: Path, true: Boxes) -> Counted:
    """How many true boxes match where they are, and at most; by what they are moved for that."""
    if not len(true):
        return {"true": 0, "here": 0, "most": 0, "across": 0.0, "down": 0.0}
    seen = seen_elements(look(read_image(path).pixels))
    marked = [e for e in seen if e.kind in ("window", "shop", "door") and e.score > SURE]
    boxes = np.array([[e.x0, e.y0, e.x1, e.y1] for e in marked]).reshape(-1, 4)
    size = np.median(true[:, 2:] - true[:, :2], axis=0)
    here = match(boxes, true, LEAST).matched
    most, across, down = here, 0.0, 0.0
    for x, y in product(STEPS.tolist(), STEPS.tolist()):
        there = match(boxes, true + np.tile(np.array([x, y]) * size, 2), LEAST).matched
        if there > most:
            most, across, down = there, x, y
    return {"true": len(true), "here": here, "most": most, "across": across, "down": down}


def _is_shifted(one: Counted) -> bool:
    return one["most"] - one["here"] > GAIN * one["true"]


def _is_doubtful(one: Counted) -> bool:
    return one["most"] < FEW * one["true"]


def _row(name: str, found: dict[str, Counted]) -> Row:
    return {
        "set": name,
        "photos": len(found),
        "true": sum(one["true"] for one in found.values()),
        "matched in place": sum(one["here"] for one in found.values()),
        "shifted": sum(map(_is_shifted, found.values())),
        "doubtful": sum(map(_is_doubtful, found.values())),
    }


def _named(found: dict[str, Counted]) -> list[str]:
    """The photos to be left out, by name."""
    return [
        f"{key}: {one['here']} of {one['true']} in place, {one['most']} when moved by"
        f" {one['across']:.1f} widths and {one['down']:.1f} heights."
        for key, one in found.items()
        if _is_shifted(one) or _is_doubtful(one)
    ] or ["No photo is shifted or doubtful: none is left out."]


if __name__ == "__main__":
    main()
