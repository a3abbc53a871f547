"""The coarse city model of a street (LoD1): a block of each building, from foot to eaves."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from veduta.place.builder import PartBuilder
from veduta.place.material import Material
from veduta.place.part import Part
from veduta.place.semantics import Provenance, SemanticClass
from veduta.synthetic.scene import PlacedPart, RayScene
from veduta.synthetic.streets.house import House, Street

GROUND_REACH_M = 150.0
_STAND = np.eye(4)


def block(house: House) -> Part:
    """The building in the world's frame: a wall for each edge of its outline, lid and floor."""
    builder = PartBuilder(house.id)
    plain = builder.material(Material("plain"))
    outline, low, high = house.outline_m, house.base_m, house.top_m
    for number, start in enumerate(outline):
        end = outline[(number + 1) % len(outline)]
        ring = [(*start, low), (*end, low), (*end, high), (*start, high)]
        name = f"wall {number}"
        size = (float(np.linalg.norm(end - start)), high - low)
        wall = builder.feature(SemanticClass.WALL, Provenance.MEASURED, name, size_m=size)
        builder.polygon([ring], wall, plain)
    roof = builder.feature(SemanticClass.ROOF, Provenance.MEASURED, "roof")
    builder.polygon([[(*corner, high) for corner in outline]], roof, plain)
    floor = builder.feature(SemanticClass.GROUND, Provenance.MEASURED, "floor")
    builder.polygon([[(*corner, low) for corner in outline[::-1]]], floor, plain)
    return builder.build()


def ground() -> Part:
    """A level square about the street at z = 0."""
    builder = PartBuilder("ground")
    plain = builder.material(Material("plain"))
    feature = builder.feature(SemanticClass.GROUND, Provenance.MEASURED, "ground")
    r = GROUND_REACH_M
    builder.polygon([[(-r, -r, 0.0), (r, -r, 0.0), (r, r, 0.0), (-r, r, 0.0)]], feature, plain)
    return builder.build()


def ray_scene(houses: Sequence[House]) -> RayScene:
    """The blocks and the ground, made ready for rays."""
    placed: list[PlacedPart] = [(block(house), _STAND) for house in houses]
    return RayScene([*placed, (ground(), _STAND)])


def everything(street: Street) -> tuple[House, ...]:
    """The houses that photos show, and those around."""
    return (*street.houses, *street.others)
