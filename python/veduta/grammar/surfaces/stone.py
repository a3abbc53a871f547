"""Stone: cut, channelled, smooth."""

from __future__ import annotations

import numpy as np

from veduta.grammar.surfaces.bonds import Bond, random_lengths, running
from veduta.grammar.surfaces.canvas import Canvas, Field, Image, eased, mixed

WARM, COOL = (1.0, 0.985, 0.955), (0.985, 0.99, 1.0)


def ashlar(canvas: Canvas) -> Image:
    """Cut stone in level courses with fine joints."""
    stones = random_lengths(canvas, [0.36, 0.32, 0.4, 0.36, 0.3, 0.38, 0.36, 0.4], 0.6, 1.0)
    joint = 1.0 - eased(stones.inside, 0.002, 0.0085)
    relief = _face(canvas, 0.00022) - 0.003 * joint
    shade = canvas.lit(relief, 1.3) * _stones(canvas, stones, 0.02) * _weathered(canvas, 0.024)
    shade *= 1.0 - 0.2 * joint
    return canvas.image(shade, _hues(canvas, stones), 0.905)


def rusticated(canvas: Canvas) -> Image:
    """Stones with deep channels around them, as ground floors have."""
    stones = running(canvas, 4, 7)
    edge = eased(stones.inside, 0.006, 0.036)
    relief = 0.014 * edge + _face(canvas, 0.0004)
    shade = canvas.lit(relief, 0.7) * canvas.hollow(relief, 0.03, 0.8)
    shade *= _stones(canvas, stones, 0.03) * _weathered(canvas, 0.03)
    shade *= 1.0 - 0.16 * (1.0 - edge)
    return canvas.image(shade, _hues(canvas, stones), 0.88)


def smooth(canvas: Canvas) -> Image:
    """Stone without joints, as mouldings are cut of."""
    shade = canvas.lit(_face(canvas, 0.00012), 1.0) * _weathered(canvas, 0.016)
    pits = eased(canvas.noise(0.05, 0.006), 2.1, 2.6)
    tint = mixed(WARM, COOL, eased(canvas.noise(0.25, 0.05), -4.0, 4.0))
    return canvas.image(shade * (1.0 - 0.12 * pits), tint, 0.93)


def _face(canvas: Canvas, rough_m: float) -> Field:
    """The tooled face of stones."""
    return np.asarray(rough_m * canvas.noise(0.12, 0.008, 0.5), np.float32)


def _stones(canvas: Canvas, stones: Bond, spread: float) -> Field:
    """No stone is quite as bright as the next."""
    value = np.clip(canvas.rng.standard_normal(stones.count), -2.0, 2.0)
    return np.asarray(1.0 + spread * stones.each(value), np.float32)


def _weathered(canvas: Canvas, spread: float) -> Field:
    """Clouds, and what rain has left."""
    clouds = canvas.noise(0.4, 0.02, 0.7)
    runs = canvas.noise(0.5, 0.03, 0.8, stretch=(0.2, 1.0))
    return np.asarray(1.0 + spread * (0.7 * clouds + 0.5 * runs + 0.25 * canvas.grain()))


def _hues(canvas: Canvas, stones: Bond) -> Field:
    """A little warmer or cooler, stone by stone."""
    share = 0.5 + 0.7 * stones.each(canvas.rng.uniform(-0.5, 0.5, stones.count))
    return mixed(WARM, COOL, np.asarray(share, np.float32))
