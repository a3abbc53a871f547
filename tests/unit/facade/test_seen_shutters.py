"""Shutters and blinds, from pixels that a network would give."""

from __future__ import annotations

import numpy as np
import pytest
from sample_document import element, sample_document

from veduta.facade.document import FacadeDocument, Shutter
from veduta.facade.eyes import Seen
from veduta.facade.seen_shutters import seen_shutters

HALF = 2
"""Pixels of the picture for one of the network's grid."""


def _document() -> FacadeDocument:
    """Two windows in a row, 48 x 68 px, at x 64 and 180."""
    return sample_document([element("window", x, 2.9, 1.2, 1.7) for x in (1.1, 4.0)])


def _seen(document: FacadeDocument, parts: list[tuple[float, float, float, float]]) -> Seen:
    """Blinds in rectangles, in shares of the first window (left, top, right, foot)."""
    window = document.elements[0]
    width, height = document.rectification.width_px, document.rectification.height_px
    classes = np.zeros((2, height // HALF, width // HALF), np.float32)
    classes[0] = 1.0
    for x0, y0, x1, y1 in parts:
        columns = [round((window.x_px + x * window.width_px) / HALF) for x in (x0, x1)]
        rows = [round((window.y_px + y * window.height_px) / HALF) for y in (y0, y1)]
        classes[1, slice(*rows), slice(*columns)] = 0.9
    empty = np.zeros((1, 100, 100), np.float32)
    borders = np.zeros((4, 100, 100), np.float32)
    return Seen(("wall", "blind"), ("window",), classes, empty, borders, 1.0, 1.0, width, height)


def _shares(document: FacadeDocument, shutter: Shutter) -> list[float]:
    window = document.elements[0]
    left = (shutter.x_px - window.x_px) / window.width_px
    top = (shutter.y_px - window.y_px) / window.height_px
    right = left + shutter.width_px / window.width_px
    return [left, top, right, top + shutter.height_px / window.height_px]


def _found(*parts: tuple[float, float, float, float]) -> list[tuple[str, list[float]]]:
    document = _document()
    found = seen_shutters(_seen(document, list(parts)), document)
    return [(one.kind, _shares(document, one)) for one in found]


def test_open_leaves_lie_on_both_sides() -> None:
    left, right = _found((-0.5, 0.0, 0.0, 1.0), (1.0, 0.0, 1.5, 1.0))
    assert (left[0], right[0]) == ("open", "open")
    assert left[1] == pytest.approx([-0.5, 0.0, 0.0, 1.0], abs=0.06)
    assert right[1] == pytest.approx([1.0, 0.0, 1.5, 1.0], abs=0.06)


def test_a_leaf_on_one_side_alone_is_one() -> None:
    assert [kind for kind, _ in _found((1.0, 0.0, 1.5, 1.0))] == ["open"]


def test_a_blind_comes_down_from_the_head() -> None:
    ((kind, shares),) = _found((0.0, 0.0, 1.0, 0.4))
    assert kind == "closed"
    assert shares == pytest.approx([0.0, 0.0, 1.0, 0.4], abs=0.06)


def test_folded_leaves_cover_the_sides_of_a_window() -> None:
    left, right = _found((0.0, 0.0, 0.3, 1.0), (0.75, 0.0, 1.0, 1.0))
    assert left == ("closed", pytest.approx([0.0, 0.0, 0.3, 1.0], abs=0.06))
    assert right == ("closed", pytest.approx([0.75, 0.0, 1.0, 1.0], abs=0.06))


def test_a_closed_window_is_covered_whole() -> None:
    ((kind, shares),) = _found((0.0, 0.0, 1.0, 1.0))
    assert (kind, shares) == ("closed", pytest.approx([0.0, 0.0, 1.0, 1.0], abs=0.06))


@pytest.mark.parametrize("columns", [(0.04, 1.0), (0.0, 0.96)])
def test_a_frame_on_either_side_of_closed_leaves_makes_no_second_leaf(
    columns: tuple[float, float],
) -> None:
    """Some of the pane is seen above them, and a strip of the frame on one side."""
    ((kind, shares),) = _found((columns[0], 0.22, columns[1], 1.0))
    assert (kind, shares) == ("closed", pytest.approx([0.0, 0.0, 1.0, 1.0], abs=0.06))


def test_little_of_it_is_none() -> None:
    assert _found() == []
    assert _found((0.0, 0.0, 1.0, 0.05)) == []
    assert _found((1.0, 0.0, 1.08, 1.0)) == []
    assert _found((1.0, 0.0, 1.5, 0.15)) == []


def test_a_leaf_ends_half_way_to_the_next_window() -> None:
    """The wall between both is 1.42 widths of a window wide."""
    near = _document()
    moved = near.elements[1].model_copy(update={"x_px": near.elements[0].x_px + 72.0})
    near = near.model_copy(update={"elements": [near.elements[0], moved]})
    found = seen_shutters(_seen(near, [(1.0, 0.0, 1.5, 1.0)]), near)
    assert [one.kind for one in found] == ["open", "open"]
    assert _shares(near, found[0])[2] == pytest.approx(1.25, abs=0.01)
    assert _shares(near, found[1])[0] == pytest.approx(1.25, abs=0.01)
