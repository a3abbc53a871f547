"""A coat painted by code, for where no footage shows the skin: every pixel of it is invented."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.fauna.options import Limbless
from veduta.place.material import Texture

_WIDTH, _HEIGHT = 1024, 256
Colour = tuple[float, float, float]


@dataclass(frozen=True)
class Coat:
    """Colours (sRGB, 0..255) from back to belly, how it is marked, and where its eyes are."""

    back: Colour
    side: Colour
    belly: Colour
    marks: Colour
    bands: float
    """Marks along the body; 0: none."""
    speckle: float
    eye_at: float
    """Place along the body; 0: it has none that one sees."""


_COATS: dict[Limbless, Coat] = {
    "snake": Coat((94, 78, 48), (140, 118, 74), (206, 194, 152), (44, 36, 24), 34.0, 0.35, 0.022),
    "worm": Coat((176, 118, 104), (190, 136, 120), (206, 160, 144), (150, 92, 82), 60.0, 0.2, 0.0),
    "fish": Coat((58, 66, 50), (112, 118, 92), (204, 204, 186), (34, 40, 30), 0.0, 0.6, 0.035),
}


def painted_coat(kind: Limbless) -> Texture:
    """The texture: u along the body from the head, v around it from the belly (the back at 0.5)."""
    coat = _COATS[kind]
    u = (np.arange(_WIDTH) + 0.5) / _WIDTH
    v = (np.arange(_HEIGHT) + 0.5) / _HEIGHT
    up = 0.5 - 0.5 * np.cos(2.0 * np.pi * v)[:, None]
    belly, side, back = (np.array(colour) for colour in (coat.belly, coat.side, coat.back))
    pixels = _mixed(_mixed(belly, side, _ramp(up, 0.12, 0.42)), back, _ramp(up, 0.5, 0.85))
    pixels = np.broadcast_to(pixels, (_HEIGHT, _WIDTH, 3)).copy()
    marks = np.zeros((_HEIGHT, _WIDTH))
    if coat.bands:
        wave = np.cos(2.0 * np.pi * coat.bands * u)[None, :]
        marks = _ramp(wave * (0.4 + 0.6 * up) - 0.9 * (1.0 - up), 0.1, 0.45) * 0.75
    random = np.random.default_rng(7)
    fine = cv2.GaussianBlur(random.normal(size=(_HEIGHT, _WIDTH)), (0, 0), 1.6)
    coarse = cv2.GaussianBlur(random.normal(size=(_HEIGHT, _WIDTH)), (0, 0), 6.0)
    grain = fine / fine.std() + coarse / coarse.std()
    marks = np.maximum(marks, _ramp(grain, 1.4, 2.6) * coat.speckle * _ramp(up, 0.2, 0.6))
    pixels = _mixed(pixels, np.array(coat.marks), marks) * (1.0 + 0.03 * grain[..., None])
    if coat.eye_at:
        _paint_eyes(pixels, u, v, coat.eye_at)
    every = np.ones((_HEIGHT, _WIDTH), dtype=np.bool_)
    return Texture(np.clip(pixels, 0.0, 255.0).astype(np.uint8), every)


def _paint_eyes(
    pixels: NDArray[np.float64], u: NDArray[np.float64], v: NDArray[np.float64], at: float
) -> None:
    """A dark pupil in a paler ring on either side of the head."""
    for side in (0.30, 0.70):
        apart = np.hypot((u[None, :] - at) / 0.0055, (v[:, None] - side) / 0.055)
        ring = (apart < 1.0)[..., None]
        pupil = (apart < 0.68)[..., None]
        pixels[:] = np.where(pupil, 12.0, np.where(ring, np.array([196.0, 172.0, 96.0]), pixels))


def _ramp(value: NDArray[np.float64], low: float, high: float) -> NDArray[np.float64]:
    """0 below `low`, 1 above `high`, smooth between them."""
    share = np.clip((value - low) / (high - low), 0.0, 1.0)
    return np.asarray(share * share * (3.0 - 2.0 * share))


def _mixed(
    first: NDArray[np.float64], second: NDArray[np.float64], share: NDArray[np.float64]
) -> NDArray[np.float64]:
    return np.asarray(first + (second - first) * share[..., None])
