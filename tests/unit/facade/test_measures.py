"""The benchmark's measures, on arrays whose measures are plain to see."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from facade_measures import Matches, accuracy, class_table, confusion, match, overlaps
from facade_truth import (
    IGNORED,
    WINDOW,
    Labelled,
    artdeco_labels,
    components,
    ecp_labels,
    horizontal_bands,
    position_template,
    resized,
    true_storeys,
)
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray
from scipy.optimize import linear_sum_assignment

from veduta.facade.document import CLASSES

WALL, ROOF, SKY, SHOP, BALCONY = (
    CLASSES.index(name) for name in ("wall", "roof", "sky", "shop", "balcony")
)
CHIMNEY = CLASSES.index("chimney")


def _labels(*rows: list[int]) -> NDArray[np.uint8]:
    return np.array(rows, np.uint8)


def test_colours_become_classes() -> None:
    colours = [(255, 0, 0), (255, 255, 0), (128, 128, 128), (0, 0, 255), (0, 0, 0), (1, 2, 3)]
    labels = ecp_labels(np.array([colours], np.uint8))
    assert labels.tolist() == [[WINDOW, WALL, ROOF, ROOF, IGNORED, IGNORED]]
    indices = np.array([[-1, 0, 1, 2, 3, 4, 5, 6]])
    names = [CLASSES[label] for label in artdeco_labels(indices)[0, 1:]]
    assert names == ["door", "shop", "balcony", "window", "wall", "sky", "roof"]
    assert artdeco_labels(indices)[0, 0] == IGNORED


def test_accuracy_leaves_out_what_is_ignored() -> None:
    true = _labels([WALL, WALL, ROOF, IGNORED])
    found = _labels([WALL, SKY, CHIMNEY, SHOP])
    counts = confusion(found, true)
    assert counts.sum() == 3
    assert accuracy(counts) == pytest.approx(2 / 3)


def test_class_table() -> None:
    true = _labels([WALL] * 8 + [WINDOW] * 2)
    found = _labels([WALL] * 6 + [WINDOW] * 3 + [SKY])
    wall, window = sorted(class_table(confusion(found, true)), key=lambda row: row.name)
    assert (wall.share, wall.recall, wall.precision, wall.iou) == (0.8, 0.75, 1.0, 0.75)
    assert wall.taken_for == "window 0.25"
    assert (window.recall, window.precision, window.iou) == (0.5, 1 / 3, 0.25)
    assert window.taken_for == "sky 0.50"


def test_components_touch_by_their_sides() -> None:
    labels = np.full((6, 7), WALL, np.uint8)
    labels[1:3, 1:3] = WINDOW
    labels[3, 3] = WINDOW  # touches by a corner only
    labels[0, 6] = WINDOW
    boxes = sorted(components(labels, WINDOW).tolist())
    assert boxes == [[1, 1, 3, 3], [3, 3, 4, 4], [6, 0, 7, 1]]
    assert components(labels, WINDOW, least_px=2).tolist() == [[1, 1, 3, 3]]
    assert components(labels, SHOP).shape == (0, 4)


def test_overlap_of_boxes() -> None:
    found = np.array([[0, 0, 2, 2], [5, 5, 6, 6]], float)
    true = np.array([[1, 0, 3, 2], [0, 0, 2, 2]], float)
    assert overlaps(found, true).tolist() == [[pytest.approx(1 / 3), 1.0], [0.0, 0.0]]


def test_each_window_matches_once() -> None:
    one = np.array([[0, 0, 10, 10]], float)
    twice = np.array([[0, 0, 10, 10], [0, 0, 10, 9]], float)
    assert match(twice, one) == Matches(true=1, found=2, matched=1)
    assert match(one, twice) == Matches(true=2, found=1, matched=1)
    assert match(one, np.array([[0, 0, 10, 5]], float)).matched == 1  # an overlap of one half
    assert match(one, np.array([[0, 0, 10, 4.9]])).matched == 0
    assert match(np.zeros((0, 4)), one).f1 == 0.0


def test_sums_of_matches() -> None:
    total = Matches(10, 8, 6) + Matches(10, 2, 2)
    assert total == Matches(20, 10, 8)
    assert (total.precision, total.recall) == (0.8, 0.4)
    assert total.f1 == pytest.approx(2 * 0.8 * 0.4 / 1.2)


@given(st.lists(st.tuples(*[st.integers(0, 9)] * 4), max_size=6), st.integers(0, 5))
def test_greedy_matching_is_within_half_of_the_best(
    corners: list[tuple[int, int, int, int]], split: int
) -> None:
    boxes = np.array([(x, y, x + w + 1, y + h + 1) for x, y, w, h in corners], float).reshape(-1, 4)
    found, true = boxes[:split], boxes[split:]
    good = overlaps(found, true) >= 0.5
    rows, columns = linear_sum_assignment(good, maximize=True)
    best = int(good[rows, columns].sum())
    assert best / 2 <= match(found, true).matched <= best


def test_bands_and_template() -> None:
    labels = _labels([SKY, SKY, WALL], [WINDOW, WINDOW, WALL], [IGNORED, IGNORED, SHOP])
    assert horizontal_bands(labels).tolist() == [[SKY] * 3, [WINDOW] * 3, [SHOP] * 3]
    only = horizontal_bands(labels, ("sky", "wall", "shop"))
    assert only.tolist() == [[SKY] * 3, [WALL] * 3, [SHOP] * 3]
    others = [_labels([WALL, SKY]), _labels([WALL, WALL]), _labels([SKY, WALL])]
    examples = [Labelled("", Path(), other) for other in others]
    assert position_template(examples, (2, 1)).tolist() == [[WALL, WALL]]
    assert resized(_labels([WALL, SKY]), (4, 2)).tolist() == [[WALL, WALL, SKY, SKY]] * 2


def _front(floors: int, ground_windows: bool) -> NDArray[np.uint8]:
    """Sky, a roof with dormers, floors of 40 px with balconies, and a ground floor of 50 px."""
    labels = np.full((80 + 40 * floors + 50, 100), WALL, np.uint8)
    labels[:40] = SKY
    labels[40:80] = ROOF
    for x in (10, 40, 70):
        labels[50:70, x : x + 20] = WINDOW
        for top in range(80, 80 + 40 * floors, 40):
            labels[top + 8 : top + 26, x : x + 18] = WINDOW
            labels[top + 22 : top + 32, x - 2 : x + 22] = BALCONY
    labels[-50:-5] = SHOP
    if ground_windows:
        labels[-40:-10, 20:60] = WINDOW
    return labels


@pytest.mark.parametrize("floors", [2, 4, 7])
@pytest.mark.parametrize("ground_windows", [False, True])
def test_true_storeys_of_a_drawn_front(floors: int, ground_windows: bool) -> None:
    assert true_storeys(_front(floors, ground_windows)) == floors + 1
