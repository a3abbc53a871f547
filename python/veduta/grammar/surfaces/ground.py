"""What one walks on."""

from __future__ import annotations

import numpy as np

from veduta.grammar.surfaces.bonds import random_lengths, running
from veduta.grammar.surfaces.canvas import Canvas, Image, eased, mixed


def cobbles(canvas: Canvas) -> Image:
    """Cut cobbles in rows, worn round."""
    rows = canvas.rng.uniform(0.1, 0.125, 19)
    stones = random_lengths(canvas, rows.tolist(), 0.09, 0.17)
    stray = 0.004 * canvas.noise(0.06, 0.02)
    dome = eased(stones.inside + stray, 0.002, 0.042)
    relief = 0.022 * np.sqrt(dome) + 0.0015 * canvas.noise(0.03, 0.006, 0.4)
    relief = np.asarray(relief, np.float32)
    shade = canvas.lit(canvas.blurred(relief, 0.003), 0.7) * canvas.hollow(relief, 0.02, 1.4)
    value = np.clip(canvas.rng.standard_normal(stones.count), -2.0, 2.0)
    shade *= 1.0 + stones.each(0.08 * value) * dome + 0.03 * canvas.grain()
    cool = stones.each(canvas.rng.uniform(0.0, 1.0, stones.count))
    return canvas.image(shade, mixed((1.0, 0.97, 0.93), (0.93, 0.97, 1.0), cool), 0.72)


def paving(canvas: Canvas) -> Image:
    """Flat slabs of stone."""
    slabs = running(canvas, 4, 6, (0.0, 0.5), jitter=0.02)
    joint = 1.0 - eased(slabs.inside, 0.003, 0.009)
    relief = -0.004 * joint + 0.00025 * canvas.noise(0.08, 0.01, 0.5)
    shade = canvas.lit(np.asarray(relief, np.float32), 0.9) * (1.0 - 0.3 * joint)
    value = np.clip(canvas.rng.standard_normal(slabs.count), -2.0, 2.0)
    shade *= 1.0 + slabs.each(0.035 * value) + 0.025 * canvas.noise(0.4, 0.02)
    return canvas.image(shade, (1.0, 0.99, 0.975), 0.86)


def lawn(canvas: Canvas) -> Image:
    """A mown lawn: short blades, some of them dry."""
    blades = np.asarray(0.006 * canvas.noise(0.035, 0.008, 0.2), np.float32)
    shade = canvas.lit(blades, 0.8) * canvas.hollow(blades, 0.012, 6.0)
    shade *= 1.0 + 0.05 * canvas.noise(0.9, 0.08) + 0.05 * canvas.grain()
    dry = eased(canvas.noise(0.3, 0.02, 0.6), 0.3, 2.2)
    return canvas.image(shade, mixed((0.95, 1.0, 0.93), (1.0, 0.97, 0.82), dry), 0.8)


def asphalt(canvas: Canvas) -> Image:
    """Asphalt with grit in it."""
    relief = np.asarray(0.0012 * canvas.noise(0.025, 0.012, 0.0), np.float32)
    shade = canvas.lit(relief, 0.9) * (1.0 + 0.05 * canvas.grain())
    shade *= 1.0 + 0.03 * canvas.noise(0.6, 0.05)
    grit = eased(canvas.noise(0.03, 0.012, 0.0), 1.9, 2.4)
    return canvas.image(shade * (1.0 + 0.25 * grit), (1.0, 1.0, 1.0), 0.78)
