"""Which lots stand beside which: against all pairs; and what rules see of them."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from veduta.grammar.derivation import parse
from veduta.grammar.lot import Lot
from veduta.grammar.lots import read_lots
from veduta.grammar.neighbours import MOST, NEAR_M, neighbours_of
from veduta.grammar.one_lot import derive_lot, find_lot
from veduta.grammar.options import GrammarOptions
from veduta.grammar.pipeline import FEW, run_derive
from veduta.run.progress import Progress

ROW = """
attr height = 6
Lot --> extrude(height) comp(f) { side : Wall | top : set(material.name, "roof") Roof. | all : NIL }
Wall -->
    case inside(inter) : set(material.name, "wall") Party.
    else : set(material.name, "window") Open.
"""
"""A wall that lies in full on that of a neighbour has no window."""


def lot(number: int, x: float, y: float, width: float, depth: float) -> Lot:
    ring = np.array([[0.0, 0.0], [width, 0.0], [width, depth], [0.0, depth]])
    return Lot(str(number), str(number), (ring,), (x, y, 0.0))


sizes = st.floats(1.0, 40.0)
places = st.floats(-60.0, 60.0)


@settings(max_examples=60, deadline=None)
@given(st.lists(st.tuples(places, places, sizes, sizes), max_size=30))
def test_neighbours_are_those_of_all_pairs(boxes: list[tuple[float, ...]]) -> None:
    lots = [lot(number, *box) for number, box in enumerate(boxes)]
    found = neighbours_of(lots)
    for row, (x, y, width, depth) in enumerate(boxes):
        gaps = {
            other: max(bx - x - width, x - bx - bw, by - y - depth, y - by - bd, 0.0)
            for other, (bx, by, bw, bd) in enumerate(boxes)
            if other != row
        }
        near = [other for other, gap in gaps.items() if gap <= NEAR_M]
        assert len(found[row]) == min(len(near), MOST)
        assert set(found[row]) <= set(near)
        if near and len(near) <= MOST:
            assert set(found[row]) == set(near)
        told = [gaps[other] for other in found[row]]
        assert told == sorted(told)


def test_lots_on_each_other_have_no_more_than_the_most() -> None:
    lots = [lot(number, 0.0, 0.0, 10.0, 10.0) for number in range(1000)]
    found = neighbours_of(lots)
    assert min(len(near) for near in found) > 0
    assert max(len(near) for near in found) == MOST


def row_of(count: int, heights: list[float]) -> dict[str, Any]:
    """Lots wall by wall, 8 m by 10 m, at 84 km and 446 km of the Dutch grid."""
    features = []
    for number in range(count):
        x, y = 84_000.0 + 8 * number, 446_000.0
        ring = [[x, y], [x + 8, y], [x + 8, y + 10], [x, y + 10], [x, y]]
        shape = {"type": "Polygon", "coordinates": [ring]}
        height = {"height": heights[number % len(heights)]}
        more = {"id": f"house {number}", "properties": height}
        features.append({"type": "Feature", "geometry": shape} | more)
    crs = {"type": "name", "properties": {"name": "EPSG:28992"}}
    return {"type": "FeatureCollection", "crs": crs, "features": features}


def files(folder: Path, count: int, heights: list[float]) -> tuple[Path, Path]:
    rules, lots = folder / "row.cga", folder / "lots.geojson"
    rules.write_text(ROW)
    lots.write_text(json.dumps(row_of(count, heights)))
    return rules, lots


def windows(out: Path) -> dict[str, int]:
    """Open walls of each building, by its name."""
    city = json.loads((out / "city.city.json").read_text())["CityObjects"].values()
    found = {}
    for one in city:
        surfaces = [s for g in one["geometry"] for s in g["semantics"]["surfaces"]]
        if "name" in one["attributes"]:
            found[one["attributes"]["name"]] = sum(s["type"] == "Window" for s in surfaces)
    return found


def derived(rules: Path, lots: Path, out: Path, jobs: int) -> dict[str, bytes]:
    result = run_derive(str(rules), lots, out, GrammarOptions(), Progress(quiet=True), jobs=jobs)
    assert not result.failures
    kept = ("place.json", "city.city.json")
    whole = [path for path in out.rglob("*") if path.suffix == ".glb" or path.name in kept]
    return {str(path.relative_to(out)): path.read_bytes() for path in whole}


def test_a_party_wall_has_no_window(tmp_path: Path) -> None:
    """Of two houses of one height each has one; of a higher one the wall is free above."""
    rules, lots = files(tmp_path, 2, [6.0])
    derived(rules, lots, tmp_path / "out", 1)
    assert windows(tmp_path / "out") == {"house 0": 3, "house 1": 3}
    rules, lots = files(tmp_path, 2, [6.0, 9.0])
    derived(rules, lots, tmp_path / "other", 1)
    assert windows(tmp_path / "other") == {"house 0": 3, "house 1": 4}


def test_the_same_on_two_processes_and_at_the_border_of_a_block(tmp_path: Path) -> None:
    count = FEW + 20
    rules, lots = files(tmp_path, count, [6.0])
    one = derived(rules, lots, tmp_path / "one", 1)
    two = derived(rules, lots, tmp_path / "two", 2)
    assert len({name.split("/")[1] for name in one if name.startswith("parts/")}) > 1
    assert one == two
    ends = {"house 0", f"house {count - 1}"}
    expected = {f"house {k}": 3 if f"house {k}" in ends else 2 for k in range(count)}
    assert windows(tmp_path / "one") == expected


def test_a_change_beside_a_lot_derives_it_again(tmp_path: Path) -> None:
    rules, lots = files(tmp_path, 2, [6.0])
    derived(rules, lots, tmp_path / "out", 1)
    _, lots = files(tmp_path, 2, [6.0, 5.0])
    result = run_derive(
        str(rules), lots, tmp_path / "out", GrammarOptions(), Progress(quiet=True), force=True
    )
    assert not result.failures
    assert windows(tmp_path / "out") == {"house 0": 4, "house 1": 3}


@pytest.mark.parametrize("lot_id", ["house 0", "house 1"])
def test_one_lot_alone_is_derived_as_among_all(tmp_path: Path, lot_id: str) -> None:
    rules_path, path = files(tmp_path, 3, [6.0])
    rules = parse(rules_path)
    own, beside = find_lot(path, lot_id)
    made = derive_lot(rules, own, GrammarOptions(), 0, beside=beside)
    names = [shape.name for shape in made.leaves()]
    assert names.count("Open") == (3 if lot_id == "house 0" else 2)
    alone = derive_lot(rules, own, GrammarOptions(), 0)
    assert [shape.name for shape in alone.leaves()].count("Open") == 4


def test_lots_know_each_other_whatever_their_order(tmp_path: Path) -> None:
    _, path = files(tmp_path, 5, [6.0])
    lots = read_lots(path).lots
    names = [lot.id for lot in lots]
    turned = lots[::-1]
    forth = {names[row]: {names[k] for k in near} for row, near in enumerate(neighbours_of(lots))}
    back = {
        turned[row].id: {turned[k].id for k in near}
        for row, near in enumerate(neighbours_of(turned))
    }
    assert forth == back
