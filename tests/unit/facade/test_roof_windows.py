"""Dormers on a roof that the test draws."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.facade.boxes import Box
from veduta.facade.columns import Columns
from veduta.facade.evidence import gather
from veduta.facade.extent import Skyline
from veduta.facade.floors import Floors
from veduta.facade.roof_windows import find_roof_windows

WIDTH, RIDGE, EAVES, STOREY = 360, 20, 84, 60
DORMERS = [(40, 26), (130, 26), (250, 26)]
TOP, FOOT = 38, 66


def draw_roof(dormers: list[tuple[int, int]], seed: int = 0) -> NDArray[np.uint8]:
    """Slate with some grain under a bright sky; dormer windows are white frames with panes."""
    rng = np.random.default_rng(seed)
    image = np.empty((EAVES + 3 * STOREY, WIDTH, 3), np.float64)
    image[:] = (205, 195, 170)
    image[:EAVES] = (96, 100, 110)
    image += rng.normal(0, 3, image.shape)
    image[:RIDGE] = (180, 205, 235)
    picture = np.clip(image, 0, 255).astype(np.uint8)
    for x, w in dormers:
        cv2.rectangle(picture, (x, TOP), (x + w - 1, FOOT - 1), (236, 234, 230), -1)
        for pane in (x + 3, x + w // 2 + 2):
            size = w // 2 - 5
            cv2.rectangle(picture, (pane, TOP + 3), (pane + size, FOOT - 4), (40, 46, 56), -1)
    return picture


def find(dormers: list[tuple[int, int]], columns: list[tuple[int, int]]) -> list[Box]:
    pixels = draw_roof(dormers)
    evidence = gather(pixels, np.ones(pixels.shape[:2], bool))
    skyline = skyline_at(RIDGE)
    floors = Floors([EAVES, EAVES + STOREY, EAVES + 2 * STOREY], float(STOREY), 0.0, {}, 0)
    return find_roof_windows(evidence, skyline, floors, Columns(columns, 0.0, {}, 0))


def skyline_at(row: int) -> Skyline:
    return Skyline(np.full(WIDTH, row), row)


def overlap(box: Box, x: int, w: int) -> float:
    """Intersection over union with a dormer."""
    left, right = max(box.x, x), min(box.x + box.width, x + w)
    top, bottom = max(box.y, TOP), min(box.y + box.height, FOOT)
    shared = max(0, right - left) * max(0, bottom - top)
    return shared / (box.width * box.height + w * (FOOT - TOP) - shared)


def test_dormers_are_found_wherever_they_stand() -> None:
    boxes = find(DORMERS, [])
    assert len(boxes) == len(DORMERS)
    for box, (x, w) in zip(boxes, DORMERS, strict=True):
        assert overlap(box, x, w) > 0.7
        assert box.floor is None
        assert box.score > 0.5


def test_columns_below_do_not_double_a_dormer() -> None:
    boxes = find(DORMERS, [(38, 30), (128, 30), (248, 30)])
    assert [any(overlap(b, *d) > 0.7 for b in boxes) for d in DORMERS] == [True] * 3
    assert len(boxes) == 3


def test_columns_below_make_no_dormers() -> None:
    assert find([], [(40, 26), (130, 26)]) == []


def test_no_window_fits_a_low_roof() -> None:
    pixels = draw_roof(DORMERS)
    evidence = gather(pixels, np.ones(pixels.shape[:2], bool))
    floors = Floors([EAVES, EAVES + STOREY], float(STOREY), 0.0, {}, 0)
    low = skyline_at(EAVES - 15)
    assert find_roof_windows(evidence, low, floors, Columns([], 0.0, {}, 0)) == []
