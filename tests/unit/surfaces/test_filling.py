"""Filling holes: repeating patterns come back, and each step does what its sentence says."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from veduta.surfaces import FillParameters, fill_holes
from veduta.surfaces.filling.bridging import bridge
from veduta.surfaces.filling.offsets import moved, refined, repeats


def wall(height: int = 150, width: int = 220) -> NDArray[np.uint8]:
    """Windows of 18 x 24 px with frames, every 44 px across and 50 px down."""
    y, x = np.mgrid[:height, :width]
    inside = (x % 44 >= 12) & (x % 44 < 30) & (y % 50 >= 10) & (y % 50 < 34)
    frame = (x % 44 >= 9) & (x % 44 < 33) & (y % 50 >= 7) & (y % 50 < 37) & ~inside
    pixels = np.empty((height, width, 3), np.uint8)
    pixels[...] = (190, 160, 130)
    pixels[frame] = (235, 235, 230)
    pixels[inside] = (60, 70, 90)
    noise = np.random.default_rng(0).normal(0.0, 3.0, pixels.shape)
    return np.clip(pixels + noise, 0, 255).astype(np.uint8)


def hole_at(pixels: NDArray[np.uint8], top: int, left: int, high: int, wide: int) -> np.ndarray:
    holes = np.zeros(pixels.shape[:2], dtype=bool)
    holes[top : top + high, left : left + wide] = True
    return holes


def test_a_hidden_window_comes_back() -> None:
    pixels = wall()
    holes = hole_at(pixels, 52, 90, 40, 40)
    spoilt = pixels.copy()
    spoilt[holes] = (255, 0, 255)
    made = fill_holes(spoilt, holes)
    off = np.abs(made.pixels.astype(int) - pixels.astype(int)).max(axis=2)
    assert np.median(off[holes]) < 12
    assert (off[holes] > 60).mean() < 0.03
    np.testing.assert_array_equal(made.pixels[~holes], pixels[~holes])
    np.testing.assert_array_equal(made.invented, holes)
    assert made.copied == holes.sum()
    assert made.unlike < 0.05


def test_two_holes_at_the_border() -> None:
    pixels = wall()
    holes = hole_at(pixels, 0, 0, 40, 38) | hole_at(pixels, 100, 170, 50, 50)
    made = fill_holes(pixels, holes)
    off = np.abs(made.pixels.astype(int) - pixels.astype(int)).max(axis=2)
    assert (off[holes] > 60).mean() < 0.08


def test_light_that_falls_off_is_followed() -> None:
    pixels = wall()
    fall = np.linspace(1.0, 0.75, pixels.shape[1])[None, :, None]
    pixels = (pixels * fall).astype(np.uint8)
    holes = hole_at(pixels, 52, 90, 40, 40)
    made = fill_holes(pixels, holes)
    rim = np.zeros_like(holes)
    rim[52:92, 90:92] = True
    off = made.pixels[rim].astype(float).mean(axis=0) - pixels[rim].astype(float).mean(axis=0)
    assert np.abs(off).max() < 5.0


def test_the_same_comes_out_twice() -> None:
    pixels = wall()
    holes = hole_at(pixels, 40, 60, 50, 50)
    one, two = fill_holes(pixels, holes), fill_holes(pixels, holes)
    np.testing.assert_array_equal(one.pixels, two.pixels)


def test_nothing_and_everything_missing() -> None:
    pixels = wall()
    none = np.zeros(pixels.shape[:2], dtype=bool)
    np.testing.assert_array_equal(fill_holes(pixels, none).pixels, pixels)
    assert (fill_holes(pixels, ~none).pixels == 128).all()
    most = ~none
    most[:3, :3] = False
    made = fill_holes(pixels, most)
    assert made.invented.sum() == most.sum()
    with pytest.raises(ValueError, match="do not belong together"):
        fill_holes(pixels, none[:-1])


def test_short_gaps_are_bridged_row_by_row() -> None:
    parameters = FillParameters(bridge_px=4, alike=200.0, smooth=200.0)
    rng = np.random.default_rng(5)
    pixels = rng.uniform(100, 110, (20, 30, 3)).astype(np.float32)
    known = rng.random((20, 30)) > 0.4
    filled, now = bridge(pixels, known, parameters)
    for y in range(20):
        for x in range(30):
            left = max((c for c in range(x + 1) if known[y, c]), default=None)
            right = min((c for c in range(x, 30) if known[y, c]), default=None)
            if known[y, x] or left is None or right is None or right - left - 1 > 4:
                continue
            assert now[y, x]
            share = (x - left) / (right - left)
            expected = pixels[y, left] * (1 - share) + pixels[y, right] * share
            np.testing.assert_allclose(filled[y, x], expected, rtol=1e-4)


def test_unlike_or_rough_ends_are_not_bridged() -> None:
    pixels = np.full((9, 20, 3), 50.0, np.float32)
    pixels[:, 12:] = 150.0
    known = np.ones((9, 20), dtype=bool)
    known[:, 9:12] = False
    assert not bridge(pixels, known, FillParameters())[1][:, 9:12].any()
    pixels[:] = 50.0
    assert bridge(pixels, known, FillParameters())[1].all()
    pixels[:, 4:9:2] = 90.0
    assert not bridge(pixels, known, FillParameters())[1][:, 9:12].any()


def test_repeats_are_measured_as_by_hand() -> None:
    pixels = wall(60, 80).astype(np.float32)
    known = np.random.default_rng(2).random((60, 80)) > 0.2
    known[20:40, 30:50] = False
    hole = ~known
    offsets, differences = repeats(pixels, known, hole, FillParameters(tried=40))
    assert len(offsets) == 40
    for (dx, dy), found in zip(offsets, differences, strict=True):
        sums, count = 0.0, 0
        for y in range(max(0, -dy), min(60, 60 - dy)):
            own = slice(max(0, -dx), min(80, 80 - dx))
            other = slice(own.start + dx, own.stop + dx)
            both = known[y, own] & known[y + dy, other]
            sums += ((pixels[y, own] - pixels[y + dy, other]) ** 2)[both].sum()
            count += int(both.sum())
        assert found == pytest.approx(sums / (3 * count), rel=1e-3)


def test_the_best_offsets_are_periods() -> None:
    pixels = wall().astype(np.float32)
    hole = hole_at(wall(), 52, 90, 40, 40)
    offsets, _ = repeats(pixels, ~hole, hole, FillParameters())
    first = offsets[:4]
    assert (first[:, 0] % 44 == 0).all()
    assert (first[:, 1] % 50 == 0).all()


def test_moved_pictures_and_finer_offsets() -> None:
    values = np.arange(48.0).reshape(6, 8)
    part = (slice(1, 4), slice(2, 6))
    found = moved(values, part, np.array([3, -2]))
    np.testing.assert_array_equal(found[0], 0.0)
    np.testing.assert_array_equal(found[1], [5.0, 6.0, 7.0, 0.0])
    pixels = wall().astype(np.float32)
    known = np.ones(pixels.shape[:2], dtype=bool)
    near = (slice(0, 100), slice(0, 150))
    fine, _ = refined(np.array([[22, 25], [-22, 0]]), pixels, known, near)
    np.testing.assert_array_equal(fine, [[-44, 0], [44, 50]])
