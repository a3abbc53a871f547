"""`overlay.png`: where outlines, numbers and floor lines stand on the picture."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from PIL import ImageFont

from veduta.facade.document import FacadeDocument
from veduta.facade.outputs import COLOURS
from veduta.facade.overlay import LEGEND_PX, PANEL_PX, floor_lines, overlay
from veduta.facade.overlay_numbers import FONT_PX, tags

Make = Callable[..., FacadeDocument]
FONT = ImageFont.load_default(FONT_PX)
GREY = np.full((200, 120, 3), 128, dtype=np.uint8)


def test_floor_lines_run_from_the_ground_to_the_eaves(make_document: Make) -> None:
    lines = floor_lines(make_document())
    assert lines == [(3.75, 115.0), (7.5, 40.0)]


def test_overlay_shows_elements(make_document: Make) -> None:
    plain = overlay(make_document(), GREY)
    found = overlay(make_document(elements=[("window", (20, 50, 20, 30))]), GREY)
    assert found.dtype == np.uint8
    scale = found.shape[0] / 200
    changed = (plain != found).any(axis=2)[:, : round(120 * scale)]
    rows, columns = np.nonzero(changed)
    assert abs(columns.min() - 20 * scale) < 5
    assert abs(columns.max() - 40 * scale) < 5
    assert abs(rows.min() - 50 * scale) < 5
    assert abs(rows.max() - 80 * scale) < 5


def seen_at(document: FacadeDocument, x: float, y: float) -> int | None:
    """The element that is painted last at a point in rectified pixels."""
    found = None
    for number, e in enumerate(document.elements):
        if e.x_px <= x <= e.x_px + e.width_px and e.y_px <= y <= e.y_px + e.height_px:
            found = number
    return found


side = st.floats(min_value=-20, max_value=130)
length = st.floats(min_value=0.5, max_value=90)


@given(st.lists(st.tuples(side, side, length, length), max_size=14), st.floats(0.7, 7.0))
def test_numbers_stand_on_what_is_seen_of_their_elements(
    make_document: Make, boxes: list[tuple[float, float, float, float]], scale: float
) -> None:
    document = make_document(elements=[("window", box) for box in boxes])
    for tag in tags(document, scale, FONT):
        left, top, right, bottom = tag.box
        assert 0 <= left < right <= 120 * scale + 0.5  # whole pixels
        assert 0 <= top < bottom <= 200 * scale + 0.5
        assert right - left > FONT.getlength(str(tag.number))
        points = [
            (x / scale, y / scale)
            for x in np.linspace(left, right, 22)[1:-1]
            for y in np.linspace(top, bottom, 22)[1:-1]
        ]
        share = np.mean([seen_at(document, x, y) == tag.number for x, y in points])
        assert share > 0.8  # 0.9 in whole pixels


def test_every_element_with_room_has_its_number(make_document: Make) -> None:
    elements = [
        ("window", (10, 50, 20, 30)),
        ("window", (50, 50, 3, 30)),  # too narrow
        ("window", (80, 50, 20, 3)),  # too low
        ("window", (10, 100, 20, 30)),  # its upper half hidden by the next
        ("balcony", (5, 95, 60, 20)),
        ("window", (70, 100, 20, 30)),  # hidden
        ("balcony", (65, 95, 40, 40)),
        ("window", (110, 100, 40, 30)),  # partly outside
    ]
    found = {tag.number: tag.box for tag in tags(make_document(elements=elements), 4.0, FONT)}
    assert sorted(found) == [0, 3, 4, 6, 7]
    assert found[0][:2] == (40, 200)
    assert found[3][3] == 4 * 130  # at its foot


@pytest.mark.parametrize(("score", "is_dashed"), [(0.5, False), (0.49, True), (1.0, False)])
def test_the_outline_of_a_doubtful_element_is_dashed(
    make_document: Make, score: float, is_dashed: bool
) -> None:
    document = make_document(elements=[("window", (20, 50, 60, 80))])
    document.elements[0].score = score
    picture = overlay(document, GREY).astype(int)
    scale = 1400 / 200
    # Along the lower border, where no number stands.
    row = picture[round(130 * scale), round(21 * scale) : round(79 * scale)]
    is_outline = np.abs(row - COLOURS["window"]).max(axis=1) < 12
    assert is_outline.all() != is_dashed
    if is_dashed:
        assert 0.3 < is_outline.mean() < 0.7
        changes = np.count_nonzero(np.diff(is_outline.astype(int)))
        assert changes > 20


def test_the_legend_has_room_beside_a_low_picture(make_document: Make) -> None:
    """All classes, doubt and numbers: nothing is drawn in its last rows."""
    names = list(COLOURS)
    elements = [(name, (10.0 + i, 60.0, 20.0, 20.0)) for i, name in enumerate(names)]
    document = make_document(size_px=(1200, 100), elements=elements)
    for element in document.elements:
        element.score = 0.1
    document.storeys_doubtful = True
    picture = overlay(document, np.full((100, 1200, 3), 128, dtype=np.uint8))
    assert picture.shape[:2] == (LEGEND_PX, 3000 + PANEL_PX)
    panel = picture[:, 3000:].astype(int)
    drawn = np.flatnonzero((np.abs(panel - panel[-1, -1]) > 20).any(axis=(1, 2)))
    assert LEGEND_PX - 60 < drawn.max() < LEGEND_PX - 8
