"""Eaves hang lower than the walls' top: what of a roof would lie in the rooms is cut out."""

from __future__ import annotations

from collections.abc import Sequence

import manifold3d
import numpy as np
from numpy.typing import NDArray
from shapely.geometry.base import BaseGeometry

from veduta import _core
from veduta.place.part import PLANE_TOLERANCE_M
from veduta.plan.house.walls import extruded, flat_faces, shell_of

Rings = list[NDArray[np.float64]]
_DEEP_M = 100.0
UNDER_M = 0.015
"""So far the roof lies over the eaves where walls end: nearer, their tops would show through."""
_LEFT_M = UNDER_M - 0.001
"""A roof is so thick where it passes over the walls' outer faces: it hangs together there."""


def clear_of(faces: Sequence[Rings], region: BaseGeometry) -> list[Rings] | None:
    """The faces of a closed roof without what lies below the walls' top, 0, within a region.

    None where they close no solid that could be cut.
    """
    solid = solid_of_faces(faces)
    if solid is None:
        return None
    cut = solid - extruded(region, -_DEEP_M, -_LEFT_M)
    return [rings for _, rings in flat_faces(shell_of(cut))]


def faces_within(faces: Sequence[Rings], region: BaseGeometry) -> list[Rings] | None:
    """The faces of what of a closed roof is over a region; None where they close no solid."""
    solid = solid_of_faces(faces)
    if solid is None:
        return None
    return [rings for _, rings in flat_faces(shell_of(solid ^ extruded(region, -_DEEP_M, _DEEP_M)))]


def solid_of_faces(faces: Sequence[Rings]) -> manifold3d.Manifold | None:
    """The solid that faces close, corners equal to the last bit; None where they close none."""
    rings = [ring for face in faces for ring in face]
    corners = np.concatenate(rings)
    try:
        indices, *_ = _core.triangulate_polygons(
            corners,
            np.cumsum([0, *(len(ring) for ring in rings)]).astype(np.int64),
            np.cumsum([0, *(len(face) for face in faces)]).astype(np.int64),
            PLANE_TOLERANCE_M,
        )
    except _core.PolygonFault:
        return None
    points, number = np.unique(corners, axis=0, return_inverse=True)
    triangles = number.reshape(-1)[indices].astype(np.uint64)
    solid = manifold3d.Manifold(manifold3d.Mesh64(points, triangles))
    return None if solid.status() != manifold3d.Error.NoError else solid
