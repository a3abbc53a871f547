"""The mesh of a morphable model: nodes on the picture's grid, with breaks at the edges of depth."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.walk.build.morph import Morph, node_destinations

WATER, GRASS, MOVING = 1, 2, 4
"""Bits of a vertex's marks."""


@dataclass(frozen=True)
class MeshSettings:
    """step_px: between nodes. tear: difference of the depths of two neighbours, as a share of the
    nearer, from which the surface between them is none. slack: what is allowed for a slanted one, in
    shares of its own slope.
    """

    step_px: int = 4
    tear: float = 0.06


@dataclass(frozen=True, eq=False)
class MorphMesh:
    """Vertices of a model as it is (m = 0) and as it becomes (m = 1).

    points: (v, 3) float32 in the first camera's frame. destinations: (v, 3) float32 in the second
    camera's. uv, uv_second: (v, 2) of the two pictures, origin upper left. psi: (v,). triangles:
    (t, 3) uint32, clockwise on the screen. torn: (t,) whether a triangle spans a break in depth:
    what it shows was never seen. round: whether the first picture is on a cylinder. marks: (v,)
    uint8 of `WATER`, `GRASS`, `MOVING`; None: nothing is marked.
    """

    points: NDArray[np.float32]
    destinations: NDArray[np.float32]
    uv: NDArray[np.float32]
    uv_second: NDArray[np.float32]
    psi: NDArray[np.float32]
    triangles: NDArray[np.uint32]
    torn: NDArray[np.bool_]
    round: bool = False
    marks: NDArray[np.uint8] | None = None

    def marked(self, mark: int) -> NDArray[np.bool_]:
        """(t,) the triangles of which a corner has the mark."""
        if self.marks is None:
            return np.zeros(len(self.triangles), dtype=np.bool_)
        return np.asarray((self.marks[self.triangles] & mark).any(axis=1))

    @property
    def depth_m(self) -> NDArray[np.float32]:
        """(v,) of the points before the first camera, or from the axis of its cylinder."""
        if self.round:
            return np.hypot(self.points[:, 0], self.points[:, 2])
        return self.points[:, 2]


def mesh_of(morph: Morph, settings: MeshSettings = MeshSettings()) -> MorphMesh:
    """Section 3.5: the grid's triangles, with psi on the vertices."""
    model = morph.first
    rows, columns = (_nodes(size, settings.step_px) for size in model.depth_m.shape)
    at = np.ix_(rows, columns)
    depth = model.depth_m[at].astype(np.float64)
    right, down = breaks(depth, settings)
    firm_right, firm_down = np.where(right, 0.002, 1.0), np.where(down, 0.002, 1.0)
    destinations = node_destinations(morph, rows, columns, firm_right, firm_down)
    triangles, torn = _triangles(depth, settings)
    size = np.array([model.screen.width_px, model.screen.height_px])
    size_second = np.array([morph.second.screen.width_px, morph.second.screen.height_px])
    pixels = model.screen.pixels[at].astype(np.float64)
    # The outermost nodes stand on the border of the picture and not half a pixel inside.
    seen = morph.second.screen.project(destinations)[0]
    target = np.where(morph.region[at][..., None], morph.target[at], np.nan_to_num(seen, nan=-1e3))
    return MorphMesh(
        model.points[at].reshape(-1, 3).astype(np.float32),
        destinations.reshape(-1, 3).astype(np.float32),
        (pixels / size).reshape(-1, 2).astype(np.float32),
        (np.clip(target, -4096, 8192) / size_second).reshape(-1, 2).astype(np.float32),
        morph.psi[at].reshape(-1).astype(np.float32),
        triangles, torn, model.screen.round, _marks(morph)[at].reshape(-1),
    )  # fmt: skip


def _marks(morph: Morph) -> NDArray[np.uint8]:
    """(h, w) of the first view."""
    seen = morph.first.marks
    shown = ((seen.water, WATER), (seen.grass, GRASS), (morph.moving, MOVING))
    return np.asarray(sum(mask.astype(np.uint8) * bit for mask, bit in shown), dtype=np.uint8)


def _nodes(size: int, step: int) -> NDArray[np.int64]:
    """Pixels from the first to the last, `step` apart but at the end."""
    nodes = np.arange(0, size - 1, step)
    return np.append(nodes, size - 1)


def breaks(
    depth: NDArray[np.float64], settings: MeshSettings
) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
    """Whether the surface breaks towards the node on the right, and below.

    A slanted plane has evenly changing inverse depth: what differs from the neighbours' slope tears.
    """
    breaks = []
    for axis in (1, 0):
        inverse = 1.0 / depth
        slope = np.diff(inverse, axis=axis)
        before = np.roll(slope, 1, axis=axis)
        after = np.roll(slope, -1, axis=axis)
        even = np.minimum(np.abs(slope - before), np.abs(slope - after))
        low = np.minimum(np.take(depth, range(depth.shape[axis] - 1), axis), np.take(depth, range(1, depth.shape[axis]), axis))
        torn = (np.abs(slope) * low > settings.tear) & (even * low > 0.5 * settings.tear)
        breaks.append(np.concatenate([torn, np.zeros_like(np.take(depth, [0], axis), dtype=bool)], axis=axis))
    return breaks[0], breaks[1]


def _triangles(
    depth: NDArray[np.float64], settings: MeshSettings
) -> tuple[NDArray[np.uint32], NDArray[np.bool_]]:
    """Two for each cell, split along the diagonal on which depth changes less."""
    right, down = breaks(depth, settings)
    number = np.arange(depth.size).reshape(depth.shape)
    a, b, c, d = number[:-1, :-1], number[:-1, 1:], number[1:, 1:], number[1:, :-1]
    inverse = 1.0 / depth
    along = np.abs(inverse[:-1, :-1] - inverse[1:, 1:]) <= np.abs(inverse[:-1, 1:] - inverse[1:, :-1])
    first = np.where(along[..., None], np.stack([a, b, c], -1), np.stack([a, b, d], -1))
    second = np.where(along[..., None], np.stack([a, c, d], -1), np.stack([b, c, d], -1))
    top, bottom, left, other = right[:-1, :-1], right[1:, :-1], down[:-1, :-1], down[:-1, 1:]
    torn_first = top | np.where(along, other, left)
    torn_second = bottom | np.where(along, left, other)
    triangles = np.concatenate([first.reshape(-1, 3), second.reshape(-1, 3)])
    return triangles.astype(np.uint32), np.concatenate([torn_first.ravel(), torn_second.ravel()])
