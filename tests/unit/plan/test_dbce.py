"""The densest ball of the RGB cube against brute force over all middles, and the paper's faults."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from veduta.plan.photos.dbce import RADIUS, ball_sums, densest_colour, in_ball


def brute_force(colours: np.ndarray) -> tuple[int, set[tuple[int, int, int]]]:
    """The most pixels within 3 of any colour of the cube, and all colours that have as many."""
    near = range(-RADIUS, RADIUS + 1)
    ball = [
        step for step in itertools.product(near, near, near)
        if sum(part * part for part in step) <= 9
    ]  # fmt: skip
    counted: dict[tuple[int, int, int], int] = {}
    for colour in colours.tolist():
        for step in ball:
            at = tuple(part + move for part, move in zip(colour, step, strict=True))
            if min(at) >= 0 and max(at) <= 255:
                counted[at] = counted.get(at, 0) + 1
    most = max(counted.values())
    return most, {colour for colour, count in counted.items() if count == most}


colours_near_a_corner = arrays(np.uint8, (12, 3), elements=st.integers(244, 255))
colours_near_black = arrays(np.uint8, (9, 3), elements=st.integers(0, 20))


@settings(max_examples=40, deadline=None)
@given(colours=colours_near_a_corner | colours_near_black)
def test_it_is_the_densest_of_all_balls(colours: np.ndarray) -> None:
    most, best = brute_force(colours)
    found = densest_colour(colours)
    assert found.share == pytest.approx(most / len(colours))
    assert found.srgb in best


def test_it_is_the_densest_of_the_whole_cube() -> None:
    colours = np.random.default_rng(2).integers(0, 256, (400, 3), dtype=np.uint8)
    most, best = brute_force(colours)
    found = densest_colour(colours)
    assert found.srgb in best
    assert found.share == pytest.approx(most / len(colours))


@pytest.mark.parametrize("colour", [(255, 255, 255), (0, 0, 0), (255, 0, 254), (1, 128, 253)])
def test_a_plain_wall_has_its_own_colour_up_to_the_faces(colour: tuple[int, int, int]) -> None:
    # The paper's loops end at 252 and sum a cube: they give none of these.
    found = densest_colour(np.full((50, 3), colour, dtype=np.uint8))
    assert found.srgb == colour
    assert found.share == 1.0


def test_it_is_a_ball_and_no_cube() -> None:
    # Corners of a cube of side 6 about (100, 100, 100), against fewer pixels of one colour.
    corners = np.array(list(itertools.product((97, 103), repeat=3)), dtype=np.uint8)
    plain = np.full((7, 3), 30, dtype=np.uint8)
    assert densest_colour(np.concatenate([corners, plain])).srgb == (30, 30, 30)


def test_shadows_and_furniture_do_not_move_it() -> None:
    rng = np.random.default_rng(3)
    wall = rng.normal((214, 170, 120), 2.5, (60_000, 3))
    shade = wall[:25_000] * rng.uniform(0.4, 0.9, (25_000, 1))
    things = rng.uniform(0, 255, (30_000, 3))
    pixels = np.concatenate([wall, shade, things]).round().clip(0, 255).astype(np.uint8)
    found = np.array(densest_colour(pixels).srgb)
    assert np.abs(found - (214, 170, 120)).max() <= 1
    mean = pixels.mean(axis=0)
    assert np.abs(mean - (214, 170, 120)).max() > 20


def test_counts_are_exact_and_whole() -> None:
    rng = np.random.default_rng(5)
    cube = rng.integers(0, 50_000_000, (9, 8, 7)).astype(np.float64)
    sums = ball_sums(cube)
    grid = np.stack(np.meshgrid(*map(np.arange, cube.shape), indexing="ij"), axis=-1)
    for at in [(0, 0, 0), (8, 7, 6), (4, 4, 3), (2, 7, 0)]:
        inside = ((grid - at) ** 2).sum(axis=-1) <= 9
        assert sums[at] == cube[inside].sum()


def test_pixels_of_the_ball_are_those_within_three() -> None:
    pixels = np.array([[[10, 10, 10], [13, 10, 10], [12, 12, 11], [13, 11, 10]]], dtype=np.uint8)
    assert in_ball(pixels, (10, 10, 10)).tolist() == [[True, True, True, False]]


def test_no_pixels_are_refused() -> None:
    with pytest.raises(ValueError, match="no pixels"):
        densest_colour(np.zeros((0, 3), dtype=np.uint8))
