"""What the points say of facades on which no wall need be found: whether they lie in their planes.

Under a right placement the points that lie before and behind a facade crowd about its plane, a
little behind it; under a wrong one they lie anywhere there. Walls are found on few facades of a
street that photos show in part; points are on all that they show.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import KDTree

from veduta.photos.city.facades import Facades
from veduta.photos.world.gauss_newton import Pose


@dataclass(frozen=True)
class FacadePointParameters:
    """near_m: points so near to a plane are looked at. inside_m: from the facade's own edges;
    foot_m: from its foot, where the street and what stands there begin.

    cell_m: the points of such a square of a facade count as one. fewest_cells: of a facade that
    says anything. exact_sd_m, rough_sd_m: of points on a facade, half of them each. on: share of
    the points that are on it; others are on sills, signs and cars. independent: what a facade
    says of its plane: where it is, and which way it runs.
    """

    near_m: float = 1.0
    inside_m: float = 0.2
    foot_m: float = 0.5
    cell_m: float = 1.0
    fewest_cells: int = 4
    exact_sd_m: float = 0.08
    rough_sd_m: float = 0.25
    on: float = 0.7
    independent: float = 2.0


@dataclass(frozen=True)
class FacadePoints:
    """nats: (f,) of each facade, 0 where it has too few points. cells: (f,) squares with points."""

    nats: NDArray[np.float64]
    cells: NDArray[np.int64]

    @property
    def score(self) -> float:
        """Of all facades."""
        return float(self.nats.sum())

    @property
    def explained(self) -> float:
        """Share of the squares that lie on facades whose points speak for the placement."""
        total = int(self.cells.sum())
        return float(self.cells[self.nats > 0.0].sum()) / max(1, total)


def facade_points(
    pose: Pose,
    points: NDArray[np.float64],
    facades: Facades,
    parameters: FacadePointParameters | None = None,
) -> FacadePoints:
    """Of (p, 3) points in the structure's frame, laid into the world by a pose."""
    known = parameters or FacadePointParameters()
    places = pose.similarity.moved(points)
    nats, cells = np.zeros(len(facades)), np.zeros(len(facades), dtype=np.int64)
    low, high = places[:, :2].min(axis=0), places[:, :2].max(axis=0)
    radius = facades.width / 2.0 + known.near_m
    near = (
        (facades.middle > low - radius[:, None]) & (facades.middle < high + radius[:, None])
    ).all(axis=1)
    rows = np.flatnonzero(near & ~facades.hidden)
    if len(rows) == 0:
        return FacadePoints(nats, cells)
    around = KDTree(places[:, :2]).query_ball_point(facades.middle[rows], radius[rows])
    for row, here in zip(rows.tolist(), around, strict=True):
        own = places[np.array(here, dtype=np.int64)]
        nats[row], cells[row] = _of_facade(own, row, facades, pose.behind_m, known)
    return FacadePoints(nats, cells)


def _of_facade(
    places: NDArray[np.float64],
    row: int,
    facades: Facades,
    behind_m: float,
    known: FacadePointParameters,
) -> tuple[float, int]:
    apart = places[:, :2] - facades.start[row]
    along, height = apart @ facades.along[row], places[:, 2]
    off = apart @ facades.outward[row] + behind_m
    on = (along > known.inside_m) & (along < facades.width[row] - known.inside_m)
    on &= (height > facades.bottom[row] + known.foot_m) & (np.abs(off) < known.near_m)
    on &= height < facades.top[row] - known.inside_m
    squares = np.column_stack([along[on] // known.cell_m, height[on] // known.cell_m])
    _, square, crowd = np.unique(
        squares.astype(np.int64), axis=0, return_inverse=True, return_counts=True
    )
    if len(crowd) < known.fewest_cells:
        return 0.0, 0
    by_chance = 0.5 / known.near_m
    density = 0.5 * known.on * (_normal(off[on], known.exact_sd_m))
    density += 0.5 * known.on * _normal(off[on], known.rough_sd_m) + (1.0 - known.on) * by_chance
    mean = float((np.log(density / by_chance) / crowd[square.ravel()]).sum()) / len(crowd)
    return known.independent * mean, len(crowd)


def _normal(values: NDArray[np.float64], sd: float) -> NDArray[np.float64]:
    found: NDArray[np.float64] = np.exp(-0.5 * (values / sd) ** 2) / (sd * np.sqrt(2.0 * np.pi))
    return found
