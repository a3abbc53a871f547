"""What rules report of a building: in CityJSON, in a table, and summed in the report."""

from __future__ import annotations

import csv
import json
from pathlib import Path
from typing import Any

import pytest

from veduta.grammar.options import GrammarOptions
from veduta.grammar.pipeline import run_derive
from veduta.grammar.reported import MAX_KEYS, Values, sums_of, table, values_of
from veduta.run.progress import Progress

RULES = """
attr floors = 2
Lot --> report("area", geometry.area) report("use", "flats") report("floors", "many") Mass
Mass --> extrude(3 * floors) comp(f) { side : Wall | top : Top. | bottom : NIL }
Wall --> report("area.wall", geometry.area) Plain
Plain --> case floors > 2 : report("tall", true) X. else : X.
"""


def read_table(path: Path) -> list[list[str]]:
    with path.open(encoding="utf-8", newline="") as lines:
        return list(csv.reader(lines))


@pytest.fixture(scope="module")
def town(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """70 lots of 10 x 8 m in two blocks; the last has three floors."""
    folder = tmp_path_factory.mktemp("reported")
    (folder / "rules.cga").write_text(RULES)
    features = []
    for number in range(70):
        x, y = 84_000.0 + 15 * (number % 10), 446_000.0 + 20 * (number // 10)
        ring = [[x, y], [x + 10, y], [x + 10, y + 8], [x, y + 8], [x, y]]
        shape = {"type": "Polygon", "coordinates": [ring]}
        more = {"id": f"house {number}", "properties": {"floors": 3 if number == 69 else 2}}
        features.append({"type": "Feature", "geometry": shape} | more)
    crs = {"type": "name", "properties": {"name": "EPSG:28992"}}
    document = {"type": "FeatureCollection", "crs": crs, "features": features}
    (folder / "lots.geojson").write_text(json.dumps(document))
    out = folder / "out"
    rules, lots = str(folder / "rules.cga"), folder / "lots.geojson"
    result = run_derive(rules, lots, out, GrammarOptions(), Progress(quiet=True), jobs=1)
    assert (result.exit_code, result.built.count) == (0, 70)
    return out


def test_the_buildings_of_cityjson_have_them(town: Path) -> None:
    objects: dict[str, Any] = json.loads((town / "city.city.json").read_text())["CityObjects"]
    (low, high) = (objects[name]["attributes"] for name in ("house-0", "house-69"))
    # Sides of 2 (10 + 8) m by 6 and by 9 m.
    assert low["area.wall"] == pytest.approx(216.0)
    assert high["area.wall"] == pytest.approx(324.0)
    assert (low["area"], low["use"]) == (pytest.approx(80.0), "flats")
    assert "tall" not in low
    assert high["tall"] is True
    # The lot's own attribute stays.
    assert (low["floors"], low["report.floors"]) == (2, "many")


def test_the_table_has_a_row_for_each_building(town: Path) -> None:
    head, *rows = read_table(town / "reports.csv")
    assert sorted(head) == sorted(["id", "name", "area", "use", "floors", "area.wall", "tall"])
    found = {row[0]: dict(zip(head, row, strict=True)) for row in rows}
    assert len(rows) == len(found) == 70
    assert (found["house-0"]["name"], found["house-0"]["area.wall"]) == ("house 0", "216")
    assert (found["house-0"]["tall"], found["house-69"]["tall"]) == ("", "true")
    assert sum(float(row["area.wall"]) for row in found.values()) == 69 * 216 + 324


def test_the_report_sums_the_numbers(town: Path) -> None:
    found = json.loads((town / "report.json").read_text())["measures"]["reports"]
    wall = {"buildings": 70, "total": 69 * 216 + 324, "least": 216, "most": 324}
    assert found["area.wall"] == pytest.approx(wall)
    assert sorted(found) == ["area", "area.wall"]
    page = (town / "report.html").read_text()
    assert "Reported by the rules" in page
    assert "reports.csv" in page


def test_rules_that_report_nothing_have_no_table(tmp_path: Path) -> None:
    rules = tmp_path / "rules.cga"
    rules.write_text("Lot --> extrude(3) X.\n")
    out = tmp_path / "out"
    assert run_derive(str(rules), None, out, GrammarOptions(), Progress(quiet=True)).exit_code == 0
    assert not list(out.rglob("reports.csv"))
    assert "Reported" not in (out / "report.html").read_text()


def test_numbers_that_are_none_and_keys_without_end_do_no_harm() -> None:
    values = values_of([("a", float("inf")), ("b", float("nan")), ("c", 2.0), ("d", False)])
    assert values == {"a": "inf", "b": "nan", "c": 2.0, "d": False}
    assert list(sums_of([values])) == ["c"]
    many: Values = {f"key {n}": 1.0 for n in range(MAX_KEYS + 50)}
    assert len(sums_of([many])) == MAX_KEYS
    written = table([("1", "one", many)])
    assert written is not None
    assert len(written.decode().splitlines()[0].split(",")) == MAX_KEYS + 2
