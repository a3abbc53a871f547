"""The front's wall as it goes on around the corners: its colours at each height, no openings."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.place.material import Colour

Pixels = NDArray[np.uint8]


@dataclass(frozen=True)
class SideParameters:
    """How the wall of the sides is made.

    least: share of a row that must be wall for the row to be read. median: share of the height over
    which a row takes the middle colour, so that thin stripes go. smooth_px: rows over which the
    colours are evened after that. grain: how much of the wall's own roughness is put on it. usual:
    how far a row may differ from the wall's usual colour (of 255, each channel): more is no wall.
    seed: of the grain.
    """

    least: float = 0.1
    median: float = 0.035
    smooth_px: float = 2.0
    grain: float = 0.5
    usual: float = 70.0
    seed: int = 0


def side_of(
    pixels: Pixels,
    wall: NDArray[np.bool_],
    rows: slice,
    usual: Colour,
    parameters: SideParameters | None = None,
) -> Pixels:
    """(h, w, 3) sRGB: in each row the median colour of the front's wall there, with its grain.

    pixels: (h, w, 3) of the front without what stands before it; wall: (h, w) what is no opening;
    rows: those of the wall, from the eaves down. usual: the wall's colour, sRGB 0..1, where a row
    has none.
    """
    p = parameters or SideParameters()
    height, width = wall.shape
    typical = np.array(usual, dtype=np.float64) * 255.0
    known = np.zeros(height, dtype=np.bool_)
    known[rows] = wall[rows].mean(axis=1) >= p.least
    shown = np.where(wall[..., None], pixels, np.nan).astype(np.float32)
    line = np.tile(typical, (height, 1))
    if known.any():
        medians = np.nanmedian(shown[known], axis=1)
        near = np.abs(medians - typical).max(axis=1) <= p.usual
        places = np.flatnonzero(known)[near]
        if len(places):
            every = np.arange(height)
            line = np.stack([np.interp(every, places, medians[near, c]) for c in range(3)], axis=1)
    side = 2 * min(127, max(1, round(0.5 * p.median * height))) + 1
    rows_only = np.clip(np.rint(line), 0, 255).astype(np.uint8).reshape(height, 1, 3)
    middle = cv2.medianBlur(np.repeat(rows_only, 3, axis=1), side)[:, 1:2]
    even = cv2.GaussianBlur(middle.astype(np.float32), (0, 0), p.smooth_px).reshape(height, 1, 3)
    rng = np.random.default_rng(p.seed)
    noise = rng.normal(0.0, 1.0, (height, width)).astype(np.float32)
    grain = np.asarray(cv2.GaussianBlur(noise, (0, 0), 1.2), np.float32)
    strength = p.grain * _roughness(shown[rows], typical) / max(float(grain.std()), 1e-6)
    made = even + strength * grain[..., None]
    return np.clip(np.rint(made), 0, 255).astype(np.uint8)


def _roughness(shown: NDArray[np.float32], usual: NDArray[np.float64]) -> float:
    """How much neighbours in the wall differ in lightness (of 255), edges aside."""
    light = shown.mean(axis=2)
    steps = np.abs(np.diff(light, axis=1))
    steps = steps[np.isfinite(steps)]
    return min(float(np.median(steps)), 8.0) if len(steps) else 0.02 * float(usual.mean())
