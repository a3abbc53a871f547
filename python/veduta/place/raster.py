"""A raster on the ground: heights of cells, a picture from above, or both, as a mesh of a place.

An orthophoto, a surface model or a scanned map lies so in a place beside buildings, and every
format that has meshes and textures holds it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.place.material import Material, Texture
from veduta.place.mesh import Mesh
from veduta.place.semantics import Provenance, SemanticClass

BARE = (0.66, 0.64, 0.58)
"""Heights without a picture (sRGB)."""


@dataclass(frozen=True, eq=False)
class Raster:
    """size_m: its width and height. heights_m: (h, w) float32 in equal cells, rows from the north,
    NaN where nothing is known; None: level at zero. picture: (H, W, 3) uint8 sRGB over the same
    extent, whatever its own cells are.

    Local frame: x east, y north, z up; its south-western corner is (0, 0).
    """

    id: str
    size_m: tuple[float, float]
    heights_m: NDArray[np.float32] | None = None
    picture: NDArray[np.uint8] | None = None

    def mesh(self) -> Mesh:
        """A vertex at the middle of each cell, two triangles between four that are known; without
        heights two triangles over its extent.

        ValueError where there are no such four.
        """
        share, heights = self._vertices()
        width, height = self.size_m
        x, y = share[..., 0] * width, (1.0 - share[..., 1]) * height
        points = np.stack([x, y, heights], axis=-1).reshape(-1, 3)
        triangles = _between(heights.shape[0], heights.shape[1])
        triangles = triangles[np.isfinite(points[:, 2])[triangles].all(axis=1)]
        if not len(triangles):
            raise ValueError(f"raster {self.id!r} has no four cells with heights beside each other")
        used, numbers = np.unique(triangles, return_inverse=True)
        material = Material("ground", BARE)
        if self.picture is not None:
            mask = np.zeros(self.picture.shape[:2], dtype=np.bool_)
            material = Material("ground", texture=Texture(self.picture, mask))
        return Mesh.simple(
            self.id, points[used], numbers.reshape(-1, 3), SemanticClass.GROUND,
            Provenance.MEASURED, name=self.id, uv=share.reshape(-1, 2)[used],
            material=material,
        )  # fmt: skip

    def _vertices(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """(h, w, 2) the share of the extent from the north-west, and (h, w) heights (m)."""
        if self.heights_m is None:
            row, column = np.mgrid[:2, :2]
            return np.stack([column, row], axis=-1).astype(np.float64), np.zeros((2, 2))
        rows, columns = self.heights_m.shape
        row, column = np.mgrid[:rows, :columns]
        share = np.stack([(column + 0.5) / columns, (row + 0.5) / rows], axis=-1)
        return share, self.heights_m.astype(np.float64)


def _between(rows: int, columns: int) -> NDArray[np.int64]:
    """Two triangles between any four vertices of a grid, counter-clockwise seen from above."""
    number = np.arange(rows * columns).reshape(rows, columns)
    north_west, north_east = number[:-1, :-1].ravel(), number[:-1, 1:].ravel()
    south_west, south_east = number[1:, :-1].ravel(), number[1:, 1:].ravel()
    lower = np.stack([south_west, south_east, north_east], axis=1)
    upper = np.stack([south_west, north_east, north_west], axis=1)
    return np.concatenate([lower, upper])
