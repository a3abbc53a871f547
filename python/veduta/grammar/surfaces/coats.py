"""Walls that are coated or cast: plaster and concrete."""

from __future__ import annotations

import numpy as np

from veduta.grammar.surfaces.bonds import running
from veduta.grammar.surfaces.canvas import Canvas, Image, eased


def plaster(canvas: Canvas) -> Image:
    """Rendered plaster, floated by hand."""
    relief = 0.0002 * canvas.noise(0.05, 0.01, 0.3) + 0.0005 * canvas.noise(0.35, 0.08, 0.5)
    shade = canvas.lit(relief, 1.0) * (1.0 + 0.012 * canvas.noise(0.6, 0.05))
    shade *= 1.0 + 0.008 * canvas.noise(0.6, 0.04, 0.8, stretch=(0.2, 1.0))
    return canvas.image(shade, (1.0, 0.998, 0.992), 0.93)


def roughcast(canvas: Canvas) -> Image:
    """Rough render with grit in it."""
    relief = 0.0011 * canvas.noise(0.03, 0.012, 0.1) + 0.0006 * canvas.noise(0.3, 0.1, 0.5)
    shade = canvas.lit(relief, 0.8) * canvas.hollow(relief, 0.01, 0.8)
    return canvas.image(shade * (1.0 + 0.014 * canvas.noise(0.6, 0.05)), (1.0, 0.995, 0.985), 0.88)


def panels(canvas: Canvas) -> Image:
    """Concrete panels with open joints."""
    own = running(canvas, 2, 2, (0.0,))
    joint = 1.0 - eased(own.inside, 0.006, 0.014)
    relief = -0.012 * joint + 0.0002 * canvas.noise(0.1, 0.015, 0.5)
    shade = canvas.lit(relief, 0.8) * (1.0 - 0.42 * joint)
    shade *= 1.0 + 0.02 * own.each(canvas.rng.uniform(-1.0, 1.0, own.count))
    streaks = canvas.noise(0.6, 0.02, 0.8, stretch=(0.14, 1.0))
    below = np.exp(-(own.height - own.up) / 0.5)  # what runs down from the joint above
    shade *= 1.0 + 0.016 * canvas.noise(0.5, 0.02) - 0.03 * below * (0.6 + 0.6 * streaks)
    pores = eased(canvas.noise(0.03, 0.008, 0.0), 2.5, 3.0)
    return canvas.image(shade * (1.0 - 0.2 * pores), (0.995, 1.0, 1.0), 0.9)


def concrete(canvas: Canvas) -> Image:
    """Smooth concrete with pores."""
    relief = 0.00025 * canvas.noise(0.12, 0.015, 0.5)
    shade = canvas.lit(relief, 0.8) * (1.0 + 0.014 * canvas.noise(0.5, 0.02, 0.8))
    shade *= 1.0 + 0.01 * canvas.noise(0.5, 0.03, 0.8, stretch=(0.15, 1.0))
    pores = eased(canvas.noise(0.04, 0.012, 0.0), 2.6, 3.1)
    return canvas.image(shade * (1.0 - 0.18 * pores), (1.0, 1.0, 0.99), 0.92)


def boarded(canvas: Canvas) -> Image:
    """Concrete as it came out of boards."""
    boards = running(canvas, 1, 16, (0.1, 0.55, 0.8, 0.3))
    seam = 1.0 - eased(np.minimum(boards.up, boards.height - boards.up), 0.001, 0.006)
    step = boards.each(canvas.rng.uniform(-1.0, 1.0, boards.count))
    wood = canvas.noise(0.3, 0.006, 0.4, stretch=(1.0, 0.04))
    relief = 0.0012 * step - 0.0025 * seam + 0.0003 * wood
    shade = canvas.lit(relief, 0.9) * (1.0 + 0.02 * step + 0.02 * canvas.noise(0.5, 0.03))
    return canvas.image(shade * (1.0 - 0.1 * seam), (1.0, 1.0, 0.99), 0.88)
