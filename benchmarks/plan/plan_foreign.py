"""How well six more ways of drawing are read: hair lines, colours, prints, permits, pages, squares.

    python benchmarks plan/plan_foreign [--seeds A..B] [--families permit] [--each]

The families are `veduta.synthetic.plans.foreign`: drawn from what such sheets look like, before
any of the reader's code was read. Scores are those of `plan_strangers`; a run over all seeds is
kept as `plan-foreign`. The seeds of the first try, 31000 to 31005, are no part of it.
"""

from __future__ import annotations

import argparse

from plan_sets import seeds
from plan_strangers import Families, judged, row_of
from record import keep_or_print

from veduta.synthetic.plans.foreign.coloured import coloured_page
from veduta.synthetic.plans.foreign.hairline import hairline_sheet
from veduta.synthetic.plans.foreign.listing import listing_page
from veduta.synthetic.plans.foreign.permit import permit_drawing
from veduta.synthetic.plans.foreign.print_drawing import print_drawing
from veduta.synthetic.plans.foreign.squared_paper import squared_sketch

FAMILIES: Families = {
    "hairline": hairline_sheet,
    "coloured": coloured_page,
    "print": print_drawing,
    "permit": permit_drawing,
    "listing": listing_page,
    "squared": squared_sketch,
}
SEEDS = range(31_006, 31_012)
NOTES: tuple[str, ...] = ()


def main() -> None:
    """Read the sheets of all seeds; only a run over all is kept."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seeds", type=seeds, default=SEEDS)
    parser.add_argument("--families", nargs="+", choices=FAMILIES, default=[*FAMILIES])
    parser.add_argument("--each", action="store_true", help="print a line for each sheet")
    asked = parser.parse_args()
    rows = []
    for family in asked.families:
        scores = []
        for seed in asked.seeds:
            found = judged(seed, FAMILIES[family])
            scores += found
            if asked.each:
                print(seed, row_of(family, found), flush=True)
        rows.append(row_of(family, scores))
    whole = list(asked.seeds) == list(SEEDS) and asked.families == [*FAMILIES]
    keep_or_print("plan-foreign", rows, NOTES, keep=whole)


if __name__ == "__main__":
    main()
