"""Textures made by code: walls, roofs and grounds as sRGB images of a known size in metres.

All are (h, w, 3) uint8; row 0 is the upper edge. Walls are made at the full size of a facade,
so that nothing repeats; roofs and grounds repeat.
"""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.synthetic.noise import Field, fractal_noise, grain, value_noise

Image = NDArray[np.uint8]
Colour = tuple[float, float, float]
PX_PER_M = 72.0


def _canvas(width_m: float, height_m: float, px_per_m: float) -> tuple[int, int]:
    return max(8, round(height_m * px_per_m)), max(8, round(width_m * px_per_m))


def _tint(value: NDArray[np.floating], colour: Colour) -> NDArray[np.float32]:
    return np.asarray(value[..., None] * np.asarray(colour), np.float32)


def _finish(image: NDArray[np.float32]) -> Image:
    return np.asarray(np.clip(np.rint(image * 255.0), 0, 255), np.uint8)


def _coordinates(shape: tuple[int, int], px_per_m: float) -> tuple[Field, Field]:
    """Metres right from the left edge and up from the lower edge, per pixel centre."""
    y, x = np.indices(shape, dtype=np.float32)
    return (x + 0.5) / px_per_m, (shape[0] - y - 0.5) / px_per_m


def _cell_values(
    rng: np.random.Generator, row: NDArray[np.int32], column: NDArray[np.int32]
) -> Field:
    """One random value of unit deviation for each (row, column) cell, looked up per pixel."""
    rows, columns = int(row.max()) + 1, int(column.max()) + 1
    table = rng.standard_normal((rows, columns)).astype(np.float32)
    return table[row, column]


def courses(
    rng: np.random.Generator,
    size_m: tuple[float, float],
    block_m: tuple[float, float],
    joint_m: float,
    px_per_m: float,
) -> tuple[Field, Field]:
    """Running bond: (value per block of unit deviation, joint strength 0..1)."""
    shape = _canvas(*size_m, px_per_m)
    x, y = _coordinates(shape, px_per_m)
    row = np.floor(y / block_m[1]).astype(np.int32)
    shifted = x / block_m[0] + 0.5 * (row % 2)
    column = np.floor(shifted).astype(np.int32)
    value = _cell_values(rng, row, column)
    to_row = np.abs(y / block_m[1] - np.round(y / block_m[1])) * block_m[1]
    to_column = np.abs(shifted - np.round(shifted)) * block_m[0]
    nearest = np.minimum(to_row, to_column)
    softness = 0.7 / px_per_m
    joint = np.clip((joint_m / 2 + softness - nearest) / (2 * softness), 0.0, 1.0)
    return value, joint.astype(np.float32)


def ashlar(rng: np.random.Generator, width_m: float, height_m: float, colour: Colour) -> Image:
    """Dressed stone in courses of 0.36 m with thin joints."""
    value, joint = courses(rng, (width_m, height_m), (0.95, 0.36), 0.012, PX_PER_M)
    mottle = fractal_noise(rng, value.shape, 0.6 * PX_PER_M)
    shade = 1.0 + 0.022 * value + 0.05 * mottle + 0.012 * grain(rng, value.shape)
    shade *= 1.0 - 0.20 * joint
    return _finish(_tint(shade, colour))


def brick(
    rng: np.random.Generator, width_m: float, height_m: float, colour: Colour, mortar: Colour
) -> Image:
    """Stretcher bond, 225 x 75 mm with 12 mm joints; some bricks are burnt darker."""
    value, joint = courses(rng, (width_m, height_m), (0.225, 0.075), 0.012, PX_PER_M * 1.35)
    burnt = np.clip(value - 1.1, 0.0, 1.5)
    shade = 1.0 + 0.09 * value - 0.28 * burnt
    shade += 0.06 * fractal_noise(rng, value.shape, 0.9 * PX_PER_M)
    shade += 0.03 * grain(rng, value.shape)
    face = _tint(shade, colour)
    bed = _tint(1.0 + 0.05 * grain(rng, value.shape), mortar)
    weight = joint[..., None] * 0.8
    return _finish(face * (1.0 - weight) + bed * weight)


def render_coat(rng: np.random.Generator, width_m: float, height_m: float, colour: Colour) -> Image:
    """Painted stucco: nearly even, with patches of repair and fine grain."""
    shape = _canvas(width_m, height_m, PX_PER_M)
    broad = fractal_noise(rng, shape, 2.2 * PX_PER_M)
    fine = fractal_noise(rng, shape, 0.12 * PX_PER_M, 3)
    shade = 1.0 + 0.045 * broad + 0.02 * fine + 0.012 * grain(rng, shape)
    return _finish(_tint(shade, colour))


def panels(
    rng: np.random.Generator,
    width_m: float,
    height_m: float,
    colour: Colour,
    panel_m: tuple[float, float],
) -> Image:
    """Concrete or fibre-cement panels with open joints in a stack bond."""
    shape = _canvas(width_m, height_m, PX_PER_M)
    x, y = _coordinates(shape, PX_PER_M)
    row, column = np.floor(y / panel_m[1]), np.floor(x / panel_m[0])
    value = _cell_values(rng, row.astype(np.int32), column.astype(np.int32))
    to_row = np.abs(y - np.round(y / panel_m[1]) * panel_m[1])
    to_column = np.abs(x - np.round(x / panel_m[0]) * panel_m[0])
    joint = np.clip((0.012 - np.minimum(to_row, to_column)) * PX_PER_M + 0.5, 0.0, 1.0)
    shade = 1.0 + 0.018 * value + 0.04 * fractal_noise(rng, shape, 1.4 * PX_PER_M)
    shade += 0.01 * grain(rng, shape)
    return _finish(_tint(shade * (1.0 - 0.45 * joint), colour))


def weather(
    rng: np.random.Generator,
    wall: Image,
    size_m: tuple[float, float],
    drips_m: list[tuple[float, float, float]],
    strength: float = 1.0,
) -> Image:
    """Dirt on a wall: darker near the ground and under the eaves, streaks below each sill.

    `drips_m` lists (left, right, height of the sill above the lower edge).
    """
    shape = (wall.shape[0], wall.shape[1])
    px_per_m = shape[0] / size_m[1]
    x, y = _coordinates(shape, px_per_m)
    dirt = 0.16 * np.exp(-y / 0.9) + 0.10 * np.exp(-(size_m[1] - y) / 0.7)
    dirt *= 1.0 + 0.8 * value_noise(rng, shape, (3.0 * px_per_m, 0.25 * px_per_m))
    streaks = 0.5 + 0.5 * value_noise(rng, shape, (4.0 * px_per_m, 0.09 * px_per_m))
    for left, right, sill in drips_m:
        below = sill - y
        inside = np.clip(np.minimum(x - left, right - x) / 0.06 + 0.5, 0.0, 1.0)
        dirt += 0.13 * inside * streaks * np.where(below > 0, np.exp(-below / 0.55), 0.0)
    dirt += 0.05 * np.clip(fractal_noise(rng, shape, 3.5 * px_per_m), 0.0, 1.0)
    kept = (1.0 - strength * np.clip(dirt, 0.0, 0.45))[..., None]
    brown = np.array([1.0, 0.985, 0.96], np.float32) ** (1.0 - kept)
    return _finish(wall.astype(np.float32) / 255.0 * kept * brown)


def zinc(rng: np.random.Generator) -> Image:
    """Standing-seam zinc, 2.4 x 2.4 m, a seam every 0.6 m; repeats."""
    shape = _canvas(2.4, 2.4, PX_PER_M)
    x, _ = _coordinates(shape, PX_PER_M)
    to_seam = np.abs(x - np.round(x / 0.6) * 0.6)
    side = (x - np.round(x / 0.6) * 0.6) > 0
    seam = np.clip((0.035 - to_seam) / 0.012, 0.0, 1.0)
    shade = 1.0 + 0.05 * fractal_noise(rng, shape, 0.5 * PX_PER_M)
    shade += 0.04 * value_noise(rng, shape, (1.6 * PX_PER_M, 0.2 * PX_PER_M))
    shade *= 1.0 + np.where(side, -0.30, 0.14) * seam
    return _finish(_tint(shade.astype(np.float32), (0.50, 0.535, 0.575)))


def slate(rng: np.random.Generator, colour: Colour) -> Image:
    """Slates or flat tiles, 0.25 m wide with 0.16 m showing, 2.0 x 1.92 m; repeats."""
    size = (2.0, 1.92)
    value, joint = courses(rng, size, (0.25, 0.16), 0.01, PX_PER_M)
    _, y = _coordinates(value.shape, PX_PER_M)
    within = y / 0.16 - np.floor(y / 0.16)
    shade = 1.0 + 0.09 * value - 0.22 * np.clip(1.0 - within / 0.25, 0.0, 1.0)
    shade += 0.05 * grain(rng, value.shape)
    return _finish(_tint(shade * (1.0 - 0.35 * joint), colour))


def pantiles(rng: np.random.Generator, colour: Colour) -> Image:
    """Clay pantiles: rounded columns 0.22 m wide, 0.33 m showing, 2.2 x 2.31 m; repeats."""
    shape = _canvas(2.2, 2.31, PX_PER_M)
    x, y = _coordinates(shape, PX_PER_M)
    row, column = np.floor(y / 0.33).astype(np.int32), np.floor(x / 0.22).astype(np.int32)
    round_ = 0.5 + 0.5 * np.cos(2 * np.pi * (x / 0.22 - 0.35))
    within = y / 0.33 - np.floor(y / 0.33)
    shade = 0.72 + 0.36 * round_ + 0.09 * _cell_values(rng, row, column)
    shade -= 0.25 * np.clip(1.0 - within / 0.18, 0.0, 1.0)
    shade += 0.03 * grain(rng, shape)
    return _finish(_tint(shade.astype(np.float32), colour))


def paving(rng: np.random.Generator) -> Image:
    """Pavement slabs of 0.6 m, 2.4 x 2.4 m; repeats."""
    value, joint = courses(rng, (2.4, 2.4), (0.6, 0.6), 0.012, PX_PER_M)
    shade = 1.0 + 0.035 * value + 0.06 * fractal_noise(rng, value.shape, 0.5 * PX_PER_M)
    shade += 0.03 * grain(rng, value.shape)
    return _finish(_tint(shade * (1.0 - 0.3 * joint), (0.56, 0.55, 0.53)))


def asphalt(rng: np.random.Generator) -> Image:
    """Road surface, 4 x 4 m; repeats."""
    shape = _canvas(4.0, 4.0, PX_PER_M)
    shade = 1.0 + 0.08 * fractal_noise(rng, shape, 1.0 * PX_PER_M) + 0.07 * grain(rng, shape)
    return _finish(_tint(shade, (0.31, 0.31, 0.315)))


def plain(rng: np.random.Generator, colour: Colour, roughness: float = 0.02) -> Image:
    """An even coat of one colour with a little mottling, 1 x 1 m; repeats."""
    shape = (64, 64)
    shade = 1.0 + roughness * (fractal_noise(rng, shape, 24.0) + 0.5 * grain(rng, shape))
    return _finish(_tint(shade, colour))


def foliage(rng: np.random.Generator) -> Image:
    """Leaves, 1 x 1 m; repeats."""
    shape = (72, 72)
    light = np.clip(0.55 + 0.9 * value_noise(rng, shape, (4.0, 4.0)), 0.1, 1.3)
    image = _tint(light.astype(np.float32), (0.30, 0.40, 0.16))
    return _finish(np.asarray(cv2.GaussianBlur(image, (0, 0), 0.6), np.float32))
