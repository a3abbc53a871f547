"""Renders as real fronts are: sizes that are not quite those of the rules, things before them, and
the faults of cameras.

A house of a style is not exactly as the rules draw it, nor is its photo as clean as a render. So
the picture of a front is stretched here and squeezed there, by as much as neighbouring bays and
storeys of CMP's fronts (every fourth of those that the eyes were trained on) differ: the logarithm
of the ratio of one bay to the next deviates by 0.06 in the median and 0.41 in the mean square, that
of storeys by 0.06 and 0.20; taken is about the middle of both, of one interval. Sprites of
`training/facade/sprites.py` stand before it; light, blur, noise and JPEG are a camera's.
"""

from __future__ import annotations

import sys
from dataclasses import dataclass
from io import BytesIO
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray
from PIL import Image

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "training" / "facade"))

from sprites import DRAWN  # type: ignore[import-not-found]

Pixels = NDArray[np.uint8]
Rng = np.random.Generator


@dataclass(frozen=True)
class RealParameters:
    """Between which limits each fault is drawn, evenly.

    bays, storeys: deviation of the logarithm by which each stretch of `knot_m` is wider or higher.
    hidden: chance of something before the front, for each kind. size_m: its height. light:
    lightness of one corner against the other. casts: factor of a colour. blur_px, noise (of 255),
    quality (JPEG) and longest_px: of the camera.
    """

    bays: float = 0.12
    storeys: float = 0.09
    knot_m: float = 3.0
    hidden: float = 0.25
    size_m: tuple[float, float] = (1.6, 6.0)
    light: tuple[float, float] = (0.6, 1.0)
    casts: tuple[float, float] = (0.85, 1.1)
    blur_px: tuple[float, float] = (0.4, 1.6)
    noise: tuple[float, float] = (2.0, 9.0)
    quality: tuple[int, int] = (35, 90)
    longest_px: tuple[int, int] = (420, 640)


def as_real(
    pixels: Pixels, px_per_m: float, seed: int, parameters: RealParameters | None = None
) -> Pixels:
    """(h, w, 3) uint8 sRGB: the render of a front as a photo of a house of its kind."""
    p = parameters or RealParameters()
    rng = np.random.default_rng([seed, 35])
    found = _stretched(pixels, px_per_m, rng, p)
    for kind, draw in DRAWN:
        if kind != "wire" and rng.random() < p.hidden:
            found = _before(found, draw(rng), px_per_m, rng, p)
    return _shot(found, rng, p)


def _stretched(pixels: Pixels, px_per_m: float, rng: Rng, p: RealParameters) -> Pixels:
    """Each stretch of the picture wider or narrower; the borders stay."""
    height, width = pixels.shape[:2]
    x = _places(width, p.knot_m * px_per_m, p.bays, rng)
    y = _places(height, p.knot_m * px_per_m, p.storeys, rng)
    return np.asarray(cv2.remap(pixels, *np.meshgrid(x, y), cv2.INTER_LINEAR), np.uint8)


def _places(size: int, knot: float, deviation: float, rng: Rng) -> NDArray[np.float32]:
    """Where each of `size` pixels comes from."""
    count = max(2, round(size / knot))
    steps = np.exp(deviation * rng.standard_normal(count))
    ends = size * np.concatenate([[0.0], np.cumsum(steps)]) / steps.sum()
    even = np.linspace(0.0, size, count + 1)
    places = np.interp(np.arange(size) + 0.5, ends, even) - 0.5
    return np.asarray(places, np.float32)


def _before(seen: Pixels, sprite: Pixels, px_per_m: float, rng: Rng, p: RealParameters) -> Pixels:
    """With something that stands on the street."""
    side = max(8, round(float(rng.uniform(*p.size_m)) * px_per_m))
    height, width = seen.shape[:2]
    scaled = cv2.resize(sprite, (side, side), interpolation=cv2.INTER_AREA)
    x = int(rng.integers(-side // 2, max(1, width - side // 2)))
    y = max(0, height - side)
    left, right = max(0, x), min(width, x + side)
    cut = scaled[max(0, side - height) :, left - x : right - x]
    alpha = cut[..., 3:] / 255.0
    made = seen.copy()
    part = made[y:height, left:right]
    part[:] = np.rint(part * (1.0 - alpha) + cut[..., :3] * alpha).astype(np.uint8)
    return made


def _shot(seen: Pixels, rng: Rng, p: RealParameters) -> Pixels:
    """Smaller, with uneven light, a cast, blur, noise and JPEG."""
    longest = int(rng.integers(*p.longest_px))
    factor = min(1.0, longest / max(seen.shape[:2]))
    small = cv2.resize(seen, None, fx=factor, fy=factor, interpolation=cv2.INTER_AREA)
    height, width = small.shape[:2]
    dark, (gx, gy) = float(rng.uniform(*p.light)), rng.uniform(0.0, 1.0, 2)
    ramp = np.abs(np.linspace(0, 1, width)[None] - gx) + np.abs(
        np.linspace(0, 1, height)[:, None] - gy
    )
    shade = 1.0 - (1.0 - dark) * ramp / max(float(ramp.max()), 1e-6)
    lit = small * shade[..., None] * rng.uniform(*p.casts, 3)
    soft = cv2.GaussianBlur(lit, (0, 0), float(rng.uniform(*p.blur_px)))
    noisy = soft + rng.normal(0.0, float(rng.uniform(*p.noise)), soft.shape)
    made = np.clip(np.rint(noisy), 0, 255).astype(np.uint8)
    quality = int(rng.integers(*p.quality))
    buffer = BytesIO()
    Image.fromarray(made).save(buffer, "JPEG", quality=quality)
    with Image.open(buffer) as image:
        return np.asarray(image.convert("RGB"), np.uint8)
