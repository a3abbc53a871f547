"""Filling by known offsets: what repeats comes back as it was, what goes on goes on."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from veduta.surfaces import RepeatParameters, fill_by_repeats
from veduta.surfaces.filling.carrying import carried_down
from veduta.surfaces.filling.choosing import Choice, Spoilt, refined

ACROSS, DOWN = 44, 50
STEPS = np.array([[ACROSS, 0], [-ACROSS, 0], [0, DOWN], [0, -DOWN]])


def wall(height: int = 200, width: int = 220) -> NDArray[np.uint8]:
    """Windows of 18 x 24 px, every 44 px across and 50 px down."""
    y, x = np.mgrid[:height, :width]
    inside = (x % ACROSS >= 12) & (x % ACROSS < 30) & (y % DOWN >= 10) & (y % DOWN < 34)
    pixels = np.where(inside[..., None], (60, 70, 90), (190, 160, 130)).astype(np.uint8)
    grain = np.random.default_rng(0).integers(-3, 4, pixels.shape)
    return np.clip(pixels + grain, 0, 255).astype(np.uint8)


def hole_at(top: int, left: int, high: int, wide: int) -> NDArray[np.bool_]:
    holes = np.zeros((200, 220), dtype=np.bool_)
    holes[top : top + high, left : left + wide] = True
    return holes


def spoilt(pixels: NDArray[np.uint8], holes: NDArray[np.bool_]) -> NDArray[np.uint8]:
    return np.where(holes[..., None], np.array([255, 0, 255], np.uint8), pixels)


def test_a_hidden_window_comes_back() -> None:
    pixels, holes = wall(), hole_at(52, 90, 40, 40)
    made = fill_by_repeats(spoilt(pixels, holes), holes, STEPS, DOWN)
    off = np.abs(made.pixels.astype(int) - pixels.astype(int)).max(axis=2)
    assert np.median(off[holes]) < 8
    assert (off[holes] > 40).mean() < 0.02
    np.testing.assert_array_equal(made.pixels[~holes], pixels[~holes])
    assert made.copied[holes].mean() > 0.8
    assert (made.copied[~holes] == 0).all()


def test_the_same_twice_and_nothing_of_the_hole_is_left() -> None:
    pixels, holes = wall(), hole_at(0, 0, 60, 70)
    one = fill_by_repeats(spoilt(pixels, holes), holes, STEPS, DOWN)
    black = fill_by_repeats(np.where(holes[..., None], 0, pixels), holes, STEPS, DOWN)
    np.testing.assert_array_equal(one.pixels, black.pixels)


def test_rows_of_other_zones_do_not_serve() -> None:
    pixels, holes = wall(), hole_at(100, 90, 40, 40)
    pixels[100:150] = 255 - pixels[100:150]
    zones = np.zeros(200, np.int64)
    zones[100:150] = 1
    made = fill_by_repeats(spoilt(pixels, holes), holes, STEPS, DOWN, zones)
    off = np.abs(made.pixels.astype(int) - pixels.astype(int)).max(axis=2)
    assert (off[holes] > 40).mean() < 0.05


def test_offsets_are_refined_by_what_is_around() -> None:
    holes = hole_at(52, 90, 40, 40)
    number = np.zeros(holes.shape, np.int16)
    choice = Choice(number, np.ones(holes.shape, np.float32))
    picture = Spoilt(wall(), holes, np.zeros(200, np.int64))
    found = refined(picture, choice, np.array([[ACROSS + 2, -1]]), 20, RepeatParameters())
    np.testing.assert_array_equal(found, [[ACROSS, 0]])


def test_upright_stripes_are_carried_down_exactly() -> None:
    stripes = np.zeros((60, 40, 3), np.uint8)
    stripes[:, ::8] = 200
    holes = np.zeros((60, 40), dtype=np.bool_)
    holes[20:50] = True
    picture = Spoilt(stripes, holes, np.zeros(60, np.int64))
    down = carried_down(picture, 40.0, RepeatParameters())
    np.testing.assert_array_equal(down.pixels[holes], stripes[holes])
    assert (np.diff(down.cost[20:50, 0]) >= 0).all()
    top = carried_down(Spoilt(stripes, ~holes, picture.zones), 40.0, RepeatParameters())
    assert (top.cost[:20] > 1e8).all()


def test_without_offsets_and_without_holes() -> None:
    pixels, holes = wall(), hole_at(90, 90, 20, 20)
    none = np.zeros((0, 2), np.int64)
    assert fill_by_repeats(spoilt(pixels, holes), holes, none, DOWN).pixels.shape == pixels.shape
    bare = fill_by_repeats(pixels, np.zeros_like(holes), STEPS, DOWN)
    np.testing.assert_array_equal(bare.pixels, pixels)
    with pytest.raises(ValueError, match="nothing of the picture is known"):
        fill_by_repeats(pixels, np.ones_like(holes), STEPS, DOWN)
    with pytest.raises(ValueError, match="do not belong together"):
        fill_by_repeats(pixels, holes[:-1], STEPS, DOWN)
