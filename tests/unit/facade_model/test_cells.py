"""Rectangles as nested splits: what the engine derives of them is where they were."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from veduta import _core
from veduta.facade.cells import Cell, StuckError, metres, parted, snapped, splits
from veduta.facade.rectangles import Rectangle, carve

WALL = Rectangle(0.0, 0.0, 20.0, 15.0)
GAP_M = 0.05


def derived(cells: list[Cell]) -> _core.DerivedLot:
    """The cells on a wall of 20 by 15 m that looks south."""
    text = f"""
    Lot --> extrude(world.up, 15) comp(f) {{ front : Front | all : NIL }}
    Front --> {splits(cells, WALL, "Wall.")}
    Cell(name) --> set(material.name, name) Cell.
    """
    lot = [(0.0, 0.0, 0.0), (20.0, 0.0, 0.0), (20.0, 9.0, 0.0), (0.0, 9.0, 0.0)]
    (found,) = _core.GrammarRules([("cells.cga", text)]).derive([[lot]], [0])
    assert not isinstance(found, str), found
    return found


def rectangles(found: _core.DerivedLot) -> dict[str, Rectangle]:
    """Where each cell is, by its class; the wall's cells are left out."""
    ends = found.ring_offsets[found.polygon_offsets]
    places = {}
    for polygon, feature in enumerate(found.polygon_feature.tolist()):
        name = found.feature_class[feature]
        points = found.positions_m[ends[polygon] : ends[polygon + 1]]
        (x0, _, z0), (x1, _, z1) = points.min(axis=0), points.max(axis=0)
        if name:
            places[name] = Rectangle(float(x0), float(z0), float(x1), float(z1))
    return places


@st.composite
def apart(draw: st.DrawFn) -> list[Cell]:
    """Rectangles with a gap between them, as the layout gives them."""
    numbers = st.floats(0.0, 20.0)
    placed: list[Rectangle] = []
    for x0, z0, width, height in draw(
        st.lists(st.tuples(numbers, numbers, st.floats(0.3, 9), st.floats(0.3, 9)), max_size=14)
    ):
        wanted = Rectangle(x0, z0, x0 + width, z0 + height).common(WALL.grown(-GAP_M))
        place = snapped(carve(wanted, placed, GAP_M))
        if min(place.width, place.height) >= 0.2:
            placed.append(place)
    return [Cell(place, f'Cell("{number}")') for number, place in enumerate(placed)]


@given(apart())
def test_cells_are_derived_where_they_were(cells: list[Cell]) -> None:
    kept, dropped = parted(cells, WALL)
    assert sorted([*kept, *dropped], key=cells.index) == cells
    found = rectangles(derived(kept))
    assert len(found) == len(kept)
    for cell in kept:
        own, there = cell.rectangle, found[cell.content.split('"')[1]]
        np.testing.assert_allclose(
            (there.x0, there.z0, there.x1, there.z1), (own.x0, own.z0, own.x1, own.z1), atol=1e-9
        )


def test_a_windmill_loses_its_smallest_sail() -> None:
    sails = [
        Rectangle(1.0, 1.0, 6.0, 3.0),
        Rectangle(6.1, 1.0, 8.0, 6.0),
        Rectangle(3.1, 6.1, 8.0, 8.0),
        Rectangle(1.0, 3.1, 3.0, 7.0),
    ]
    cells = [Cell(sail, f'Cell("{number}")') for number, sail in enumerate(sails)]
    with pytest.raises(StuckError):
        splits(cells, WALL, "Wall.")
    kept, dropped = parted(cells, WALL)
    assert dropped == [cells[3]]
    assert len(rectangles(derived(kept))) == 3


def test_a_cell_as_wide_as_its_region_may_have_words_of_its_own() -> None:
    cell = Cell(Rectangle(1.0, 2.0, 3.0, 5.0), "Window.", "Column({}, {}, {})")
    assert splits([cell], Rectangle(1.0, 0.0, 3.0, 6.5), "Wall.") == "Column(2, 3, 1.5)"
    # At the region's foot there is nothing below it.
    assert splits([cell], Rectangle(1.0, 2.0, 3.0, 6.5), "Wall.") == (
        "split(y) { 3 : Window. | ~1.5 : Wall. }"
    )


@pytest.mark.parametrize(
    ("value_m", "text"), [(1.0, "1"), (0.25, "0.25"), (-0.0, "0"), (1e-4, "0"), (12.3456, "12.346")]
)
def test_lengths_are_whole_millimetres(value_m: float, text: str) -> None:
    assert metres(value_m) == text
