"""Labels belong to rooms; rooms without one are guessed, and said to be."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from veduta.plan.document import Text
from veduta.plan.names.guess import RoomFacts, guess_uses
from veduta.plan.names.name import name_rooms, shown
from veduta.plan.names.voids import names_void


def _box(x: float, y: float, wide: float, tall: float) -> NDArray[np.float64]:
    return np.array([(x, y), (x + wide, y), (x + wide, y + tall), (x, y + tall)], dtype=float)


def _text(words: str, x: float, y: float) -> Text:
    half = 4.0 * len(words)
    box = [(x - half, y - 6), (x + half, y - 6), (x + half, y + 6), (x - half, y + 6)]
    return Text(text=words, box_px=box, score=1.0)


def test_each_label_goes_to_its_room() -> None:
    rooms = [_box(0, 0, 400, 300), _box(410, 0, 300, 300), _box(720, 0, 20, 60)]
    texts = [_text("OH", 200, 150), _text("MH", 560, 150), _text("VH", 730, 30), _text("N", 900, 9)]
    facts = [RoomFacts(12.0), RoomFacts(9.0), RoomFacts(0.12)]
    named = name_rooms(rooms, texts, facts, [(0, 1), (1, 2)])
    assert [(one.use, one.name, one.origin) for one in named] == [
        ("living", "OH", "measured"),
        ("bedroom", "MH", "measured"),
        ("wardrobe", "VH", "measured"),
    ]


def test_two_lines_are_one_label() -> None:
    texts = [_text("LAUNDRY", 200, 150), _text("ROOM", 200, 164), _text("6'1\" x 6'0\"", 200, 178)]
    (named,) = name_rooms([_box(0, 0, 400, 300)], texts, [RoomFacts(3.4)], [])
    assert (named.use, named.name) == ("utility", "LAUNDRY ROOM")


def test_an_open_space_is_what_leads_it() -> None:
    texts = [_text("Kitchen", 60, 50), _text("Living room", 200, 200), _text("Dining", 300, 60)]
    (named,) = name_rooms([_box(0, 0, 400, 300)], texts, [RoomFacts(40.0)], [])
    assert (named.use, named.name) == ("living", "Living room")


def test_a_word_of_two_languages_is_that_of_the_sheet() -> None:
    """TH is a room with a fireplace in Finnish and a staircase in German."""
    rooms = [_box(0, 0, 100, 100), _box(110, 0, 100, 100), _box(220, 0, 100, 100)]
    facts = [RoomFacts(9.0)] * 3
    finnish = [_text("TH", 50, 50), _text("MH", 160, 50), _text("Keittiö", 270, 50)]
    german = [_text("TH", 50, 50), _text("Bad", 160, 50), _text("Küche", 270, 50)]
    assert name_rooms(rooms, finnish, facts, [])[0].use == "living"
    assert name_rooms(rooms, german, facts, [])[0].use == "stairs"


def test_without_labels_a_flat_is_guessed() -> None:
    """Hall, living room, bedroom, bathroom, cupboard behind the bedroom."""
    facts = [
        RoomFacts(7.0, 1.8, doors=5, windows=0),
        RoomFacts(26.0, 1.3, doors=2, windows=2),
        RoomFacts(12.0, 1.2, doors=2, windows=1),
        RoomFacts(4.8, 1.3, doors=1, windows=0),
        RoomFacts(1.4, 1.8, doors=1, windows=0),
    ]
    named = name_rooms(
        [_box(500 * i, 0, 400, 300) for i in range(5)], [], facts,
        [(0, 1), (0, 2), (0, 3), (2, 4)],
    )  # fmt: skip
    assert [one.use for one in named] == ["hall", "living", "bedroom", "bathroom", "wardrobe"]
    assert all(one.origin == "inferred" and one.name == "" and one.score < 1 for one in named)


@pytest.mark.parametrize("remark", ["MIN. 22x30 ATTIC ACCESS", "GAS FAU IN ATTIC"])
def test_what_is_written_for_builders_names_no_room(remark: str) -> None:
    texts = [_text(remark, 200, 100), _text("HALL", 200, 200)]
    (named,) = name_rooms([_box(0, 0, 400, 300)], texts, [RoomFacts(6.0)], [])
    assert (named.use, named.name) == ("hall", "HALL")
    (alone,) = name_rooms([_box(0, 0, 400, 300)], texts[:1], [RoomFacts(6.0)], [])
    assert alone.name == ""


def test_what_leads_to_three_rooms_is_no_bathroom() -> None:
    facts = [RoomFacts(3.6, 1.1, doors=3, windows=0), RoomFacts(3.9, 1.2, windows=0)]
    doors = [(0, 1), (0, 2), (0, 3)]
    known = [None, "bathroom", "living", "bedroom"]
    uses = guess_uses([*facts, RoomFacts(19.0), RoomFacts(13.0)], doors, known)
    assert uses[0][0] in ("hall", "corridor")
    assert guess_uses(facts[:1], [], [None])[0][0] == "bathroom"


@pytest.mark.parametrize(("way_out_m", "garage"), [(None, True), (2.4, True), (0.9, False)])
def test_a_car_needs_a_way_in(way_out_m: float | None, garage: bool) -> None:
    room = RoomFacts(27.0, 1.3, doors=1, windows=0, way_out_m=way_out_m)
    uses = guess_uses([room, RoomFacts(26.0, 1.3, doors=2)], [], [None, "living"])
    assert (uses[0][0] == "garage") is garage


@pytest.mark.parametrize(("area", "use"), [(5.0, "balcony"), (30.0, "terrace")])
def test_outdoors(area: float, use: str) -> None:
    assert guess_uses([RoomFacts(area, outdoors=True)], [], [None])[0][0] == use


@given(
    st.lists(
        st.builds(
            RoomFacts,
            area_m2=st.floats(0.01, 500.0),
            elongation=st.floats(1.0, 30.0),
            doors=st.integers(0, 12),
            windows=st.integers(0, 9),
        ),
        max_size=8,
    )
)
def test_any_rooms_get_a_use_and_a_probability(facts: list[RoomFacts]) -> None:
    doors = [(i, i + 1) for i in range(len(facts) - 1)]
    guesses = guess_uses(facts, doors, [None] * len(facts))
    assert len(guesses) == len(facts)
    assert all(0 <= score <= 1 and math.isfinite(score) for _, score in guesses)


def test_what_is_known_is_kept() -> None:
    assert guess_uses([RoomFacts(12.0)], [], ["sauna"]) == [("sauna", 1.0)]


@pytest.mark.parametrize(("area_m2", "uses"), [(13.0, ["stairs"]), (26.0, ["living", "hall"])])
def test_nobody_sleeps_where_stairs_are(area_m2: float, uses: list[str]) -> None:
    (named,) = name_rooms([_box(0, 0, 400, 300)], [], [RoomFacts(area_m2, stairs=True)], [])
    assert named.use in uses


@pytest.mark.parametrize(
    ("label", "name"),
    [
        ("2 CAR GARAGE 21'2 x 20'10", "2 CAR GARAGE"),
        ("Reception Room 5.74m x 3.96m (18'10\" x 13'0\")", "Reception Room"),
        ("Kitchen 12'0\" × 11'1\"", "Kitchen"),
        ("K/RU 17,4 m²", "K/RU"),
        ("Hall (3.2 sqm)", "Hall"),
        ("Chambre 1 12.30 m", "Chambre 1"),
        ("2668 W.I.C.", "W.I.C."),
        ("Bedroom 2", "Bedroom 2"),
        ("Office 2001", "Office 2001"),
        ("4.94 x 3.06", "4.94 x 3.06"),
    ],
)
def test_a_name_is_shown_without_the_sizes_beside_it(label: str, name: str) -> None:
    assert shown(label) == name


def test_what_lies_over_a_room_is_not_that_room() -> None:
    texts = [_text("vide sur", 200, 150), _text("salon", 200, 164)]
    (named,) = name_rooms([_box(0, 0, 400, 300)], texts, [RoomFacts(14.0)], [])
    assert (named.use, named.origin) == ("other", "measured")
    assert names_void(named.name)
    # A railing parts a landing from it: the space is the landing.
    both = [*texts, _text("Palier", 60, 40)]
    (named,) = name_rooms([_box(0, 0, 400, 300)], both, [RoomFacts(20.0)], [])
    assert not names_void(named.name)
