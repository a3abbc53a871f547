"""Grass and planks around a house, and what scanning and photographing do to a drawing."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray
from shapely.geometry.base import BaseGeometry

from veduta.synthetic.plans.canvas import Canvas, Image

WOBBLE_PX = 1.6


def grass(canvas: Canvas, area: BaseGeometry, rng: np.random.Generator) -> None:
    """A lawn with its grain."""
    _grained(canvas, area, (122, 178, 84), 26.0, rng)


def planks(canvas: Canvas, area: BaseGeometry, rng: np.random.Generator) -> None:
    """A deck: grained wood with a joint every 14 cm."""
    _grained(canvas, area, (196, 176, 152), 12.0, rng)
    if area.is_empty:
        return
    left, bottom, right, top = area.bounds
    for y in np.arange(bottom, top, 0.14):
        canvas.line([(left, y), (right, y)], 0.6, (158, 138, 116))


def _grained(
    canvas: Canvas,
    area: BaseGeometry,
    colour: tuple[int, int, int],
    grain: float,
    rng: np.random.Generator,
) -> None:
    before = canvas.pixels.copy()
    canvas.fill(area, colour)
    inside = (before != canvas.pixels).any(axis=2)
    noise = rng.normal(0.0, grain, canvas.pixels.shape[:2])[inside]
    own = canvas.pixels[inside].astype(np.float64) + noise[:, None]
    canvas.pixels[inside] = np.clip(own, 0.0, 255.0).astype(np.uint8)


def as_scan(picture: Image, rng: np.random.Generator) -> Image:
    """An old sheet: stains, uneven paper, a fold, grain, and no colour."""
    light = 1.0 - 0.16 * smooth_noise(picture.shape[:2], 140.0, rng)
    fold = round(picture.shape[1] * float(rng.uniform(0.3, 0.7)))
    light[:, fold - 1 : fold + 2] *= 0.9
    grain = rng.normal(0.0, 5.0, picture.shape[:2])
    grey = cv2.cvtColor(picture, cv2.COLOR_RGB2GRAY).astype(np.float64) * light + grain
    soft = cv2.GaussianBlur(np.clip(grey, 0.0, 255.0), (0, 0), 0.7)
    return np.repeat(soft.astype(np.uint8)[:, :, None], 3, axis=2)


def as_photo(picture: Image, rng: np.random.Generator) -> Image:
    """A sketch on the table: strokes that waver and are uneven, a shadow, the camera's grain."""
    height, width = picture.shape[:2]
    shifts = [WOBBLE_PX * (2.0 * smooth_noise((height, width), 22.0, rng) - 1.0) for _ in "xy"]
    x, y = np.meshgrid(np.arange(width), np.arange(height))
    moved = cv2.remap(
        picture, (x + shifts[0]).astype(np.float32), (y + shifts[1]).astype(np.float32),
        cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE,
    ).astype(np.float64)  # fmt: skip
    paper = np.median(moved, axis=(0, 1))
    press = 0.65 + 0.35 * smooth_noise((height, width), 9.0, rng)
    drawn = paper + (moved - paper) * press[:, :, None]
    across = np.linspace(1.0, float(rng.uniform(0.62, 0.8)), width)[None, :, None]
    grain = rng.normal(0.0, 3.0, (height, width, 1))
    return np.clip(drawn * across + grain, 0.0, 255.0).astype(np.uint8)


def smooth_noise(
    shape: tuple[int, int], size_px: float, rng: np.random.Generator
) -> NDArray[np.float64]:
    """(h, w) from 0 to 1 that changes within so many pixels."""
    height, width = shape
    small = rng.random((int(height / size_px) + 3, int(width / size_px) + 3))
    large = cv2.resize(small, (width, height), interpolation=cv2.INTER_CUBIC)
    return np.asarray(np.clip(large, 0.0, 1.0), np.float64)
