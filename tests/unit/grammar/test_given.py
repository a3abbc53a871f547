"""Attributes and the start rule as a call gives them."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from veduta import _core
from veduta.grammar.deriving import attributes_of, seed_of
from veduta.grammar.given import check_options, read_attributes
from veduta.grammar.lot import Lot
from veduta.grammar.options import AttributeOptions, DeriveOptions, GrammarOptions
from veduta.grammar.outline import Attribute
from veduta.run.errors import InputError

RULES = _core.GrammarRules(
    [
        (
            "test.cga",
            'attr height = 50% : 3 else : 4\nattr roof = "flat"\nattr shops = true\n'
            "attr area = rand(3)\n@StartRule Lot --> NIL\nOther --> NIL\nNeeds(a) --> NIL",
        )
    ]
)
PATH = Path("test.cga")


def checked(*words: str, start: str | None = None) -> dict[str, Attribute]:
    options = GrammarOptions(attributes=read_attributes(words), derive=DeriveOptions(start=start))
    return check_options(RULES, PATH, options).attributes.values


def test_values_are_what_the_rules_say() -> None:
    words = ("height=12.5", "roof=7", "shops=FALSE", "area=9")
    assert checked(*words) == {"height": 12.5, "roof": "7", "shops": False, "area": 9.0}


@pytest.mark.parametrize(
    ("word", "fault", "remedy"),
    [
        ("height", "is not NAME=VALUE", "--attr height=12"),
        ("heigth=3", "is no attribute of test.cga", "`height`"),
        ("height=tall", "is a number", "12.5"),
        ("height=nan", "is a number", "12.5"),
        ("shops=maybe", "is a truth value", "true or false"),
    ],
)
def test_what_cannot_be_is_refused(word: str, fault: str, remedy: str) -> None:
    with pytest.raises(InputError) as caught:
        checked(word)
    assert fault in caught.value.fault
    assert remedy in caught.value.remedy


def test_a_rule_that_cannot_start_is_refused() -> None:
    checked(start="Other")
    for name in ("Othr", "Needs"):
        with pytest.raises(InputError, match="can start without arguments"):
            checked(start=name)


def test_the_call_goes_before_the_lot_and_the_lot_before_the_file() -> None:
    lot = Lot("a", "a", (np.zeros((3, 2)),), (0, 0, 0), {"height": "8", "roof": 2.0, "colour": "x"})
    kinds = dict(RULES.attributes)
    assert attributes_of(lot, kinds, GrammarOptions()) == {"height": 8.0, "roof": "2"}
    given = GrammarOptions(attributes=AttributeOptions(values={"height": 9.0}))
    assert attributes_of(lot, kinds, given) == {"height": 9.0, "roof": "2"}
    bad = Lot("a", "a", lot.rings_m, lot.anchor_m, {"height": "tall"})
    assert "property height" in str(attributes_of(bad, kinds, GrammarOptions()))


def test_seeds_of_lots_differ_and_stay() -> None:
    lots = [Lot(name, name, (), (0, 0, 0)) for name in "abc"]
    seeds = {seed_of(lot, seed) for lot in lots for seed in range(5)}
    assert len(seeds) == 15
    assert all(0 <= seed < 2**64 for seed in seeds)
