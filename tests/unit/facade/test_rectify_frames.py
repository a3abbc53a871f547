"""The frame of a picture, by boxes round its windows: a known distortion is found again."""

from __future__ import annotations

import numpy as np
import pytest
from rectify import compared
from rectify_frames import frame_by_windows, terms

from veduta.geometry import homography, polygon

SIZE = (800, 1000)


def distorted_boxes(true: np.ndarray, jitter_px: float) -> np.ndarray:
    """Five columns by six floors that `true` brings back to level, drawn to whole pixels."""
    rng = np.random.default_rng(1)
    x, y = np.meshgrid(60 + 140 * np.arange(5), 80 + 150 * np.arange(6))
    corners = np.stack([x.ravel(), y.ravel(), x.ravel() + 60, y.ravel() + 90], axis=1)
    seen = homography.apply(np.linalg.inv(true), corners.reshape(-1, 2).astype(np.float64))
    return (seen.reshape(-1, 4) + rng.normal(0, jitter_px, (30, 4))).round()


def off(found: np.ndarray, true: np.ndarray) -> float:
    frame = polygon.rectangle(0, 0, *SIZE).astype(np.float64)
    return compared(homography.apply(found, frame), homography.apply(true, frame))[0]


def distortion(a: float, b: float, p: float, r: float) -> np.ndarray:
    width, height = SIZE
    unit = homography.scaling(1 / width, 1 / width) @ homography.translation(
        -width / 2, -height / 2
    )
    return np.linalg.inv(unit) @ np.array([[1, b, 0], [a, 1, 0], [p, r, 1.0]]) @ unit


@pytest.mark.parametrize(
    "four", [(0.01, 0, 0, 0), (0, -0.01, 0, 0), (0, 0, 0.04, 0), (0, 0, 0, -0.03)]
)
def test_each_distortion_is_found_again(four: tuple[float, float, float, float]) -> None:
    true = distortion(*four)
    found = frame_by_windows(distorted_boxes(true, 0.7), SIZE)
    assert found is not None
    assert off(np.eye(3), true) > 0.0049
    assert off(found, true) < 0.003
    assert np.allclose(terms(found, SIZE), four, atol=0.006)


def test_few_windows_say_nothing() -> None:
    assert frame_by_windows(np.array([[10.0, 10, 40, 60], [90, 10, 120, 60]]), SIZE) is None
