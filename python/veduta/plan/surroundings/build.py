"""The surroundings as parts of the place: the ground, on which one walks, and what grows on it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from shapely.geometry.polygon import orient
from shapely.ops import unary_union

from veduta.place.builder import PartBuilder
from veduta.place.part import Part
from veduta.place.place import UNMOVED, ModelFile, Place, Standing
from veduta.place.semantics import Provenance, SemanticClass
from veduta.plan.house.frame import Sculptor, Surface, level
from veduta.plan.house.looks import Looks
from veduta.plan.house.sound import sound_part
from veduta.plan.house.space import Space
from veduta.plan.options import HouseOptions
from veduta.plan.surroundings.plants import Plant, body, plants_of
from veduta.plan.surroundings.terrain import Terrain, terrain_of

GROUND, GARDEN = "ground", "garden"


@dataclass(frozen=True)
class Surroundings:
    """What lies around a house, in the frame of the place; garden is None where nothing grows."""

    terrain: Terrain
    plants: tuple[Plant, ...]
    ground: Part
    garden: Part | None

    @property
    def parts(self) -> list[Part]:
        """The ground, and the garden where there is one."""
        return [self.ground, *([] if self.garden is None else [self.garden])]


def build_surroundings(space: Space, options: HouseOptions) -> Surroundings:
    """The surroundings of a house by its storey at ground level."""
    terrain = terrain_of(space, options.ground_slope)
    windows = [hole.outline.buffer(2.2) for hole in space.holes if hole.low_m < 0.8]
    plants = tuple(plants_of(terrain, unary_union(windows)))
    return Surroundings(terrain, plants, ground_part(terrain), _garden(plants))


def add_surroundings(place: Place, around: Surroundings) -> None:
    """Put them into the place as further parts, each with a file of its own name."""
    for part, name in zip(around.parts, ("Ground", "Garden"), strict=False):
        standing = Standing(name, UNMOVED, arrangement="invented", ground=part.id == GROUND)
        place.add(part, standing, ModelFile(f"{part.id}.glb"))


def ground_part(terrain: Terrain) -> Part:
    """The areas of the ground as a part, without what is too thin for single precision."""
    builder = PartBuilder(GROUND)
    sculptor = Sculptor(builder, Looks(builder))
    for kind, region in terrain.areas:
        feature = builder.feature(SemanticClass.GROUND, Provenance.INVENTED, kind)
        for piece in terrain.flat_pieces(region):
            shape = orient(piece)
            rings = []
            for ring in (shape.exterior, *shape.interiors):
                points = np.array(ring.coords)[:-1]
                rings.append(np.column_stack([points, terrain.height(points)]))
            sculptor.face(rings, level(0.0), Surface(feature, kind))
    return sound_part(builder.build())


def _garden(plants: tuple[Plant, ...]) -> Part | None:
    if not plants:
        return None
    builder = PartBuilder(GARDEN)
    sculptor = Sculptor(builder, Looks(builder))
    for number, plant in enumerate(plants, start=1):
        feature = builder.feature(
            SemanticClass.OTHER,
            Provenance.INVENTED,
            f"{plant.kind} {number}",
            shell=builder.new_shell(),
        )
        for look, faces in body(plant):
            for face in faces:
                placed = face + np.array(plant.at_m)
                sculptor.face([placed], level(0.0), Surface(feature, look))
    return builder.build()
