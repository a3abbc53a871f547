"""Which views each is compared with, and between which depths."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.dense.document.views import Views
from veduta.dense.read.sparse import SparsePoints


@dataclass(frozen=True)
class NeighbourParameters:
    """best_rad: the angle between two rays at which depths are surest yet still look alike;
    narrow_rad, wide_rad: by how much less and more takes the weight to 0.6 (Yao et al. 2018,
    MVSNet, have 5, 1 and 10 degrees). least_points: that two views must share. near, far: the
    depths looked at, times the nearest and the farthest point.
    """

    best_rad: float = np.radians(8.0)
    narrow_rad: float = np.radians(4.0)
    wide_rad: float = np.radians(12.0)
    least_points: int = 8
    near: float = 0.55
    far: float = 1.8


@dataclass(frozen=True)
class Comparison:
    """A view, those that it is compared with (the best first), and the depths looked at (m)."""

    view: int
    neighbours: tuple[int, ...]
    near_m: float
    far_m: float


def choose_neighbours(
    views: Views, sparse: SparsePoints, count: int, parameters: NeighbourParameters
) -> tuple[list[Comparison], list[str]]:
    """One comparison for each view that shares points with others, and what is left out and why."""
    found, left = [], []
    masks = np.zeros((len(views), len(sparse.points_m)), dtype=bool)
    for view, index in enumerate(sparse.visible):
        masks[view, index] = True
    for view, camera in enumerate(views.cameras):
        depths = _depths(views, view, sparse)
        scores = [
            _score(views, view, other, masks, sparse, parameters) for other in range(len(views))
        ]
        order = [int(other) for other in np.argsort(-np.array(scores), kind="stable")]
        near = tuple(other for other in order if scores[other] > 0.0)[:count]
        if not near or len(depths) < parameters.least_points:
            left.append(f"{camera.name}: shows nothing that another photo shows, too")
            continue
        low, high = np.quantile(depths, [0.005, 0.995])
        found.append(
            Comparison(view, near, float(low * parameters.near), float(high * parameters.far))
        )
    return found, left


def _depths(views: Views, view: int, sparse: SparsePoints) -> NDArray[np.float64]:
    points = sparse.points_m[sparse.visible[view]]
    pose = views.cameras[view].cam_from_world
    depths = points @ pose[2, :3] + pose[2, 3]
    return np.asarray(depths[depths > 0.0])


def _score(
    views: Views,
    view: int,
    other: int,
    masks: NDArray[np.bool_],
    sparse: SparsePoints,
    parameters: NeighbourParameters,
) -> float:
    """Shared points, each weighed by the angle between its rays and by the likeness of scale."""
    shared = masks[view] & masks[other]
    if view == other or shared.sum() < parameters.least_points:
        return 0.0
    points = sparse.points_m[shared]
    rays = [points - views.cameras[one].centre() for one in (view, other)]
    away = [np.linalg.norm(ray, axis=1) for ray in rays]
    cosines = np.sum(rays[0] * rays[1], axis=1) / np.maximum(away[0] * away[1], 1e-12)
    angles = np.arccos(np.clip(cosines, -1.0, 1.0))
    spread = np.where(angles < parameters.best_rad, parameters.narrow_rad, parameters.wide_rad)
    weights = np.exp(-((angles - parameters.best_rad) ** 2) / (2.0 * spread**2))
    sizes = [views.cameras[one].focal_px[0] / away[k] for k, one in enumerate((view, other))]
    scale = np.minimum(sizes[0] / sizes[1], sizes[1] / sizes[0])
    return float(np.sum(weights * scale**2))
