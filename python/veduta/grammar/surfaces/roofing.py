"""What roofs are covered with. The upper edge looks up the slope."""

from __future__ import annotations

import numpy as np

from veduta.grammar.surfaces.bonds import Bond, running
from veduta.grammar.surfaces.canvas import Canvas, Field, Image, eased, mixed


def slate(canvas: Canvas) -> Image:
    """Slates, half of each under the next course."""
    slates = running(canvas, 12, 18, jitter=0.05)
    chipped = 0.0025 * canvas.noise(0.04, 0.01)
    relief = _lapped(slates, 0.008, chipped) - 0.006 * _gaps(slates, 0.0045)
    relief += 0.0006 * canvas.noise(0.12, 0.006, 0.8, stretch=(0.5, 1.0))
    shade = canvas.lit(relief, 0.85) * _shadow(slates, 0.016, 0.34)
    value = canvas.rng.standard_normal(slates.count)
    shade *= 1.0 + 0.055 * slates.each(value) + 0.02 * canvas.noise(0.5, 0.02)
    shade *= 1.0 - 0.22 * _gaps(slates, 0.004)
    cool = slates.each(canvas.rng.uniform(0.0, 1.0, slates.count))
    return canvas.image(shade, mixed((1.0, 0.985, 0.965), (0.945, 0.985, 1.0), cool), 0.84)


def clay_tile(canvas: Canvas) -> Image:
    """Plain clay tiles, each with a rounded end."""
    tiles = running(canvas, 15, 24, jitter=0.02)
    middle = (tiles.right / tiles.width - 0.5) * 2.0
    bowed = 0.014 * middle**4
    chipped = 0.0015 * canvas.noise(0.03, 0.008)
    lifted = np.asarray(tiles.up + bowed * -1.0 + chipped, np.float32)
    relief = 0.012 * (1.0 - tiles.up / tiles.height) * eased(lifted, -0.014, 0.002)
    relief = relief + 0.002 * (1.0 - middle**2) - 0.005 * _gaps(tiles, 0.004)
    relief += 0.0008 * canvas.noise(0.03, 0.005, 0.4)
    shade = canvas.lit(np.asarray(relief, np.float32), 0.8) * _shadow(tiles, 0.018, 0.36)
    value = canvas.rng.standard_normal(tiles.count)
    shade *= 1.0 + tiles.each(0.06 * np.clip(value, -2.2, 1.8))
    shade *= (1.0 + 0.02 * canvas.noise(0.4, 0.03)) * (1.0 - 0.25 * _gaps(tiles, 0.004))
    old = tiles.each(canvas.rng.uniform(0.0, 1.0, tiles.count) ** 3)
    return canvas.image(shade, mixed((1.0, 0.99, 0.975), (0.86, 0.88, 0.86), old), 0.83)


def pantile(canvas: Canvas) -> Image:
    """Pantiles: a wave across each course."""
    tiles = running(canvas, 12, 9, (0.0,))
    share = tiles.right / tiles.width
    wave = 0.5 + 0.5 * np.cos(2.0 * np.pi * (share - 0.3))
    relief = 0.03 * wave**1.3 + 0.022 * (1.0 - tiles.up / tiles.height)
    relief = np.asarray(relief + 0.0008 * canvas.noise(0.03, 0.006, 0.4), np.float32)
    shade = canvas.lit(relief, 0.62) * canvas.hollow(relief, 0.05, 0.5)
    shade *= _shadow(tiles, 0.03, 0.4)
    value = np.clip(canvas.rng.standard_normal(tiles.count), -2.0, 2.0)
    shade *= 1.0 + tiles.each(0.05 * value) + 0.025 * canvas.noise(0.4, 0.03)
    return canvas.image(shade, (1.0, 0.985, 0.97), 0.8)


def concrete_tile(canvas: Canvas) -> Image:
    """Concrete roof tiles with two low rolls each."""
    tiles = running(canvas, 10, 9, (0.0, 0.5))
    share = tiles.right / tiles.width
    roll = 0.5 + 0.5 * np.cos(2.0 * np.pi * (2.0 * share - 0.25))
    relief = 0.016 * roll + 0.02 * (1.0 - tiles.up / tiles.height)
    relief = np.asarray(relief - 0.006 * _gaps(tiles, 0.005), np.float32)
    relief += 0.0011 * canvas.noise(0.02, 0.005, 0.2)
    shade = canvas.lit(relief, 0.6) * canvas.hollow(relief, 0.04, 0.3)
    shade *= _shadow(tiles, 0.03, 0.4) * (1.0 - 0.2 * _gaps(tiles, 0.005))
    value = np.clip(canvas.rng.standard_normal(tiles.count), -2.0, 2.0)
    shade *= 1.0 + tiles.each(0.03 * value) + 0.018 * canvas.noise(0.4, 0.02)
    return canvas.image(shade, (1.0, 0.995, 0.99), 0.82)


def zinc(canvas: Canvas) -> Image:
    """Sheets of zinc with standing seams."""
    pans = running(canvas, 6, 2, (0.0, 0.0))
    beside = np.minimum(pans.right, pans.width - pans.right)
    seam = 1.0 - eased(beside, 0.006, 0.017)
    step = pans.each(canvas.rng.uniform(-1.0, 1.0, pans.count))
    lap = 1.0 - eased(np.minimum(pans.up, pans.height - pans.up), 0.002, 0.007)
    buckled = 0.0012 * canvas.noise(0.6, 0.2, 0.8, stretch=(0.7, 1.0))
    relief = np.asarray(0.02 * seam + buckled + 0.001 * lap, np.float32)
    shade = canvas.lit(relief, 0.75) * (1.0 + 0.016 * step - 0.1 * lap * (1 - seam))
    bloom = canvas.noise(0.5, 0.015, 0.7, stretch=(0.3, 1.0))
    shade *= 1.0 + 0.022 * bloom + 0.008 * canvas.grain()
    beyond = eased(pans.right, 0.017, 0.05)  # the seam's own shadow falls to its right
    shade *= 0.86 + 0.14 * beyond
    return canvas.image(
        shade, mixed((1.0, 1.0, 1.0), (0.96, 0.985, 1.0), eased(bloom, -2, 2)), 0.88
    )


def gravel(canvas: Canvas) -> Image:
    """Round gravel on a flat roof."""
    stones = canvas.noise(0.05, 0.022, 0.0)
    fine = canvas.noise(0.03, 0.01, 0.0)
    relief = np.asarray(0.007 * np.abs(stones) + 0.0035 * np.abs(fine), np.float32)
    shade = canvas.lit(relief, 0.55) * canvas.hollow(relief, 0.012, 1.6)
    shade *= 1.0 + 0.09 * canvas.noise(0.035, 0.02, 0.0) + 0.02 * canvas.noise(0.5, 0.05)
    tint = mixed(
        (1.0, 0.97, 0.93), (0.95, 0.98, 1.0), eased(canvas.noise(0.04, 0.02, 0), -1.5, 1.5)
    )
    return canvas.image(shade, tint, 0.8)


def felt(canvas: Canvas) -> Image:
    """Bituminous felt with mineral grit, in lapped strips."""
    strips = running(canvas, 1, 3, (0.15, 0.6, 0.85))
    lap = eased(strips.up, 0.0, 0.012)
    relief = np.asarray(0.003 * lap + 0.0006 * canvas.grain(), np.float32)
    shade = canvas.lit(relief, 0.5) * (1.0 - 0.22 * (1.0 - eased(strips.up, 0.004, 0.02)))
    shade *= 1.0 + 0.022 * canvas.noise(0.6, 0.03) + 0.02 * canvas.grain()
    end = np.minimum(strips.right, strips.width - strips.right)
    return canvas.image(shade * (1.0 - 0.15 * (1.0 - eased(end, 0.003, 0.01))), (1, 1, 1), 0.86)


def _lapped(tiles: Bond, thick_m: float, stray: Field) -> Field:
    """Each course rises towards its lower edge, under which the next one comes out."""
    rise = 1.0 - tiles.up / tiles.height
    return np.asarray(thick_m * rise * eased(tiles.up + stray, -0.001, 0.004), np.float32)


def _gaps(tiles: Bond, half_m: float) -> Field:
    """1 in the gap between two tiles of a course."""
    beside = np.minimum(tiles.right, tiles.width - tiles.right)
    return np.asarray(1.0 - eased(beside, 0.15 * half_m, half_m), np.float32)


def _shadow(tiles: Bond, long_m: float, dark: float) -> Field:
    """What a course throws on the one below: at the upper end of what is seen of that."""
    from_above = tiles.height - tiles.up
    return np.asarray(1.0 - dark * (1.0 - eased(from_above, 0.0, long_m)), np.float32)
