"""Rule files in the manner of published projects: how many derive as the reference has it.

`python benchmarks grammar/published [--keep]` derives the files of two folders beside the tests,
`published` and `published_more`, on a lot of 20 x 30 m and compares what they report with what was
worked out by hand. How many came out right at the first try was written down then.
"""

from __future__ import annotations

import argparse
import math
import runpy
import time
from collections.abc import Mapping
from pathlib import Path

from record import Row, keep_or_print

from veduta.grammar.deriving import deriver
from veduta.grammar.one_lot import plain_lot
from veduta.grammar.options import GrammarOptions
from veduta.grammar.otherwise import otherwise
from veduta.grammar.rules import check_rules, read_rules

TESTS = Path(__file__).parents[2] / "tests" / "unit" / "grammar"

FIRST_TRY = {"the forty": (33, 40), "fifteen more": (14, 15)}
"""Right, and how many there were."""
NOTES = (
    "Each file was written from the reference alone, before it was tried; right: all areas and"
    " counts are those worked out by hand. First try: before the engine was mended for them.",
    "The bound is 90 % at the first try: 33 of 40 (82 %) missed it, 14 of 15 (93 %) of"
    " other kinds reach it; together 47 of 55 (85 %). All are right today.",
    "`cemetery` was corrected before it counted: it had `with` behind the arrow, which is no CGA.",
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
    rows: list[Row] = []
    for told, files in sets.items():
        right, count = FIRST_TRY[told]
        each = [_tried(told, *one) for one in files]
        today = sum(row["state"] == "right" for row in each)
        rows.append(
            {"files": told, "first_try": f"{right} of {count}", "state": f"{today} of {len(each)}"}
        )
        rows += each
    keep_or_print("grammar-published", rows, NOTES, keep)


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
