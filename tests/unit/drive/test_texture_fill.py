"""Holes of an atlas: what was seen stays, what is invented is marked, far texels stay plain."""

from __future__ import annotations

import numpy as np

from veduta.drive.build.atlas import Atlas
from veduta.drive.build.texture_fill import fill_texture

_TEXEL_M = 0.05


def _atlas(pixels: np.ndarray, seen: np.ndarray, surface: np.ndarray) -> Atlas:
    height, width = seen.shape
    rows, columns = np.arange(height, 0.0, -1.0), np.arange(float(width))
    return Atlas(pixels, seen, surface, rows, columns, 0)


def test_smooth_rows_are_joined_and_marked() -> None:
    ramp = np.repeat(np.linspace(60, 90, 120)[None], 80, axis=0)
    pixels = np.repeat(ramp[..., None], 3, axis=2).astype(np.uint8)
    seen = np.ones((80, 120), dtype=bool)
    seen[30:50, 40:70] = False
    holes = np.where(seen[..., None], pixels, 128).astype(np.uint8)
    filled, invented, plain = fill_texture(_atlas(holes, seen, np.ones_like(seen)), _TEXEL_M)
    np.testing.assert_array_equal(filled[seen], pixels[seen])
    np.testing.assert_array_equal(invented, ~seen)
    assert not plain.any()
    assert np.abs(filled[~seen].astype(int) - pixels[~seen]).max() < 8


def test_far_from_anything_seen_stays_plain() -> None:
    pixels = np.full((20, 400, 3), 200, dtype=np.uint8)
    seen = np.zeros((20, 400), dtype=bool)
    seen[:, :10] = True
    surface = np.ones_like(seen)
    surface[:2] = False
    _, invented, plain = fill_texture(_atlas(pixels, seen, surface), _TEXEL_M)
    assert not (invented & plain).any()
    assert plain[5, 399]
    assert invented[5, 12]
    assert not (invented | plain)[:2].any()


def test_nothing_seen_invents_nothing() -> None:
    seen = np.zeros((10, 10), dtype=bool)
    pixels = np.full((10, 10, 3), 128, dtype=np.uint8)
    _, invented, plain = fill_texture(_atlas(pixels, seen, np.ones_like(seen)), _TEXEL_M)
    assert not invented.any()
    assert plain.all()


def _windows(count: int) -> tuple[np.ndarray, list[slice]]:
    """A smooth wall with a row of dark windows with light frames, and their columns."""
    random = np.random.default_rng(1)
    pixels = np.full((64, 40 * count, 3), (190, 160, 130), dtype=np.float64)
    pixels += random.normal(0.0, 2.0, pixels.shape)
    columns = [slice(40 * n + 8, 40 * n + 32) for n in range(count)]
    for one in columns:
        pixels[16:48, one] = 240.0
        pixels[20:44, one.start + 4 : one.stop - 4] = 50.0
    return np.clip(pixels, 0, 255).astype(np.uint8), columns


def test_a_hidden_window_comes_again() -> None:
    """The wall beside it is smooth and alike on both sides: it is not joined over the window."""
    pixels, columns = _windows(5)
    seen = np.ones(pixels.shape[:2], dtype=bool)
    hole = slice(columns[2].start - 6, columns[2].stop + 6)
    seen[10:54, hole] = False
    holes = np.where(seen[..., None], pixels, 128).astype(np.uint8)
    filled, _, _ = fill_texture(_atlas(holes, seen, np.ones_like(seen)), _TEXEL_M)
    dark = (filled[..., 0] < 120)[20:44, columns[2].start + 4 : columns[2].stop - 4]
    assert dark.mean() > 0.9
    assert (filled[12:15, hole, 0] > 150).mean() > 0.9


def test_on_the_ground_kerbs_go_on() -> None:
    kerb = np.full((60, 200, 3), 100, dtype=np.uint8)
    kerb[28:32] = 180
    seen = np.ones((60, 200), dtype=bool)
    seen[10:50, 60:130] = False
    holes = np.where(seen[..., None], kerb, 128).astype(np.uint8)
    ground = np.ones_like(seen)
    filled, _, _ = fill_texture(_atlas(holes, seen, np.ones_like(seen)), _TEXEL_M, ground=ground)
    np.testing.assert_array_equal(filled, kerb)


def test_a_mask_of_the_depth_image_is_spread_over_the_texels() -> None:
    seen = np.zeros((40, 60), dtype=bool)
    rows, columns = np.linspace(39.0, 1.0, 20), np.linspace(1.0, 59.0, 30)
    atlas = Atlas(np.zeros((40, 60, 3), np.uint8), seen, seen, rows, columns, 0)
    values = np.zeros((20, 30), dtype=bool)
    values[:8, 10:] = True
    spread = atlas.spread(values)
    assert spread.shape == (40, 60)
    assert spread[39, 59]
    assert not spread[10, 59]
    assert not spread[39, 5]
    assert abs(spread.mean() - values.mean()) < 0.05
