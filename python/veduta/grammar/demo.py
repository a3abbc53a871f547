"""The lots of a call that names none: a synthetic street, and the reader who stands in it."""

from __future__ import annotations

import numpy as np

from veduta.grammar.lot import Lot
from veduta.grammar.lots import Lots
from veduta.grammar.outline import Road
from veduta.synthetic.lots import STREET_M, street_of_lots

DEMO_LOTS = 14
PAVEMENT_M, ENDS_M = 3.0, 12.0
"""Beside the carriageway, and how far the street goes on beyond the last house (m)."""
NOTE = "no lots were given: the street is synthetic"


def demo_lots(count: int, seed: int) -> Lots:
    """Lots along both sides of a street, in a frame of their own."""
    street = street_of_lots(count, seed)
    lots = []
    for name, outline in zip(street.names, street.outlines_m, strict=True):
        low = np.floor(outline.min(axis=0))
        anchor = (float(low[0]), float(low[1]), 0.0)
        lots.append(Lot(id=name, name=name, rings_m=(outline - low,), anchor_m=anchor))
    middle = np.array([[-ENDS_M, STREET_M / 2, 0.0], [street.length_m + ENDS_M, STREET_M / 2, 0.0]])
    road = Road(middle, STREET_M - 2 * PAVEMENT_M)
    return Lots(tuple(lots), notes=(NOTE,), roads=(road,))
