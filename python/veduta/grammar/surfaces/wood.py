"""Wood: boards on walls, planed wood for doors and frames, shingles."""

from __future__ import annotations

import numpy as np

from veduta.grammar.surfaces.bonds import Bond, bond, running
from veduta.grammar.surfaces.canvas import Canvas, Field, Image, eased, mixed


def siding(canvas: Canvas) -> Image:
    """Level boards, each lapped over the one below and painted."""
    boards = running(canvas, 1, 16, (0.05, 0.45, 0.8, 0.25, 0.6))
    rise = 1.0 - boards.up / boards.height
    butt = 1.0 - eased(np.minimum(boards.right, boards.width - boards.right), 0.0006, 0.004)
    relief = 0.016 * rise - 0.002 * butt + 0.0003 * _fibres(canvas, level=True)
    shade = canvas.lit(np.asarray(relief, np.float32), 0.8)
    from_above = boards.height - boards.up
    shade *= 1.0 - 0.34 * (1.0 - eased(from_above, 0.0, 0.022))
    shade *= 1.0 + 0.012 * boards.each(canvas.rng.standard_normal(boards.count))
    shade *= (1.0 + 0.012 * canvas.noise(0.5, 0.03)) * (1.0 - 0.15 * butt)
    return canvas.image(shade, (1.0, 0.998, 0.99), 0.91)


def boards(canvas: Canvas) -> Image:
    """Upright boards with grooves between them."""
    count = 16
    wide = canvas.size_m[0] / count
    joints = np.arange(count) * wide
    own = bond(canvas, [1.0], [joints.tolist()])
    beside = np.minimum(own.right, own.width - own.right)
    groove = 1.0 - eased(beside, 0.002, 0.008)
    relief = -0.006 * groove + 0.0005 * _fibres(canvas, level=False)
    shade = canvas.lit(np.asarray(relief, np.float32), 0.8) * (1.0 - 0.4 * groove)
    shade *= _grown(canvas, own, 0.05)
    warm = own.each(canvas.rng.uniform(0.0, 1.0, own.count))
    return canvas.image(shade, mixed((1.0, 0.97, 0.92), (0.96, 0.96, 0.96), warm), 0.86)


def planed(canvas: Canvas) -> Image:
    """Planed and painted wood, as doors and window frames are made of."""
    fibres = canvas.noise(0.3, 0.002, 0.5, stretch=(0.035, 1.0))
    shade = canvas.lit(np.asarray(0.00025 * fibres, np.float32), 1.0)
    shade *= 1.0 + 0.022 * fibres + 0.012 * canvas.noise(0.3, 0.03)
    return canvas.image(shade, (1.0, 0.995, 0.985), 0.92)


def shingles(canvas: Canvas) -> Image:
    """Wooden shingles of random widths."""
    rows = 14
    joints = []
    for _ in range(rows):
        widths = canvas.rng.uniform(0.07, 0.2, 15)
        at = np.cumsum(widths) * (canvas.size_m[0] / widths.sum())
        joints.append((at + canvas.rng.uniform(0.0, 1.0)).tolist())
    own = bond(canvas, [1.0] * rows, joints)
    gap = 1.0 - eased(np.minimum(own.right, own.width - own.right), 0.0008, 0.0045)
    ragged = own.each(canvas.rng.uniform(-0.006, 0.006, own.count))
    lift = eased(own.up + ragged, -0.002, 0.003)
    relief = 0.011 * (1.0 - own.up / own.height) * lift - 0.006 * gap
    relief = np.asarray(relief + 0.0006 * _fibres(canvas, level=False), np.float32)
    shade = canvas.lit(relief, 0.75) * (1.0 - 0.3 * gap) * _grown(canvas, own, 0.08)
    shade *= 1.0 - 0.36 * (1.0 - eased(own.height - own.up, 0.0, 0.02))
    warm = own.each(canvas.rng.uniform(0.0, 1.0, own.count))
    return canvas.image(shade, mixed((1.0, 0.96, 0.9), (0.92, 0.94, 0.95), warm), 0.82)


def _fibres(canvas: Canvas, *, level: bool) -> Field:
    """Along level boards, or along upright ones."""
    return canvas.noise(0.25, 0.003, 0.5, stretch=(1.0, 0.05) if level else (0.05, 1.0))


def _grown(canvas: Canvas, own: Bond, spread: float) -> Field:
    """Boards of different trees, with what has grown in each."""
    value = np.clip(canvas.rng.standard_normal(own.count), -2.0, 2.0)
    shade = 1.0 + spread * own.each(value) + 0.035 * _fibres(canvas, level=False)
    return np.asarray(shade, np.float32)
