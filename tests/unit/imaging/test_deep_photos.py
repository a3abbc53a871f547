"""16-bit files with fewer bits are stretched; those with all are as they were."""

from __future__ import annotations

from pathlib import Path

import cv2
import numpy as np
import pytest

from veduta.imaging.read import read_image


def written(path: Path, bits: int, channels: int) -> np.ndarray:
    rng = np.random.default_rng(0)
    top = (1 << bits) - 1
    shape = (90, 120) if channels == 1 else (90, 120, channels)
    values = rng.integers(0, top + 1, shape).astype(np.uint16)
    values.flat[:3] = top
    assert cv2.imwrite(str(path), values)
    return values if channels == 1 else values[:, :, ::-1]


@pytest.mark.parametrize("suffix", [".tif", ".png"])
@pytest.mark.parametrize("channels", [1, 3])
@pytest.mark.parametrize("bits", [10, 12, 14, 16])
def test_values_of_a_sensor_fill_the_eight_bits(
    tmp_path: Path, suffix: str, channels: int, bits: int
) -> None:
    path = tmp_path / f"a{suffix}"
    values = written(path, bits, channels)
    photo = read_image(path)
    expected = values >> (bits - 8)
    if channels == 1:
        expected = np.repeat(expected[:, :, None], 3, axis=2)
    assert np.array_equal(photo.pixels, expected)
    assert [f"use {bits} bits" in note for note in photo.notes] == ([] if bits == 16 else [True])
