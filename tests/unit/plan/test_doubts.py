"""What is said at the terminal of a house that was found."""

from __future__ import annotations

from sample_plan import sample_plan

from veduta.plan.document import Opening, PlanDocument, Scale, Stairs, Text
from veduta.plan.doubts import doubts
from veduta.plan.house.space import space_of
from veduta.plan.report import measures, summary_line


def changed(scale: Scale | None = None, **openings: dict[str, object]) -> PlanDocument:
    """The sample with another scale, or with openings changed by their ids."""
    plan = sample_plan()
    storey = plan.storeys[0]
    now: list[Opening] = [
        one.model_copy(update=openings.get(one.id, {})) for one in storey.openings
    ]
    storey = storey.model_copy(update={"openings": now, "scale": scale or storey.scale})
    return plan.model_copy(update={"storeys": [storey]})


def test_nothing_is_said_of_a_sound_house() -> None:
    assert doubts(changed(), None) == []


def test_an_assumed_scale_is_said_also_without_its_evidence() -> None:
    scale = changed().storeys[0].scale
    assumed = scale.model_copy(update={"basis": "assumed", "sigma": 0.4, "evidence": []})
    (said,) = doubts(changed(assumed), None)
    assert "Sizes may be wrong by 80 %" in said


def test_rooms_without_a_door_are_named() -> None:
    shut = {one.id: {"kind": "window"} for one in changed().storeys[0].openings}
    (said,) = doubts(changed(None, **shut), None)
    assert said == "no door was found into 2 rooms: living, bath."


def test_doubtful_openings_are_counted_by_their_kind() -> None:
    doors = [one.id for one in changed().storeys[0].openings if one.kind == "door"]
    line = summary_line(measures(changed(None, **{doors[0]: {"score": 0.2}})))
    assert "doors (1 doubtful)" in line or "door (1 doubtful)" in line
    assert line.count("doubtful") == 1


def test_doubtful_openings_are_named_with_their_rooms() -> None:
    (said,) = doubts(changed(None, inner={"score": 0.2}, w2={"score": 0.4, "kind": "gap"}), None)
    assert said.startswith(
        "doubtful: door inner between Living (living) and Bath (bath), gap w2 of Bath (bath);"
    )


def test_an_arrow_to_the_north_that_is_not_read_is_said() -> None:
    plan = changed()
    letter = Text(text="N", box_px=[(0, 0), (9, 0), (9, 9), (0, 9)], score=0.9)
    storey = plan.storeys[0].model_copy(update={"texts": [letter]})
    plan = plan.model_copy(update={"storeys": [storey]})
    told = [one for one in doubts(plan, None) if "north" in one]
    assert len(told) == 1
    assert "--north" in told[0]
    assert doubts(plan.model_copy(update={"north_deg": 20.0}), None) == [
        one for one in doubts(plan, None) if one not in told
    ]


def test_steep_stairs_are_said() -> None:
    """Four treads to the next floor: steps of 56 cm, and nothing says which way they rise."""
    flight = Stairs(
        id="s1", outline_m=[(1.0, 1.0), (3.0, 1.0), (3.0, 1.9), (1.0, 1.9)], treads=4,
        up=(0.0, 0.0), score=0.9, origin="measured",
    )  # fmt: skip
    lower = changed().storeys[0].model_copy(update={"stairs": [flight]})
    upper = lower.model_copy(update={"name": "first floor", "elevation_m": 2.8, "stairs": []})
    spaces = [space_of(one, 2.55) for one in (lower, upper)]
    plan = changed().model_copy(update={"storeys": [lower, upper]})
    assert any("are steep" in one for one in doubts(plan, None, spaces))
