"""How well six more ways of drawing are read: hair lines, colours, prints, permits, pages, squares.

    python benchmarks plan/plan_foreign [--seeds A..B] [--families permit] [--each]

The families are `veduta.synthetic.plans.foreign`: drawn from what such sheets look like, before
any of the reader's code was read. Scores are those of `plan_strangers`; a run over all seeds is
kept as `plan-foreign`. The seeds of the first try, 31000 to 31005, are no part of it.
"""

from __future__ import annotations

from plan_strangers import Families, measure

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
NOTES = (
    "At the first try, rooms, openings, wall IoU, sheets with the right scale: hairline on 31000 to"
    " 31005 0.41 (mean of sheets), 0.26, 0.44, 1 of 6; on 31000 to 31002 coloured 0, 0.07, 0.02, 0"
    " of 3, print 0.56, 0.46, 0.29, 3 of 3, permit 0.77, 0.64, 0.64, 3 of 3, listing 1.00, 0.75,"
    " 0.41, 1 of 3, squared 0.57, 0.18, 0.13, 1 of 3 (one not read).",
    "listing, squared and print were mended on seeds 100 to 107, coloured on 200 to 205.",
)


def main() -> None:
    """Measure, and print or keep the table."""
    measure("plan-foreign", FAMILIES, SEEDS, NOTES, __doc__)


if __name__ == "__main__":
    main()
