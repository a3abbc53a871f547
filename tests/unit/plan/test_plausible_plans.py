"""Scales and findings that can be no house: voted down before, refused after."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from sample_plan import sample_plan

from veduta.plan.document import Text
from veduta.plan.doubts import doubts, position_notes, unlike_storeys
from veduta.plan.no_house import check_house
from veduta.plan.scale.estimate import DrawnSizes, estimate_scale
from veduta.plan.scale.evidence import Hypothesis, Voter
from veduta.plan.scale.plausible import limits_of, plausible
from veduta.run.errors import NotFoundError

ROOM = np.array([(100, 100), (600, 100), (600, 450), (100, 450)], float)


def sizes(
    texts: tuple[Text, ...] = (), doors: tuple[float, ...] = (78.0, 80.0, 79.0)
) -> DrawnSizes:
    """A room of 500 x 350 px whose doors are 80 px wide."""
    ink = np.zeros((600, 800), dtype=np.float32)
    return DrawnSizes([ROOM], list(doors), [12.0, 12.0, 25.0], ink, texts=texts)


def written(text: str) -> Text:
    return Text(text=text, box_px=[(300, 250), (400, 250), (400, 280), (300, 280)], score=1.0)


def test_a_scale_by_which_doors_are_wrong_is_out() -> None:
    # All rooms have at least 4 m2, which says more than doors of 0.3 m, and doors at most 3.2 m.
    low, high = limits_of(sizes())
    assert low == pytest.approx(math.sqrt(4.0 / (500 * 350)))
    assert high == pytest.approx(3.2 / 79.0)
    right, absurd = (Hypothesis(math.log(mpp), 0.01, 1.0) for mpp in (0.0106, 0.00066))
    (kept,) = plausible([Voter("dimension", "11X12", "r", (absurd, right))], (low, high))
    assert kept.hypotheses == (right,)
    assert plausible([Voter("dimension", "11X12", "r", (absurd,))], (low, high)) == []


def test_rooms_of_a_house_have_three_square_metres_on_average() -> None:
    """Six rooms of 500 x 350 px and a cupboard, which does not count."""
    cupboard = ROOM[0] + (ROOM - ROOM[0]) * 0.05
    house = replace(sizes(), rooms=[*(ROOM + 600.0 * row for row in range(6)), cupboard])
    assert limits_of(house)[0] == pytest.approx(math.sqrt(18.0 / (6 * 500 * 350)), rel=1e-2)
    few = replace(house, rooms=house.rooms[:4])
    assert limits_of(few)[0] == pytest.approx(max(0.3 / 79.0, math.sqrt(4.0 / (4 * 500 * 350))))


def test_limits_that_contradict_each_other_leave_those_of_doors() -> None:
    assert limits_of(sizes(doors=(1.0, 1.0, 1.0)))[0] == pytest.approx(0.3)


def test_whole_numbers_without_marks_are_feet() -> None:
    """500 x 350 px are 17.4 x 12.2 ft with doors of 0.85 m: 17X12 says feet."""
    scale = estimate_scale(sizes((written("17X12"),)))
    assert scale.basis == "evidence"
    assert scale.metres_per_px == pytest.approx(17 * 0.3048 / 500.0, rel=0.03)


def test_storeys_beside_each_other_vote_together() -> None:
    alone = estimate_scale(sizes())
    assert alone.basis == "assumed"
    both = estimate_scale(sizes(), beside=[sizes((written("5.30 x 3.71"),))])
    assert both.metres_per_px == pytest.approx(0.0106, rel=0.01)


def _changed(**update: object) -> None:
    storey = sample_plan().storeys[0]
    check_house(storey.model_copy(update=update), "a.png")


def test_a_house_is_one() -> None:
    _changed()


def test_no_rooms_or_tiny_ones_are_no_house() -> None:
    storey = sample_plan().storeys[0]
    with pytest.raises(NotFoundError, match="no room that is closed"):
        _changed(rooms=[])
    tiny = [room.model_copy(update={"area_m2": 0.1}) for room in storey.rooms]
    with pytest.raises(NotFoundError, match="no house is so small"):
        _changed(rooms=tiny)


def test_strokes_around_one_room_are_no_windows() -> None:
    storey = sample_plan().storeys[0]
    window = next(one for one in storey.openings if one.kind == "window")
    many = [window.model_copy(update={"id": f"w{number}"}) for number in range(34)]
    assumed = storey.scale.model_copy(update={"basis": "assumed"})
    with pytest.raises(NotFoundError, match="34 windows"):
        _changed(rooms=storey.rooms[:1], openings=many, scale=assumed)


def test_a_mirror_and_a_turn_are_said() -> None:
    sheet = sample_plan().storeys[0].sheet
    assert position_notes(sheet) == []
    (said,) = position_notes(sheet.model_copy(update={"mirrored": True}))
    assert "mirror image" in said
    (said,) = position_notes(sheet.model_copy(update={"rotation_rad": math.pi / 2 + 0.01}))
    assert "90 degrees" in said


def test_storeys_that_differ_in_size_are_told() -> None:
    plan = sample_plan()
    lower = plan.storeys[0]
    half = [
        one.model_copy(update={"at_m": (one.at_m[0] * 0.5, one.at_m[1] * 0.5)})
        for one in lower.junctions
    ]
    upper = lower.model_copy(update={"junctions": half, "name": "upper"})
    assert unlike_storeys([lower, lower]) == []
    (said,) = unlike_storeys([lower, upper])
    assert "upper" in said
    both = plan.model_copy(update={"storeys": [lower, upper]})
    assert said in doubts(both, None)


def test_walls_that_stand_apart_are_called_bearing_walls() -> None:
    plan = sample_plan().storeys[0]
    ends = [
        one.model_copy(update={"id": f"{one.id}-{number}", "type": "end"})
        for one in plan.junctions
        for number in range(3)
    ]
    walls = [
        wall.model_copy(update={"start": f"{wall.start}-1", "end": f"{wall.end}-2"})
        for wall in plan.walls
    ]
    apart = plan.model_copy(
        update={"rooms": [], "openings": [], "junctions": ends, "walls": walls, "stairs": []}
    )
    (said,) = check_house(apart, "columns.png")
    assert "bearing walls or columns alone" in said
    assert "all walls of the rooms" in said
    few = apart.model_copy(update={"walls": walls[:3]})
    with pytest.raises(NotFoundError, match="3 walls and 0 windows, but no room"):
        check_house(few, "strokes.png")


def test_walls_that_meet_around_no_room_are_no_house() -> None:
    storey = sample_plan().storeys[0].model_copy(update={"rooms": [], "openings": []})
    with pytest.raises(NotFoundError, match="no room that is closed"):
        check_house(storey, "scribble.png")
