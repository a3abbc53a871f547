"""Fewer triangles under a stated error; what they are, and their place in the atlas, stay."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from veduta.drive.build.surface import Surface
from veduta.surfaces import simplify


@dataclass(frozen=True)
class LighterParameters:
    """around: vertices about a new one that tell where it lies in the depth image. fewest:
    triangles; smaller surfaces stay as they are.
    """

    around: int = 8
    fewest: int = 2000


def lighten(
    surface: Surface, error_m: float, parameters: LighterParameters | None = None
) -> tuple[Surface, float]:
    """Walls and ground by quadrics, each by itself, and the error that was reached (m).

    error_m: 95 % of the vertices lie nearer to the new surface; 0 leaves all.
    """
    chosen = parameters or LighterParameters()
    if error_m <= 0.0 or len(surface.triangles) < chosen.fewest:
        return surface, 0.0
    there = [wall for wall in (True, False) if (surface.wall == wall).any()]
    parts = [_part(surface, wall, error_m, chosen) for wall in there]
    shift = np.cumsum([0, *(len(part.vertices) for part, _ in parts)])
    joined = Surface(
        np.concatenate([part.vertices for part, _ in parts]),
        np.concatenate([part.pixel for part, _ in parts]),
        np.concatenate([part.triangles + first for (part, _), first in zip(parts, shift, strict=False)]),
        np.concatenate([part.source for part, _ in parts]),
        np.concatenate([part.wall for part, _ in parts]),
    )
    return joined, max(error for _, error in parts)


def _part(
    surface: Surface, wall: bool, error_m: float, chosen: LighterParameters
) -> tuple[Surface, float]:
    own = surface.wall == wall
    used, triangles = np.unique(surface.triangles[own], return_inverse=True)
    triangles = triangles.reshape(-1, 3)
    vertices, pixel = surface.vertices[used], surface.pixel[used]
    source = surface.source[own]
    if len(triangles) < chosen.fewest:
        return replace(
            surface, vertices=vertices, pixel=pixel, triangles=triangles, source=source,
            wall=np.full(len(triangles), wall),
        ), 0.0  # fmt: skip
    found = simplify(vertices, triangles, error_m=error_m)
    middles = vertices[triangles].mean(axis=1)
    faces = found.triangles.astype(np.int64)
    nearest = cKDTree(middles).query(found.positions[faces].mean(axis=1))[1]
    new = Surface(
        found.positions,
        _pixels(vertices, pixel, found.positions, chosen.around),
        faces,
        source[nearest],
        np.full(len(faces), wall),
    )
    return new, found.error_m


def _pixels(
    vertices: NDArray[np.float64],
    pixel: NDArray[np.float64],
    places: NDArray[np.float64],
    count: int,
) -> NDArray[np.float64]:
    """(n, 2) rows and columns of new vertices: the affine map of those around each, by least
    squares."""
    around = np.asarray(cKDTree(vertices).query(places, k=count)[1])
    middle, centre = vertices[around].mean(axis=1), pixel[around].mean(axis=1)
    offsets = vertices[around] - middle[:, None]
    steps = pixel[around] - centre[:, None]
    maps = np.linalg.pinv(offsets, rcond=1e-2) @ steps
    moved = np.einsum("ni,nij->nj", places - middle, maps)
    low, high = pixel[around].min(axis=1) - 1.0, pixel[around].max(axis=1) + 1.0
    return np.asarray(np.clip(centre + moved, low, high), dtype=np.float64)
