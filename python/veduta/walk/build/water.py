"""Still water: what lies below a level plane and is the mirror image of what stands above it.

Stereo measures a mirrored thing where its mirror image is, below the surface. So a level is sought
about which points below have their counterparts above, at the right depth and of the same look.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.walk.build.sampling import sampled
from veduta.walk.build.screen import Screen
from veduta.walk.rig import Image

Floats = NDArray[np.float64]
Mask = NDArray[np.bool_]


@dataclass(frozen=True)
class WaterLimits:
    """levels_m: below the camera, the lowest and highest tried, in `steps` of one ratio. tilts_rad:
    of the plane, up and down. points: that a level is tried with. under: how far below the level a
    point is a mirrored one, as a share of its depth. depth: by how much (a share) its counterpart
    may be nearer or further. alike: least correlation of the two looks, over window_px. share,
    correlation: least of the points below that agree, and of all their looks, for there to be water.
    fewest: points below. piece: smallest piece, as a share of the picture. colour: by how much
    (0..255) mirrored sky may differ from the sky.
    """

    levels_m: tuple[float, float] = (0.4, 8.0)
    steps: int = 40
    tilts_rad: tuple[float, ...] = (-0.12, -0.09, -0.06, -0.03, 0.0, 0.03, 0.06, 0.09, 0.12)
    points: int = 4000
    under: float = 0.03
    depth: float = 0.1
    alike: float = 0.45
    window_px: int = 15
    share: float = 0.4
    correlation: float = 0.4
    fewest: int = 60
    piece: float = 0.004
    colour: float = 70.0


@dataclass(frozen=True)
class _Level:
    """The plane n . p = below_m, its normal down and tilted about the camera's x."""

    below_m: float
    tilt_rad: float

    @property
    def normal(self) -> Floats:
        return np.array([0.0, np.cos(self.tilt_rad), np.sin(self.tilt_rad)])

    def under(self, points: Floats) -> Floats:
        """How far below it points are."""
        return np.asarray(points @ self.normal - self.below_m)

    def mirrored(self, points: Floats) -> Floats:
        """The points above that these are the mirror images of."""
        return np.asarray(points - 2.0 * self.under(points)[..., None] * self.normal)


def find_water(
    image: Image, points: Floats, measured: Mask, sky: Mask, screen: Screen,
    limits: WaterLimits = WaterLimits(),
) -> Mask:  # fmt: skip
    """(h, w) where still water is seen. points: (h, w, 3) in the camera's frame, y down.

    sky: (h, w); what mirrors it belongs to the water, too.
    """
    nothing = np.zeros(measured.shape, dtype=np.bool_)
    detail, rows = _detail(image)
    level = _best_level(points, measured, rows, screen, limits)
    if level is None:
        return nothing
    alike = _mirrors(points, measured, detail, screen, level, limits)
    alike |= _mirrors_sky(image, screen, sky, level, limits) & ~measured
    side = np.ones((9, 9), np.uint8)
    closed = cv2.morphologyEx(alike.astype(np.uint8), cv2.MORPH_CLOSE, side)
    closed = cv2.morphologyEx(closed, cv2.MORPH_OPEN, np.ones((7, 7), np.uint8))
    water = _large(closed > 0, limits.piece)
    # What stereo lost within the water is water.
    return np.asarray((water | ~_large(~water, limits.piece)) & ~sky, dtype=np.bool_)


def _large(found: Mask, least: float) -> Mask:
    """The pieces that are so large a share of the picture."""
    _, numbers, stats, _ = cv2.connectedComponentsWithStats(found.astype(np.uint8), connectivity=8)
    large = stats[:, cv2.CC_STAT_AREA] >= least * found.size
    large[0] = False
    return np.asarray(large[numbers], dtype=np.bool_)


def _detail(image: Image) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
    """(h, w) the light without what changes slowly, and how it changes from row to row.

    A mirror turns the latter around. What is upright looks the same above and below any level, and
    would make water of walls; it does not change from row to row.
    """
    grey = cv2.cvtColor(image, cv2.COLOR_RGB2GRAY).astype(np.float32)
    soft = cv2.GaussianBlur(grey, (0, 0), 1.5)
    fine = np.asarray(soft - cv2.GaussianBlur(grey, (0, 0), 12.0), dtype=np.float32)
    return fine, np.asarray(cv2.Sobel(soft, cv2.CV_32F, 0, 1, ksize=3), dtype=np.float32)


def _best_level(
    points: Floats, measured: Mask, rows: NDArray[np.float32], screen: Screen, limits: WaterLimits
) -> _Level | None:
    """The level about which most points below agree with what is above; None: there is no water."""
    seen = np.flatnonzero(measured & (points[..., 1] > 0.0))
    if len(seen) < limits.fewest:
        return None
    chosen = seen[:: max(1, len(seen) // limits.points)]
    own, look = points.reshape(-1, 3)[chosen], rows.ravel()[chosen]
    depth = screen.project(points)[1]
    best: tuple[float, _Level] | None = None
    for below_m in np.geomspace(*limits.levels_m, limits.steps):
        for tilt_rad in limits.tilts_rad:
            level = _Level(float(below_m), tilt_rad)
            score = _score(own, look, depth, measured, rows, screen, level, limits)
            if score > 0.0 and (best is None or score > best[0]):
                best = (score, level)
    return None if best is None else best[1]


def _score(
    own: Floats, look: NDArray[np.float32], depth: Floats, measured: Mask,
    rows: NDArray[np.float32], screen: Screen, level: _Level, limits: WaterLimits,
) -> float:  # fmt: skip
    """How many points below a level agree, times how alike they look; 0 where it is no water."""
    own_depth = np.hypot(own[:, 0], own[:, 2])
    below = level.under(own) > limits.under * own_depth
    if below.sum() < limits.fewest:
        return 0.0
    pixels, ahead = screen.project(level.mirrored(own[below]))
    inside = _inside(pixels, screen)
    at = tuple(np.where(inside, np.nan_to_num(pixels[:, axis]), 0).astype(int) for axis in (1, 0))
    known = inside & measured[at]
    if known.sum() < limits.fewest:
        return 0.0
    near = known & (np.abs(depth[at] - ahead) < limits.depth * ahead)
    agree = float(near.sum() / known.sum())
    if agree < limits.share or near.sum() < limits.fewest:
        return 0.0
    pair = look[below][near].astype(np.float64), rows[at][near].astype(np.float64)
    alike = -float(np.corrcoef(*pair)[0, 1]) if min(one.std() for one in pair) > 1e-6 else 0.0
    return float(near.sum()) * alike if alike > limits.correlation else 0.0


def _inside(pixels: Floats, screen: Screen) -> Mask:
    x, y = pixels[..., 0], pixels[..., 1]
    with np.errstate(invalid="ignore"):
        return (x >= 0) & (y >= 0) & (x < screen.width_px) & (y < screen.height_px)


def _mirrors(
    points: Floats, measured: Mask, detail: NDArray[np.float32], screen: Screen, level: _Level,
    limits: WaterLimits,
) -> Mask:  # fmt: skip
    """(h, w) what looks as its counterpart above does."""
    own_depth = np.hypot(points[..., 0], points[..., 2])
    below = level.under(points) > limits.under * own_depth
    pixels, _ = screen.project(level.mirrored(points))
    there = below & _inside(pixels, screen)
    seen = np.where(there, sampled(detail, np.where(there[..., None], pixels, 0.0)), 0.0)
    own = np.where(there, detail, 0.0)
    size = (limits.window_px, limits.window_px)

    def mean(values: Floats) -> Floats:
        return np.asarray(cv2.blur(values.astype(np.float64), size))

    weight = np.maximum(mean(there.astype(np.float64)), 1e-6)
    means = [mean(one) / weight for one in (own, seen)]
    both = mean(own * seen) / weight - means[0] * means[1]
    spread = [
        np.maximum(mean(one * one) / weight - average**2, 1e-3)
        for one, average in zip((own, seen), means, strict=True)
    ]
    return np.asarray(there & (both / np.sqrt(spread[0] * spread[1]) > limits.alike))


def _mirrors_sky(
    image: Image, screen: Screen, sky: Mask, level: _Level, limits: WaterLimits
) -> Mask:
    """(h, w) whose mirrored ray leads into the sky and whose colour is near the sky's."""
    if not sky.any():
        return np.zeros_like(sky)
    rays = screen.points(screen.pixels, np.ones(sky.shape))
    down = rays @ level.normal
    pixels, _ = screen.project(rays - 2.0 * down[..., None] * level.normal)
    there = (down > 0.0) & _inside(pixels, screen)
    open_there = sampled(sky, np.where(there[..., None], pixels, 0.0), nearest=True) > 0
    apart = np.abs(image.astype(np.float64) - np.median(image[sky], axis=0)).max(axis=-1)
    return np.asarray(there & open_there & (apart < limits.colour) & ~sky)
