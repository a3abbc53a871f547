"""Meshes that stand in a part many times, each written once.

A shared mesh has a frame of its own (metres, right-handed, z up). Where it stands, and of which
feature it is there, are columns: there is no object per instance.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class SharedMesh:
    """Triangles that several places share.

    positions_m, normals: (v, 3) float32. indices: (m, 3) uint32, counter-clockwise seen from
    outside. slot: (m,) int32, which of `slots` a triangle is of; what a slot looks like is said
    where the mesh stands. uv: (v, 2) float32, glTF's; None where no slot ever has a texture.
    """

    name: str
    positions_m: NDArray[np.float32]
    normals: NDArray[np.float32]
    indices: NDArray[np.uint32]
    slot: NDArray[np.int32]
    slots: tuple[str, ...]
    uv: NDArray[np.float32] | None = None


@dataclass(frozen=True)
class InstanceGroup:
    """One mesh in one look, wherever it stands.

    mesh: its place in `Instances.meshes`. materials: of each slot, a place in `Part.materials`.
    part_from_mesh: (n, 3, 4) float64, a turn with a stretch along the mesh's own axes, and a move.
    feature: (n,) int32, row in the part's feature table.
    """

    mesh: int
    materials: tuple[int, ...]
    part_from_mesh: NDArray[np.float64]
    feature: NDArray[np.int32]


@dataclass(frozen=True)
class Instances:
    """All instances of a part."""

    meshes: tuple[SharedMesh, ...]
    groups: tuple[InstanceGroup, ...]

    def __len__(self) -> int:
        return sum(len(group.feature) for group in self.groups)

    @property
    def triangle_count(self) -> int:
        """Triangles that are seen, each instance counted."""
        return sum(
            len(group.feature) * len(self.meshes[group.mesh].indices) for group in self.groups
        )

    def bounds_m(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Lower and upper corner of the box around the boxes of all instances."""
        corners = [
            placed(group.part_from_mesh, _box(self.meshes[group.mesh])).reshape(-1, 3)
            for group in self.groups
        ]
        every = np.concatenate(corners)
        return every.min(axis=0).round(6), every.max(axis=0).round(6)

    def feature_area_m2(self, features: int) -> NDArray[np.float64]:
        """(features,) the summed area of the triangles of each feature."""
        area = np.zeros(features)
        for group in self.groups:
            mesh = self.meshes[group.mesh]
            corners = mesh.positions_m.astype(np.float64)[mesh.indices]
            sides = corners[:, 1:] - corners[:, :1]
            turned = np.einsum("nij,mkj->nmki", group.part_from_mesh[:, :, :3], sides)
            crossed = np.cross(turned[:, :, 0], turned[:, :, 1])
            np.add.at(area, group.feature, np.linalg.norm(crossed, axis=2).sum(axis=1) / 2)
        return area


def placed(part_from_mesh: NDArray[np.float64], points: NDArray[np.float64]) -> NDArray[np.float64]:
    """(n, v, 3) the (v, 3) points in each of (n, 3, 4) places."""
    moved: NDArray[np.float64] = np.einsum("nij,vj->nvi", part_from_mesh[:, :, :3], points)
    return moved + part_from_mesh[:, None, :, 3]


def turn_and_stretch(
    part_from_mesh: NDArray[np.float64],
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """(n, 3, 3) turns and (n, 3) stretches along the mesh's axes, whose product the places are."""
    stretch = np.linalg.norm(part_from_mesh[:, :, :3], axis=1)
    return part_from_mesh[:, :, :3] / stretch[:, None, :], stretch


def _box(mesh: SharedMesh) -> NDArray[np.float64]:
    ends = np.stack([mesh.positions_m.min(axis=0), mesh.positions_m.max(axis=0)]).astype(float)
    grid = np.meshgrid(*ends.T, indexing="ij")
    return np.stack([axis.reshape(-1) for axis in grid], axis=1)
