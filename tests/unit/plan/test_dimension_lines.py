"""Dimension lines of all drawings, drawn with known ends."""

from __future__ import annotations

import math

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray

from veduta.plan.document import Text
from veduta.plan.scale.dimension_lines import dimension_spans, is_height_under, line_voters
from veduta.plan.scale.vote import take_vote

TALL = 14


def _text(words: str, x: float, y: float, upwards: bool = False) -> Text:
    w = 4.0 * len(words)
    h = TALL / 2.0
    box = [(x - w, y - h), (x + w, y - h), (x + w, y + h), (x - w, y + h)]
    if upwards:  # from below: the first letter is at the bottom, its top to the left
        box = [(x - h, y + w), (x - h, y - w), (x + h, y - w), (x + h, y + w)]
    return Text(text=words, box_px=box, score=0.95)


def _sheet() -> NDArray[np.float32]:
    return np.zeros((300, 500), dtype=np.float32)


def _line(ink: NDArray[np.float32], start: tuple[int, int], end: tuple[int, int]) -> None:
    cv2.line(ink, start, end, 1.0, 1)


def _ends(ink: NDArray[np.float32], x: int, y: int, style: str, inwards: int) -> None:
    if style == "slash":
        _line(ink, (x - 6, y + 6), (x + 6, y - 6))
    elif style == "tick":
        _line(ink, (x, y - 6), (x, y + 6))
    elif style == "dot":
        cv2.circle(ink, (x, y), 5, 1.0, -1)
    else:
        _line(ink, (x, y - 12), (x, y + 12))
        tip = np.array([(x, y), (x + 10 * inwards, y - 4), (x + 10 * inwards, y + 4)])
        cv2.fillPoly(ink, [tip], 1.0)


@pytest.mark.parametrize("style", ["slash", "tick", "dot", "arrow"])
@pytest.mark.parametrize("place", ["above", "through", "below"])
@pytest.mark.parametrize("upwards", [False, True])
def test_the_likeliest_span_is_the_line_that_was_drawn(
    style: str, place: str, upwards: bool
) -> None:
    ink = _sheet()
    _line(ink, (100, 150), (340, 150))
    _ends(ink, 100, 150, style, 1)
    _ends(ink, 340, 150, style, -1)
    if place == "through":
        ink[140:161, 195:246] = 0.0
    y = {"above": 136, "through": 150, "below": 164}[place]
    text = _text("2400", 220, y)
    if upwards:
        ink = np.ascontiguousarray(np.rot90(ink))
        text = _text("2400", y, 500 - 220, upwards=True)
    spans = dimension_spans(text, ink)
    # An arrow's mark reaches from its tip to its barbs: half of that to either side.
    assert spans[0][0] == pytest.approx(240, abs=13 if style == "arrow" else 2.5)


def test_a_chain_gives_each_number_its_own_piece() -> None:
    ink, ends = _sheet(), [40, 130, 300, 470]
    _line(ink, (40, 200), (470, 200))
    for x in ends:
        _ends(ink, x, 200, "slash", 1)
    pieces = list(zip(ends, ends[1:], strict=False))
    texts = [_text(f"{(b - a) * 20}", (a + b) / 2, 186) for a, b in pieces]
    verdict = take_vote(line_voters(texts, ink, 0.7))
    assert verdict.metres_per_px == pytest.approx(0.02, rel=0.01)
    assert verdict.agrees == (True, True, True)


def test_a_number_beside_a_wall_or_alone_has_no_line() -> None:
    ink = _sheet()
    ink[160:172, 50:450] = 1.0
    assert dimension_spans(_text("2400", 220, 146), ink) == []
    assert dimension_spans(_text("101", 220, 60), ink) == []


def test_texts_that_are_no_lengths_do_not_vote() -> None:
    ink = _sheet()
    _line(ink, (100, 150), (340, 150))
    _ends(ink, 100, 150, "tick", 1)
    _ends(ink, 340, 150, "tick", -1)
    assert line_voters([_text("Kitchen", 220, 136)], ink, 0.7) == []
    (voter,) = line_voters([_text("2.40 m", 220, 136)], ink, 0.7)
    best = max(voter.hypotheses, key=lambda one: one.trust)
    assert math.exp(best.log_mpp) == pytest.approx(0.01, rel=0.01)


def test_the_height_under_a_width_is_no_length_of_its_line() -> None:
    ink = _sheet()
    _line(ink, (80, 150), (460, 150))
    for x in (100, 240, 440):
        _ends(ink, x, 150, "slash", 1)
    width, height = _text("1,40", 170, 138), _text("1,385", 170, 164)
    other = _text("2,00", 340, 138)
    assert is_height_under(height, width)
    assert not is_height_under(width, height)
    assert not is_height_under(height, other)
    voters = line_voters([width, height, other], ink, 0.7)
    assert [one.text for one in voters] == ["1,40", "2,00"]
    assert take_vote(voters).metres_per_px == pytest.approx(0.01, rel=0.01)


def test_both_faces_of_a_thin_wall_are_ends() -> None:
    ink = _sheet()
    _line(ink, (40, 150), (470, 150))
    for x in (60, 250, 257, 450):
        _ends(ink, x, 150, "slash", 1)
    spans = [span for span, _ in dimension_spans(_text("1,90", 150, 138), ink)]
    assert min(abs(span - 190.0) for span in spans) <= 1.5
    spans = [span for span, _ in dimension_spans(_text("1,93", 350, 138), ink)]
    assert min(abs(span - 193.0) for span in spans) <= 1.5


def test_a_line_that_runs_close_beside_a_mark_is_told_from_it() -> None:
    ink = _sheet()
    _line(ink, (40, 150), (470, 150))
    for x in (60, 260):
        _ends(ink, x, 150, "slash", 1)
    _line(ink, (248, 100), (248, 200))
    spans = [span for span, _ in dimension_spans(_text("2,00", 150, 138), ink)]
    assert min(abs(span - 200.0) for span in spans) <= 1.0
