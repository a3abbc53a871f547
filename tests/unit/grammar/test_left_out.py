"""Which rule made the surfaces that are left out, and where it stands."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from test_neighbours import row_of

from veduta.cli.main import main
from veduta.grammar.left_out import LeftOut, left_out_by_rule, told_of_all

RULES = """version "2024.0"
Lot --> extrude(3) comp(f) { side : Wall }
// Cloth --> a remark
Wall --> Cloth Sign(2)
  Cloth --> s('1, 0, 0)
Sign(n) --> s(n, 0, 0)
"""


def test_each_rule_is_named_with_its_line() -> None:
    lots = [left_out_by_rule(["Sign", "Cloth", "Cloth"]), left_out_by_rule(["Cloth"]), ()]
    assert lots[0] == (LeftOut("Cloth", 2), LeftOut("Sign", 1))
    assert lots[0][0].told() == "2 surfaces of Cloth were left out: too thin, or their lines cross"
    counted = [{one.rule: one.count for one in lot} for lot in lots]
    assert told_of_all(counted, {"Cloth": 9}, [("rules/shop.cga", RULES)]) == [
        "3 surfaces of Cloth (shop.cga:5) were left out: too thin, or their lines cross",
        "1 surfaces of Sign (shop.cga:6) were left out: too thin, or their lines cross",
    ]


def test_of_many_buildings_the_tiles_say_it() -> None:
    assert told_of_all([], {"Sign": 7}, [("rules/shop.cga", RULES)]) == [
        "7 surfaces of Sign (shop.cga:6) were left out: too thin, or their lines cross"
    ]
    assert told_of_all([{}], {}, []) == []
    many = {f"Rule{number}": 20 - number for number in range(12)}
    told = told_of_all([], many, [])
    assert len(told) == 11
    assert told[-1] == "19 surfaces of 2 more rules were left out"


def test_a_town_names_rules_and_missing_assets_at_the_terminal(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    rules = tmp_path / "town.cga"
    rules.write_text(
        "Lot --> extrude(4) comp(f) { front : Front | side : Wall | all : NIL }\n"
        "Front --> [ Thin ] [ t(0, 1, 0) Thin ]\n"
        '  i("sign" + rint(rand(0, 5)) + ".obj") A.\n'
        "Thin --> s('1, 0, 0)\n"
        "Wall --> B."
    )
    lots = tmp_path / "lots.geojson"
    lots.write_text(json.dumps(row_of(70, [6.0])))
    words = ["grammar", "derive", str(rules), "--lots", str(lots), "-o", str(tmp_path / "out")]
    assert main([*words, "--jobs", "1"]) == 0
    told = capsys.readouterr().out
    assert "140 surfaces of Thin (town.cga:4) were left out" in told, told
    assert "6 assets of computed names cannot be had: a box stands for each" in told
    assert told.count("sign0.obj") == 1
    assert "and 3 more" in told
