"""An edited document: rooms follow walls that were moved; --scale scales all of it."""

from __future__ import annotations

from pathlib import Path

import pytest
from sample_plan import sample_plan
from shapely.geometry import Polygon

from veduta.plan.document import PlanDocument
from veduta.plan.follow_walls import with_rooms_on_walls
from veduta.plan.load import load_document
from veduta.plan.rescale import rescaled


def moved(by_m: float, names: set[str]) -> PlanDocument:
    """The sample with some junctions moved to the right."""
    plan = sample_plan()
    storey = plan.storeys[0]
    junctions = [
        one.model_copy(update={"at_m": (one.at_m[0] + by_m * (one.id in names), one.at_m[1])})
        for one in storey.junctions
    ]
    return plan.model_copy(update={"storeys": [storey.model_copy(update={"junctions": junctions})]})


def _right_edge() -> set[str]:
    storey = sample_plan().storeys[0]
    most = max(one.at_m[0] for one in storey.junctions)
    return {one.id for one in storey.junctions if one.at_m[0] > most - 0.01}


def test_a_sound_document_is_left_alone() -> None:
    plan = sample_plan()
    followed, notes = with_rooms_on_walls(plan)
    assert followed is plan
    assert notes == []


def test_rooms_grow_with_the_wall_that_was_moved() -> None:
    plan = moved(0.5, _right_edge())
    followed, notes = with_rooms_on_walls(plan)
    before, after = (sum(room.area_m2 for room in one.storeys[0].rooms) for one in (plan, followed))
    high = max(one.at_m[1] for one in plan.storeys[0].junctions) - min(
        one.at_m[1] for one in plan.storeys[0].junctions
    )
    # The strip is as long as the free part of the wall.
    assert 0.5 * (high - 1.0) < after - before <= 0.5 * high
    assert notes
    for room in followed.storeys[0].rooms:
        assert room.area_m2 == pytest.approx(Polygon(room.outline_m, room.holes_m).area, abs=1e-3)


def test_a_scale_is_of_all_that_was_measured() -> None:
    plan = sample_plan()
    storey = plan.storeys[0]
    mm_per_px = 2.0 * 1000.0 * storey.sheet.metres_per_px  # of the file, whose pixels are those
    sheet = storey.sheet.model_copy(update={"clean_from_scan": [[1, 0, 0], [0, 1, 0], [0, 0, 1]]})
    plan = plan.model_copy(update={"storeys": [storey.model_copy(update={"sheet": sheet})]})
    twice, (note,) = rescaled(plan, mm_per_px)
    now = twice.storeys[0]
    assert "by 2" in note
    assert now.scale.basis == "given"
    for old, new in zip(storey.rooms, now.rooms, strict=True):
        assert new.area_m2 == pytest.approx(4.0 * old.area_m2, rel=1e-3)
    for old, new in zip(storey.openings, now.openings, strict=True):
        assert new.width_m == pytest.approx(2.0 * old.width_m)
        assert new.height_m == old.height_m
    assert rescaled(twice, mm_per_px) == (twice, [])
    assert rescaled(plan, None) == (plan, [])


@pytest.mark.regression
def test_the_moved_wall_of_the_case(veduta_data: Path) -> None:
    path = veduta_data / "cases" / "plan" / "b3d_wall_moved.plan.json"
    if not path.is_file():
        pytest.skip(f"no {path.name} in {veduta_data}")
    followed, notes = with_rooms_on_walls(load_document(path))
    areas = {room.id: room.area_m2 for room in followed.storeys[0].rooms}
    assert areas["r3"] == pytest.approx(4.9, abs=0.1)
    assert areas["r6"] == pytest.approx(2.6, abs=0.1)
    assert len(notes) == 4
