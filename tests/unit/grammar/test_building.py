"""Derived lots as parts: areas, classes, provenance, and what is left out."""

from __future__ import annotations

import numpy as np
import pytest

from veduta import _core
from veduta.grammar.building import NothingBuiltError, build_part
from veduta.place.part import Part
from veduta.place.semantics import Provenance, SemanticClass

SQUARE = [[(0.0, 0.0, 0.0), (10.0, 0.0, 0.0), (10.0, 6.0, 0.0), (0.0, 6.0, 0.0)]]
HOUSE = """
Lot --> extrude(world.up, 5) comp(f) { front : Front | top : Top | all : Wall }
Front --> set(material.name, "wall") split(x) { 4 : Wall. | 2 : Window | ~1 : Wall. }
Window --> set(material.name, "window") split(y) { 1 : color("#ff0000") | ~1 : color("#00ff00") }
Wall --> set(material.name, "wall")
Top --> set(material.name, "dome")
"""


def derived(text: str) -> _core.DerivedLot:
    (found,) = _core.GrammarRules([("test.cga", text)]).derive([SQUARE], [0])
    assert not isinstance(found, str), found
    return found


@pytest.fixture
def house() -> Part:
    return build_part(derived(HOUSE), "house")


def areas(part: Part) -> dict[str, float]:
    found: dict[str, float] = {}
    for row in range(len(part.features)):
        name = part.features.semantic(row).value
        found[name] = found.get(name, 0.0) + float(part.feature_area_m2[row])
    return found


def test_areas_are_those_of_the_box(house: Part) -> None:
    # Front without its window, back, two sides, and the bottom, which `all` takes too.
    walls = (10 - 2) * 5 + 10 * 5 + 2 * 6 * 5 + 10 * 6
    assert areas(house) == pytest.approx({"wall": walls, "window": 10.0, "other": 60.0})
    assert house.bounds_m == ((0.0, 0.0, 0.0), (10.0, 6.0, 5.0))


def test_a_window_is_one_surface_of_two_colours(house: Part) -> None:
    (row,) = np.flatnonzero(house.features.class_code == SemanticClass.WINDOW.code)
    assert house.features.name[row] == "Window 1"
    assert house.features.id[row] == "house/Window-1"
    assert (house.features.width_m[row], house.features.height_m[row]) == (2.0, 5.0)
    materials = house.polygon_material[house.polygon_feature == row]
    colours = {house.materials[number].colour for number in materials}
    assert colours == {(1.0, 0.0, 0.0), (0.0, 1.0, 0.0)}


def test_all_is_invented_and_ids_are_unique(house: Part) -> None:
    assert set(house.features.provenance_code) == {Provenance.INVENTED.code}
    assert len(set(house.features.id)) == len(house.features)


def test_a_class_that_is_none_is_told(house: Part) -> None:
    assert any("dome" in note for note in house.notes)


def test_nothing_left_is_a_failure() -> None:
    with pytest.raises(NothingBuiltError):
        build_part(derived("Lot --> NIL"), "empty")


def test_slivers_are_left_out_and_told() -> None:
    sliver = "[ t(5, 0, 0) s(0.0000001, 0, 5) Rest ]"
    text = f'Lot --> {sliver} Rest\nRest --> set(material.name, "ground")'
    part = build_part(derived(text), "lot")
    assert areas(part) == pytest.approx({"ground": 60.0})
    assert any("1 surfaces were left out" in note for note in part.notes)
