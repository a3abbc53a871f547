"""The road under the first sweeps becomes the plane z = 0: recorded frames are seldom level."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class LevelParameters:
    """Thresholds of levelling.

    near_m: points so close to the path are taken; a road is flat there. within_m: a point of the
    road is so near to its plane (3 sigma of a scanner with 3.5 cm and a road's camber).
    draws: triples that are tried; with half of the points on the road, 200 miss it never.
    lowest_share: so many of the points must be on the road.
    """

    near_m: float = 8.0
    within_m: float = 0.12
    draws: int = 200
    steepest: float = 0.25
    lowest_share: float = 0.2


@dataclass(frozen=True, eq=False)
class Level:
    """level_from_world: (4, 4), turns and lifts a frame so that the road is z = 0.

    share: of the points near the path that lie on the road; 0 where none was found.
    """

    level_from_world: NDArray[np.float64]
    share: float


def level_road(
    points: NDArray[np.float64],
    path: NDArray[np.float64],
    seed: int,
    parameters: LevelParameters | None = None,
) -> Level:
    """RANSAC for the plane of most points below the path, refined by least squares.

    points: (n, 3), z roughly up. path: (s, 3). Where no plane holds enough points the frame is only
    lifted by the lowest points.
    """
    chosen = parameters or LevelParameters()
    middle = path.mean(axis=0)
    reach = chosen.near_m + float(np.linalg.norm(path[:, :2] - middle[:2], axis=1).max())
    near = points[np.linalg.norm(points[:, :2] - middle[:2], axis=1) < reach]
    near = near[near[:, 2] < middle[2] - 0.3]
    lift = np.eye(4)
    if len(near) < 100:
        lift[2, 3] = -float(middle[2]) if not len(near) else -float(np.quantile(near[:, 2], 0.05))
        return Level(lift, 0.0)
    random = np.random.default_rng(seed)
    sample = near[random.choice(len(near), min(len(near), 6000), replace=False)]
    best = _best_plane(sample, random, chosen)
    if best is None or best[1] < chosen.lowest_share:
        lift[2, 3] = -float(np.quantile(near[:, 2], 0.05))
        return Level(lift, 0.0)
    plane, share = best
    turn = _turn_upright(plane[:3])
    level = np.eye(4)
    level[:3, :3] = turn
    level[2, 3] = plane[3]
    return Level(level, share)


def _best_plane(
    sample: NDArray[np.float64], random: np.random.Generator, chosen: LevelParameters
) -> tuple[NDArray[np.float64], float] | None:
    """Unit normal (upwards) and offset of n.p + o = 0, with the share of points on it."""
    triples = sample[random.integers(0, len(sample), (chosen.draws, 3))]
    normals = np.cross(triples[:, 1] - triples[:, 0], triples[:, 2] - triples[:, 0])
    length = np.linalg.norm(normals, axis=1)
    usable = length > 1e-6
    normals = normals[usable] / length[usable, None]
    normals *= np.where(normals[:, 2:] < 0.0, -1.0, 1.0)
    flat = normals[:, 2] > 1.0 / np.hypot(1.0, chosen.steepest)
    normals, corners = normals[flat], triples[usable, 0][flat]
    if not len(normals):
        return None
    offsets = -(normals * corners).sum(axis=1)
    hits = (np.abs(sample @ normals.T + offsets) < chosen.within_m).mean(axis=0)
    first = int(np.argmax(hits))
    normal, offset = normals[first], offsets[first]
    for _ in range(3):
        on = np.abs(sample @ normal + offset) < chosen.within_m
        centre = sample[on].mean(axis=0)
        _, _, axes = np.linalg.svd(sample[on] - centre, full_matrices=False)
        normal = axes[2] * (1.0 if axes[2][2] > 0.0 else -1.0)
        offset = -float(normal @ centre)
    share = float((np.abs(sample @ normal + offset) < chosen.within_m).mean())
    return np.append(normal, offset), share


def _turn_upright(normal: NDArray[np.float64]) -> NDArray[np.float64]:
    """The shortest turn that brings a unit normal to z."""
    axis = np.cross(normal, [0.0, 0.0, 1.0])
    cosine = float(normal[2])
    skew = np.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]])
    return np.asarray(np.eye(3) + skew + skew @ skew / (1.0 + cosine), dtype=np.float64)
