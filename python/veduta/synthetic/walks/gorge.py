"""A gorge as triangles: a height field between two walls of rock, and trees beside the path.

World frame: x east, y north (along the path), z up, metres.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.synthetic.noise import fractal_noise

Floats = NDArray[np.float64]
ROCK, LEAF, BARK, WATER, MOVER = 0, 1, 2, 3, 4
_CELL_M = 0.35
_HALF_M = 22.0
_BEFORE_M, _AFTER_M = 8.0, 70.0
_FLOOR_M, _SLOPE_M, _WALL_M = 3.0, 5.0, 16.0


@dataclass(frozen=True, eq=False)
class Gorge:
    """vertices: (v, 3). triangles: (t, 3) int32. kind: (t,) `ROCK` and the others.

    mover_m: (3,) how far what moves has gone.
    """

    vertices: Floats
    triangles: NDArray[np.int32]
    kind: NDArray[np.int32]
    mover_m: Floats | None = None


def make_gorge(length_m: float, seed: int = 0, trees: int = 40) -> Gorge:
    """A gorge around a path from y = 0 to y = length_m."""
    rng = np.random.default_rng(seed)
    field, indices = _rock(rng, length_m)
    pieces = [(field.reshape(-1, 3), indices, np.full(len(indices), ROCK))]
    for _ in range(trees):
        along = rng.uniform(4.0, length_m + 0.6 * _AFTER_M)
        aside = rng.choice([-1.0, 1.0]) * rng.uniform(3.6, 6.5)
        foot = np.array([aside, along, _height_at(field, aside, along)])
        pieces += _tree(rng, foot, rng.uniform(2.5, 5.0))
    starts = np.cumsum([0, *(len(vertices) for vertices, _, _ in pieces)])[:-1]
    moved = [own + start for (_, own, _), start in zip(pieces, starts, strict=True)]
    return Gorge(
        np.concatenate([vertices for vertices, _, _ in pieces]),
        np.concatenate(moved).astype(np.int32),
        np.concatenate([kind for _, _, kind in pieces]).astype(np.int32),
    )


def ground_m(gorge: Gorge, x: float, y: float) -> float:
    """The height of the rock nearest to a place of the path."""
    rock = gorge.vertices[: gorge.triangles[gorge.kind == ROCK].max() + 1]
    nearest = np.argmin((rock[:, 0] - x) ** 2 + (rock[:, 1] - y) ** 2)
    return float(rock[nearest, 2])


def _rock(rng: np.random.Generator, length_m: float) -> tuple[Floats, NDArray[np.int64]]:
    """(rows, columns, 3) of the height field, and its triangles."""
    columns = round(2.0 * _HALF_M / _CELL_M)
    rows = round((length_m + _BEFORE_M + _AFTER_M) / _CELL_M)
    x, y = np.meshgrid(
        np.linspace(-_HALF_M, _HALF_M, columns), np.linspace(-_BEFORE_M, length_m + _AFTER_M, rows)
    )
    bend = 1.2 * np.sin(y / 11.0)
    away = np.clip((np.abs(x - bend) - _FLOOR_M) / _SLOPE_M, 0.0, 1.0)
    rough = fractal_noise(rng, (rows, columns), 24.0, 5).astype(np.float64)
    broad = fractal_noise(rng, (rows, columns), 60.0, 2).astype(np.float64)
    wall = away * away * (3.0 - 2.0 * away)
    z = wall * (_WALL_M + 5.0 * broad) + rough * (0.12 + 2.4 * wall)
    x = x + 0.9 * wall * fractal_noise(rng, (rows, columns), 12.0, 3)
    field = np.stack([x, y, z], axis=-1)
    number = np.arange(rows * columns).reshape(rows, columns)
    a, b, c, d = number[:-1, :-1], number[:-1, 1:], number[1:, 1:], number[1:, :-1]
    cells = [np.stack([a, b, c], axis=-1), np.stack([a, c, d], axis=-1)]
    return field, np.concatenate([cell.reshape(-1, 3) for cell in cells])


def _height_at(field: Floats, x: float, y: float) -> float:
    apart = (field[..., 0] - x) ** 2 + (field[..., 1] - y) ** 2
    return float(field[..., 2].reshape(-1)[apart.argmin()])


def _tree(
    rng: np.random.Generator, foot: Floats, height_m: float
) -> list[tuple[Floats, NDArray[np.int64], NDArray[np.int64]]]:
    """A trunk, and a few balls of leaves with dents."""
    parts = []
    trunk, faces = dented_ball(rng, 6, 8, 0.0)
    trunk = trunk * np.array([0.12, 0.12, 0.5 * height_m]) + np.array([0.0, 0.0, 0.45 * height_m])
    parts.append((trunk + foot, faces, np.full(len(faces), BARK)))
    for _ in range(4):
        ball, faces = dented_ball(rng, 14, 18, 0.25)
        radius = rng.uniform(0.18, 0.3) * height_m
        middle = rng.normal(scale=[0.15, 0.15, 0.1]) * height_m + [0.0, 0.0, 0.75 * height_m]
        parts.append((ball * radius + middle + foot, faces, np.full(len(faces), LEAF)))
    return parts


def dented_ball(
    rng: np.random.Generator, rings: int, sides: int, dents: float
) -> tuple[Floats, NDArray[np.int64]]:
    """A ball of radius 1 about the origin, its vertices moved in and out."""
    polar, turn = np.meshgrid(
        np.linspace(0.0, np.pi, rings), np.linspace(0.0, 2.0 * np.pi, sides)[:-1]
    )
    radius = 1.0 + dents * rng.uniform(-1.0, 1.0, polar.shape)
    points = radius[..., None] * np.stack(
        [np.sin(polar) * np.cos(turn), np.sin(polar) * np.sin(turn), np.cos(polar)], axis=-1
    )
    number = np.arange(points[..., 0].size).reshape(polar.shape)
    following = np.roll(number, -1, axis=0)
    a, b, c, d = number[:, :-1], number[:, 1:], following[:, 1:], following[:, :-1]
    cells = [np.stack([a, b, c], axis=-1), np.stack([a, c, d], axis=-1)]
    return points.reshape(-1, 3), np.concatenate([cell.reshape(-1, 3) for cell in cells])
