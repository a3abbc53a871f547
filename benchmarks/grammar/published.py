"""Rule files of published projects, and in their manner: how many derive as the reference has it.

The files of others are not ours to keep: how many of each project derived on a lot of 20 x 30 m,
when it was read for the first time and now, stands here as it was found. `python benchmarks
grammar/published [--keep]` adds our own, two folders beside the tests, `published` and
`published_more`: it derives them on the same lot and compares what they report with what was worked
out by hand. It also evaluates the examples that the reference prints values of.
"""

from __future__ import annotations

import argparse
import math
import runpy
import time
from collections.abc import Iterable, Mapping
from pathlib import Path

from record import Row, keep_or_print

from veduta.grammar.deriving import deriver
from veduta.grammar.one_lot import plain_lot
from veduta.grammar.options import GrammarOptions
from veduta.grammar.otherwise import otherwise
from veduta.grammar.rules import check_rules, read_rules

TESTS = Path(__file__).parents[2] / "tests" / "unit" / "grammar"

ENGINE_MENDED = {
    "Duke-BC-DL-for-Energy-Infrastructure/CityEngine-Files": (3, 3, 3),
    "FraknToastr/CityEngine": (2, 2, 2),
    "GD3Duk/cityengine": (1, 2, 2),
    "Lesrac/ivis_cityengine": (1, 1, 1),
    "bohaohuang/Synthinel": (0, 4, 4),
    "cuthb3rt/cityengine-test": (1, 1, 1),
    "jbdong/CityEngine_cga": (13, 14, 14),
    "niteshbagde/ESRI_CityEngine_custom_CGA": (1, 1, 1),
    "twak, two projects": (2, 3, 3),
    "urschrei/CityEngine-Twitter": (1, 1, 1),
    "virtualarchitectures/OS_Building_Height_In_CityEngine": (1, 2, 2),
}
"""Projects that the engine was mended with in view: at the first try, today, and files."""
UNSEEN = {
    "Duke-BC-DL-for-Energy-Infrastructure/CityEngine-Files": (3, 4, 4),
    "FraknToastr/CityEngine": (1, 1, 1),
    "UAV-GeoLAB/MAP-CGA-Rules": (0, 2, 5),
    "amybam/WRENVR": (0, 1, 1),
    "hejibo/VirtualCity": (3, 3, 3),
    "jbdong/CityEngine_cga": (21, 24, 24),
    "rchurch26/IGME-386": (3, 3, 3),
    "rkoksal, a rule of random masses": (1, 1, 1),
    "swiss, a rule of streets": (1, 1, 1),
}
"""Those read after that, by the engine as it was at that time."""
THIRD = {
    "kikita, a rule of touching volumes": (2, 2, 2),
    "Esri Japan, tutorials": (4, 4, 4),
    "Esri, a city at night": (0, 1, 1),
    "snippets of a Chinese collection": (3, 3, 3),
}
"""Those read after that again."""
FOURTH = {
    "snippets of a Chinese collection, the rest": (4, 4, 4),
    "Esri, a first rule file": (1, 1, 1),
}
"""Those read after operations had been compared with the reference, by the engine before that."""

FIFTH = {
    "fhnw-iit/swiss-building-rules, houses at a low level of detail": (3, 3, 3),
    "d-wasserman/Complete_Street_Rule, a bus lane with its libraries": (0, 1, 1),
    "answers in Esri's forum and support pages": (6, 6, 6),
    "a blog, an introduction": (2, 2, 2),
}
"""Read after that, by the engine before it was mended for them."""
SIXTH = {
    "twak/multiball, a damaged old town": (17, 17, 17),
    "twak/multiball, a desert city": (6, 7, 7),
    "twak/multiball, roofs of Paris": (1, 1, 1),
    "twak/multiball, Pompeii": (2, 2, 2),
    "twak/multiball, complete streets of 2016": (3, 3, 4),
    "hejibo/VirtualCity, the rest": (2, 2, 2),
    "a Spanish generator of houses and works": (2, 2, 2),
    "forums, blogs, tutorials and the reference": (8, 8, 8),
}
"""Read after that again, by the engine before `getGeoCoord(X)` was mended."""
SEVENTH = {
    "Unit26Y21/UrbanLab, a studio of students: streets, events, towers, waste": (18, 18, 19),
    "Esri, a bench and a fountain": (2, 2, 2),
}
"""Read after that, by the engine before `check` derived on a lot."""
REFERENCE_EXAMPLES = (55, 56, 56)
"""Of pages on operations that had not been compared: derived at first, today, and all."""

REFERENCE_VALUES = (231, 276, 276)
"""At the first try, after mending, and how many there are."""
FIRST_TRY = {"the forty": (33, 40), "fifteen more": (14, 15)}
"""Right, and how many there were."""
NOTES = (
    "Published files count that are whole in what was published and can start by themselves. Not"
    " so are five libraries whose rules all have parameters, seven files that are no valid CGA,"
    " and those whose imports were not published. Long lists of five files were shortened. It"
    " counts that a file derives with its own values, with a box where an asset is missing; seven"
    " leave nothing, as they say. No values were worked out; pictures were looked at.",
    "The bound for published files is 80 % at the first try: 33 of 43 unseen, 9 of 10 that were"
    " read after those, 5 of 5 after them, 11 of 12, 41 of 43 and then 20 of 21, the newest,"
    " together 119 of 134 (89 %), reach it. Of the 21 (of 78 files of one studio those that are"
    " short) one sets a ring back by its own width again and again, without end."
    " Of the 43 come 31 from one collection, 17 of them from one project; lists of ranges"
    " and comments at their heads were shortened. Whether three files of the same collector that"
    " were read first are among them is not known. On a lot with a street the same files derive as"
    " on the plain one. Refused was `getGeoCoord(X)`; a rule that divides a body by storeys wants"
    " one, and applies itself without end on a flat lot. Others whose imports were not published"
    " were not tried.",
    "Of the twelve before, the lane and the houses are long (their lists were shortened), eight are"
    " of a page or less. What failed there was a table that its project leaves to CityEngine: an"
    " empty one stands for it today. Before any mending 141 of all 168 derived (84 %); today 163"
    " (97 %). Three name a function that no reference has (`geometry.lowerheight`): such names are"
    " taken for 0 today, which was tried on lines of ours alone, so that they count as refused.",
    "Of 56 examples of operations in the reference 55 derived when they were tried first; the side"
    " of a cylinder was divided into endless parts along its texture. That they derive does not say"
    " that they look as there: `i` and primitives do not trim, and a cylinder's texture does not"
    " run around it.",
    "Of the values that the reference prints beside its examples of functions 231 of 276 (84 %)"
    " came out when they were tried first; wrong were missing values, `setElems`, `findFirst` with"
    " a tolerance, `*` in lists, rows of `sortIndices`, texts in `sum` and `max`, truths of texts.",
    "What was mended: rules of imports that the importing file tells otherwise (`lib.Rule -->"
    " ...`), imports from `rules/` without a project, leaves in lower case, `streetSide` and"
    " `noStreetSide`, cells of `split` without a size, `#rgb`, `material.color.a`, a texture as"
    " high as a flat shape, and, as a picture showed, `s` with a size below zero, which mirrors.",
    "Each file was written from the reference alone, before it was tried; right: all areas and"
    " counts are those worked out by hand. First try: before the engine was mended for them.",
    "The bound is 90 % at the first try: 33 of 40 (82 %) missed it, 14 of 15 (93 %) of"
    " other kinds reach it; together 47 of 55 (85 %). All are right today.",
    "`cemetery` was corrected before it counted: it had `with` behind the arrow, which is no CGA;"
    " `watertower` since then: it stood legs along the vertices' own axes, whose z is the mean of"
    " the normals there, and says `noAlign` now.",
)


def main() -> None:
    """Derive all files and print or keep the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--keep", action="store_true", help="keep the table in benchmarks/results")
    keep = parser.parse_args().keep
    first = runpy.run_path(str(TESTS / "test_published_manner.py"))
    more = runpy.run_path(str(TESTS / "test_published_more.py"))
    forty = [
        (name, first["FOLDER"] / path, wanted) for name, (path, wanted) in first["CASES"].items()
    ]
    others = [
        (name, more["FOLDER"] / f"{name}.cga", wanted) for name, wanted in more["CASES"].items()
    ]
    sets = {"the forty": forty, "fifteen more": others}
    rows = [
        *_of_others("published, the engine was mended with them in view", ENGINE_MENDED),
        *_of_others("published, read after that", UNSEEN),
        *_of_others("published, read after that again", THIRD),
        *_of_others("published, read before the last", FOURTH),
        *_of_others("published, read after the last", FIFTH),
        *_of_others("published, read before the newest", SIXTH),
        *_of_others("published, the newest", SEVENTH),
        *_of_reference(),
    ]
    for told, files in sets.items():
        right, count = FIRST_TRY[told]
        each = [_tried(told, *one) for one in files]
        today = sum(row["state"] == "right" for row in each)
        rows.append(
            {"files": told, "first_try": f"{right} of {count}", "state": f"{today} of {len(each)}"}
        )
        rows += each
    keep_or_print("grammar-published", rows, NOTES, keep)


def _of_others(told: str, projects: Mapping[str, tuple[int, int, int]]) -> list[Row]:
    def row(counts: Iterable[int]) -> dict[str, str | float]:
        first, today, count = counts
        return {"files": told, "first_try": f"{first} of {count}", "state": f"{today} of {count}"}

    sums = [sum(column) for column in zip(*projects.values(), strict=True)]
    return [row(sums), *(row(counts) | {"file": name} for name, counts in projects.items())]


def _of_reference() -> list[Row]:
    """Examples that the reference prints: they are not ours to keep."""
    printed = {
        "values printed in the reference": REFERENCE_VALUES,
        "examples of operations in the reference": REFERENCE_EXAMPLES,
    }
    return [
        {"files": told, "first_try": f"{first} of {count}", "state": f"{today} of {count}"}
        for told, (first, today, count) in printed.items()
    ]


def _tried(told: str, name: str, path: Path, wanted: Mapping[str, float]) -> Row:
    begin = time.perf_counter()
    rules = read_rules(path)
    row: dict[str, str | float] = {"files": told, "file": name, "values": len(wanted)}
    if check_rules(rules).errors:
        return row | {"state": "refused"}
    made = deriver(rules.files, rules.search, GrammarOptions())
    lot = plain_lot(20, 30)
    built = made.together([lot], 2.0)
    if made.fault(built, 0, lot) is not None:
        return row | {"state": "fails"}
    reported = dict(built.reports(0))
    off = [key for key, value in wanted.items() if not _alike(reported.get(key), value)]
    state = f"otherwise: {', '.join(off)}" if off else "right"
    seconds = round(time.perf_counter() - begin, 2)
    return row | {"state": state, "notes": len(otherwise(rules, made.rules)), "s": seconds}


def _alike(found: object, wanted: float) -> bool:
    return isinstance(found, float) and math.isclose(found, wanted, rel_tol=1e-6, abs_tol=1e-9)


if __name__ == "__main__":
    main()
