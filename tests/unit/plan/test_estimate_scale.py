"""The scale of a sheet: given, by evidence of each kind, or assumed and said."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from veduta.plan.document import Text
from veduta.plan.scale.estimate import DrawnSizes, estimate_scale, scale_notes
from veduta.run.errors import InputError

BLANK = np.zeros((400, 600), dtype=np.float32)
ROOM = np.array([(50, 50), (450, 50), (450, 350), (50, 350)], dtype=float)


def _text(words: str, x: float, y: float, wide: float = 60.0, tall: float = 12.0) -> Text:
    left, right, top, bottom = x - wide / 2, x + wide / 2, y - tall / 2, y + tall / 2
    box = [(left, top), (right, top), (right, bottom), (left, bottom)]
    return Text(text=words, box_px=box, score=1.0)


def _sheet(*texts: Text, **fields: object) -> DrawnSizes:
    plain = DrawnSizes(rooms=[], doors=[], walls=[], ink=BLANK, texts=texts)
    return dataclasses.replace(plain, **fields)


def test_room_sizes() -> None:
    scale = estimate_scale(_sheet(_text("4.00 x 3.00", 250, 200), rooms=[ROOM]))
    assert scale.basis == "evidence"
    assert scale.metres_per_px == pytest.approx(0.01, rel=1e-6)
    assert scale.sigma == 0.03  # it is the only thing that says so
    assert scale_notes(scale) == []
    other = ROOM + np.array([450.0, 0.0])
    texts = [_text("4.00 x 3.00", *room.mean(axis=0)) for room in (ROOM, other)]
    scale = estimate_scale(_sheet(*texts, rooms=[ROOM, other]))
    assert 0.002 < scale.sigma < 0.01


def test_the_papers_width_rule() -> None:
    """AV3D: 17 m2 where the width is 235 px give sqrt(17 / 0.68) = 5 m and 47 px/m."""
    ink = BLANK.copy()
    ink[:, 97:101] = ink[:, 334:338] = 1.0
    scale = estimate_scale(_sheet(_text("17 m2", 218, 200), ink=ink))
    assert 1 / scale.metres_per_px == pytest.approx(47.0, rel=0.02)
    assert scale.sigma >= 0.15


def test_a_ratio_needs_a_resolution() -> None:
    sheet = _sheet(_text("1:100", 100, 380))
    assert estimate_scale(sheet).basis == "assumed"
    scale = estimate_scale(dataclasses.replace(sheet, dpi=300.0))
    assert scale.metres_per_px == pytest.approx(100 * 0.0254 / 300)
    assert scale.evidence[0].kind == "ratio"


@pytest.mark.parametrize("last", ["5m", "5 m"])
def test_a_scale_bar_of_single_numbers(last: str) -> None:
    marks = [_text(str(i), 100 + 50 * i, 380, 7) for i in (0, 1, 2)]
    # The number of the last mark stands under it; its unit comes after.
    width = 0.55 * 12 * len(last.replace(" ", ""))
    end = _text(last, 350 + 0.55 * 12 / 2, 380, width)
    scale = estimate_scale(_sheet(*marks, end))
    assert scale.evidence[0].kind == "bar"
    assert scale.metres_per_px == pytest.approx(1 / 50, rel=0.01)


def test_a_scale_bar_that_was_read_as_one_line() -> None:
    scale = estimate_scale(_sheet(_text("0 1 2 3 4", 200, 380, 200 + 6.6)))
    assert scale.metres_per_px == pytest.approx(1 / 50, rel=0.02)


def test_a_given_scale_goes_before_evidence_and_tells_what_disagrees() -> None:
    sheet = _sheet(_text("4.00 x 3.00", 250, 200), rooms=[ROOM])
    scale = estimate_scale(sheet, given=0.0125)
    assert (scale.metres_per_px, scale.basis) == (0.0125, "given")
    assert [one.agrees for one in scale.evidence] == [True, False]
    assert "4.00 x 3.00 (-20.0 %)" in scale_notes(scale)[0]
    assert scale_notes(estimate_scale(sheet, given=0.01)) == []


@pytest.mark.parametrize("given", [0.0, -1.0, 50.0, float("nan")])
def test_a_given_scale_that_is_none_is_refused(given: float) -> None:
    with pytest.raises(InputError, match="--scale"):
        estimate_scale(_sheet(), given=given)


def test_without_evidence_doors_then_walls_then_the_drawing_are_taken() -> None:
    ink = BLANK.copy()
    ink[100:200, 50:530] = 1.0
    doors = estimate_scale(_sheet(doors=[84, 85, 86], walls=[30], ink=ink))
    walls = estimate_scale(_sheet(walls=[30, 30, 12], ink=ink))
    drawing = estimate_scale(_sheet(ink=ink))
    assert doors.metres_per_px == pytest.approx(0.01)
    assert walls.metres_per_px == pytest.approx(0.01)
    assert drawing.metres_per_px == pytest.approx(12.0 / 480)
    assert doors.sigma < walls.sigma < drawing.sigma
    for scale in (doors, walls, drawing):
        assert scale.basis == "assumed"
        assert "Nothing on the sheet says its scale" in scale_notes(scale)[0]
        assert "--scale" in scale_notes(scale)[0]


def test_a_blank_sheet_has_a_scale_too() -> None:
    assert estimate_scale(_sheet()).metres_per_px == pytest.approx(12.0 / 600)


def test_what_disagrees_is_named() -> None:
    rooms = [ROOM, ROOM + np.array([0.0, 400.0]), ROOM + np.array([500.0, 0.0])]
    texts = [_text("4.00 x 3.00", *room.mean(axis=0)) for room in rooms[:2]]
    wrong = _text("8.00 x 6.00", *rooms[2].mean(axis=0))
    scale = estimate_scale(_sheet(*texts, wrong, rooms=rooms))
    assert scale.metres_per_px == pytest.approx(0.01, rel=1e-6)
    assert scale_notes(scale) == ["1 of 3 sizes on the sheet disagree: 8.00 x 6.00 (+100.0 %)."]


def test_doors_settle_what_a_lone_number_means() -> None:
    """`345` on a line of 345 px: by doors of 85 px it is centimetres, by 850 px millimetres."""
    ink = BLANK.copy()
    ink[200, 100:446] = 1.0
    ink[190:211, 100] = ink[190:211, 445] = 1.0
    text = _text("345", 272, 188, 24)
    near = estimate_scale(_sheet(text, ink=ink, doors=[85.0] * 3))
    far = estimate_scale(_sheet(text, ink=ink, doors=[850.0] * 3))
    assert near.metres_per_px == pytest.approx(0.01, rel=0.01)
    assert far.metres_per_px == pytest.approx(0.001, rel=0.01)


def test_a_number_that_doors_outvote_leaves_the_scale_assumed() -> None:
    """`88` on a line of 345 px fits doors of 85 px in no unit: it means something else."""
    ink = BLANK.copy()
    ink[200, 100:446] = 1.0
    ink[190:211, 100] = ink[190:211, 445] = 1.0
    text = _text("88", 272, 188, 24).model_copy(update={"score": 0.2})
    scale = estimate_scale(_sheet(text, ink=ink, doors=[85.0] * 3))
    assert scale.basis == "assumed"
    assert scale.metres_per_px == pytest.approx(0.01)
    assert [(one.kind, one.agrees) for one in scale.evidence] == [("door", True), ("line", False)]
    notes = scale_notes(scale)
    assert any("assumed" in note or "Nothing on the sheet says" in note for note in notes)


SCRIBBLES = st.text(alphabet="0123456789.,'\"″ xm²/:=½-ftO|lI", min_size=1, max_size=16)


@example(words=["0 1 1.883.25", "1.883.25 m", "1/0'' = 1'"])
@given(words=st.lists(SCRIBBLES, min_size=1, max_size=4))
def test_whatever_letters_are_read_from_a_scan_there_is_a_scale(words: list[str]) -> None:
    texts = [_text(word, 250 + 40 * row, 200) for row, word in enumerate(words)]
    scale = estimate_scale(_sheet(*texts, rooms=[ROOM], dpi=300.0))
    assert 0.0 < scale.metres_per_px < np.inf
