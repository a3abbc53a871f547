"""Brick in two bonds: neutral, to be multiplied with a colour, or in the colours of clays."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from veduta.grammar.surfaces.bonds import Bond, bond, running
from veduta.grammar.surfaces.canvas import Canvas, Image, eased, mixed

ROWS, STRETCHERS = 30, 10
"""Courses of 75 mm and stretchers of 225 mm with their joints, on 2.25 m."""
Rgb = tuple[float, float, float]


def stretcher(canvas: Canvas) -> Image:
    """Bricks end to end: stretcher bond."""
    return _laid(canvas, running(canvas, STRETCHERS, ROWS, jitter=0.012), [(1, 1, 1)], (1, 1, 1))


def flemish(canvas: Canvas) -> Image:
    """Stretchers and headers in turn: Flemish bond."""
    return _laid(canvas, _flemish(canvas), [(1, 1, 1)], (1, 1, 1))


def red(canvas: Canvas) -> Image:
    """Red bricks with grey mortar in Flemish bond; for the colour white."""
    clays = [(0.60, 0.29, 0.21), (0.65, 0.34, 0.25), (0.54, 0.25, 0.19), (0.44, 0.22, 0.19)]
    return _laid(canvas, _flemish(canvas), clays, (0.72, 0.69, 0.64))


def yellow(canvas: Canvas) -> Image:
    """Yellow stock bricks, some of them sooty, in Flemish bond; for the colour white."""
    clays = [(0.74, 0.64, 0.46), (0.70, 0.58, 0.42), (0.78, 0.69, 0.52), (0.58, 0.49, 0.38)]
    return _laid(canvas, _flemish(canvas), clays, (0.70, 0.68, 0.63))


def brown(canvas: Canvas) -> Image:
    """Dark brown bricks in stretcher bond; for the colour white."""
    clays = [(0.42, 0.31, 0.26), (0.47, 0.35, 0.28), (0.36, 0.27, 0.24), (0.30, 0.25, 0.24)]
    return _laid(canvas, running(canvas, STRETCHERS, ROWS, jitter=0.012), clays, (0.64, 0.61, 0.57))


def _flemish(canvas: Canvas) -> Bond:
    """Header above the middle of each stretcher."""
    pair = canvas.size_m[0] / 7.0
    joints = []
    for row in range(ROWS):
        start = 0.5 * pair * (row % 2) + np.arange(7) * pair
        at = np.concatenate([start, start + pair * 2 / 3])
        joints.append(at + canvas.rng.uniform(-0.002, 0.002, 14))
    return bond(canvas, [1.0] * ROWS, [each.tolist() for each in joints])


def _laid(canvas: Canvas, bricks: Bond, clays: Sequence[Rgb], mortar: Rgb) -> Image:
    stray = 0.0012 * canvas.noise(0.05, 0.008)
    face = eased(bricks.inside + stray, 0.0035, 0.0085)
    relief = 0.0045 * face + 0.0003 * canvas.noise(0.04, 0.006, 0.5)
    shade = canvas.lit(relief, 0.8) * canvas.hollow(relief, 0.012, 0.9)
    value = canvas.rng.standard_normal(bricks.count)
    burnt = np.clip(value - 1.2, 0.0, 1.2) * 0.16
    own = 1.0 + bricks.each(0.05 * np.clip(value, -2.0, 1.5) - burnt) * face
    shade *= own * (1.0 + 0.02 * canvas.noise(0.5, 0.05) + 0.025 * canvas.noise(0.03))
    chosen = canvas.rng.choice(len(clays), bricks.count, p=_shares(len(clays)))
    clay = np.asarray(clays, np.float32)[chosen][bricks.number]
    neutral = len(clays) == 1
    bed = np.asarray(mortar, np.float32) * (1.3 if neutral else 1.0)
    tint = mixed(bed, clay, face)
    mean = 0.86 if neutral else float(0.8 * np.mean(clays) + 0.2 * np.mean(mortar))
    return canvas.image(shade, tint, mean)


def _shares(count: int) -> list[float]:
    """Of the clays, the last of them rare."""
    return [1.0] if count == 1 else [0.4, 0.3, 0.2, 0.1]
