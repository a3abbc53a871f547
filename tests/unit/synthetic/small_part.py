"""Parts of a few rectangles, for tests that know where every surface is."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from veduta.place.builder import PartBuilder
from veduta.place.material import Material, Texture
from veduta.place.part import Part
from veduta.place.semantics import Provenance, SemanticClass

Vector = tuple[float, float, float]


def part_of(
    quads: Sequence[tuple[Vector, Vector, Vector]],
    texture: Texture | None = None,
    colour: Vector = (0.5, 0.5, 0.5),
    roughness: float = 0.9,
) -> Part:
    """One feature per quad (origin, u, v); UV runs from the lower left (0, 1) to (1, 0)."""
    builder = PartBuilder("test")
    material = builder.material(
        Material("plain", (1.0, 1.0, 1.0) if texture else colour, roughness, texture=texture)
    )
    for number, (origin, u, v) in enumerate(quads):
        feature = builder.feature(SemanticClass.WALL, Provenance.MEASURED, f"quad {number}")
        o, a, b = np.array(origin), np.array(u), np.array(v)
        builder.polygon(
            [np.stack([o, o + a, o + a + b, o + b])],
            feature,
            material,
            lambda _: np.array([[0.0, 1.0], [1.0, 1.0], [1.0, 0.0], [0.0, 0.0]]),
        )
    return builder.build()
