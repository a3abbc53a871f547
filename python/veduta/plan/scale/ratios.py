"""`1:100` with the resolution of the file."""

from __future__ import annotations

import math

from veduta.plan.document import Text
from veduta.plan.scale.evidence import Hypothesis, Voter
from veduta.plan.scale.quantities import INCH_M, read_quantities

_SCANNERS_DPI = (100.0, 150.0, 200.0, 240.0, 254.0, 300.0, 360.0, 400.0, 600.0, 1200.0)
_SIGMA = 0.01  # of what was printed and scanned at its own size
_SCREEN_DPI = 100.0  # below, the number is the program's that wrote the file, not a scanner's


def ratio_voters(texts: list[Text], dpi: float | None, *, on_paper: bool = False) -> list[Voter]:
    """The scale by a printed ratio; none without a resolution.

    A sheet is often printed to another size than it was drawn for, and the resolution of a picture
    from the web is none: this alone decides nothing where rooms have sizes. `on_paper`: the
    resolution is that of a page whose size is known, as in a PDF, and no program's guess.
    """
    if dpi is None or dpi <= 0.0:
        return []
    scanned = on_paper or any(abs(dpi - known) < 0.5 for known in _SCANNERS_DPI)
    doubtful = dpi < _SCREEN_DPI and not on_paper
    trust = 0.2 if doubtful else (0.7 if scanned else 0.5)
    return [
        Voter(
            "ratio",
            f"{text.text} at {dpi:.0f} dpi",
            "ratio",
            (Hypothesis(math.log(INCH_M / dpi * quantity.values[0]), _SIGMA, trust),),
            mass=text.score,
        )
        for text in texts
        for quantity in read_quantities(text.text)
        if quantity.kind == "ratio"
    ]
