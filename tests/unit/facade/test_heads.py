"""Arched heads, against windows drawn with known ones."""

from __future__ import annotations

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray

from veduta.facade.boxes import Box
from veduta.facade.heads import arched, with_heads

WIDTH, HEIGHT = 40, 80


def _front(
    rises: list[float], shift: int = 0, seed: int = 0
) -> tuple[list[Box], NDArray[np.float32]]:
    """A row of windows whose heads rise by these shares of their width; boxes off by `shift`."""
    rng = np.random.default_rng(seed)
    picture = np.full((160, 80 * len(rises), 3), (205, 180, 140), np.uint8)
    boxes = []
    for k, rise in enumerate(rises):
        box = Box("window", 20 + 80 * k, 40, WIDTH, HEIGHT, 1, k, 0.9)
        corners = np.array([(60 + 80 * k, 40), (60 + 80 * k, 120), (20 + 80 * k, 120)])
        corners = np.vstack([corners, [(20 + 80 * k, 40)]])
        if rise:
            corners = np.array(arched(box, rise * WIDTH, steps=24))
        cv2.fillPoly(picture, [np.round(corners).astype(np.int32)], (50, 58, 70))
        cv2.polylines(picture, [np.round(corners).astype(np.int32)], True, (240, 238, 230), 3)
        boxes.append(Box("window", box.x + shift, box.y - shift, WIDTH, HEIGHT, 1, k, 0.9))
    noisy = np.clip(picture + rng.normal(0, 8, picture.shape), 0, 255).astype(np.uint8)
    return boxes, cv2.cvtColor(noisy, cv2.COLOR_RGB2LAB).astype(np.float32)


@pytest.mark.parametrize("shift", [0, 2])
@pytest.mark.parametrize("rise", [0.2, 0.35, 0.5])
def test_arches_are_found_with_their_rise(rise: float, shift: int) -> None:
    boxes, lab = _front([rise] * 4, shift)
    found = with_heads(boxes, lab)
    for box in found:
        assert box.outline
        points = np.array(box.outline)
        assert points[:, 0].min() == box.x
        assert points[:, 0].max() == box.x + box.width
        assert points[:, 1].min() == pytest.approx(box.y)
        springer = points[1, 1]
        assert (springer - box.y) / WIDTH == pytest.approx(rise, abs=0.21)


@pytest.mark.parametrize("seed", range(3))
def test_level_heads_stay_rectangles(seed: int) -> None:
    boxes, lab = _front([0.0] * 5, 0, seed)
    assert with_heads(boxes, lab) == boxes


def test_each_column_has_its_own_head() -> None:
    boxes, lab = _front([0.0, 0.5, 0.0, 0.5])
    found = with_heads(boxes, lab)
    assert [bool(box.outline) for box in found] == [False, True, False, True]


def test_what_is_no_window_or_too_narrow_is_not_looked_at() -> None:
    _, lab = _front([0.5])
    shop = Box("shop", 20, 40, WIDTH, HEIGHT, 0, None, 0.9)
    narrow = Box("window", 20, 40, 6, 20, 1, 0, 0.9)
    assert with_heads([shop, narrow], lab) == [shop, narrow]
    assert with_heads([], lab) == []


def test_a_round_head_is_a_half_circle() -> None:
    box = Box("door", 0, 0, 20, 50, 0, None, 1.0)
    outline = np.array(arched(box, 10.0, steps=16))
    radii = np.hypot(outline[1:-1, 0] - 10.0, outline[1:-1, 1] - 10.0)
    assert radii == pytest.approx(10.0)
    assert outline[0].tolist() == [0.0, 50.0]
    assert outline[-1].tolist() == [20.0, 50.0]
