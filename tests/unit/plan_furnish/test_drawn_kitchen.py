"""Kitchen rows where hob and sink are drawn: units, a worktop between them, a hood above."""

from __future__ import annotations

import numpy as np
import pytest
from sample_plan import sample_plan

from veduta.plan.document import Fitting, Furniture, PlanDocument
from veduta.plan.furnish import drawn_kitchen
from veduta.plan.furnish.catalogue.read import catalogue_of
from veduta.plan.furnish.furnish import furnish

BACK_M = 4.85
"""The inner face of the north wall of the sample's larger room, which is a kitchen here."""


def fitting(kind: str, x: float, back_m: float = BACK_M, width_m: float = 0.55) -> Fitting:
    """Drawn with its back to the north wall."""
    return Fitting.model_validate(
        {
            "id": f"{kind}{x}",
            "kind": kind,
            "room": "living",
            "at_m": (x, back_m - 0.3),
            "turn_rad": 0.0,
            "size_m": (width_m, 0.5),
            "score": 0.9,
        }
    )


def furnished(*fittings: Fitting) -> list[Furniture]:
    plan: PlanDocument = sample_plan()
    storey = plan.storeys[0]
    rooms = [
        room.model_copy(update={"use": "kitchen"} if room.id == "living" else {})
        for room in storey.rooms
    ]
    storey = storey.model_copy(update={"rooms": rooms, "fittings": list(fittings)})
    document = plan.model_copy(update={"storeys": [storey]})
    made, _ = furnish(document, catalogue_of(None), 0, 0.25)
    return [one for one in made.storeys[0].furniture or [] if one.room == "living"]


def test_what_finds_no_place_is_called_as_it_is_drawn(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(drawn_kitchen, "_stands", lambda *_: False)
    plan = sample_plan()
    drawn = [fitting("kitchen-sink", 1.2), fitting("hob", 3.2)]
    storey = plan.storeys[0].model_copy(update={"fittings": drawn})
    document = plan.model_copy(update={"storeys": [storey]})
    _, rooms = furnish(document, catalogue_of(None), 0, 0.25)
    notes = " ".join(note for room in rooms for note in room.notes)
    assert "the kitchen-sink that is drawn" in notes
    assert "the hob that is drawn" in notes


def of_kind(things: list[Furniture], word: str) -> list[Furniture]:
    return [one for one in things if one.object.startswith(word)]


def ends(one: Furniture) -> tuple[float, float]:
    return one.at_m[0] - one.size_m[0] / 2, one.at_m[0] + one.size_m[0] / 2


def test_what_stands_between_hob_and_sink_is_the_counter() -> None:
    things = furnished(fitting("kitchen-sink", 1.2), fitting("hob", 3.2))
    (sink,), (hob,) = of_kind(things, "kitchen-sink"), of_kind(things, "kitchen-hob")
    assert (sink.origin, hob.origin) == ("measured", "measured")
    assert sink.at_m[0] == pytest.approx(1.2, abs=0.21)
    assert hob.at_m[0] == pytest.approx(3.2, abs=0.21)
    row = sorted((one for one in things if one.above_m == 0.0 and ends(one)[0] >= ends(sink)[0]
                  and ends(one)[1] <= ends(hob)[1] and one.at_m[1] > 4.0),
                 key=lambda one: one.at_m[0])  # fmt: skip
    assert len(row) >= 3
    for first, second in zip(row, row[1:], strict=False):
        assert ends(first)[1] == pytest.approx(ends(second)[0], abs=0.005)
    backs = [one.at_m[1] + one.size_m[1] / 2 for one in row]
    np.testing.assert_allclose(backs, BACK_M, atol=0.03)
    between = row[1:-1]
    assert {one.origin for one in between} == {"inferred"}
    assert of_kind(things, "hood")


def test_only_one_row_and_one_hob() -> None:
    things = furnished(fitting("kitchen-sink", 1.2), fitting("hob", 3.2))
    assert len(of_kind(things, "kitchen-hob")) == 1
    assert len(of_kind(things, "kitchen-sink")) == 1


def test_a_lone_sink_gets_its_hob_in_the_same_row() -> None:
    things = furnished(fitting("kitchen-sink", 1.2))
    (hob,) = of_kind(things, "kitchen-hob")
    assert hob.origin == "invented"
    assert hob.at_m[1] + hob.size_m[1] / 2 == pytest.approx(BACK_M, abs=0.03)
    assert hob.at_m[0] > 1.2


def test_units_that_are_drawn_too_near_stand_side_by_side() -> None:
    things = furnished(fitting("kitchen-sink", 1.5), fitting("hob", 2.1))
    (sink,), (hob,) = of_kind(things, "kitchen-sink"), of_kind(things, "kitchen-hob")
    assert ends(sink)[1] == pytest.approx(ends(hob)[0], abs=0.005)


def test_what_is_drawn_in_the_middle_of_a_room_is_not_against_a_wall() -> None:
    things = furnished(fitting("hob", 2.4, back_m=3.0))
    assert len(of_kind(things, "kitchen-hob")) <= 1
    assert not [one for one in of_kind(things, "kitchen-hob") if one.origin == "measured"]
