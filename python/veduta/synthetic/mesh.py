"""Building a textured mesh out of rectangles and boxes, in the part's local frame.

Part frame (metres): x right along the wall, y into the building (the street is at y < 0), z up.
A face's vertices run counter-clockwise seen from outside. Texture coordinates are those of
glTF: u right, v down, (0, 0) at the upper left corner of the texture; outside 0..1 it repeats.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

Vector = tuple[float, float, float]
UvBox = tuple[float, float, float, float]
SMALLEST_M = 1e-4


@dataclass(frozen=True)
class Mesh:
    """Plane faces as columns; the vertices of face i are those from `start[i]` to `start[i + 1]`.

    `positions` (n, 3), `uv` (n, 2), `start` (m + 1,), `material` and `feature` (m,).
    """

    positions: NDArray[np.float64]
    uv: NDArray[np.float64]
    start: NDArray[np.int64]
    material: NDArray[np.int32]
    feature: NDArray[np.int32]


@dataclass
class MeshBuilder:
    """Collects quads; `tile_m` says how many metres one repeat of a material covers."""

    tile_m: dict[str, tuple[float, float]]
    materials: list[str] = field(default_factory=list)
    _corners: list[NDArray[np.float64]] = field(default_factory=list)
    _uv: list[NDArray[np.float64]] = field(default_factory=list)
    _material: list[int] = field(default_factory=list)
    _feature: list[int] = field(default_factory=list)

    def quad(
        self,
        origin: Vector,
        u: Vector,
        v: Vector,
        material: str,
        feature: int,
        uv: UvBox | None = None,
    ) -> None:
        """The parallelogram from `origin` along `u` and `v`; its outside is that of u x v.

        `uv` is (left, top, right, bottom); without it the material's tile repeats in metres.
        """
        o, a, b = (np.asarray(each, np.float64) for each in (origin, u, v))
        self.face([o, o + a, o + a + b, o + b], material, feature, uv)

    def face(
        self,
        corners: list[NDArray[np.float64]],
        material: str,
        feature: int,
        uv: UvBox | None = None,
    ) -> None:
        """A plane face; its first edge is the lower one. `uv` is for four corners only."""
        ring = np.stack(corners)
        if uv is None:
            coordinates = _tiled(ring, self.tile_m.get(material, (1.0, 1.0)))
        else:
            left, top, right, bottom = uv
            coordinates = np.array([[left, bottom], [right, bottom], [right, top], [left, top]])
        self._corners.append(ring)
        self._uv.append(coordinates)
        self._material.append(self._material_index(material))
        self._feature.append(feature)

    def box(
        self, low: Vector, high: Vector, material: str, feature: int, faces: str = "fblrtd"
    ) -> None:
        """An upright box; `faces` of front, back, left, right, top and down (underside)."""
        (x0, y0, z0), (x1, y1, z1) = low, high
        w, d, h = x1 - x0, y1 - y0, z1 - z0
        sides: dict[str, tuple[Vector, Vector, Vector]] = {
            "f": ((x0, y0, z0), (w, 0, 0), (0, 0, h)),
            "b": ((x1, y1, z0), (-w, 0, 0), (0, 0, h)),
            "l": ((x0, y1, z0), (0, -d, 0), (0, 0, h)),
            "r": ((x1, y0, z0), (0, d, 0), (0, 0, h)),
            "t": ((x0, y0, z1), (w, 0, 0), (0, d, 0)),
            "d": ((x0, y1, z0), (w, 0, 0), (0, -d, 0)),
        }
        for name in faces:
            self.quad(*sides[name], material, feature)

    def mesh(self) -> Mesh:
        """All faces as columns, no vertex shared."""
        empty = not self._corners
        sizes = [len(ring) for ring in self._corners]
        return Mesh(
            positions=np.zeros((0, 3)) if empty else np.concatenate(self._corners),
            uv=np.zeros((0, 2)) if empty else np.concatenate(self._uv),
            start=np.concatenate([[0], np.cumsum(sizes, dtype=np.int64)]).astype(np.int64),
            material=np.asarray(self._material, np.int32),
            feature=np.asarray(self._feature, np.int32),
        )

    def _material_index(self, name: str) -> int:
        if name not in self.materials:
            self.materials.append(name)
        return self.materials.index(name)


def _tiled(ring: NDArray[np.float64], tile_m: tuple[float, float]) -> NDArray[np.float64]:
    """Texture coordinates in metres along the first edge and across it, over the tile's size."""
    axis = ring[1] - ring[0]
    axis = axis / float(np.linalg.norm(axis))
    side = ring[-1] - ring[0]
    side = side - axis * float(side @ axis)
    side = side / float(np.linalg.norm(side))
    metres = np.stack([ring @ axis, ring @ side], axis=1)
    return np.asarray(metres / np.array(tile_m) * np.array([1.0, -1.0]), np.float64)


def wall_cells(
    outer: tuple[float, float, float, float], holes: list[tuple[float, float, float, float]]
) -> list[tuple[float, float, float, float]]:
    """Rectangles (x0, z0, x1, z1) that cover `outer` except `holes`, without overlap.

    Bands between the heights at which a hole begins or ends; in each, the gaps between holes.
    """
    x0, z0, x1, z1 = outer
    levels = {z0, z1}
    for hole in holes:
        levels |= {min(max(hole[1], z0), z1), min(max(hole[3], z0), z1)}
    ordered = sorted(levels)
    cells = []
    for low, high in pairwise(ordered):
        if high - low < SMALLEST_M:
            continue
        middle = (low + high) / 2
        at = x0
        for hole in sorted(h for h in holes if h[1] < middle < h[3]):
            if hole[0] - at >= SMALLEST_M:
                cells.append((at, low, min(hole[0], x1), high))
            at = max(at, hole[2])
        if x1 - at >= SMALLEST_M:
            cells.append((at, low, x1, high))
    return cells
