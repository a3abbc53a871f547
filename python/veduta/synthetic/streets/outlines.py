"""Outlines of houses and roads on the ground: convex, counter-clockwise, metres."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

Outline = NDArray[np.float64]


def rectangle(
    corner_m: NDArray[np.float64], along: NDArray[np.float64], width_m: float, depth_m: float
) -> Outline:
    """(4, 2) from a corner along a unit vector, and to its left."""
    inwards = np.array([-along[1], along[0]])
    steps = np.array([[0.0, 0.0], [width_m, 0.0], [width_m, depth_m], [0.0, depth_m]])
    return np.asarray(corner_m + steps @ np.stack([along, inwards]), np.float64)


def road(start_m: NDArray[np.float64], end_m: NDArray[np.float64], width_m: float) -> Outline:
    """(4, 2) what is kept free about a straight piece of street, but for a few centimetres."""
    way = (end_m - start_m) / np.linalg.norm(end_m - start_m)
    aside = width_m / 2 - 0.05
    corner = start_m + aside * np.array([way[1], -way[0]])
    return rectangle(corner, way, float(np.linalg.norm(end_m - start_m)), 2 * aside)


def overlap(first: Outline, second: Outline, least_m: float = 0.02) -> bool:
    """Whether two convex outlines share more than a sliver: no edge's normal parts them."""
    for outline in (first, second):
        edges = np.roll(outline, -1, axis=0) - outline
        normals = np.stack([edges[:, 1], -edges[:, 0]], axis=1)
        normals /= np.linalg.norm(normals, axis=1, keepdims=True)
        ours, theirs = first @ normals.T, second @ normals.T
        gap = np.maximum(ours.min(0) - theirs.max(0), theirs.min(0) - ours.max(0))
        if float(gap.max()) > -least_m:
            return False
    return True


def any_overlap(outlines: Sequence[Outline]) -> bool:
    """Whether any two of the convex outlines do."""
    return any(overlap(a, b) for k, a in enumerate(outlines) for b in outlines[k + 1 :])
