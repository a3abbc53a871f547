"""Party walls between the houses of a photo: fitted on some pictures of CMP, measured on others.

    python benchmarks facade/houses [--signs FILE] [--most 20] [--draft]

`houses_marked.json` has where one house ends and the next begins, as shares of the width, marked
by eye in pictures of CMP: those of odd numbers below 240 are fitted to, those from 241 on are
measured. `unsure` are borders that a person is in doubt of; what is near them counts as nothing.
The signs of each picture's columns are kept in FILE as they come. The fit is logistic: a picture's
border counts once, however many columns are near it.

Told for the pictures that were not fitted to: of the borders that have a house (windows enough, and
width) on both sides, how many are found, within 4 % of the width; of all borders, as many are cut
sides; how many pictures of one house are parted, or doubted.
"""

from __future__ import annotations

import argparse
import json
import os
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from kept_lines import kept_of
from logistic import likeliest
from numpy.typing import NDArray
from record import Row, keep_or_print

from veduta.facade.evidence import gather
from veduta.facade.eyes import (
    SeenElement,
    believed,
    look,
    seen_elements,
)
from veduta.facade.houses import (
    HouseParameters,
    PartyWall,
    candidates,
    chance_of,
    chosen,
    house_spans,
    storey_of,
)
from veduta.facade.party_signs import SIGNS, fronts_of
from veduta.facade.seen_boxes import in_crop
from veduta.imaging.padding import inside_photo
from veduta.imaging.read import read_image

HERE = Path(__file__).parent

DATA = Path(os.environ.get("VEDUTA_DATA", HERE.parents[2] / "shared" / "data"))
HELD_FROM = 241
NEAR, FAR, FOUND = 0.02, 0.07, 0.04
"""Shares of the width: a column so near to a mark is a border; one so far from all is none; a
border that is found lies so near."""
RIDGE, PLAIN = 0.02, 0.02
"""Of the fit: of the weights' squares; what a column that is no border counts."""
Float = NDArray[np.float64]


@dataclass(frozen=True)
class Picture:
    """The columns of a picture that may be borders (n,), as shares of its width, with their signs
    (n, 9); windows (k, 4) and a storey, in pixels of the evidence; borders that were marked.
    """

    name: str
    width: int
    storey: float
    at: Float
    signs: Float
    windows: Float
    borders: tuple[float, ...]
    unsure: tuple[float, ...]

    @property
    def is_held_out(self) -> bool:
        """Not fitted to."""
        return int(self.name.removeprefix("cmp_b")) >= HELD_FROM

    @property
    def elements(self) -> list[SeenElement]:
        """The windows."""
        return [SeenElement("window", a, b, c, d, 1.0) for a, b, c, d in self.windows.tolist()]

    @property
    def truth(self) -> NDArray[np.int64]:
        """(n,) 1 at a border, 0 where there is none, -1 where it counts as nothing."""
        found = np.zeros(len(self.at), np.int64)
        for marks, reach, value in (
            (self.unsure, FAR, -1), (self.borders, FAR, -1), (self.borders, NEAR, 1)
        ):  # fmt: skip
            for mark in marks:
                found[np.abs(self.at - mark) < reach] = value
        return found

    def parted(self, own: HouseParameters) -> tuple[list[float], bool]:
        """The borders that are found, as shares of the width; and whether one is doubted."""
        walls = [
            PartyWall(round(x * self.width), chance_of(signs, own))
            for x, signs in zip(self.at.tolist(), self.signs, strict=True)
        ]
        found = chosen(walls, self.storey, own)
        return [w.x / self.width for w in found.walls], found.doubtful is not None

    def houses(self, found: Sequence[float], own: HouseParameters) -> list[tuple[int, int]]:
        """Columns from and to of each house between borders at these shares of the width."""
        walls = [PartyWall(round(x * self.width), 1.0) for x in found]
        return house_spans(walls, self.elements, (0, self.width), self.storey, own)

    def whole_borders(self, own: HouseParameters) -> list[float]:
        """The marked borders that have a house on both sides."""
        spans = self.houses(self.borders, own)
        ends = {a for a, _ in spans} & {b for _, b in spans}
        at = [round(x * self.width) for x in self.borders]
        return [x / self.width for x in at if x in ends]


def main() -> None:
    """Gather, fit, measure, record."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--signs", type=Path, help="where signs are kept as they come")
    parser.add_argument("--most", type=int, help="gather no more than so many pictures")
    parser.add_argument("--draft", action="store_true", help="keep nothing")
    call = parser.parse_args()
    pictures = gathered(call.signs, call.most)
    fitted = [one for one in pictures if not one.is_held_out]
    held = [one for one in pictures if one.is_held_out]
    own = HouseParameters()
    offset, weights = fit(fitted)
    now = replace(own, weights=tuple(weights.round(2).tolist()), offset=round(offset, 2))
    sure, likely = (threshold(fitted, now, share) for share in (1 / 30, 1 / 10))
    now = replace(now, sure=sure, likely=likely)
    rows = [
        measured("fitted to, by the fit", fitted, now),
        measured("fitted to, as the step has it", fitted, own),
        measured("not fitted to, by the fit", held, now),
        measured("not fitted to, as the step has it", held, own),
    ]
    told = ", ".join(f"{k} {w:.2f}" for k, w in zip(SIGNS, weights, strict=True))
    notes = [f"The fit: {told}; offset {offset:.2f}, sure {sure:.2f}, likely {likely:.2f}.", LEGEND]
    keep_or_print("facade-houses", rows, notes, not call.draft)


LEGEND = (
    "between houses: marked borders with a house on both sides, and how many of them are found;"
    " borders: all that were marked; false: found ones near no mark; parted: pictures of one house"
    " of which two were made. A first fit without the limit of 1.5 parted 7 of 19 pictures of one"
    " house that it was not fitted to; the limit was chosen by four folds of the others. After that"
    " three neighbours that had not been marked (b0284, b0285, b0289) became `unsure`."
)


def gathered(path: Path | None, most: int | None) -> list[Picture]:
    """The signs of all marked pictures, from the file where it has them."""
    marks = json.loads((HERE / "houses_marked.json").read_text("utf-8"))
    known = kept_of(list(marks), path, most, _signs_of)
    return [_picture(name, known[name], marks[name]) for name in known if known[name]]


def _signs_of(name: str) -> dict[str, object]:
    pixels = read_image(DATA / "facades/cmp" / f"{name}.jpg").pixels
    evidence, seen = gather(pixels, inside_photo(pixels)), look(pixels)
    size = evidence.width, evidence.height
    elements = in_crop(believed(seen_elements(seen), seen), evidence.px_per_rectified, 0, size)
    windows = [e for e in elements if e.kind == "window"]
    if len(windows) < HouseParameters().windows:
        return {}
    storey = storey_of(windows)
    found = candidates(fronts_of(evidence, seen, windows, storey))
    return {
        "width": evidence.width,
        "storey": storey,
        "windows": [[round(v, 1) for v in (e.x0, e.y0, e.x1, e.y1)] for e in windows],
        "columns": [[w.x, *(round(s, 4) for s in w.signs)] for w in found],
    }


def _picture(name: str, row: dict[str, object], marks: dict[str, list[float]]) -> Picture:
    width = int(str(row["width"]))
    columns = np.array(row["columns"], np.float64).reshape(-1, 1 + len(SIGNS))
    return Picture(
        name,
        width,
        float(str(row["storey"])),
        columns[:, 0] / width,
        columns[:, 1:],
        np.array(row["windows"], np.float64).reshape(-1, 4),
        tuple(marks["borders"]),
        tuple(marks["unsure"]),
    )


def fit(pictures: Sequence[Picture]) -> tuple[float, Float]:
    """Offset and weights (9,) of the likeliest logistic model, by Newton's method."""
    rows, truth, counts = [], [], []
    for one in pictures:
        kept = one.truth >= 0
        own = one.truth[kept]
        rows.append(np.clip(one.signs[kept], 0.0, HouseParameters().most))
        truth.append(own)
        marks = max(1, len(one.borders))
        counts.append(np.where(own == 1, marks / max(1, int(own.sum())), PLAIN))
    signs, right, weight = np.concatenate(rows), np.concatenate(truth), np.concatenate(counts)
    used = np.ones(signs.shape[1], dtype=np.bool_)
    while True:
        offset, weights = _newton(signs[:, used], right, weight)
        if (weights >= 0.0).all():
            break
        # A sign speaks for a border or not at all: the worst of those that would speak against one
        # goes, and the others are fitted again.
        used[np.flatnonzero(used)[int(weights.argmin())]] = False
    whole = np.zeros(signs.shape[1])
    whole[used] = weights
    return offset, whole


def _newton(signs: Float, right: NDArray[np.int64], weight: Float) -> tuple[float, Float]:
    known = np.column_stack([np.ones(len(signs)), signs])
    at = likeliest(known, right, weight, RIDGE, 60)
    return float(at[0]), at[1:]


def threshold(pictures: Sequence[Picture], own: HouseParameters, share: float) -> float:
    """The chance that the likeliest column of one in so many pictures of one house has."""
    single = [one for one in pictures if not one.borders and not one.unsure and len(one.at)]
    best = [max(chance_of(signs, own) for signs in one.signs) for one in single]
    return round(float(np.quantile(best, 1.0 - share)), 2)


def measured(name: str, pictures: Sequence[Picture], own: HouseParameters) -> Row:
    """What is found of the borders of some pictures."""
    whole = found_whole = every = found_every = false = single = parted = doubted = 0
    for one in pictures:
        found, doubt = one.parted(own)
        hits = [any(abs(x - mark) < FOUND for x in found) for mark in one.borders]
        between = one.whole_borders(own)
        whole += len(between)
        found_whole += sum(any(abs(x - mark) < FOUND for x in found) for mark in between)
        every += len(hits)
        found_every += sum(hits)
        marks = (*one.borders, *one.unsure)
        wrong = sum(all(abs(x - mark) >= FAR for mark in marks) for x in found)
        false += wrong
        if not marks:
            single += 1
            spans = one.houses(found, own)
            parted += len(spans) > 1
            doubted += bool(doubt and len(spans) == 1)
    return {
        "pictures": name,
        "number": len(pictures),
        "between houses": whole,
        "found of these": found_whole,
        "borders": every,
        "found": found_every,
        "false": false,
        "of one house": single,
        "parted": parted,
        "doubted": doubted,
    }


if __name__ == "__main__":
    main()
