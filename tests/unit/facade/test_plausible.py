"""Patterns that repeat as facades do are not taken for facades; facades that repeat exactly are."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from drawn_facade import analysed, draw_facade
from numpy.typing import NDArray

from veduta.run.errors import NotFoundError

Picture = NDArray[np.uint8]


def bricks(course: int, length: int, seed: int) -> Picture:
    """Running bond of unlike bricks in light mortar, with grain."""
    rng = np.random.default_rng(seed)
    pixels = np.full((700, 560, 3), 195.0)
    for row, y in enumerate(range(0, 700, course)):
        for x in range(-(row % 2) * (length // 2), 560, length):
            brick = np.array([150, 80, 60]) + rng.normal(0, 14) + rng.normal(0, 5, 3)
            pixels[y : y + course - 2, max(0, x) : max(0, x + length - 2)] = brick
    return np.clip(pixels + rng.normal(0, 4, pixels.shape), 0, 255).astype(np.uint8)


def checkerboard(side: int) -> Picture:
    """Black and white squares."""
    rows, columns = np.arange(600)[:, None] // side, np.arange(500)[None] // side
    return np.repeat(((rows + columns) % 2 * 255).astype(np.uint8)[..., None], 3, axis=2)


def tiles(height: int, width: int) -> Picture:
    """Light tiles between dark joints."""
    pixels = np.full((600, 600, 3), 220, np.uint8)
    for line in (0, 1):
        pixels[line::height] = 120
        pixels[:, line::width] = 120
    return pixels


def stripes(width: int, upright: bool) -> Picture:
    """Two tones in turn."""
    tones = ((np.arange(600) // width) % 2 * 170 + 40).astype(np.uint8)
    pixels = np.broadcast_to(tones[:, None, None], (600, 600, 3))
    return (pixels.transpose(1, 0, 2) if upright else pixels).copy()


@pytest.mark.parametrize(
    "draw",
    [
        lambda: bricks(16, 42, 1),
        lambda: bricks(24, 62, 2),
        lambda: bricks(11, 30, 3),
        lambda: checkerboard(12),
        lambda: checkerboard(37),
        lambda: checkerboard(90),
        lambda: tiles(20, 20),
        lambda: tiles(40, 60),
        lambda: tiles(25, 100),
        lambda: stripes(15, upright=True),
        lambda: stripes(15, upright=False),
        lambda: stripes(60, upright=True),
        lambda: stripes(60, upright=False),
    ],
)
def test_a_pattern_is_no_facade(draw: Callable[[], Picture]) -> None:
    with pytest.raises(NotFoundError, match="a facade not found"):
        analysed(draw())


@pytest.mark.parametrize("seed", [1, 2])
def test_a_tower_of_too_many_floors_is_named_as_one(seed: int) -> None:
    """Thirty floors of windows, alike but for the light in them."""
    rng = np.random.default_rng(seed)
    pixels = np.full((900, 600, 3), 205, np.uint8)
    for y in range(20, 880, 28):
        for x in range(20, 580, 70):
            pixels[y : y + 14, x : x + 50] = 90 + rng.integers(0, 20)
    with pytest.raises(NotFoundError, match="more than 18 floors"):
        analysed(pixels)


def test_floors_that_are_copies_are_a_facade() -> None:
    """As in a drawing or a render: the windows still stand out from the wall."""
    assert analysed(draw_facade(5).pixels).storeys == draw_facade(5).storeys
