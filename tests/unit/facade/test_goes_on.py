"""Rows that go on to the edges of the picture are no sure storeys; those that end are."""

from __future__ import annotations

from collections.abc import Callable

import cv2
import numpy as np
import pytest
from drawn_facade import analysed, draw_facade
from numpy.typing import NDArray

from veduta.facade.dissimilarity import of_pairs
from veduta.facade.extent import RowHistograms
from veduta.facade.floors import Floors
from veduta.facade.goes_on import goes_on, unlike_below
from veduta.facade.plausible import UNENDED
from veduta.facade.rows import Rows

WORDS = ("neither", "sky", "nor", "street", "is", "in", "a", "book", "of", "many", "words")


def page(scale: float, leading: int) -> NDArray[np.uint8]:
    """Lines of words as a scanner sees them."""
    rng = np.random.default_rng(3)
    pixels = np.full((900, 640, 3), 240, np.uint8)
    weight = int(2 * scale)
    for y in range(40 + leading, 880, leading):
        x = 40
        while x < 560:
            word = WORDS[rng.integers(len(WORDS))]
            font = cv2.FONT_HERSHEY_COMPLEX
            cv2.putText(pixels, word, (x, y), font, scale, (30, 30, 30), weight, cv2.LINE_AA)
            x += cv2.getTextSize(word, font, scale, weight)[0][0] + int(16 * scale)
    scanned = cv2.GaussianBlur(pixels, (0, 0), 0.7) + rng.normal(0, 2, pixels.shape)
    return np.clip(scanned, 0, 255).astype(np.uint8)


def tiles(side: int) -> NDArray[np.uint8]:
    """Tiles with a dark round ornament each."""
    rng = np.random.default_rng(7)
    pixels = np.full((800, 640, 3), 120.0)
    for y in range(0, 800, side):
        for x in range(0, 640, side):
            pixels[y + 8 : y + side, x + 8 : x + side] = np.array([200, 190, 170]) + rng.normal(
                0, 8
            )
            cv2.circle(pixels, (x + side // 2, y + side // 2), side // 3, (90, 90, 80), -1)
    return np.clip(pixels + rng.normal(0, 4, pixels.shape), 0, 255).astype(np.uint8)


@pytest.mark.parametrize("draw", [lambda: page(1.0, 60), lambda: tiles(140)])
def test_a_pattern_that_becomes_a_building_is_doubtful(
    draw: Callable[[], NDArray[np.uint8]],
) -> None:
    document = analysed(draw())
    assert document.storeys_doubtful
    assert UNENDED in document.notes


def test_a_house_under_a_sky_ends_there() -> None:
    assert UNENDED not in analysed(draw_facade(5).pixels).notes


def rows_of(vectors: NDArray[np.float64], ridge: int = 0) -> Rows:
    """Rows of the given features; 1 is the mean dissimilarity of any two of them."""
    distance = of_pairs(vectors)
    distance = np.asarray(distance / distance.mean(), np.float32)
    histograms = RowHistograms(np.zeros((2, 2, 64)))
    return Rows(1, ridge, distance, np.zeros(len(vectors), np.float32), histograms)


def test_the_same_floor_again_is_not_unlike_wherever_it_begins() -> None:
    floor = np.random.default_rng(1).normal(size=(40, 6))
    floors = Floors([20, 60, 100], 40.0, -0.5, {}, 180)
    vectors = np.vstack([floor[-20:], floor, floor, floor, floor])
    assert unlike_below(rows_of(vectors), floors) == pytest.approx(0.0, abs=1e-5)
    shifted = np.vstack([vectors[:100], floor[:3], vectors[100:]])
    assert unlike_below(rows_of(shifted), floors) == pytest.approx(0.0, abs=1e-5)


def test_another_ground_floor_or_a_sky_ends_the_storeys() -> None:
    rng = np.random.default_rng(2)
    floor = rng.normal(size=(40, 6))
    floors = Floors([20, 60, 100], 40.0, -0.5, {}, 140)
    alike = np.vstack([floor[-20:], floor, floor, floor])
    other = np.vstack([alike[:100], rng.normal(size=(40, 6))])
    assert goes_on(rows_of(alike), floors)
    assert not goes_on(rows_of(alike, ridge=12), floors)
    assert not goes_on(rows_of(other), floors)


def test_a_picture_that_ends_says_nothing() -> None:
    floor = np.random.default_rng(4).normal(size=(40, 6))
    vectors = np.vstack([floor[-20:], floor, floor, floor[:15]])
    floors = Floors([20, 60, 100], 40.0, -0.5, {}, 115)
    assert unlike_below(rows_of(vectors), floors) is None
    assert not goes_on(rows_of(vectors), floors)
