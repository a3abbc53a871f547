"""One smooth skin around the parts of an animal with limbs, and how its vertices follow the bones."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.fauna.build.limbed_skeleton import Bones
from veduta.fauna.motion.figure import Floats
from veduta.surfaces import simplify, surface_nets, vertex_normals


@dataclass(frozen=True)
class BodyLooks:
    """How the skin is made; in shares of the animal's length."""

    cell: float = 0.011
    blend: float = 0.012
    """Parts grow together over so much."""
    follow: float = 0.022
    """So near to a second bone a vertex follows both."""
    most_triangles: int = 14_000


@dataclass(frozen=True, eq=False)
class Hull:
    """positions (v, 3) m, triangles (m, 3), normals (v, 3); joints (v, 4) bones, weights (v, 4)."""

    positions: Floats
    triangles: NDArray[np.uint32]
    normals: Floats
    joints: NDArray[np.uint16]
    weights: NDArray[np.float32]


def hull_of(bones: Bones, looks: BodyLooks) -> Hull:
    """The surface around all bones at rest."""
    length = bones.length_m
    margin = float(bones.deep_m.max()) + 3.0 * looks.cell * length
    low = np.minimum(bones.start_m, bones.end_m).min(axis=0) - margin
    high = np.maximum(bones.start_m, bones.end_m).max(axis=0) + margin
    cell = looks.cell * length
    counts = np.ceil((high - low) / cell).astype(int) + 1
    axes = [low[k] + cell * np.arange(counts[k]) for k in range(3)]
    grid = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1)
    values = _together(bones, grid.reshape(-1, 3), looks.blend * length).reshape(counts)
    positions, triangles = surface_nets(values, 0.0, low, cell)
    fewer = simplify(positions, triangles, most=looks.most_triangles)
    apart = distances(bones, fewer.positions)
    joints, weights = _followed(apart, looks.follow * length)
    normals = vertex_normals(fewer.positions, fewer.triangles)
    return Hull(fewer.positions, fewer.triangles, np.asarray(normals), joints, weights)


def distances(bones: Bones, points: Floats) -> Floats:
    """(p, b) from points (p, 3) to the surface of each bone's tapered capsule, less inside.

    Across its plane a part is as round as its plan says: there distances are stretched by that.
    """
    found = np.empty((len(points), len(bones.start_m)))
    for number, (start, end) in enumerate(zip(bones.start_m, bones.end_m, strict=True)):
        stretch = np.ones(3)
        stretch[bones.across] = 1.0 / bones.round[number]
        from_start = (points - start) * stretch
        along = (end - start) * stretch
        share = np.clip(from_start @ along / max(float(along @ along), 1e-12), 0.0, 1.0)
        away = np.linalg.norm(from_start - share[:, None] * along, axis=1)
        first, last = bones.deep_m[number]
        found[:, number] = away - first - share * (last - first)
    return found


def _together(bones: Bones, points: Floats, blend: float) -> Floats:
    """The smooth least of the distances: -k log sum exp(-d / k), bone by bone."""
    total = np.full(len(points), -np.inf)
    for at in range(0, len(points), 200_000):
        rows = slice(at, at + 200_000)
        apart = distances(bones, points[rows]) / -blend
        most = apart.max(axis=1)
        total[rows] = most + np.log(np.exp(apart - most[:, None]).sum(axis=1))
    return np.asarray(-blend * total)


def _followed(apart: Floats, follow: float) -> tuple[NDArray[np.uint16], NDArray[np.float32]]:
    """The four nearest bones of each vertex; the root is joint 0, bones begin at 1."""
    count = min(4, apart.shape[1])
    nearest = np.argpartition(apart, count - 1, axis=1)[:, :count]
    there = np.take_along_axis(apart, nearest, axis=1)
    share = np.exp(-(there - there.min(axis=1, keepdims=True)) / follow)
    share /= share.sum(axis=1, keepdims=True)
    joints = np.zeros((len(apart), 4), dtype=np.uint16)
    weights = np.zeros((len(apart), 4), dtype=np.float32)
    joints[:, :count], weights[:, :count] = nearest + 1, share
    return joints, weights
