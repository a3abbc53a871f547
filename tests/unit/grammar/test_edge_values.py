"""Attributes of the edges of lots, and where lots lie on Earth, from files to the rules."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pyproj
import pytest

from veduta.grammar.deriving import deriver, known_besides
from veduta.grammar.edge_values import edge_lists, edge_texts, edges_of_ring, without_edges
from veduta.grammar.lots import read_lots
from veduta.grammar.on_earth import on_earth
from veduta.grammar.options import GrammarOptions
from veduta.grammar.outline import plain_attributes
from veduta.grammar.project import SearchPath

SQUARE = [(0.0, 0.0), (20.0, 0.0), (20.0, 10.0), (0.0, 10.0)]
EAST, NORTH = 500_000.0, 5_400_000.0
SIDES = ["south", "east", "north", "west"]
CRS = {"type": "name", "properties": {"name": "EPSG:25832"}}


def write(path: Path, corners: list[tuple[float, float]], told: object, *more: object) -> Path:
    ring = [[EAST + x, NORTH + y] for x, y in [*corners, corners[0]]]
    lot = {
        "type": "Feature",
        "properties": {"name": "a", "edgeattr.side": told},
        "geometry": {"type": "Polygon", "coordinates": [ring]},
    }
    document = {"type": "FeatureCollection", "crs": CRS, "features": [lot, *more]}
    path.write_text(json.dumps(document))
    return path


def road(*points: tuple[float, float], width: float) -> dict[str, object]:
    line = [[EAST + x, NORTH + y] for x, y in points]
    geometry = {"type": "LineString", "coordinates": line}
    about = {"highway": "residential", "width": width}
    return {"type": "Feature", "properties": about, "geometry": geometry}


def said(path: Path, text: str) -> list[str]:
    lots = read_lots(path)
    rules, earth = (("a.cga", text),), on_earth(lots.crs, lots.origin_m)
    made = deriver(rules, SearchPath.of(Path()), GrammarOptions(), earth=earth)
    return made.together(list(lots.lots), 2.0).messages(0)


def test_properties_become_texts_of_edges() -> None:
    given = {"/edgeattr/a": [1, True, None], "edgeattr_b": "x;y", "EdgeAttr.c": [], "d": "e"}
    given |= {"n": 3}
    found = plain_attributes(given)
    assert found == {
        "/edgeattr/a": "1;true;;",
        "/edgeattr/b": "x;y",
        "/edgeattr/c": "",
        "d": "e",
    } | {"n": 3.0}
    assert without_edges(found) == {"d": "e", "n": 3.0}
    assert edge_texts({"edgeattr/q": ["a;b", "c"]}) == {"/edgeattr/q": "a,b;c"}


@pytest.mark.parametrize(
    ("text", "values"),
    [
        ("1;2.5", [1.0, 2.5]),
        ("true;false;", [True, False]),
        ("1;true", ["1", "true"]),
        ("1;nan", ["1", "nan"]),
    ],
)
def test_texts_become_lists_of_one_kind(text: str, values: list[object]) -> None:
    assert edge_lists({"/edgeattr/a": text, "b": "1;2"}) == {"/edgeattr/a": values}


@pytest.mark.parametrize("told", [["a", "b", "c", ""], ["a", "b", "c", None], "a;b;c;", "a;b;c;;"])
@pytest.mark.parametrize("turn", range(4))
def test_an_empty_last_element_is_an_edges_too(told: object, turn: int) -> None:
    given = np.array(SQUARE)
    texts = edge_texts({"/edgeattr/a": told})
    found = edges_of_ring(dict(texts), [given], [np.roll(given, -turn, axis=0)])
    values = ["a", "b", "c", ""]
    assert edge_lists(found) == {"/edgeattr/a": values[turn:] + values[:turn]}


@pytest.mark.parametrize("told", [["a", "b", "c"], "a;b;c", ["a", "", "c", "", ""]])
def test_lists_of_another_length_are_not_used(told: object) -> None:
    texts = edge_texts({"/edgeattr/a": told})
    assert edges_of_ring(dict(texts), [np.array(SQUARE)], [np.array(SQUARE)]) == {}


@pytest.mark.parametrize("turn", range(4))
@pytest.mark.parametrize("reverse", [False, True])
def test_edges_keep_what_is_theirs(turn: int, reverse: bool) -> None:
    """Whichever way the lot's ring runs, and without the corners that part nothing."""
    given = np.array([(0, 0), (8, 0), (20, 0), (20, 10), (0, 10), (0, 0)], dtype=np.float64)
    own = np.roll(np.array(SQUARE), -turn, axis=0)
    own = own[::-1] if reverse else own
    found = edges_of_ring({"/edgeattr/n": "1;2;3;4;5", "h": 2.0}, [given], [own])
    middle = (own + np.roll(own, -1, axis=0)) / 2
    told = {(10.0, 0.0): "12", (20.0, 5.0): "3", (10.0, 10.0): "4", (0.0, 5.0): "5"}
    values = str(found["/edgeattr/n"]).split(";")
    assert all(value in told[(x, y)] for value, (x, y) in zip(values, middle.tolist(), strict=True))
    assert found["h"] == 2.0
    assert "/edgeattr/n" not in edges_of_ring({"/edgeattr/n": "1;2"}, [given], [own])


@pytest.mark.parametrize(
    ("told", "found"),
    [
        (["a", "b", "c", ""], ["a", "b", "c", ""]),
        ([1, 2, 3, None], ["1", "2", "3", ""]),
        ("a;b;c;", ["a", "b", "c", ""]),
    ],
)
def test_rules_read_the_edges_of_a_file_whose_last_says_nothing(
    tmp_path: Path, told: object, found: list[str]
) -> None:
    path = write(tmp_path / "a.geojson", SQUARE, told)
    text = """Lot --> extrude(3) comp(f) { world.south : P | world.east : P | world.north : P
        | world.west : P | all : NIL }
    P --> print("<" + edgeAttr.getString("side") + ">")"""
    assert said(path, text) == [f"<{one}>" for one in found]


@pytest.mark.parametrize("told", [SIDES, ";".join(SIDES)])
def test_rules_read_the_edges_of_a_file(tmp_path: Path, told: object) -> None:
    path = write(tmp_path / "a.geojson", SQUARE, told)
    text = """Lot --> extrude(3) comp(f) { world.south : P | world.east : P | world.north : P
        | world.west : P | all : NIL }
    P --> print(edgeAttr.getString("side"))"""
    assert said(path, text) == SIDES


def test_a_house_at_a_corner_has_two_fronts(tmp_path: Path) -> None:
    streets = (road((-50, -8), (70, -8), width=6), road((29, -50), (29, 50), width=8))
    path = write(tmp_path / "a.geojson", SQUARE, SIDES, *streets)
    (lot,) = read_lots(path).lots
    assert lot.attributes["streetCorner"] is True
    assert known_besides(lot)["/edgeattr/streetWidth"] == [6.0, 8.0, 0.0, 0.0]
    text = """Lot --> extrude(3)
        comp(f) { street.front : P("front") | street.side : P("side") | all : NIL }
    P(told) --> print(told + edgeAttr.getString("side") + edgeAttr.getFloat("streetWidth"))"""
    found = sorted(said(path, text))
    assert found == ["fronteast8", "frontsouth6", "sidenorth0", "sidewest0"]


def test_places_on_earth_are_those_of_the_crs(tmp_path: Path) -> None:
    path = write(tmp_path / "a.geojson", SQUARE, SIDES)
    text = "Lot --> print(getGeoCoord(x)) print(getGeoCoord(y)) print(getGeoCoord(lon)) "
    found = [float(one) for one in said(path, f"{text} print(getGeoCoord(lat))")]
    # The scope's origin is the corner in the north-west.
    assert found[:2] == pytest.approx([EAST, NORTH + 10.0])
    back = pyproj.Transformer.from_crs(4326, 25832, always_xy=True).transform(*found[2:])
    assert np.subtract(back, found[:2]) == pytest.approx([0.0, 0.0], abs=1e-3)
