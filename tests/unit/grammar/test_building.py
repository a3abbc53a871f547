"""Derived lots as parts: areas, classes, provenance, and what is left out."""

from __future__ import annotations

import numpy as np
import pytest
from closed_shells import assert_closed, shells

from veduta import _core
from veduta.grammar.building import NothingBuiltError, build, build_part
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
    building = build(derived(text), "lot")
    assert areas(building.part) == pytest.approx({"ground": 60.0})
    (lost,) = building.left_out
    assert (lost.rule, lost.count) == ("Rest", 1)
    assert building.said == ()
    assert building.part.notes == (lost.told(),)
    assert build_part(derived(text), "lot").notes == building.part.notes


def test_what_rules_print_is_never_taken_for_what_is_left_out() -> None:
    said = "3 surfaces of Rest were left out: too thin, or their lines cross"
    building = build(derived(f'Lot --> print("{said}") set(material.name, "ground")'), "lot")
    assert building.left_out == ()
    assert any(said in note for note in building.said)


NAMED = """
attr surface = ""
attr solid = ""
attr provenance = "invented"
Lot --> extrude(world.up, 5) comp(f) { front : Front | all : Wall(comp.sel + comp.index) }
Wall(name) --> set(surface, name)
Front --> set(surface, "front wall") set(provenance, "measured") [ Box ] Cells
Box --> t(4, 1, 0) s(2, 1, 0) set(surface, "box") set(solid, "box") extrude(0.5)
Cells --> split(x) { 4 : Wall. | 2 : Middle | ~1 : Wall. }
Middle --> split(y) { 1 : Wall. | 2 : Hole | ~1 : Wall. }
Hole --> [ Reveal ] t(0, 0, -0.3) Pane
Reveal -->
    set(surface, "reveal") extrude(-0.3) reverseNormals()
    comp(f) { top : NIL | bottom : NIL | all : Wall. }
Pane --> set(surface, "pane") set(provenance, "guessed") split(x) { 1 : Pane. | ~1 : Pane. }
"""


@pytest.fixture
def named() -> Part:
    return build_part(derived(NAMED), "house")


def test_surfaces_are_called_and_known_as_the_rules_say(named: Part) -> None:
    row_of = {name: row for row, name in enumerate(named.features.name)}
    assert len(row_of) == 9  # the front and its box, reveal and pane, and five more sides
    wall, pane = row_of["front wall"], row_of["pane"]
    assert named.features.id[wall] == "house/front-wall"
    assert named.features.provenance(wall) is Provenance.MEASURED
    assert named.features.provenance(pane) is Provenance.INVENTED  # "guessed" is no provenance
    for inner in ("box", "reveal", "pane"):
        assert named.features.parent[row_of[inner]] == wall
    assert named.features.shell[row_of["box"]] == 1
    assert named.features.width_m[pane] == 2.0


def test_cells_of_a_surface_are_the_face_that_they_were_cut_from(named: Part) -> None:
    wall = named.features.name.index("front wall")
    (polygon,) = np.flatnonzero(named.polygon_feature == wall)
    first, last = named.polygon_offsets[polygon : polygon + 2]
    assert last - first == 2  # an outline and a hole, of four corners each
    assert np.diff(named.ring_offsets[first : last + 1]).tolist() == [4, 4]
    assert named.feature_area_m2[wall] == pytest.approx(10 * 5 - 2 * 2)
    pane = named.features.name.index("pane")
    assert (named.polygon_feature == pane).sum() == 1


def test_what_the_rules_close_is_closed_in_the_part(named: Part) -> None:
    assert_closed(named)
    body, box = shells(named)
    assert body.volume == pytest.approx(10 * 6 * 5 - 2 * 2 * 0.3, rel=1e-6)
    assert box.volume == pytest.approx(2 * 1 * 0.5, rel=1e-6)
