"""Which breaks are closed together: those that one after the other would be judged the same."""

from __future__ import annotations

import itertools
from dataclasses import replace

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely.geometry import Polygon, box

from veduta.plan.rooms import mend
from veduta.plan.rooms.breaks import Break
from veduta.plan.rooms.closing import Closing, Placed, Reason, apart
from veduta.plan.rooms.enclosed import enclosed_by
from veduta.plan.walls.axes import Axis
from veduta.plan.walls.pieces import Piece

DOOR: Reason = "a door is drawn there"
NAMES: Reason = "two rooms are named in one space"
OPEN: Reason = "a room is open to the outdoors"
HALL = box(0.0, 0.0, 200.0, 40.0)


def cut(
    x: float, worth: float, *, reason: Reason = DOOR, hall: Polygon = HALL, number: int = 0,
    outdoors: bool = False, wide: float = 4.0,
) -> Placed:  # fmt: skip
    """A break across a hall at x; outdoors the hall is open at its right end."""
    low, high = hall.bounds[1], hall.bounds[3]
    broken = Break(np.array([x, low]), np.array([x, high]), wide, ())
    body = box(x - wide / 2, low - 1.0, x + wide / 2, high + 1.0)
    parts = tuple(hall.difference(body).geoms)
    right = hall.bounds[2]
    still_open = tuple(part.bounds[2] == right for part in parts) if outdoors else None
    return Placed(Closing(broken, reason, worth), body, frozenset({number}), parts, still_open)


def places(closings: list[Closing]) -> list[float]:
    return [float(one.broken.start[0]) for one in closings]


def test_what_is_apart_in_one_space_is_closed_at_once_the_best_first() -> None:
    assert places(apart([cut(50.0, 2.1), cut(120.0, 2.9), cut(90.0, 2.5)])) == [120.0, 90.0, 50.0]


def test_of_breaks_that_cross_only_the_best_is_closed() -> None:
    assert places(apart([cut(50.0, 2.1), cut(52.0, 2.4), cut(120.0, 2.2)])) == [52.0, 120.0]


def test_outdoors_nothing_is_closed_behind_what_is_closed() -> None:
    """It would be indoors then, where other things speak for a closing."""
    both = [cut(50.0, 2.9, outdoors=True), cut(120.0, 2.5, outdoors=True)]
    assert places(apart(both)) == [50.0]


def test_what_is_drawn_nowhere_waits_for_what_is() -> None:
    other = box(0.0, 100.0, 200.0, 140.0)
    undrawn = cut(50.0, 1.9, reason=OPEN, hall=other, number=1, outdoors=True)
    assert places(apart([undrawn, cut(120.0, 2.5)])) == [120.0]
    assert places(apart([undrawn])) == [50.0]


def test_names_speak_for_one_closing_of_a_space_at_a_time() -> None:
    """Each says that there are two names on both sides, which the first may part."""
    other = box(0.0, 100.0, 200.0, 140.0)
    found = apart([
        cut(50.0, 0.9, reason=NAMES),
        cut(120.0, 0.8, reason=NAMES),
        cut(70.0, 0.7, reason=NAMES, hall=other, number=1),
    ])  # fmt: skip
    assert places(found) == [50.0, 70.0]


def test_a_break_in_two_spaces_is_closed_alone_in_both() -> None:
    other = box(0.0, 41.0, 200.0, 80.0)
    both = replace(cut(50.0, 2.9), spaces=frozenset({0, 1}))
    beside = [cut(120.0, 2.5), cut(120.0, 2.4, hall=other, number=1)]
    assert places(apart([both, *beside])) == [50.0]
    third = cut(90.0, 2.1, hall=box(0.0, 200.0, 200.0, 240.0), number=2)
    assert places(apart([both, *beside, third])) == [50.0, 90.0]


def test_a_wall_that_makes_no_room_is_not_kept_with_one_that_makes_two() -> None:
    """Two rooms without a wall at one end of both; and a stub that parts nothing."""

    def wall(*ends: float) -> Axis:
        return Axis(Piece(np.array(ends[:2]), np.array(ends[2:]), 8.0), ())

    given = [
        wall(0, 0, 300, 0), wall(0, 200, 300, 200), wall(0, 0, 0, 200), wall(0, 100, 300, 100),
    ]  # fmt: skip
    enclosed = enclosed_by(given, 8.0)
    assert len(enclosed.rooms) == 0
    closing, stub = wall(300, 0, 300, 200), wall(150, 200, 150, 300)
    kept, whole = mend._closed(enclosed, [closing, stub], 8.0)
    assert kept == [0]
    assert len(whole.rooms) == 2
    assert len(whole.axes) == len(given) + 1
    assert mend._closed(enclosed, [stub], 8.0) == ([], enclosed)


cuts = st.lists(
    st.tuples(st.integers(20, 180), st.floats(2.0, 3.0), st.floats(1.0, 30.0)),
    min_size=1, max_size=8, unique_by=lambda one: one[0] // 4,
)  # fmt: skip


@given(cuts)
@settings(max_examples=60, deadline=None)
def test_each_of_those_makes_a_part_more(drawn: list[tuple[int, float, float]]) -> None:
    chosen = apart([cut(float(x), worth, wide=wide) for x, worth, wide in drawn])
    assert chosen[0].worth == max(worth for _, worth, _ in drawn)
    clear = all(
        abs(x - y) > (wide + other) / 2
        for (x, _, wide), (y, _, other) in itertools.combinations(drawn, 2)
    )
    assert len(chosen) == len(drawn) or not clear
    rest = HALL
    for one in chosen:
        half = one.broken.thickness_px / 2
        rest = rest.difference(
            box(one.broken.start[0] - half, -1.0, one.broken.start[0] + half, 41.0)
        )
    assert len(getattr(rest, "geoms", [rest])) == len(chosen) + 1
