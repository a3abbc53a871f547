"""Edges of photos that may be vertical in the scene: each gives a direction that up is square to.

In all photos together they are the vertical vanishing points, without a need to find each.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from veduta.imaging.segments import Segments
from veduta.photos.structure import Structure

SegmentsOf = Callable[[int], Segments]
"""The edges of a photo, by its row in the structure."""

MOST_PHOTOS = 16
"""Photos whose edges are looked at; of more, as many are taken evenly."""
STEEPEST_RAD = np.deg2rad(10.0)
"""How far an edge may seem to lean, by the first up."""


def looked_at(structure: Structure) -> list[int]:
    """The photos, by row, whose edges are looked at."""
    count = len(structure.names)
    rows = np.unique(np.linspace(0, count - 1, min(count, MOST_PHOTOS)).round().astype(int))
    found: list[int] = rows.tolist()
    return found


def edge_normals(
    structure: Structure, up: NDArray[np.float64], segments_of: SegmentsOf
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """(n, 3) normals of the planes through a camera and an edge that nearly holds up, and weights.

    A weight is the angle that an edge spans, as far as that makes its direction surer.
    """
    normals, weights = [np.zeros((0, 3))], [np.zeros(0)]
    for row in looked_at(structure):
        segments = segments_of(row)
        first, last = (rays_of(structure, row, end) for end in (segments.start, segments.end))
        normal = np.cross(first, last)
        angle = np.linalg.norm(normal, axis=1)
        sure = np.isfinite(angle) & (angle > 1e-6)
        normal = normal[sure] / angle[sure, None]
        own = np.abs(normal @ up) < np.sin(STEEPEST_RAD)
        normals.append(normal[own])
        weights.append(np.minimum(angle[sure][own], 0.1))
    return np.concatenate(normals), np.concatenate(weights)


def rays_of(structure: Structure, row: int, places: NDArray[np.float64]) -> NDArray[np.float64]:
    """(n, 3) unit directions in the structure's frame of (n, 2) places in a photo."""
    flat = np.asarray(structure.camera(row).cam_from_img(places)).reshape(-1, 2)
    rays = np.column_stack([flat, np.ones(len(flat))])
    rays /= np.linalg.norm(rays, axis=1, keepdims=True)
    found: NDArray[np.float64] = rays @ structure.cam_from_world[row, :, :3]
    return found
