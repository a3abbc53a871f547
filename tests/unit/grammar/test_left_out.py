"""Which rule made the surfaces that are left out, and where it stands."""

from __future__ import annotations

from veduta.grammar.left_out import is_left_out, left_out_notes, told_of_all

RULES = """version "2024.0"
Lot --> extrude(3) comp(f) { side : Wall }
// Cloth --> a remark
Wall --> Cloth Sign(2)
  Cloth --> s('1, 0, 0)
Sign(n) --> s(n, 0, 0)
"""


def test_each_rule_is_named_with_its_line() -> None:
    lots = [left_out_notes(["Cloth", "Sign", "Cloth"]), left_out_notes(["Cloth"]), ["else"]]
    assert lots[0][0] == "2 surfaces of Cloth were left out: too thin, or their lines cross"
    assert told_of_all(lots, 4, [("rules/shop.cga", RULES)]) == [
        "3 surfaces of Cloth (shop.cga:5) were left out: too thin, or their lines cross",
        "1 surfaces of Sign (shop.cga:6) were left out: too thin, or their lines cross",
    ]
    assert is_left_out(lots[0][0])
    assert not is_left_out("else")


def test_of_many_buildings_the_number_alone_is_known() -> None:
    (told,) = told_of_all([], 7, [])
    assert told.startswith("7 surfaces were left out")
    assert told_of_all([[]], 0, []) == []
    assert "Roof were left out" in told_of_all([left_out_notes(["Roof"])], 1, [])[0]
