"""The ground as a grid of heights, and what stands in the way of an animal on it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import cv2
import numpy as np
from embreex.mesh_construction import TriangleMesh
from embreex.rtcore_scene import EmbreeScene
from numpy.typing import NDArray
from scipy.ndimage import map_coordinates

from veduta.fauna.motion.angles import Floats
from veduta.place.place import Place
from veduta.run.errors import InputError

MOST_CELLS = 1_000_000
_FINEST = 0.2
"""A cell is no smaller than this share of the animal's length."""
_STEP = 0.12
"""What is lower than this share of its length, it walks over."""
_HEADROOM = 0.5
"""What is higher above the ground than this share, it walks under."""
_REMEDY = "Name a place whose ground is marked as such, or that consists of a terrain alone."


@dataclass(frozen=True, eq=False)
class Terrain:
    """heights_m: (rows, columns) float64, NaN where there is no ground; row 0 is the southernmost.
    blocked: what stands in the way there. origin_m: x, y of the middle of the first cell. exact:
    heights of the surface itself at places (n, 2), where there is one: feet are set by that.
    """

    heights_m: Floats
    blocked: NDArray[np.bool_]
    origin_m: tuple[float, float]
    cell_m: float
    exact: Callable[[Floats], Floats] | None = None

    def footing(self, points: Floats) -> Floats:
        """(n,) the ground's height under feet at points (n, 2); NaN beside it."""
        return self.height_at(points) if self.exact is None else self.exact(points)

    def cell_of(self, points: Floats) -> Floats:
        """(n, 2) row and column, fractional, of points (n, 2 or 3) in metres."""
        rows = (points[:, 1] - self.origin_m[1]) / self.cell_m
        columns = (points[:, 0] - self.origin_m[0]) / self.cell_m
        return np.stack([rows, columns], axis=1)

    def point_of(self, cells: Floats) -> Floats:
        """(n, 2) x, y in metres of cells (n, 2), row and column."""
        return np.stack(
            [
                self.origin_m[0] + self.cell_m * cells[:, 1],
                self.origin_m[1] + self.cell_m * cells[:, 0],
            ],
            axis=1,
        )

    def height_at(self, points: Floats) -> Floats:
        """(n,) the ground's height, between the cells linearly; NaN beside the ground."""
        cells = self.cell_of(points)
        return np.asarray(
            map_coordinates(self.heights_m, cells.T, order=1, mode="constant", cval=np.nan),
            dtype=np.float64,
        )


def terrain_of(place: Place, length_m: float) -> Terrain:
    """The terrain of a place for an animal of this length; InputError where it has no ground.

    What is marked as ground is; where nothing is, the place's only part. All else is in the way
    where it is between knee and head of the animal.
    """
    ground, rest = _sorted_triangles(place)
    low, high = ground.reshape(-1, 3).min(axis=0), ground.reshape(-1, 3).max(axis=0)
    size = high - low
    cell = max(_FINEST * length_m, float(np.sqrt(size[0] * size[1] / MOST_CELLS)))
    counts = np.maximum(np.floor(size[:2] / cell).astype(int), 2)
    origin = (float(low[0] + 0.5 * cell), float(low[1] + 0.5 * cell))
    x = origin[0] + cell * np.arange(counts[0])
    y = origin[1] + cell * np.arange(counts[1])
    grid = np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2)
    surface = _Surface(ground, float(high[2]) + 1.0)
    heights = surface.heights(grid).reshape(counts[1], counts[0])
    blocked = np.zeros(heights.shape, dtype=np.bool_)
    empty = Terrain(heights, blocked, origin, cell)
    if len(rest):
        blocked = _in_the_way(rest, empty, grid, length_m)
    return Terrain(heights, blocked | ~np.isfinite(heights), origin, cell, surface.heights)


def terrain_of_heights(heights_m: Floats, cell_m: float, origin_m: tuple[float, float]) -> Terrain:
    """A terrain of a grid alone; NaN: no ground."""
    return Terrain(heights_m, ~np.isfinite(heights_m), origin_m, cell_m)


def _sorted_triangles(place: Place) -> tuple[Floats, Floats]:
    """(m, 3, 3) the corners of the ground's triangles, and of all others that one bumps into."""
    alive = {animal.part for animal in place.animals}
    solid = [
        placed
        for placed in place.parts.values()
        if not placed.standing.backdrop and placed.id not in alive
    ]
    marked = [placed for placed in solid if placed.standing.ground]
    ground = marked or (solid if len(solid) == 1 else [])
    if not ground:
        raise InputError("--place", "has no ground on which an animal could go", _REMEDY)
    corners = []
    for chosen in (ground, [placed for placed in solid if placed not in ground]):
        found = [np.zeros((0, 3, 3))]
        for placed in chosen:
            points, faces = placed.triangles()
            found.append(points[faces.astype(np.int64)])
        corners.append(np.concatenate(found))
    return corners[0], corners[1]


class _Surface:
    """The highest points of triangles (m, 3, 3) over places."""

    def __init__(self, triangles: Floats, top: float) -> None:
        self._scene, self._top = EmbreeScene(), top
        TriangleMesh(self._scene, triangles.astype(np.float32))

    def heights(self, places: Floats) -> Floats:
        """(n,) at places (n, 2); NaN where there is none."""
        origins = np.column_stack([places, np.full(len(places), self._top)]).astype(np.float32)
        down = np.tile(np.array([0.0, 0.0, -1.0], dtype=np.float32), (len(places), 1))
        found = self._scene.run(origins, down, output=1)
        height = self._top - found["tfar"].astype(np.float64)
        return np.where(found["primID"] >= 0, height, np.nan)


def _in_the_way(
    triangles: Floats, terrain: Terrain, grid: Floats, length_m: float
) -> NDArray[np.bool_]:
    """Cells in which something stands between knee and head: seen from the knee upwards, and where
    outlines of upright triangles, which no ray from below meets, cross the cell.
    """
    ground = terrain.heights_m.reshape(-1)
    known = np.isfinite(ground)
    step, room = _STEP * length_m, _HEADROOM * length_m
    scene = EmbreeScene()
    TriangleMesh(scene, triangles.astype(np.float32))
    knee = np.where(known, ground, 0.0) + step
    origins = np.column_stack([grid, knee]).astype(np.float32)
    up = np.tile(np.array([0.0, 0.0, 1.0], dtype=np.float32), (len(grid), 1))
    found = scene.run(origins, up, output=1)
    inside = (found["primID"] >= 0) & (found["tfar"] < room)
    blocked = inside.reshape(terrain.heights_m.shape)
    middle = terrain.height_at(triangles.mean(axis=1)[:, :2])
    base = np.where(np.isfinite(middle), middle, 0.0)
    low, high = triangles[..., 2].min(axis=1), triangles[..., 2].max(axis=1)
    near = (low < base + room) & (high > base + step)
    cells = terrain.cell_of(triangles[near].reshape(-1, 3))[:, ::-1].reshape(-1, 3, 2)
    limit = 4.0 * max(terrain.heights_m.shape)
    outlines = np.clip(np.round(np.clip(cells, -limit, limit) * 16), -(2**30), 2**30)
    canvas = np.zeros(terrain.heights_m.shape, dtype=np.uint8)
    cv2.polylines(canvas, list(outlines.astype(np.int32)), True, 1, 1, cv2.LINE_8, 4)
    return np.asarray(blocked | (canvas > 0))
