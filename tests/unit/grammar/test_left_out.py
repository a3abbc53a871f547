"""Which rule made the surfaces that are left out, and where it stands."""

from __future__ import annotations

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
    assert told_of_all(counted, 4, [("rules/shop.cga", RULES)]) == [
        "3 surfaces of Cloth (shop.cga:5) were left out: too thin, or their lines cross",
        "1 surfaces of Sign (shop.cga:6) were left out: too thin, or their lines cross",
    ]


def test_of_many_buildings_the_number_alone_is_known() -> None:
    (told,) = told_of_all([], 7, [])
    assert told.startswith("7 surfaces were left out")
    assert told_of_all([{}], 0, []) == []
    assert "Roof were left out" in told_of_all([{"Roof": 1}], 1, [])[0]
