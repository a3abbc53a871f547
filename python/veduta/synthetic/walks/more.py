"""What a gorge may have besides rock and trees: still water, and a thing that moves."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from veduta.synthetic.walks.gorge import MOVER, WATER, Gorge, dented_ball

Floats = NDArray[np.float64]


def with_pool(gorge: Gorge, from_m: float, to_m: float, level_m: float) -> Gorge:
    """Level water from one y to another, from wall to wall; rock that is higher shows."""
    half = 9.0
    corners = np.array(
        [[-half, from_m], [half, from_m], [half, to_m], [-half, to_m]], dtype=np.float64
    )
    vertices = np.column_stack([corners, np.full(4, level_m)])
    return _with(gorge, vertices, np.array([[0, 1, 2], [0, 2, 3]]), WATER)


def with_mover(gorge: Gorge, place: Floats, radius_m: float, home: Floats) -> Gorge:
    """A boulder at a place (3,); its grain goes along with it, as it was at `home` (3,)."""
    ball, faces = dented_ball(np.random.default_rng(77), 16, 20, 0.12)
    moved = _with(gorge, ball * radius_m + place, faces, MOVER)
    return replace(moved, mover_m=np.asarray(place - home, dtype=np.float64))


def _with(gorge: Gorge, vertices: Floats, faces: NDArray[np.integer], kind: int) -> Gorge:
    start = len(gorge.vertices)
    return replace(
        gorge,
        vertices=np.concatenate([gorge.vertices, vertices]),
        triangles=np.concatenate([gorge.triangles, faces + start]).astype(np.int32),
        kind=np.concatenate([gorge.kind, np.full(len(faces), kind)]).astype(np.int32),
    )
