"""Furnished houses, by checks that know nothing of how they were furnished."""

from __future__ import annotations

from dataclasses import replace

import pytest
from plan_documents import document_of
from plan_furnish_checks import doors_shut, overlaps
from sample_plan import opening, rectangle, room, sample_plan, sample_storey

from veduta.plan.document import PlanDocument, Storey
from veduta.plan.furnish import furnish as recipe
from veduta.plan.furnish.catalogue.entry import Wanted
from veduta.plan.furnish.catalogue.read import builtin_catalogue
from veduta.plan.furnish.furnish import furnish
from veduta.synthetic.plans.layout import make_house

SLAB_M = 0.25


def furnished(document: PlanDocument, seed: int = 0, *, varied: bool = False) -> PlanDocument:
    return furnish(document, builtin_catalogue(), seed, SLAB_M, varied=varied)[0]


def things(storey: Storey, use: str) -> list[str]:
    """The types of things in the rooms of a use."""
    rooms = {one.id for one in storey.rooms if one.use == use}
    entries = builtin_catalogue().entries
    return [entries[one.object].type for one in storey.furniture or () if one.room in rooms]


@pytest.mark.parametrize("seed", [3, 32, 34, 36, 41])
def test_nothing_overlaps_and_all_doors_are_reached(seed: int) -> None:
    for storey in furnished(document_of(make_house(seed)), seed).storeys:
        assert overlaps(storey) == []
        assert doors_shut(storey) == []


def test_the_checks_see_what_is_wrong() -> None:
    storey = furnished(sample_plan()).storeys[0]
    first = next(one for one in storey.furniture or () if one.above_m == 0.0)
    twice = [*(storey.furniture or ()), first.model_copy(update={"id": "again"})]
    assert (first.id, "again") in overlaps(storey.model_copy(update={"furniture": twice}))
    # The front door is 1 m wide from x = 0.6 on; a box of 2 m before it shuts it.
    before = {"id": "box", "at_m": (1.1, 1.2), "size_m": (2.0, 2.0, 1.0), "above_m": 0.0}
    box = [first.model_copy(update=before)]
    assert "front+" in doors_shut(storey.model_copy(update={"furniture": box}))


def test_the_same_seed_gives_the_same_house_and_another_seed_another() -> None:
    document = sample_plan()
    first = furnished(document, 7)
    assert first == furnished(document, 7)
    assert first != furnished(document, 8)


def test_rooms_have_what_their_use_asks_for() -> None:
    storey = furnished(sample_plan()).storeys[0]
    bath = things(storey, "bathroom")
    assert {"toilet", "mirror"} <= set(bath)
    assert any(kind.startswith("basin") for kind in bath)
    assert {"bathtub", "shower"} & set(bath)
    living = things(storey, "living")
    assert {"sofa", "tv-bench", "tv"} <= set(living)


def test_a_television_is_opposite_of_the_sofa() -> None:
    storey = furnished(sample_plan()).storeys[0]
    entries = builtin_catalogue().entries
    of = {entries[one.object].type: one for one in storey.furniture or ()}
    sofa, screen = of["sofa"], of["tv"]
    turned = abs(sofa.turn_rad - screen.turn_rad)
    assert turned == pytest.approx(3.14159, abs=1e-3)
    assert screen.on == of["tv-bench"].id
    assert screen.above_m == pytest.approx(of["tv-bench"].size_m[2], abs=1e-3)


def test_one_model_of_a_type_in_the_house_unless_asked() -> None:
    entries = builtin_catalogue().entries
    house = document_of(make_house(3))

    def models(document: PlanDocument, kind: str) -> set[str]:
        return {
            one.object
            for storey in document.storeys
            for one in storey.furniture or ()
            if entries[one.object].type == kind
        }

    plain = furnished(house)
    for kind in ("bed-double", "nightstand", "chair"):
        assert len(models(plain, kind)) <= 1
    assert len(models(furnished(house, varied=True), "nightstand")) > 1


@pytest.mark.parametrize("seed", [3, 32, 36])
def test_no_room_has_one_picture_twice_and_rooms_differ(seed: int) -> None:
    entries = builtin_catalogue().entries
    document = furnished(document_of(make_house(seed)), seed)
    hung = [
        (storey.name, one.room, one.object)
        for storey in document.storeys
        for one in storey.furniture or ()
        if entries[one.object].type == "picture"
    ]
    assert len(hung) >= 2
    assert len(set(hung)) == len(hung)
    assert len({motif for _, _, motif in hung}) >= min(len(hung), 4)


def test_a_storey_that_has_furniture_stays_as_it_is() -> None:
    empty = sample_storey(furniture=[])
    assert furnished(sample_plan(empty)).storeys[0] == empty


def test_a_small_bathroom_gets_a_shower_for_a_bathtub() -> None:
    """1.5 x 2.1 m: no wall is long enough for a bathtub beside the door and the rest."""
    rooms = [
        room("living", rectangle(0.15, 0.15, 4.94, 4.85), use="hall"),
        room("bath", rectangle(5.06, 0.15, 6.7, 2.15), use="bathroom"),
    ]
    storey = sample_storey(rooms=rooms, openings=[opening("inner", "middle", 0.6, 0.75)])
    done = furnished(sample_plan(storey)).storeys[0]
    assert "toilet" in things(done, "bathroom")
    assert "bathtub" not in things(done, "bathroom")


def test_a_garage_for_one_car_has_one_and_the_other_is_told() -> None:
    """A second car is asked for by the area of 4.8 x 4.7 m, and finds no place."""
    rooms = [room("car", rectangle(0.15, 0.15, 4.94, 4.85), use="garage")]
    storey = sample_storey(rooms=rooms, openings=[opening("gate", "west", 1.0, 3.0, type="garage")])
    done = furnished(sample_plan(storey)).storeys[0]
    assert sum("car" in one for one in things(done, "garage")) == 1


def test_a_room_as_large_as_a_park_is_left_empty_and_that_is_told() -> None:
    """Its grid would have 64 million cells."""
    park = rectangle(0.0, 0.0, 400.0, 400.0)
    storey = sample_storey(walls=[], openings=[], junctions=[], rooms=[room("park", park)])
    document, rooms = furnish(sample_plan(storey), builtin_catalogue(), 0, SLAB_M)
    assert document.storeys[0].furniture == []
    assert [one.notes for one in rooms] == [("is left empty: it is too large",)]


def test_wishes_beyond_what_a_room_may_have_are_told(monkeypatch: pytest.MonkeyPatch) -> None:
    """Ten stools are asked for, and six things are the most."""
    monkeypatch.setattr(recipe, "MOST_THINGS", 6)
    stools = Wanted("living", "stool", 10, 10, 0.0, 1000.0, 1.0, critical=False, place=1)
    asked = replace(builtin_catalogue(), wanted=(stools,))
    document, rooms = furnish(sample_plan(), asked, 0, SLAB_M)
    assert len(document.storeys[0].furniture or []) == 6
    assert [one.notes for one in rooms] == [
        ("has 6 things, which are the most; 4 wishes were not looked at",),
        (),
    ]
