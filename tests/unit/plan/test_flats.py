"""A flat has no roof and no garden of its own, and one walks in it alone."""

from __future__ import annotations

import pytest
from sample_plan import sample_plan, sample_storey, wall, window

from veduta.plan.document import Junction, PlanDocument, Text
from veduta.plan.flat_alone import as_flat
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


NEXT_DOOR = [("g", (8.0, -4.0)), ("h", (12.0, -4.0)), ("i", (2.0, 2.0)), ("j", (3.5, 2.0))]


def with_next_door(*texts: Text) -> PlanDocument:
    """The sample with walls of neighbours that hang on it, and a screen in the living room."""
    plain = sample_storey()
    ends = [Junction(id=name, at_m=at, type="end") for name, at in NEXT_DOOR]
    corner = next(one for one in plain.junctions if one.id == "c")
    junctions = [one for one in plain.junctions if one is not corner]
    walls = [wall("next-1", "c", "g"), wall("next-2", "g", "h"), wall("screen", "i", "j")]
    return sample_plan(
        sample_storey(
            junctions=[*junctions, corner.model_copy(update={"type": "T"}), *ends],
            walls=[*plain.walls, *walls],
            openings=[*plain.openings, window("theirs", "next-2", 1.0, 1.5)],
            texts=list(texts),
        )
    )


def alone(document: PlanDocument) -> PlanDocument:
    """The document as one of a flat."""
    return as_flat(document, HouseOptions(flat=True), drawn=True)


def test_walls_of_neighbours_are_left_out_of_a_flat() -> None:
    (storey,) = alone(with_next_door()).storeys
    (plain,) = sample_plan().storeys
    assert {one.id for one in storey.walls} == {*(one.id for one in plain.walls), "screen"}
    assert {one.id for one in storey.openings} == {one.id for one in plain.openings}
    types = {one.id: one.type for one in storey.junctions}
    assert types["c"] == "L"
    assert "g" not in types
    assert "8.0 m of wall that border no room" in storey.doubts[0]
    assert build_house(PlanDocument(storeys=[storey], flat=True), HouseOptions()).part


def test_walls_of_a_house_and_near_the_name_of_a_lost_room_stay() -> None:
    house = with_next_door()
    assert as_flat(house, HouseOptions(), drawn=True) is house
    lost = Text(text="Bedroom", box_px=[(980, 700), (1060, 700), (1060, 720), (980, 720)],
                score=0.9)  # fmt: skip
    (storey,) = alone(with_next_door(lost)).storeys
    assert len(storey.walls) == 10
    assert storey.doubts == []


def test_walls_of_an_own_room_that_was_not_found_stay_and_so_do_those_that_somebody_drew() -> None:
    document = with_next_door()
    (full,) = document.storeys
    found = [one for one in full.rooms if one.id != "bath"]
    openings = [one for one in full.openings if one.wall != "north-2"]
    lost = full.model_copy(update={"rooms": found, "openings": openings})
    (storey,) = alone(sample_plan(lost)).storeys
    gone = {one.id for one in full.walls} - {one.id for one in storey.walls}
    assert gone == {"next-1", "next-2"}
    assert "border no room that was found" in storey.doubts[0]
    rebuilt = as_flat(document, HouseOptions(flat=True), drawn=False)
    assert rebuilt.flat
    assert rebuilt.storeys == document.storeys
