"""A flat has no roof and no garden of its own, and one walks in it alone."""

from __future__ import annotations

import pytest
from sample_plan import sample_plan

from veduta.plan.document import PlanDocument, Text
from veduta.plan.flats import flat_named, flat_options, with_flat
from veduta.plan.house.build import build_house
from veduta.plan.options import HouseOptions
from veduta.plan.tour.find import find_tour


def written(text: str, score: float = 0.95) -> Text:
    return Text(text=text, box_px=[(0, 0), (9, 0), (9, 3), (0, 3)], score=score)


def saying(text: str) -> PlanDocument:
    plan = sample_plan()
    storey = plan.storeys[0].model_copy(update={"texts": [written(text)]})
    return plan.model_copy(update={"storeys": [storey]})


@pytest.mark.parametrize(
    "text", ["Apartment 12", "3h+k", "2-Zimmer-Wohnung", "2LDK", "FLAT B", "Appartement"]
)
def test_a_sheet_can_say_that_it_is_a_flat(text: str) -> None:
    assert flat_named([written(text)]) == text
    found = with_flat(saying(text), HouseOptions(), by_text=True)
    assert found.flat
    assert "taken for a flat" in found.storeys[0].doubts[0]
    assert not with_flat(saying(text), HouseOptions(), by_text=False).flat


@pytest.mark.parametrize("text", ["Flat roof above", "Kitchen", "2.90", "LDK 16"])
def test_other_words_say_nothing_of_it(text: str) -> None:
    assert flat_named([written(text)]) is None
    assert flat_named([written("Apartment", 0.5)]) is None


def test_the_option_takes_roof_and_garden_away() -> None:
    document = with_flat(sample_plan(), HouseOptions(flat=True), by_text=False)
    options = flat_options(document, HouseOptions())
    assert (options.roof, options.surroundings) == ("none", "none")
    house = build_house(document, options)
    assert not any("roof" in name for name in house.part.features.name)
    tour = find_tour(house, 1.2, indoors=True)
    assert tour is not None
    assert tour.notes == ()
    assert "Outside" not in {one.title for one in tour.stretches}


def test_a_house_stays_one() -> None:
    options = HouseOptions()
    assert flat_options(sample_plan(), options) is options
