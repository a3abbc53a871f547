"""Which elements are believed, on maps that are painted for the purpose."""

from __future__ import annotations

import numpy as np

from veduta.facade.eyes import BeliefParameters, Seen, SeenElement, believed

NAMES = ("window", "blind", "wall", "balcony", "door", "shop")
SIZE = 200


def seen_with(*boxes: SeenElement) -> Seen:
    """Maps at half size in which the pixels of the boxes have their class, and the rest is wall."""
    classes = np.zeros((len(NAMES), SIZE // 2, SIZE // 2), np.float32)
    classes[2] = 1.0
    for e in boxes:
        part = np.s_[int(e.y0 / 2) : int(e.y1 / 2), int(e.x0 / 2) : int(e.x1 / 2)]
        classes[2][part] = 0.0
        classes[NAMES.index(e.kind)][part] = 1.0
    none = np.zeros((4, SIZE // 4, SIZE // 4), np.float32)
    return Seen(NAMES, ("window",), classes, none, none, 1.0, 1.0, SIZE, SIZE)


def window(x: float, y: float, score: float, kind: str = "window") -> SeenElement:
    return SeenElement(kind, x, y, x + 20.0, y + 40.0, score)


def test_a_sure_window_needs_pixels_of_a_window() -> None:
    one, other = window(20.0, 20.0, 0.9), window(80.0, 100.0, 0.9)
    assert believed([one, other], seen_with(one)) == [one]


def test_a_doubtful_window_needs_sure_ones_in_its_row_and_its_column() -> None:
    sure = [window(20.0, 20.0, 0.9), window(100.0, 100.0, 0.8)]
    crossing, beside = window(20.0, 103.0, 0.4), window(60.0, 20.0, 0.4)
    every = [*sure, crossing, beside]
    assert believed(every, seen_with(*every)) == [*sure, crossing]


def test_doubtful_ones_do_not_support_each_other() -> None:
    some = [window(x, y, 0.45) for x in (20.0, 80.0) for y in (20.0, 100.0)]
    assert believed(some, seen_with(*some)) == []


def test_a_row_of_three_doubtful_ones_under_sure_ones_is_a_row() -> None:
    sure = [window(x, 20.0, 0.9) for x in (20.0, 80.0, 140.0)]
    row = [window(x, 100.0, 0.4) for x in (20.0, 80.0, 140.0)]
    every = [*sure, *row]
    assert believed(every, seen_with(*every)) == every
    assert believed([*sure, *row[:2]], seen_with(*every)) == sure


def test_how_far_out_of_line_is_measured_in_sizes() -> None:
    sure = [window(20.0, 20.0, 0.9), window(100.0, 100.0, 0.8)]
    off = window(23.9, 107.9, 0.4)
    assert off in believed([*sure, off], seen_with(*sure, off))
    tight = BeliefParameters(in_line=0.19)
    assert off not in believed([*sure, off], seen_with(*sure, off), tight)


def test_a_doubtful_balcony_needs_one_of_both_and_a_doubtful_door_has_no_help() -> None:
    balconies = [window(20.0, 20.0, 0.9, "balcony"), window(90.0, 20.0, 0.45, "balcony")]
    doors = [window(20.0, 120.0, 0.9, "door"), window(90.0, 120.0, 0.45, "door")]
    every = [*balconies, *doors]
    assert believed(every, seen_with(*every)) == [*balconies, doors[0]]


def test_a_shop_of_pixels_of_the_wall_is_none() -> None:
    sign = window(20.0, 20.0, 0.9, "shop")
    assert believed([sign], seen_with()) == []
    assert believed([sign], seen_with(sign)) == [sign]


def test_nothing_seen_is_nothing_believed() -> None:
    assert believed([], seen_with()) == []
