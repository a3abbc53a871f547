"""Windows of a ground floor that the test draws, of another stone than the floors above it."""

from __future__ import annotations

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray

from veduta.facade.boxes import Box
from veduta.facade.columns import Columns
from veduta.facade.evidence import gather
from veduta.facade.floors import Floors
from veduta.facade.ground_windows import find_ground_windows, with_windows

WIDTH, EAVES, STOREY = 360, 20, 60
TOP = EAVES + 2 * STOREY
STREET = TOP + 66
STRIPES = [(30, 26), (100, 26), (170, 26), (240, 26), (310, 26)]
HEAD, SILL = TOP + 14, TOP + 44


def draw_ground(
    windows: list[tuple[int, int]], head: int = HEAD, sill: int = SILL, seed: int = 0
) -> NDArray[np.uint8]:
    """Beige floors over grey stone; windows are white frames with dark panes."""
    rng = np.random.default_rng(seed)
    image = np.empty((STREET, WIDTH, 3), np.float64)
    image[:] = (205, 195, 170)
    image[TOP:] = (128, 124, 122)
    picture = np.clip(image + rng.normal(0, 3, image.shape), 0, 255).astype(np.uint8)
    for x, w in windows:
        cv2.rectangle(picture, (x, head), (x + w - 1, sill - 1), (236, 234, 230), -1)
        for pane in (x + 3, x + w // 2 + 2):
            size = w // 2 - 5
            cv2.rectangle(picture, (pane, head + 3), (pane + size, sill - 4), (40, 46, 56), -1)
    return picture


def find(pixels: NDArray[np.uint8]) -> list[Box]:
    evidence = gather(pixels, np.ones(pixels.shape[:2], bool))
    floors = Floors([EAVES, EAVES + STOREY, TOP], float(STOREY), 0.0, {}, 0)
    return find_ground_windows(evidence, floors, Columns(STRIPES, 0.0, {}, 0))


@pytest.mark.parametrize("drawn", [STRIPES, STRIPES[:4]])
def test_windows_stand_under_those_above(drawn: list[tuple[int, int]]) -> None:
    """As many as there are, though one stripe may have none."""
    boxes = find(draw_ground(drawn))
    assert len(boxes) == len(drawn)
    for box, (x, w) in zip(boxes, drawn, strict=True):
        assert (box.kind, box.floor) == ("window", 0)
        sides = np.array([box.x, box.x + box.width, box.y, box.y + box.height])
        np.testing.assert_allclose(sides, [x, x + w, HEAD, SILL], atol=4)


@pytest.mark.parametrize(
    ("drawn", "head", "sill"),
    [
        ([], HEAD, SILL),
        (STRIPES[:2], HEAD, SILL),  # of five
        ([(4 + 71 * i, 67) for i in range(5)], TOP + 8, STREET),  # shop fronts
        (STRIPES, TOP + 26, STREET),  # doors
    ],
)
def test_other_ground_floors_have_no_row_of_windows(
    drawn: list[tuple[int, int]], head: int, sill: int
) -> None:
    assert find(draw_ground(drawn, head, sill)) == []


def box(kind: str, x: int, width: int, y: int = 10, height: int = 20) -> Box:
    return Box(kind, x, y, width, height, 0, None, 0.8)


def test_windows_take_the_place_of_shops_and_not_of_doors() -> None:
    shop, other, door = box("shop", 0, 80), box("shop", 160, 40), box("door", 100, 30)
    under = [box("window", 20, 20), box("window", 60, 20), box("window", 110, 20)]
    assert with_windows([shop, door, other], under, 30) == [*under[:2], door, other]
    assert with_windows([shop, door, other], [], 30) == [shop, door, other]


@pytest.mark.parametrize(("storey", "stays"), [(60, True), (64, False)])
def test_a_shop_stays_under_a_mezzanine_where_it_has_room(storey: int, stays: bool) -> None:
    """48 px are left below the lower sill: 0.8 of 60 and less of 64."""
    shop, under = box("shop", 0, 90, 4, 74), [box("window", 10, 20), box("window", 50, 20, 12, 18)]
    left = [box("shop", 0, 90, 30, 48)] if stays else []
    assert with_windows([shop], under, storey) == [*left, *under]
