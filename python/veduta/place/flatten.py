"""Instances to plain polygons, for formats and code that know no instances."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from veduta.place.instances import InstanceGroup, Instances, placed
from veduta.place.part import Part

MOST_TRIANGLES = 20_000_000
"""More than this are refused: they would not fit into memory."""


class TooManyTrianglesError(ValueError):
    """The instances of a part are too many to be written out one by one."""


def flattened(part: Part) -> Part:
    """The same part with each triangle of each instance as a polygon of its own.

    Raises TooManyTrianglesError where they are more than `MOST_TRIANGLES`.
    """
    instances = part.instances
    if instances is None:
        return part
    if instances.triangle_count > MOST_TRIANGLES:
        raise TooManyTrianglesError(
            f"{part.id}: {instances.triangle_count} triangles of repeated assets; "
            f"{MOST_TRIANGLES} are the most that can be written one by one"
        )
    groups = [_triangles(instances, group) for group in instances.groups]
    positions = np.concatenate([part.positions_m, *(group[0] for group in groups)])
    added = len(positions) - len(part.positions_m)
    rings = part.ring_offsets[-1] + np.arange(3, added + 1, 3)
    polygons = part.polygon_offsets[-1] + np.arange(1, added // 3 + 1)
    return replace(
        part,
        positions_m=positions,
        uv=np.concatenate([part.uv, *(group[3] for group in groups)]),
        ring_offsets=np.concatenate([part.ring_offsets, rings]),
        polygon_offsets=np.concatenate([part.polygon_offsets, polygons]),
        polygon_feature=np.concatenate([part.polygon_feature, *(group[1] for group in groups)]),
        polygon_material=np.concatenate([part.polygon_material, *(group[2] for group in groups)]),
        instances=None,
    )


def _triangles(
    instances: Instances, group: InstanceGroup
) -> tuple[NDArray[np.float32], NDArray[np.int32], NDArray[np.int32], NDArray[np.float32]]:
    """Corners, feature and material of each triangle, texture coordinates; of a whole group."""
    mesh = instances.meshes[group.mesh]
    points = placed(group.part_from_mesh, mesh.positions_m.astype(np.float64))
    corners = points[:, mesh.indices.reshape(-1)].reshape(-1, 3).astype(np.float32)
    each = len(mesh.indices)
    uv = np.zeros((len(mesh.positions_m), 2), np.float32) if mesh.uv is None else mesh.uv
    material = np.array(group.materials, dtype=np.int32)[mesh.slot]
    count = len(group.feature)
    return (
        corners,
        np.repeat(group.feature, each),
        np.tile(material, count),
        np.tile(uv[mesh.indices.reshape(-1)], (count, 1)),
    )
