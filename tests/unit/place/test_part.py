"""Columns of a part, the builder that packs them, and the closed sets."""

from __future__ import annotations

import numpy as np
import pytest

from veduta.place.builder import PartBuilder
from veduta.place.material import Material, Texture
from veduta.place.part import NO_PARENT
from veduta.place.semantics import CITYJSON_SURFACE, Provenance, SemanticClass


def test_codes_go_there_and_back() -> None:
    for semantic in SemanticClass:
        assert SemanticClass.of_code(semantic.code) is semantic
    for provenance in Provenance:
        assert Provenance.of_code(provenance.code) is provenance


def test_every_class_has_a_cityjson_surface() -> None:
    assert set(CITYJSON_SURFACE) == set(SemanticClass)


def test_builder_packs_rings_features_and_materials() -> None:
    builder = PartBuilder("p")
    stone = builder.material(Material("stone", (0.5, 0.5, 0.5)))
    wall = builder.feature(SemanticClass.WALL, Provenance.MEASURED, "wall", size_m=(4.0, 3.0))
    pane = builder.feature(SemanticClass.WINDOW, Provenance.INFERRED, "pane", parent=wall)
    outline = [(0, 0, 0), (4, 0, 0), (4, 0, 3), (0, 0, 3)]
    hole = [(1, 0, 1), (1, 0, 2), (2, 0, 2), (2, 0, 1)]
    builder.polygon([outline, hole], wall, stone)
    builder.polygon([hole[::-1]], pane, stone, uv=lambda points: points[:, [0, 2]] / 4)
    part = builder.build()
    assert part.positions_m.dtype == np.float32
    assert part.ring_offsets.tolist() == [0, 4, 8, 12]
    assert part.polygon_offsets.tolist() == [0, 2, 3]
    assert part.features.parent.tolist() == [NO_PARENT, wall]
    assert part.features.semantic(pane) is SemanticClass.WINDOW
    assert part.features.provenance(pane) is Provenance.INFERRED
    assert part.feature_area_m2.tolist() == [11.0, 1.0]
    assert part.uv[8:].tolist() == [[0.5, 0.25], [0.5, 0.5], [0.25, 0.5], [0.25, 0.25]]
    assert part.bounds_m == ((0.0, 0.0, 0.0), (4.0, 0.0, 3.0))
    assert len(set(part.features.id)) == 2


def test_a_texture_and_its_mask_have_one_size() -> None:
    pixels = np.zeros((4, 6, 3), dtype=np.uint8)
    with pytest.raises(ValueError, match=r"\(4, 6\) bool"):
        Texture(pixels=pixels, invented=np.zeros((6, 4), dtype=np.bool_))


def test_a_position_that_is_no_number_is_refused() -> None:
    builder = PartBuilder("p")
    row = builder.feature(SemanticClass.WALL, Provenance.MEASURED, "wall")
    stone = builder.material(Material("stone"))
    builder.polygon([[(0, 0, 0), (1, 0, 0), (0, np.inf, 1)]], row, stone)
    with pytest.raises(ValueError, match="part 'p': a position is no number"):
        builder.build()
