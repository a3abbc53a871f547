"""Storeys are called what their sheets call them, each by another name."""

from __future__ import annotations

import pytest

from veduta.plan.document import Text
from veduta.plan.names.storeys import (
    StoreyName,
    named_apart,
    out_of_order,
    storey_name,
    title_of,
)
from veduta.synthetic.plans.names import STOREYS


def text(words: str, score: float = 0.95) -> Text:
    return Text(text=words, box_px=[(0, 0), (50, 0), (50, 9), (0, 9)], score=score)


@pytest.mark.parametrize(
    ("line", "name", "rank"),
    [
        ("Fourth Floor", "Fourth Floor", 4),
        ("GROUND FLOOR PLAN", "Ground floor", 0),
        ("Plan of the First Floor", "First Floor", 1),
        ("2nd floor", "2nd floor", 2),
        ("Level 3", "Level 3", 3),
        ("BASEMENT", "Basement", -1),
        ("Grundriss Erdgeschoß", "Erdgeschoß", 0),
        ("1. OG", "1. OG", 1),
        ("Kellergeschoss", "Kellergeschoss", -1),
        ("Plan du 1er étage", "1er étage", 1),
        ("Sous-sol", "Sous-sol", -1),
        ("Planta baixa - 2º pavimento", "2º pavimento", 2),
        ("Segundo andar", "Segundo andar", 2),
        ("3. krs", "3. krs", 3),
        ("PIANO TERRA", "Piano terra", 0),
        ("Piano primo", "Piano primo", 1),
        ("Secondo piano", "Secondo piano", 2),
        ("Piano interrato", "Piano interrato", -1),
        ("Planta baja", "Planta baja", 0),
        ("Primera planta", "Primera planta", 1),
        ("PLANTA ALTA", "Planta alta", 99),
        ("Planta sótano", "Planta sótano", -1),
        ("Begane grond", "Begane grond", 0),
        ("1e verdieping", "1e verdieping", 1),
        ("Tweede verdieping", "Tweede verdieping", 2),
        ("Bottenvåning", "Bottenvåning", 0),
        ("ÖVERVÅNING", "Övervåning", 99),
        ("Källarplan", "Källarplan", -1),
        ("1F", "1F", 0),
        ("2F", "2F", 1),
        ("B1F", "B1F", -1),
        ("1階", "1階", 0),
        ("2階", "2階", 1),
        ("EG", "EG", 0),
        ("OG", "OG", 99),
        ("DG", "DG", 99),
        ("Grundriss EG", "EG", 0),
        ("קומת קרקע", "קומת קרקע", 0),
    ],
)
def test_titles(line: str, name: str, rank: int) -> None:
    assert title_of(line) == StoreyName(name, rank)


@pytest.mark.parametrize("language", STOREYS)
def test_the_titles_of_all_languages_are_in_order(language: str) -> None:
    found = [title_of(line) for line in STOREYS[language]]  # type: ignore[index]
    assert [one.name for one in found if one] == list(STOREYS[language])  # type: ignore[index]
    assert out_of_order(found) == []


@pytest.mark.parametrize(
    "line",
    [
        "Floor plan",
        "Plan",
        "Floor",
        "First",
        "Bedroom 1",
        "12",
        "Loft",
        "first floor flat 2",
        "og",
        "Planta",
    ],
)
def test_what_names_no_storey(line: str) -> None:
    assert title_of(line) is None


def test_a_sheet_has_one_title_that_is_read_surely() -> None:
    kitchen, first = text("Kitchen"), text("First Floor")
    assert storey_name([kitchen, first, text("FIRST FLOOR")]) is not None
    assert storey_name([kitchen, first, text("Ground Floor")]) is None
    assert storey_name([text("First Floor", 0.6)]) is None


def test_no_two_storeys_have_one_name() -> None:
    first, again = StoreyName("First Floor", 1), StoreyName("first floor", 1)
    assert named_apart([None, None]) == ["ground floor", "first floor"]
    assert named_apart([StoreyName("Basement", -1), None]) == ["Basement", "first floor"]
    assert named_apart([first, None]) == ["First Floor", "storey 2"]
    assert named_apart([first, again]) == ["ground floor", "first floor"]
    assert named_apart([None] * 6)[-1] == "floor 5"


def test_a_wrong_order_is_said() -> None:
    upper, lower = StoreyName("First Floor", 1), StoreyName("Ground Floor", 0)
    assert out_of_order([lower, None, upper]) == []
    (said,) = out_of_order([upper, None, lower])
    assert "'Ground Floor' is given after 'First Floor'" in said
