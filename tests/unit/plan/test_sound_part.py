"""Slivers that no triangle fills are left out of a house, and their surfaces named."""

from __future__ import annotations

import numpy as np
import pytest

from veduta.place.builder import PartBuilder
from veduta.place.material import Material
from veduta.place.semantics import Provenance, SemanticClass
from veduta.plan.house.sound import sound_part

SQUARE = np.array([(0, 0, 0), (2, 0, 0), (2, 1, 0), (0, 1, 0)], dtype=float)


def test_a_sliver_is_left_out_and_its_surface_named() -> None:
    builder = PartBuilder("house")
    paint = builder.material(Material("paint", (0.8, 0.8, 0.8)))
    floor = builder.feature(SemanticClass.FLOOR, Provenance.MEASURED, "r1 floor")
    thin = builder.feature(SemanticClass.FLOOR, Provenance.MEASURED, "r2 floor")
    builder.polygon([SQUARE], floor, paint)
    builder.polygon([SQUARE * (1.0, 0.0, 1.0)], thin, paint)
    part = sound_part(builder.build())
    assert part.feature_area_m2 == pytest.approx([2.0, 0.0])
    assert part.notes == ("1 slivers of surfaces are left out, of r2 floor",)


def test_a_part_without_slivers_stays_as_it_is() -> None:
    builder = PartBuilder("house")
    paint = builder.material(Material("paint", (0.8, 0.8, 0.8)))
    floor = builder.feature(SemanticClass.FLOOR, Provenance.MEASURED, "r1 floor")
    builder.polygon([SQUARE], floor, paint)
    built = builder.build()
    assert sound_part(built) is built
