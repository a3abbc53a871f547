"""Footage of a bending band, drawn for tests by OpenCV alone."""

from __future__ import annotations

import cv2
import numpy as np


def band_axis(frame: int, *, drift: float = 3.0, count: int = 400) -> np.ndarray:
    """(n, 2) px, the head first, which goes to the right: a sine about a straight course."""
    along = np.linspace(0.0, 1.0, count)
    x = 200.0 + drift * frame - 120.0 * along
    y = 120.0 + 14.0 * np.sin(2.0 * np.pi * (1.2 * along - 0.11 * frame))
    return np.stack([x, y], axis=1)


def band_frame(
    axes: list[np.ndarray], *, seed: int, noise: float = 4.0, shadow: bool = False
) -> np.ndarray:
    """(240, 400, 3) uint8: dark bands of 14 px over a mottled ground, with noise and a shadow."""
    ground = cv2.GaussianBlur(
        np.random.default_rng(9).normal(170.0, 60.0, (240, 400)).astype(np.float32), (0, 0), 5.0
    )
    picture = np.repeat(ground[..., None], 3, axis=2)
    for axis in axes:
        line = np.round(axis * 16).astype(np.int32)
        if shadow:
            mask = np.zeros((240, 400), np.uint8)
            cv2.polylines(mask, [line + 16 * 9], False, 255, 14, cv2.LINE_AA, shift=4)
            soft = cv2.GaussianBlur(mask, (0, 0), 1.5)[..., None] / 255.0
            picture = picture * (1.0 - 0.35 * soft)
        cv2.polylines(picture, [line], False, (40, 50, 30), 14, cv2.LINE_AA, shift=4)
    grain = np.random.default_rng(seed).normal(0.0, noise, picture.shape)
    return np.clip(picture + grain, 0, 255).astype(np.uint8)


def band_footage(count: int = 24, **looks: bool) -> np.ndarray:
    """(t, 240, 400, 3) frames of one band."""
    return np.stack([band_frame([band_axis(k)], seed=k, **looks) for k in range(count)])
