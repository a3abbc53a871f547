"""Elements from middles and borders, against maps that are painted for the purpose."""

from __future__ import annotations

import numpy as np
import pytest

from veduta.facade.eyes import ElementParameters, Seen, seen_elements

NAMES = ("window", "wall", "balcony", "door", "shop")
KINDS = ("window", "balcony", "door", "shop")
Box = tuple[float, float, float, float]


def seen_with(boxes: list[tuple[str, Box, float]], size: int = 256) -> Seen:
    """Maps in which each of the boxes has one middle of that height, and the rest is wall."""
    cells = size // 4
    centres = np.zeros((len(KINDS), cells, cells), np.float32)
    borders = np.ones((4, cells, cells), np.float32)
    for kind, (x0, y0, x1, y1), sure in boxes:
        row, column = (int((a + b) / 2 // 4) for a, b in ((y0, y1), (x0, x1)))
        x, y = column * 4 + 2.5, row * 4 + 2.5
        centres[KINDS.index(kind), row, column] = sure
        borders[:, row, column] = x - x0, y - y0, x1 - x, y1 - y
    classes = np.zeros((len(NAMES), size // 2, size // 2), np.float32)
    classes[1] = 1.0
    return Seen(NAMES, KINDS, classes, centres, borders, 1.0, 1.0, size, size)


def test_each_middle_becomes_its_box() -> None:
    boxes = [("window", (20.0, 30.0, 60.0, 90.0), 0.9), ("door", (100.0, 150.0, 140.0, 250.0), 0.8)]
    found = seen_elements(seen_with(boxes))
    assert [e.kind for e in found] == ["window", "door"]
    for element, (_, box, sure) in zip(found, boxes, strict=True):
        assert (element.x0, element.y0, element.x1, element.y1) == pytest.approx(box, abs=1e-3)
        assert element.score == pytest.approx(sure)


def test_windows_side_by_side_stay_two_and_one_seen_twice_is_one() -> None:
    twins = [("window", (20.0, 30.0, 60.0, 90.0), 0.9), ("window", (61.0, 30.0, 101.0, 90.0), 0.8)]
    again = [*twins, ("window", (24.0, 60.0, 64.0, 96.0), 0.6)]
    assert len(seen_elements(seen_with(twins))) == 2
    assert [e.score for e in seen_elements(seen_with(again))] == pytest.approx([0.9, 0.8])


def test_a_window_that_is_surer_a_door_is_a_door_but_a_balcony_stays_before_it() -> None:
    box = (40.0, 40.0, 90.0, 140.0)
    rivals = [("window", box, 0.6), ("door", box, 0.9)]
    assert [e.kind for e in seen_elements(seen_with(rivals))] == ["door"]
    before = [("window", box, 0.9), ("balcony", (38.0, 100.0, 94.0, 140.0), 0.8)]
    assert {e.kind for e in seen_elements(seen_with(before))} == {"window", "balcony"}


def test_what_is_less_sure_than_asked_is_nothing() -> None:
    seen = seen_with([("window", (20.0, 30.0, 60.0, 90.0), 0.4)])
    assert len(seen_elements(seen)) == 1
    assert seen_elements(seen, ElementParameters(least_window=0.5)) == []


def test_shop_pixels_in_one_piece_are_one_front() -> None:
    seen = seen_with([("shop", (20.0, 180.0, 60.0, 240.0), 0.9)])
    seen.classes[4, 90:125, 5:120] = 0.8
    (front,) = [e for e in seen_elements(seen) if e.kind == "shop"]
    assert (front.x0, front.x1) == pytest.approx((10.0, 240.0), abs=2.0)
    assert (front.y0, front.y1) == pytest.approx((180.0, 250.0), abs=2.0)


def test_boxes_end_at_the_picture() -> None:
    (element,) = seen_elements(seen_with([("window", (-20.0, 10.0, 40.0, 50.0), 0.9)]))
    assert element.x0 == 0.0


def test_shops_that_a_pier_parts_are_several_and_those_of_one_piece_one() -> None:
    boxes = [
        ("shop", (40.0, 160.0, 100.0, 240.0), 0.9),
        ("shop", (112.0, 160.0, 172.0, 240.0), 0.8),
    ]
    for between, number in ((0.05, 2), (0.8, 1)):
        seen = seen_with(boxes)
        seen.classes[4, 80:120, 20:86] = 0.9
        seen.classes[4, 84:120, 50:56] = between  # one piece all the same, above
        seen.classes[1] = 1.0 - seen.classes[4]
        assert len([e for e in seen_elements(seen) if e.kind == "shop"]) == number
