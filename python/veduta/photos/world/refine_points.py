"""The last refinement of a placement: the points on all facades, in place of the walls' corners.

The plane of a wall is told at its corners, which lie beyond its points, and facades on which no
wall was found say nothing. So a placement by walls depends on where it began. Here all points near
the facades that they were matched to by nothing but place count (iterated closest points, from
point to plane), a facade no more than a few places of it that are known independently; edges, tops
and feet are still those of the walls.
"""

from __future__ import annotations

import itertools
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import KDTree

from veduta.photos.city.facades import Facades
from veduta.photos.world.columns import WallColumns
from veduta.photos.world.evidence import FacadeIndex, match_walls
from veduta.photos.world.gauss_newton import (
    UP_SD_RAD,
    Pose,
    Rows,
    median_sd,
    residuals_m,
    stepped,
    weights,
)
from veduta.photos.world.refine import (
    FIRST_SD_M,
    PLANE,
    Refined,
    WallRows,
    deviations,
    wall_rows,
)

MOST_ITERATIONS = 20
STILL_M = 1e-3
"""A structure of which no corner moves by more has arrived."""
NEAR_M = 0.3
"""Points so near to a facade's plane are on it."""
INSIDE_M = 0.2
"""Points nearer to a facade's edges may lie on its neighbour, the eaves or the ground."""
CELL_M = 1.0
"""The points of such a square of a facade count as one."""
FEWEST_CELLS = 3
INDEPENDENT = 4.0
"""A facade counts as so many points: they lie off together."""
LEAST_POINT_SD_M, MOST_POINT_SD_M = 0.03, 0.15


@dataclass(frozen=True)
class _OnFacades:
    """Points on facades: their rows, the facade of each, and what each counts."""

    point: NDArray[np.int64]
    facade: NDArray[np.int64]
    share: NDArray[np.float64]


def refine_by_points(
    first: Refined,
    walls: WallColumns,
    corners: NDArray[np.float64],
    index: FacadeIndex,
    points: NDArray[np.float64],
    middle: NDArray[np.float64],
    up_sd_rad: float = UP_SD_RAD,
) -> Refined:
    """From a placement that is right but for some decimetres; points: (p, 3) of the structure.

    What it leaves is that at the walls, as `refine` tells it; the first where no facade has points.
    """
    facades = index.facades
    sds = np.array(FIRST_SD_M)
    point_sd = MOST_POINT_SD_M
    refined = first
    for _ in range(MOST_ITERATIONS):
        now = refined.pose
        seen = wall_rows(corners, index, match_walls(walls, index, refined.level))
        on = _on_facades(now.similarity.moved(points), facades, now.behind_m)
        if len(on.point) == 0:
            return first
        rows, sd = _together(seen, points, on, facades, len(walls), sds, point_sd)
        after = stepped(now, rows, sd, middle, up_sd_rad)
        point_sd = median_sd(after.left_m[rows.is_plane], LEAST_POINT_SD_M, MOST_POINT_SD_M)
        left = residuals_m(after.pose, seen.rows)
        sds = deviations(seen.kind, left, np.array(FIRST_SD_M))
        refined = Refined(
            after.pose,
            after.covariance,
            seen.wall,
            seen.kind,
            left,
            weights(left, sds[seen.kind]),
        )
        if _moved_m(now, after.pose, points) < STILL_M:
            break
    return refined


def _moved_m(before: Pose, after: Pose, points: NDArray[np.float64]) -> float:
    """The furthest that a corner of the box of all points moves."""
    low, high = points.min(axis=0), points.max(axis=0)
    box = np.array(list(itertools.product(*zip(low, high, strict=True))))
    apart = after.similarity.moved(box) - before.similarity.moved(box)
    return float(np.linalg.norm(apart, axis=1).max())


def _together(
    seen: WallRows,
    points: NDArray[np.float64],
    on: _OnFacades,
    facades: Facades,
    walls: int,
    sds: NDArray[np.float64],
    point_sd: float,
) -> tuple[Rows, NDArray[np.float64]]:
    """All of the walls but their planes, and the points; the deviation of each."""
    kept = seen.kind != PLANE
    own, count = seen.rows, len(on.point)
    outward = facades.outward[on.facade]
    rows = Rows(
        np.concatenate([own.place[kept], points[on.point]]),
        np.concatenate([own.direction[kept], np.column_stack([outward, np.zeros(count)])]),
        np.concatenate([own.offset[kept], (outward * facades.start[on.facade]).sum(axis=1)]),
        np.concatenate([np.zeros(kept.sum(), dtype=bool), np.ones(count, dtype=bool)]),
        np.concatenate([own.share[kept], on.share]),
        np.concatenate([own.group[kept], walls + on.facade]),
    )
    return rows, np.concatenate([sds[seen.kind[kept]], np.full(count, point_sd)])


def _on_facades(places: NDArray[np.float64], facades: Facades, behind_m: float) -> _OnFacades:
    """The points on the facades, each on the nearest; (p, 3) metres of the world."""
    nearest = np.full(len(places), NEAR_M)
    facade = np.full(len(places), -1, dtype=np.int64)
    radius = facades.width / 2.0 + NEAR_M + abs(behind_m)
    low, high = places[:, :2].min(axis=0), places[:, :2].max(axis=0)
    beside = (facades.middle > low - radius[:, None]) & (facades.middle < high + radius[:, None])
    rows = np.flatnonzero(~facades.hidden & beside.all(axis=1))
    around = KDTree(places[:, :2]).query_ball_point(facades.middle[rows], radius[rows])
    for row, found in zip(rows.tolist(), around, strict=True):
        here = np.array(found, dtype=np.int64)
        apart = places[here, :2] - facades.start[row]
        along = apart @ facades.along[row]
        off = np.abs(apart @ facades.outward[row] + behind_m)
        height = places[here, 2]
        on = (along > INSIDE_M) & (along < facades.width[row] - INSIDE_M)
        on &= (height > facades.bottom[row] + INSIDE_M) & (height < facades.top[row] - INSIDE_M)
        on &= off < nearest[here]
        nearest[here[on]] = off[on]
        facade[here[on]] = row
    point = np.flatnonzero(facade >= 0)
    return _counted(point, facade[point], places, facades)


def _counted(
    point: NDArray[np.int64],
    facade: NDArray[np.int64],
    places: NDArray[np.float64],
    facades: Facades,
) -> _OnFacades:
    """With what each point counts: by squares of its facade."""
    along = ((places[point, :2] - facades.start[facade]) * facades.along[facade]).sum(axis=1)
    squares = np.column_stack([facade, along // CELL_M, places[point, 2] // CELL_M])
    _, square, crowd = np.unique(
        squares.astype(np.int64), axis=0, return_inverse=True, return_counts=True
    )
    share = 1.0 / crowd[square.ravel()]
    cells = np.bincount(facade, weights=share, minlength=len(facades))[facade]
    enough = cells >= FEWEST_CELLS
    share *= np.minimum(1.0, INDEPENDENT / cells)
    return _OnFacades(point[enough], facade[enough], share[enough])
