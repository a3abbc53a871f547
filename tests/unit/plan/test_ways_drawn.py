"""Names of rooms tell which of several ways the walls of a sheet are drawn in."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from veduta.plan import reading
from veduta.plan.document import Text
from veduta.plan.drawn import Cleaned, Drawn, DrawnRoom
from veduta.plan.reading import MOST_WALLS, likeliest, read_storey
from veduta.plan.walls.solid import Thickness
from veduta.plan.walls.ways import Way
from veduta.run.errors import NotFoundError
from veduta.synthetic.plans.degrade import DEGRADATIONS
from veduta.synthetic.plans.sets import sheets_of
from veduta.synthetic.plans.styles import BY_NAME
from veduta.synthetic.plans.truth_file import SheetTruth

CLEAN = next(one for one in DEGRADATIONS if one.name == "clean")


def names(truth: SheetTruth) -> list[Text]:
    """A name in the middle of each room."""
    found = []
    for room in truth.storey.rooms:
        middle = np.append(np.mean(room.outline_m, axis=0), 1.0)
        x, y = (truth.px_from_m @ middle)[:2]
        box = [(x - 20, y - 6), (x + 20, y - 6), (x + 20, y + 6), (x - 20, y + 6)]
        found.append(Text(text="Bedroom", box_px=box, score=1.0))
    return found


@pytest.mark.parametrize(("seed", "style"), [(4014, "single"), (4003, "hollow")])
def test_names_that_lie_in_one_room_speak_against_a_reading(seed: int, style: str) -> None:
    """A flight's sides look like hollow walls there, and the space between lines of dimensions."""
    picture, truth = next(iter(sheets_of(seed, BY_NAME[style], CLEAN)))
    rooms = len(truth.storey.rooms)
    assert rooms - 1 <= len(read_storey(np.asarray(picture), names(truth)).rooms) <= rooms + 1


LABELS = [np.array([x, 5.0]) for x in (5.0, 15.0, 25.0, 35.0)]


def drawn(*widths: float) -> Drawn:
    """Rooms side by side, ten pixels deep."""
    ends = np.cumsum([0.0, *widths])
    rooms = [
        DrawnRoom(
            str(low), np.array([(low, 0.0), (high, 0.0), (high, 10.0), (low, 10.0)]),
            (), (), (), False, 0.9,
        )
        for low, high in zip(ends, ends[1:], strict=False)
    ]  # fmt: skip
    blank = np.zeros((10, 40), np.float32)
    cleaned = Cleaned(np.zeros((10, 40, 3), np.uint8), blank, np.eye(3), False, 0.0, 1.0)
    return Drawn(cleaned, (), (), (), tuple(rooms))


def none(_: float = 0.0) -> Drawn:
    raise NotFoundError("walls", "there are none", "Give some.")


def says(*found: Drawn) -> list[Callable[[float], Drawn]]:
    """Readings with these results."""
    return [lambda _, one=one: one for one in found]


def test_the_first_reading_stands_where_names_have_rooms() -> None:
    first, second = drawn(10, 10, 20), drawn(10, 10, 10, 10)
    assert likeliest(says(first, second), LABELS)[1] is first


def test_the_best_reading_is_taken_where_they_have_none() -> None:
    one, two, three = drawn(40), drawn(20, 20), drawn(30, 10)
    assert likeliest([*says(one), none, *says(two, three)], LABELS)[1] is two
    assert likeliest([none, *says(one)], LABELS)[1] is one


def test_noise_is_read_once() -> None:
    one, two = drawn(40), drawn(10, 10, 10, 10)
    noise = replace(one, walls=(None,) * 1000)  # type: ignore[arg-type]
    assert likeliest(says(noise, two), LABELS)[1] is noise
    # Where no name has a room in it, others are asked for, but for no more noise.
    asked = []

    def other(most_pieces: float) -> Drawn:
        asked.append(most_pieces)
        return two

    assert likeliest([*says(replace(noise, rooms=())), other], LABELS)[1] is two
    assert asked == [MOST_WALLS]


def test_few_names_say_nothing() -> None:
    one, two = drawn(40), drawn(20, 20)
    assert likeliest(says(one, two), LABELS[:3])[1] is one
    with pytest.raises(NotFoundError, match="there are none"):
        likeliest([none, *says(one)], LABELS[:3])
    with pytest.raises(NotFoundError, match="there are none"):
        likeliest([none, none], LABELS)


def test_walls_scribbled_by_hand_are_asked_for_last(monkeypatch: pytest.MonkeyPatch) -> None:
    """Hatched ones look like it: a house within a ring of walls is looked for before."""
    blank = np.zeros((4, 4), np.bool_)
    ways = [
        Way(blank, blank, Thickness(2.0, 4.0), "hatched", told) for told in ("by hand", "by ink")
    ]
    asked: list[str] = []

    def refused(sheet: object, way: Way, *_: object, **__: object) -> Drawn:
        asked.append(way.told)
        return none()

    def ring(sheet: object, way: Way, *_: object) -> Drawn:
        asked.append(f"within a ring, {way.told}")
        return none()

    monkeypatch.setattr(reading, "ways_drawn", lambda *_: iter(ways))
    monkeypatch.setattr(reading, "room_labels", lambda *_, **__: LABELS)
    monkeypatch.setattr(reading, "_read", refused)
    monkeypatch.setattr(reading, "_within_ring", ring)
    sheet = reading.Sheeted(drawn(40).cleaned, (), (), None)
    with pytest.raises(NotFoundError):
        reading._likeliest_way(sheet)
    assert asked == ["by ink", "within a ring, by ink", "by hand"]
