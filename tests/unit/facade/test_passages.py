"""Passages, in a drawn ground floor: dark parts of it down to the pavement."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from veduta.facade.boxes import Box
from veduta.facade.passages import with_passages

HEIGHT, WIDTH, GROUND, FOOT = 240, 300, 150, 230
WALL, DARK = 180.0, 30.0
WINDOWS = [Box("window", x, 60, 24, 40, 1, k, 0.9) for k, x in enumerate((30, 110, 190))]
DOOR = Box("door", 20, 180, 22, 50, 0, None, 0.8)


def _read(
    *holes: tuple[int, int, int, int],
    boxes: tuple[Box, ...] = (),
    other: NDArray[np.float32] | None = None,
) -> list[Box]:
    """What is found where the holes (left, top, right, foot) are dark."""
    light = np.full((HEIGHT, WIDTH), WALL, np.float32)
    wall = np.ones((HEIGHT, WIDTH), np.float32)
    for x0, y0, x1, y1 in holes:
        light[y0:y1, x0:x1], wall[y0:y1, x0:x1] = DARK, 0.0
    nothing = np.zeros_like(light) if other is None else other
    return with_passages([*WINDOWS, DOOR, *boxes], light, wall, nothing, GROUND)


def test_a_wide_dark_hole_down_to_the_ground_is_a_passage() -> None:
    *others, passage = _read((100, 160, 170, FOOT))
    assert others == [*WINDOWS, DOOR]
    assert (passage.kind, passage.floor, passage.is_passage) == ("door", 0, True)
    box = (passage.x, passage.y, passage.width, passage.height)
    assert box == pytest.approx((100, 160, 70, 70), abs=2)


def test_what_the_eyes_took_for_openings_in_it_is_none() -> None:
    """A window of half its width, and a door as large as it; a window elsewhere stays."""
    inside = Box("window", 105, 165, 35, 40, 0, 1, 0.6)
    same = Box("door", 98, 158, 74, 72, 0, None, 0.6)
    beside = Box("window", 200, 170, 24, 40, 0, 2, 0.6)
    found = _read((100, 160, 170, FOOT), boxes=(inside, same, beside))
    assert inside not in found
    assert same not in found
    assert beside in found
    assert sum(box.is_passage for box in found) == 1


@pytest.mark.parametrize(
    "hole",
    [
        (100, 160, 130, FOOT),  # a door
        (100, 160, 170, 200),  # a pane
        (100, 20, 170, 100),  # above the ground floor
        (100, 200, 220, FOOT),  # a low opening
        (20, 160, 280, FOOT),  # shadow along the foot
    ],
)
def test_other_dark_parts_are_none(hole: tuple[int, int, int, int]) -> None:
    assert not any(box.is_passage for box in _read(hole))


def test_vehicles_and_shops_are_none() -> None:
    seen = np.zeros((HEIGHT, WIDTH), np.float32)
    seen[150:] = 0.9
    assert not any(box.is_passage for box in _read((100, 160, 170, FOOT), other=seen))


def test_without_windows_nothing_tells_how_large_one_is() -> None:
    light = np.full((HEIGHT, WIDTH), WALL, np.float32)
    light[160:FOOT, 100:170] = DARK
    wall = np.ones_like(light)
    assert with_passages([DOOR], light, wall, np.zeros_like(light), GROUND) == [DOOR]
