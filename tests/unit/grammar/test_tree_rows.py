"""The derivation as rows, as text and as a drawing."""

from __future__ import annotations

import xml.etree.ElementTree as ElementTree
from pathlib import Path

import pytest

from veduta import grammar
from veduta.grammar.edits import parse_path
from veduta.grammar.tree_rows import tree_rows
from veduta.grammar.tree_svg import tree_svg
from veduta.grammar.tree_text import tree_text

RULES = """
Lot --> extrude(3) comp(f) { front : Front | top : Roof. | all : NIL }
Front --> split(x) { 1 : Wall. | { 2 : Bay(split.index) }* | 1 : Wall. }
Bay(i) --> split(y) { 1 : Wall. | ~1 : Window }
Window --> set(material.name, "window") split(x) { ~1 : Pane | ~1 : Pane }
Pane --> 100% : Glass. else : NIL
"""
TEXT = """\
Lot  10.00 × 6.00 m                              /:Lot
├─ Front  10.00 × 3.00 m                         /0:Front
│  ├─ Wall.  1.00 × 3.00 m                       /0/0:Wall
│  ├─ Bay(i=1)  ×4  2.00 × 3.00 m                /0/1:Bay
│  │  ├─ Wall.  2.00 × 1.00 m                    /0/1/0:Wall
│  │  └─ Window  2.00 × 2.00 m  +4 below         /0/1/1:Window
│  └─ Wall.  1.00 × 3.00 m                       /0/5:Wall
└─ Roof.  10.00 × 6.00 m                         /1:Roof
"""


@pytest.fixture(scope="module")
def house(tmp_path_factory: pytest.TempPathFactory) -> grammar.Derivation:
    path = tmp_path_factory.mktemp("rules") / "house.cga"
    path.write_text(RULES)
    return grammar.derive(grammar.parse(path), [[(0, 0), (10, 0), (10, 6), (0, 6)]])


def test_neighbours_that_are_alike_are_one_row(house: grammar.Derivation) -> None:
    rows = tree_rows(house.root, 3)
    found = [line.split() for line in tree_text(rows).splitlines()]
    assert found == [line.split() for line in TEXT.splitlines()]


def test_every_shape_is_in_a_row_or_counted(house: grammar.Derivation) -> None:
    for depth in range(7):
        rows = tree_rows(house.root, depth)
        total = 0
        counts: list[int] = []
        for row in rows:
            del counts[row.depth :]
            counts.append((counts[-1] if counts else 1) * row.count)
            total += counts[-1] * (1 + row.hidden)
        assert total == len(house)


def test_paths_lead_to_the_shapes(house: grammar.Derivation) -> None:
    for line in tree_text(tree_rows(house.root, 9)).splitlines():
        path, name = parse_path(line.split()[-1])
        shape = house.shape(path)
        assert shape is not None
        assert shape.name == name


def test_choices_and_hidden_shapes_are_told(house: grammar.Derivation) -> None:
    window = next(shape for shape in house.shapes() if shape.name == "Window")
    (row, pane, glass) = tree_text(tree_rows(window, 2)).splitlines()
    assert "window" in glass
    assert "×2" in pane
    assert "[1 of 2: 100 %]" in pane
    assert "+" not in row


def test_the_drawing_is_sound_and_says_the_same(house: grammar.Derivation) -> None:
    rows = tree_rows(house.root, 9)
    root = ElementTree.fromstring(tree_svg('a <b> & "c"', rows))
    name = "{http://www.w3.org/2000/svg}"
    titles = [title.text or "" for title in root.iter(f"{name}title")]
    paths = [line.split()[-1] for line in tree_text(rows).splitlines()]
    assert [title.splitlines()[-1] for title in titles] == paths
    assert len(list(root.iter(f"{name}path"))) == len(rows) - 1
    texts = [text.text for text in root.iter(f"{name}text")]
    assert texts[0] == 'a <b> & "c"'
    assert "Bay  ×4" in texts


def test_a_deep_tree_ends(tmp_path: Path) -> None:
    path = tmp_path / "deep.cga"
    path.write_text("Lot --> Down(900)\nDown(n) --> case n > 0 : Down(n - 1) else : End.")
    deep = grammar.derive(grammar.parse(path), [[(0, 0), (1, 0), (1, 1)]])
    assert len(tree_rows(deep.root, 1000)) == 903
