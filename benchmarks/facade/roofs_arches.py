"""Roofs, arched heads and fronts of glass: told on pictures that no step was looked at on.

    python benchmarks facade/roofs_arches [cmp] [renders] [glass] [--kept FILE] [--most 20]
                                         [--draft]

`roofs_arches_marked.json` has, by eye, what ends each front of CMP: `gable`, `roof` (a slope is
seen over the eaves), `none` (a cornice or a parapet), or `unsure`; and rectangles, as shares of
width and height, in which all windows and doors have arched heads, or a person is in doubt. All
others have level heads. `gable.py` and `heads.py` were looked at on every third picture up to
b0240: the marked ones are those from b0241 on, and some others for their roofs. Renders are fronts
of styles whose roofs the rules say. What was read of each picture is kept in FILE as it comes.
"""

from __future__ import annotations

import argparse
import json
import os
from collections import Counter
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from kept_lines import kept_of
from record import Row, keep_or_print
from style_fronts import TrueFront, true_front

from veduta.facade.analyse import read_houses
from veduta.facade.document import FacadeDocument, Source
from veduta.facade.glass import GLASS_TOLD
from veduta.facade.house_folders import main_house
from veduta.facade.options import FacadeOptions, RectifyOptions
from veduta.facade.rectify import rectify
from veduta.imaging.read import Photo, read_image
from veduta.run.errors import NotFoundError

HERE = Path(__file__).parent
DATA = Path(os.environ.get("VEDUTA_DATA", HERE.parents[2] / "shared" / "data"))
HELD_FROM = 241
RENDERED = {
    "modern-slab": ("none", (*range(6), *range(40, 50))),
    "haussmann": ("roof", range(40, 43)),
    "restauration": ("roof", range(40, 43)),
    "empire": ("roof", range(40, 43)),
    "victorian": ("roof", range(40, 43)),
}
"""Styles with what ends their fronts, and seeds: those from 40 on nothing was looked at on."""
UNSEEN_FROM = 40
TOLD = {"flat": "none", "mansard": "roof", "hip": "gable", "gable": "gable"}
"""What a document says; the end of a hipped roof has a gable's outline."""
GLASS = {"curtain": range(10, 16), "bands": range(10, 14), "loggias": range(10, 13)}
"""Fronts of `modern-slab` with seeds: the first two are of glass."""
KINDS = ("none", "roof", "gable")
SETS = ("cmp", "renders", "glass")
"""Of what: pictures, rendered roofs, rendered fronts of glass; a part has a table of its own."""
Found = dict[str, Any]
Share = Sequence[float]


def main() -> None:
    """Read, compare, record."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("sets", nargs="*", choices=[*SETS, []], default=list(SETS))
    parser.add_argument("--kept", type=Path, help="where what was read is kept as it comes")
    parser.add_argument("--most", type=int, help="read no more than so many pictures")
    parser.add_argument("--draft", action="store_true", help="keep nothing")
    call = parser.parse_args()
    marks = json.loads((HERE / "roofs_arches_marked.json").read_text("utf-8"))
    for style, (roof, seeds) in RENDERED.items():
        marks |= {f"{style} {seed}": {"roof": roof} for seed in seeds}
    for facade, seeds in GLASS.items():
        marks |= {f"modern-slab {seed} {facade}": {"roof": "unsure"} for seed in seeds}
    marks = {name: mark for name, mark in marks.items() if _kind_of(name) in call.sets}
    found = kept_of(list(marks), call.kept, call.most, _read)
    rows = [*_roofs(marks, found), *_arches(marks, found), *_glass(found)]
    rows = [row for row in rows if row["number"]]
    parts = "-".join(call.sets)
    name = "facade-roofs-arches" if len(call.sets) == len(SETS) else f"facade-roofs-{parts}"
    keep_or_print(name, rows, [LEGEND, *_wrong(marks, found)], not call.draft)


def _kind_of(name: str) -> str:
    return ("cmp", "renders", "glass")[name.count(" ")]


LEGEND = (
    "Roofs: of fronts that end in nothing but a cornice or parapet (none), in a slope (roof) or a"
    " gable or hip, how many are told as each. Arches: of openings that were read where all are"
    " arched, and where all are level, how many are told as arched. No picture was tuned on but"
    " b0280, which the step for glass was looked at on, and modern-slab 0 to 5, which were told as"
    " gables or mansards before blocks and parapets on flat roofs were parted from these."
)


def _read(name: str) -> Found:
    """What is read of a picture; of a rendered one how many floors it has, too."""
    found = _found(read(name))
    return {**found, "floors": floors_of(name)} if " " in name else found


def read(name: str) -> FacadeDocument | None:
    """The document of a picture's main house; None where it is refused."""
    photo = _photo(name)
    options = FacadeOptions(rectify=RectifyOptions(rectified=True))
    height, width = photo.pixels.shape[:2]
    source = Source(image=name, sha256=photo.sha256, width_px=width, height_px=height)
    try:
        documents, _, _ = read_houses(rectify(photo, options.rectify), source, options)
    except NotFoundError:
        return None
    return documents[main_house(documents)]


def _photo(name: str) -> Photo:
    if name.startswith("cmp"):
        return read_image(DATA / "facades/cmp" / f"{name}.jpg")
    return Photo(_rendered(name).pixels, "0" * 64, None, None, Path(name))


def _rendered(name: str) -> TrueFront:
    style, seed, *facade = name.split(" ")
    return true_front(style, int(seed), 800, {"facade": facade[0]} if facade else None)


def floors_of(name: str) -> int:
    """Floors of a rendered front, with the ground floor."""
    return 1 + int(float(_rendered(name).state.attributes["storeys"]))


def _found(document: FacadeDocument | None) -> Found:
    if document is None:
        return {}
    wide, high = document.rectification.width_px, document.rectification.height_px
    openings = [
        [
            round((one.x_px + 0.5 * one.width_px) / wide, 4),
            round((one.y_px + 0.5 * one.height_px) / high, 4),
            bool(one.outline_px),
        ]
        for one in document.elements
        if one.class_ in ("window", "door")
    ]
    return {
        "roof": document.roof,
        "roof_m": round(document.rules.roof_height_m, 2),
        "storeys": document.storeys,
        "glass": any(note.startswith(GLASS_TOLD) for note in document.notes),
        "openings": openings,
    }


def _roofs(marks: dict[str, Found], found: dict[str, Found]) -> Iterator[Row]:
    for title in ("CMP", "renders", "renders, unseen"):
        for true in KINDS:
            some = [
                found[name]
                for name in found
                if marks[name]["roof"] == true and _set_of(name) == title
            ]
            if not some:
                continue
            told = Counter(TOLD[one["roof"]] if "roof" in one else "refused" for one in some)
            columns = {f"told {kind}": told[kind] for kind in (*KINDS, "refused")}
            yield {
                "what": f"roofs, {title}: {true}", "number": len(some), **columns,
                "right": round(told[true] / len(some), 2),
            }  # fmt: skip


def _set_of(name: str) -> str:
    if " " not in name:
        return "CMP"
    return "renders, unseen" if int(name.split(" ")[1]) >= UNSEEN_FROM else "renders"


def _arches(marks: dict[str, Found], found: dict[str, Found]) -> Iterator[Row]:
    counts: Counter[tuple[bool, bool]] = Counter()
    for name, true, told in _openings(marks, found):
        if int(name.removeprefix("cmp_b")) >= HELD_FROM:
            counts[true, told] += 1
    for true in (True, False):
        number = counts[true, True] + counts[true, False]
        yield {
            "what": f"heads, CMP: {'arched' if true else 'level'}",
            "number": number,
            "told arched": counts[true, True],
            "right": round(counts[true, true] / max(1, number), 2),
        }
    called = counts[True, True] + counts[False, True]
    yield {
        "what": "heads, CMP: of those told as arched",
        "number": called,
        "right": round(counts[True, True] / max(1, called), 2),
    }


def _glass(found: dict[str, Found]) -> Iterator[Row]:
    groups = {
        f"renders, {facade}": [f"modern-slab {seed} {facade}" for seed in seeds]
        for facade, seeds in GLASS.items()
    }
    groups["CMP held out, b0280"] = ["cmp_b0280"]
    groups["CMP held out, the others"] = [
        name
        for name in found
        if name.startswith("cmp") and name != "cmp_b0280" and int(name[5:]) >= HELD_FROM
    ]
    for title, names in groups.items():
        some = [found[name] for name in names if found.get(name)]
        told = sum(one["glass"] for one in some)
        right = told if title.endswith(("curtain", "bands", "b0280")) else len(some) - told
        yield {
            "what": f"glass, {title}",
            "number": len(some),
            "told glass": told,
            "right": round(right / max(1, len(some)), 2),
            "storeys right": sum(one["storeys"] == one["floors"] for one in some)
            if title.startswith("renders")
            else None,
        }


def _openings(marks: dict[str, Found], found: dict[str, Found]) -> Iterator[tuple[str, bool, bool]]:
    """The picture of each opening that is read and no doubt, whether it is arched, and told so."""
    for name, one in found.items():
        mark = marks[name]
        if "arched" not in mark or not one:
            continue
        for x, y, told in one["openings"]:
            if not _inside(x, y, mark["unsure"]):
                yield name, _inside(x, y, mark["arched"]), told


def _inside(x: float, y: float, some: Sequence[Share]) -> bool:
    return any(x0 <= x <= x1 and y0 <= y <= y1 for x0, y0, x1, y1 in some)


def _wrong(marks: dict[str, Found], found: dict[str, Found]) -> Iterator[str]:
    """Which pictures are told wrongly, for whoever looks at them."""
    roofs = [
        f"{name} {marks[name]['roof']} as {one['roof']} ({one['roof_m']} m)"
        for name, one in found.items()
        if "roof" in one
        and marks[name]["roof"] in KINDS
        and TOLD[one["roof"]] != marks[name]["roof"]
    ]
    yield f"Roofs told wrongly: {', '.join(roofs) or 'none'}."
    heads = Counter(name for name, true, told in _openings(marks, found) if true != told)
    told = ", ".join(f"{name} {count}" for name, count in heads.most_common(12))
    yield f"Heads told wrongly, by picture: {told or 'none'}."


if __name__ == "__main__":
    main()
