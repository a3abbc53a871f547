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
