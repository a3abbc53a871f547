"""Where fronts end before the picture's border: slivers without windows beside the outermost ones.

    python benchmarks facade/margins [--kept FILE] [--most 60] [--draft]

`houses_marked.json` has borders between houses on pictures of CMP, marked by eye. Those beyond the
outermost windows are looked for here; the step was looked at on two thirds of the pictures. What is
cut where nothing is marked is told, too: mostly sky beside houses that stand alone.
"""

from __future__ import annotations

import argparse
import json
import os
from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from kept_lines import kept_of
from record import Row, keep_or_print

from veduta.facade.evidence import gather
from veduta.facade.eyes import believed, look, seen_elements
from veduta.facade.houses import HouseParameters, storey_of
from veduta.facade.margins import MarginParameters, end_of, outermost
from veduta.facade.party_signs import fronts_of
from veduta.facade.seen_boxes import in_crop
from veduta.imaging.padding import inside_photo
from veduta.imaging.read import read_image

HERE = Path(__file__).parent
DATA = Path(os.environ.get("VEDUTA_DATA", HERE.parents[2] / "shared" / "data"))
UNSEEN = slice(35, None, 3)
"""Which of the marked pictures the step was not looked at on."""
NEAR_WIDTHS, NEAR_STOREYS = 0.02, 0.1
"""An end that is found lies so near its mark, one or the other."""
Margin = dict[str, Any]


def main() -> None:
    """Look, compare, record."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--kept", type=Path, help="where what was found is kept as it comes")
    parser.add_argument("--most", type=int, help="look at no more than so many pictures")
    parser.add_argument("--draft", action="store_true", help="keep nothing")
    call = parser.parse_args()
    marks = json.loads((HERE / "houses_marked.json").read_text("utf-8"))
    found = kept_of(list(marks), call.kept, call.most, margins_of)
    unseen = set(list(marks)[UNSEEN])
    rows = [
        row_of("not looked at", [name for name in found if name in unseen], found, marks),
        row_of("looked at", [name for name in found if name not in unseen], found, marks),
    ]
    keep_or_print("facade-margins", rows, [LEGEND], not call.draft)


LEGEND = (
    "marked: borders beyond the outermost windows; found: within 2 % of the width or a tenth of a"
    " storey; beside: elsewhere in that margin; cut where none is marked, in storeys in the median,"
    " of so many margins."
)


def margins_of(name: str) -> list[Margin]:
    """The margins of a picture as shares of its width, and where the front ends in each."""
    p = MarginParameters()
    pixels = read_image(DATA / "facades/cmp" / f"{name}.jpg").pixels
    evidence, seen = gather(pixels, inside_photo(pixels)), look(pixels)
    size = evidence.width, evidence.height
    elements = in_crop(believed(seen_elements(seen), seen), evidence.px_per_rectified, 0, size)
    windows = [e for e in elements if e.kind == "window" and e.score > p.seen]
    if len(windows) < HouseParameters().windows:
        return []
    fronts = fronts_of(evidence, seen, windows, storey_of(windows))
    first, last = outermost(windows, p)
    found: list[Margin] = []
    for border, window in ((0, first), (evidence.width, last)):
        end = end_of(fronts, (border, window), p)
        found.append(
            {
                "border": border / evidence.width,
                "window": window / evidence.width,
                "storey": fronts.storey / evidence.width,
                "end": None if end is None else end / evidence.width,
            }
        )
    return found


def row_of(
    title: str, names: Sequence[str], found: dict[str, list[Margin]], marks: dict[str, Any]
) -> Row:
    """What is found of the marked ends of some pictures."""
    counts: Counter[str] = Counter()
    cuts: list[float] = []
    for name in names:
        for one in found[name]:
            low, high = sorted((one["border"], one["window"]))
            if any(low - 0.02 < x < high + 0.02 for x in marks[name]["unsure"]):
                continue
            own = [x for x in marks[name]["borders"] if low - 0.01 < x < high + 0.01]
            counts["margins"] += 1
            counts["marked"] += bool(own)
            if one["end"] is None:
                continue
            if not own:
                cuts.append(abs(one["end"] - one["border"]) / one["storey"])
                continue
            mark = min(own, key=lambda x: abs(x - one["window"]))
            near = max(NEAR_WIDTHS, NEAR_STOREYS * one["storey"])
            counts["found" if abs(one["end"] - mark) < near else "beside"] += 1
    return {
        "pictures": title,
        "number": len(names),
        "marked": counts["marked"],
        "found": counts["found"],
        "beside": counts["beside"],
        "other margins": counts["margins"] - counts["marked"],
        "cut": len(cuts),
        "by (storeys)": round(float(np.median(cuts)), 2) if cuts else None,
    }


if __name__ == "__main__":
    main()
