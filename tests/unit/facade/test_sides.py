"""Neighbours of a house in streets that the test draws."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from veduta.facade.evidence import gather
from veduta.facade.extent import Skyline
from veduta.facade.sides import find_sides, two_levels

HEIGHT, WIDTH, EDGE = 300, 320, 200
BEIGE, GREY, SKY = (205, 196, 174), (168, 166, 160), (170, 200, 240)
YELLOW = (206, 190, 150)


def sides_of(
    roofs: tuple[int, int],
    walls: tuple[tuple[int, int, int], tuple[int, int, int]],
    eaves: int = 0,
    jut: tuple[int, slice] = (0, slice(0)),
) -> tuple[int, int]:
    """Columns found of a house up to EDGE and what is right of it, with their roofs' rows.

    The left roof reaches `eaves` columns over the neighbour, the left wall `jut` of columns, in
    those rows.
    """
    rng = np.random.default_rng(3)
    picture = np.empty((HEIGHT, WIDTH, 3), np.float64)
    rows = np.where(np.arange(WIDTH) < EDGE + eaves, *roofs)
    picture[:, :EDGE], picture[:, EDGE:] = walls
    picture[jut[1], EDGE : EDGE + jut[0]] = walls[0]
    for y in range(90, HEIGHT - 40, 50):
        for x in range(20, WIDTH - 20, 45):
            picture[y : y + 28, x : x + 16] = (60, 66, 76)
    picture += rng.normal(0, 2, picture.shape)
    picture[np.arange(HEIGHT)[:, None] < rows] = SKY
    pixels = np.clip(picture, 0, 255).astype(np.uint8)
    evidence = gather(pixels, np.ones(pixels.shape[:2], bool))
    assert evidence.height == HEIGHT
    sides = find_sides(evidence, Skyline(rows, int(np.percentile(rows, 60))))
    return sides.left, sides.right


def test_a_lower_house_of_nearly_the_same_colour_is_another() -> None:
    left, right = sides_of((30, 66), (BEIGE, GREY))
    assert left == 0
    assert abs(right - EDGE) <= 4


@pytest.mark.parametrize("eaves", [0, 4, 8, 12])
def test_eaves_that_jut_over_the_neighbour_do_not_hide_it(eaves: int) -> None:
    """The step of the roof line is beside that of the wall, at which the house ends."""
    left, right = sides_of((30, 90), (YELLOW, GREY), eaves)
    assert left == 0
    assert abs(right - EDGE) <= 4


@pytest.mark.parametrize("rows", [slice(60, 150), slice(150, 300), slice(180, 300)])
@pytest.mark.parametrize("jut", [0, 8, 14, 20])
def test_a_part_of_the_wall_that_juts_over_the_neighbour_does_not_hide_it(
    jut: int, rows: slice
) -> None:
    """What parts the two houses peaks beside where most of the wall changes."""
    left, right = sides_of((30, 66), (BEIGE, GREY), jut=(jut, rows))
    assert left == 0
    assert abs(right - EDGE) <= 4


def test_under_one_roof_a_little_other_colour_is_one_house() -> None:
    assert sides_of((30, 30), (BEIGE, GREY)) == (0, WIDTH)


def test_a_step_of_the_roof_over_one_wall_is_one_house() -> None:
    assert sides_of((30, 66), (BEIGE, BEIGE)) == (0, WIDTH)


def levels(rows: NDArray[np.int64], first: int = 0) -> NDArray[np.float64]:
    valid = np.arange(100)[:, None] >= np.broadcast_to(first, len(rows))
    return two_levels(rows, valid, 20)


def test_a_step_of_the_roof_line_parts_two_levels() -> None:
    found = levels(np.repeat([10, 35], 60))
    assert found[60] == 25
    assert found[30] == found[90] == 0


def test_chimneys_and_gables_part_nothing() -> None:
    rows = np.full(120, 40)
    rows[50:60] = 10
    assert levels(rows).max() == 0
    gable = 10 + np.abs(np.arange(120) - 60) // 2
    assert levels(gable).max() < 10


def test_where_the_photo_ends_no_roof_is_known_to_be_low() -> None:
    rows = np.repeat([10, 35], 60)
    valid = np.arange(100)[:, None] >= rows
    assert two_levels(rows, valid, 20).max() == 0
