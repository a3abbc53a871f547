"""The front's wall as it goes on around the corners: its colour and that of its base."""

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

    least: share of a row that must be wall for the row to be read. base: the share of the height,
    from the ground up, in which a base of another colour may end; lowest: how high one is at least.
    other: how far the colours of base and wall are apart (of 255, in the mean of the channels) from
    which on there is one. smooth_px: rows over which one goes over into the other. grain: how much
    of the wall's own roughness is put on it. usual: how far a row may differ from the wall's usual
    colour (of 255, each channel): more is no wall. seed: of the grain.
    """

    least: float = 0.1
    base: float = 0.4
    lowest: float = 0.03
    other: float = 10.0
    smooth_px: float = 1.5
    grain: float = 0.6
    usual: float = 70.0
    seed: int = 0


def side_of(
    pixels: Pixels,
    wall: NDArray[np.bool_],
    rows: slice,
    usual: Colour,
    parameters: SideParameters | None = None,
) -> Pixels:
    """(h, w, 3) sRGB: the median colour of the front's wall, with its grain, over that of its base.

    The front's courses, shadows and signs do not go on around a corner, so that there are two
    colours at most. pixels: (h, w, 3) of the front without what stands before it; wall: (h, w) what
    is no opening; rows: those of the wall, from the eaves down. usual: the wall's colour, sRGB
    0..1, where a row has none.
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
        if near.any():
            line = _two_colours(np.flatnonzero(known)[near], medians[near], height, p)
    rows_only = line.astype(np.float32).reshape(height, 1, 3)
    even = cv2.GaussianBlur(rows_only, (0, 0), p.smooth_px).reshape(height, 1, 3)
    rng = np.random.default_rng(p.seed)
    noise = rng.normal(0.0, 1.0, (height, width)).astype(np.float32)
    grain = np.asarray(cv2.GaussianBlur(noise, (0, 0), 1.2), np.float32)
    strength = p.grain * _roughness(shown[rows], typical) / max(float(grain.std()), 1e-6)
    made = even + strength * grain[..., None]
    return np.clip(np.rint(made), 0, 255).astype(np.uint8)


def _two_colours(
    places: NDArray[np.intp], colours: NDArray[np.floating], height: int, p: SideParameters
) -> NDArray[np.float64]:
    """(height, 3) the wall's median colour, and below it that of its base, where there is one.

    places: rows (n,) of which the colours (n, 3) are known. The base ends where two medians are
    least apart from the rows.
    """
    whole = np.median(colours, axis=0)
    line = np.tile(whole, (height, 1)).astype(np.float64)
    foot = int(places[-1]) + 1
    high = foot - int(places[0])
    best, least = None, np.inf
    for row in np.linspace(foot - p.base * high, foot - p.lowest * high, 24).astype(int).tolist():
        above = places < row
        if above.sum() < 2 or (~above).sum() < 2:
            continue
        wall, base = (np.median(colours[some], axis=0) for some in (above, ~above))
        apart = np.where(above[:, None], wall, base)
        error = float(np.abs(colours - apart).sum())
        if error < least:
            best, least = (row, wall, base), error
    if best is not None and float(np.abs(best[1] - best[2]).mean()) >= p.other:
        line[: best[0]], line[best[0] :] = best[1], best[2]
    return line


def _roughness(shown: NDArray[np.float32], usual: NDArray[np.float64]) -> float:
    """How much neighbours in the wall differ in lightness (of 255), edges aside."""
    light = shown.mean(axis=2)
    steps = np.abs(np.diff(light, axis=1))
    steps = steps[np.isfinite(steps)]
    return min(float(np.median(steps)), 8.0) if len(steps) else 0.02 * float(usual.mean())
