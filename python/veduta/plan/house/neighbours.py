"""Neighbours of a house in a row: blank blocks under the roof that goes on, all invented."""

from __future__ import annotations

import numpy as np
from shapely.geometry.polygon import orient

from veduta.place.builder import PartBuilder
from veduta.place.part import Part
from veduta.place.semantics import Provenance, SemanticClass
from veduta.plan.house.build import House
from veduta.plan.house.eaves import UNDER_M, faces_within
from veduta.plan.house.frame import Sculptor, Surface, level
from veduta.plan.house.looks import Looks
from veduta.plan.house.party import ROW, neighbour_region, parties_of, row_region
from veduta.plan.house.roof import roofs_over
from veduta.plan.house.space import pieces_of
from veduta.plan.options import HouseOptions

NEIGHBOURS = "neighbours"
APART_M = 0.01
"""Between the house and its neighbours, so that no two faces lie in one plane."""
WIDTH_M = (4.5, 9.0)


def build_neighbours(house: House, options: HouseOptions, raised_m: float) -> Part | None:
    """A block beside each party wall, in the frame of the place; None where there is none.

    raised_m: how much higher the house stands there than in the plan frame.
    """
    last = house.spaces[-1]
    parties = parties_of(last)
    if not parties:
        return None
    builder = PartBuilder(NEIGHBOURS)
    sculptor = Sculptor(builder, Looks(builder))
    top = last.storey.elevation_m + last.storey.height_m + raised_m
    row = row_region(last.covered, parties)
    roofs = roofs_over(row, options)
    for number, party in enumerate(parties, start=1):
        shape = last.covered
        own = neighbour_region(shape, party, 1.0)
        width = float(np.clip(shape.area / max(own.area, 1.0), *WIDTH_M))
        # No broader than the row's roof reaches.
        width = min(width, ROW * own.area)
        strip = party.beyond(APART_M).difference(party.beyond(width))
        block = neighbour_region(shape, party, width).intersection(strip)
        feature = builder.feature(
            SemanticClass.WALL, Provenance.INVENTED, f"neighbour {number}",
            shell=builder.new_shell(),
        )  # fmt: skip
        for piece in pieces_of(block):
            sculptor.prism(orient(piece), 0.0, top, level(0.0), Surface(feature, "facade"))
        above = builder.feature(
            SemanticClass.ROOF, Provenance.INVENTED, f"neighbour {number} roof",
            shell=builder.new_shell(),
        )  # fmt: skip
        for roof in roofs:
            for rings in () if roof.faces is None else faces_within(roof.faces, strip) or ():
                normal = np.cross(rings[0], np.roll(rings[0], -1, axis=0)).sum(axis=0)
                look = "roof" if normal[2] > 1e-9 else "soffit"
                sculptor.face(rings, level(top + UNDER_M), Surface(above, look))
    return builder.build()
