"""The small cases of `cases/grammar`: each stands for a kind of file, and comes out as it says."""

from __future__ import annotations

from pathlib import Path

import pytest

from veduta.grammar.deriving import deriver
from veduta.grammar.lot import Lot
from veduta.grammar.lots import read_lots
from veduta.grammar.options import GrammarOptions, LotOptions
from veduta.grammar.otherwise import otherwise
from veduta.grammar.rules import check_rules, read_rules

RULES: dict[str, str | None] = {
    "latin1.cga": "was read as cp1252",
    "project/rules/texture.cga": None,
    "project/rules/asset.cga": None,
    "project/rules/a.cga": None,
    "group-without-star.cga": None,
    "extrude-world-y.cga": None,
    "setupprojection-5.cga": None,
    "alignscope-2.cga": None,
    "innerrect.cga": None,
    "builtin-cube.cga": None,
    "builtin-uvtest.cga": None,
    "filerandom.cga": None,
    "dead-branch-refused.cga": None,
    "soften-normals.cga": "`softenNormals` does not derive: the shape stays as it is",
    "handle-caret.cga": None,
    "undefined-rule-with-arguments.cga": None,
    "projectuv-without-setup.cga": None,
    "missing-asset.cga": "a box stands for it",
    "flat-asset/flat.cga": None,
    "shop-awnings-left-out.cga": None,
    "house.cga": None,
}
"""What has to be told of a file; None where nothing has to."""
LOTS = (
    "crs-epsg-code.geojson",
    "lot.shp",
    "map.osm",
    "a.kml",
    "ms.geojsonl",
    "street.geojson",
    "osmattrs.geojson",
)


@pytest.fixture
def cases(veduta_data: Path) -> Path:
    folder = veduta_data / "cases" / "grammar"
    if not folder.is_dir():
        pytest.skip(f"no {folder}")
    return folder


def test_each_case_is_tried(cases: Path) -> None:
    rows = [line.split("|")[1].strip() for line in (cases / "INDEX.md").read_text().splitlines()
            if line.startswith("|")][2:]  # fmt: skip
    listed = [name.strip() for row in rows for name in row.replace(" + ", ",").split(",")]
    assert len(rows) == 26
    assert set(listed) <= {*RULES, *LOTS}


@pytest.mark.parametrize("name", RULES)
def test_rules_derive_on_the_plain_lot(name: str, cases: Path) -> None:
    rules = read_rules(cases / name)
    assert check_rules(rules).errors == 0, check_rules(rules).told
    (lot,) = read_lots(cases / "rect.geojson").lots
    made = deriver(rules.files, rules.search, GrammarOptions())
    built = made.together([lot], 2.0)
    assert made.fault(built, 0, lot) is None
    low, high, _ = built.extent(0) or ((0.0,) * 3, (0.0,) * 3, 0)
    assert max(high) - min(low) < 200.0, "no asset is blown up"
    told = " ".join([*otherwise(rules, made.rules), *made.library.missing.values()])
    wanted = RULES[name]
    assert wanted is None or wanted in told, told


@pytest.mark.parametrize("name", LOTS)
def test_lots_are_read(name: str, cases: Path) -> None:
    options = LotOptions(crs="EPSG:25832") if name == "lot.shp" else LotOptions()
    lots = list(read_lots(cases / name, options).lots)
    assert len(lots) >= 1
    rules = read_rules(cases / "house.cga")
    made = deriver(rules.files, rules.search, GrammarOptions())
    built = made.together(lots, 2.0)
    assert [made.fault(built, row, lot) for row, lot in enumerate(lots)] == [None] * len(lots)


def test_a_lot_looks_at_the_road_in_its_file(cases: Path) -> None:
    found = read_lots(cases / "street.geojson")
    (lot,) = found.lots
    assert _looks_north(lot), "the road lies in the north"
    assert found.roads


def test_lengths_with_units_are_metres(cases: Path) -> None:
    rules = read_rules(cases / "house.cga")
    made = deriver(rules.files, rules.search, GrammarOptions())
    lots = list(read_lots(cases / "osmattrs.geojson").lots)
    built = made.together(lots, 2.0)
    heights = {lot.id: (built.extent(row) or ((0, 0, 0), (0, 0, 0), 0))[1][2]
               for row, lot in enumerate(lots)}  # fmt: skip
    # Walls of that height under a roof of 2 m.
    assert heights["strm"] == pytest.approx(14.0)
    assert heights["strh"] == pytest.approx(14.5)


def _looks_north(lot: Lot) -> bool:
    along = lot.rings_m[0][1] - lot.rings_m[0][0]
    return bool(-along[0] > abs(along[1]))
