"""Printed sizes of rooms against outlines of known size, whatever their direction and shape."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from veduta.plan.document import Text
from veduta.plan.scale.room_sizes import room_voters
from veduta.plan.scale.vote import take_vote


def _text(words: str, x: float, y: float) -> Text:
    box = [(x - 20, y - 6), (x + 20, y - 6), (x + 20, y + 6), (x - 20, y + 6)]
    return Text(text=words, box_px=box, score=0.95)


def _turned(corners: list[tuple[float, float]], angle: float) -> NDArray[np.float64]:
    cos, sin = math.cos(angle), math.sin(angle)
    return np.array(corners) @ np.array([[cos, sin], [-sin, cos]]) + 1000.0


@given(
    st.integers(200, 900), st.integers(200, 900), st.floats(0.008, 0.04),
    st.floats(0.0, 3.0), st.booleans(),
)  # fmt: skip
def test_a_room_in_any_direction(
    a_cm: int, b_cm: int, mpp: float, angle: float, swap: bool
) -> None:
    w, h = a_cm / 100 / mpp, b_cm / 100 / mpp
    room = _turned([(0, 0), (w, 0), (w, h), (0, h)], angle)
    first, second = (b_cm, a_cm) if swap else (a_cm, b_cm)
    text = _text(f"{first / 100:.2f} x {second / 100:.2f}", *room.mean(axis=0))
    (voter,) = room_voters([text], [room], 0.7)
    best = max(voter.hypotheses, key=lambda one: one.trust)
    assert math.exp(best.log_mpp) == pytest.approx(mpp, rel=1e-6)


def test_an_open_room_is_measured_through_its_text() -> None:
    """A dining corner of 3 x 2.5 m and a kitchen in one L-shaped space, at 1 cm for a pixel."""
    space = np.array([(0, 0), (700, 0), (700, 250), (400, 250), (400, 600), (0, 600)], dtype=float)
    texts = [_text("4.00 x 6.00", 200, 450), _text("7,00 x 2,50", 550, 125)]
    verdict = take_vote(room_voters(texts, [space], 0.7))
    assert verdict.metres_per_px == pytest.approx(0.01, rel=1e-3)
    assert verdict.agrees == (True, True)


def test_areas_of_rooms_and_of_the_whole() -> None:
    left = np.array([(0, 0), (400, 0), (400, 300), (0, 300)], dtype=float)
    right = left + np.array([410.0, 0.0])
    texts = [_text("12,0 m2", 200, 150), _text("24 m²", 600, 150), _text("24,0 m²", 400, 500)]
    verdict = take_vote(room_voters(texts, [left, right], 0.7))
    assert verdict.metres_per_px == pytest.approx(0.01, rel=1e-3)
    assert verdict.agrees == (True, True, True)


def test_a_text_outside_all_rooms_says_nothing_of_a_room() -> None:
    room = np.array([(0, 0), (400, 0), (400, 300), (0, 300)], dtype=float)
    assert room_voters([_text("4.00 x 3.00", 900, 900)], [room], 0.7) == []


def test_an_outline_that_crosses_itself_is_survived() -> None:
    bow = np.array([(0, 0), (400, 300), (400, 0), (0, 300)], dtype=float)
    for voter in room_voters([_text("4.00 x 3.00", 50, 150)], [bow], 0.7):
        assert all(math.isfinite(one.log_mpp) for one in voter.hypotheses)


def test_sizes_in_rooms_that_run_together_do_not_agree_on_their_outline() -> None:
    """Four rooms of one depth, whose walls were missed, would all say a third of the scale."""
    texts = [_text(f"{a}.00 x 3.00", 150 * a, 300) for a in (2, 3, 4, 5)]
    together = np.array([(0, 0), (1000, 0), (1000, 900), (0, 900)], dtype=float)
    alone = np.array([(0, 950), (500, 950), (500, 1200), (0, 1200)], dtype=float)
    voters = room_voters([*texts, _text("5.00 x 2.50", 250, 1100)], [together, alone], 0.7)
    assert take_vote(voters).metres_per_px == pytest.approx(0.01, rel=1e-3)


def test_a_size_in_metres_and_in_feet_is_one_of_its_room() -> None:
    room = np.array([(0, 0), (400, 0), (400, 300), (0, 300)], dtype=float)
    texts = [_text("4.00 x 3.00", 200, 150), _text("13'1 x 9'10", 200, 165)]
    both = room_voters(texts, [room], 0.7)
    single = room_voters(texts[:1], [room], 0.7)
    assert both[0].hypotheses == single[0].hypotheses
