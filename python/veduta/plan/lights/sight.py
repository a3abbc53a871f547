"""Which points of a room a lamp lights: those within its reach that it sees.

A point of the floor is lit where the way from a lamp of its room stays in the room, and it is no
further off than the corner of a square whose side is the diameter of illumination: rows of lamps
at that distance light all of a rectangle.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely.geometry import Polygon

GRID_M = 0.25
CORNER = math.sqrt(2.0)
_INSIDE_M = 0.02
"""Points are looked at that are so far from the walls: on a wall, rounding decides."""
_ROUNDED_M = 1e-3
"""Places of lamps are rounded to this."""
_MOST_POINTS = 4000
_AT_ONCE = 200_000
"""Lines of sight that are in memory together."""


@dataclass(frozen=True, eq=False)
class Field:
    """The floor of one room, or of one piece of it (plan frame, m), and points all over it.

    grid_m: from point to point.
    """

    region: Polygon
    grid_m: float = GRID_M

    @cached_property
    def points(self) -> NDArray[np.float64]:
        """(n, 2) a grid, and all corners."""
        inner = self.region.buffer(-_INSIDE_M, join_style="mitre")
        if inner.is_empty:
            return np.array([self.region.representative_point().coords[0]])
        step = max(self.grid_m, math.sqrt(inner.area / _MOST_POINTS))
        left, bottom, right, top = inner.bounds
        x, y = np.meshgrid(
            np.arange(left + step / 2.0, right, step), np.arange(bottom + step / 2.0, top, step)
        )
        grid = np.stack([x.reshape(-1), y.reshape(-1)], axis=1)
        grid = grid[shapely.covers(inner, shapely.points(grid))] if len(grid) else grid
        corners = shapely.get_coordinates(inner)
        return np.concatenate([grid, corners])

    @cached_property
    def _convex(self) -> bool:
        return bool(self.region.convex_hull.area - self.region.area < 1e-6)

    def lit_by(
        self,
        lamps: NDArray[np.float64],
        reach_m: float,
        points: NDArray[np.float64] | None = None,
    ) -> NDArray[np.bool_]:
        """(n, k) whether each point (all if not given) is lit by each of the lamps, (k, 2)."""
        points = self.points if points is None else points
        away = np.linalg.norm(points[:, None] - lamps[None], axis=2)
        lit: NDArray[np.bool_] = np.asarray(away <= CORNER * reach_m)
        # In a convex room each lamp sees all of it, but for those that hang elsewhere.
        lit &= shapely.dwithin(self.region, shapely.points(lamps), _ROUNDED_M)
        if self._convex or not lit.any():
            return lit
        point, lamp = np.nonzero(lit)
        for start in range(0, len(point), _AT_ONCE):
            some = slice(start, start + _AT_ONCE)
            lit[point[some], lamp[some]] = self._seen(points[point[some]], lamps[lamp[some]])
        return lit

    def sees(self, lamp: NDArray[np.float64], others: NDArray[np.float64]) -> NDArray[np.bool_]:
        """(k,) whether the way to each of the others stays in the room. lamp: (2,)."""
        return self._seen(np.broadcast_to(lamp, others.shape), others)

    def _seen(self, first: NDArray[np.float64], second: NDArray[np.float64]) -> NDArray[np.bool_]:
        shapely.prepare(self.region)
        ways = shapely.linestrings(np.stack([first, second], axis=1))
        seen: NDArray[np.bool_] = np.asarray(shapely.covers(self.region, ways))
        return seen


def filled_up(
    field: Field, lamps: NDArray[np.float64], sites: NDArray[np.float64], reach_m: float
) -> NDArray[np.float64]:
    """(k, 2) the lamps, and those of the sites that it takes to light what they leave dark.

    Always the site that lights most of what is dark (the greedy cover of Chvatal 1979). What no
    site sees gets a lamp above itself.
    """
    dark = field.points
    for lamp in lamps:
        # What one lamp lights, no other one need be asked for.
        dark = dark[~field.lit_by(lamp[None], reach_m, dark)[:, 0]]
    if not len(dark):
        return lamps
    lights = field.lit_by(sites, reach_m, dark)
    added: list[NDArray[np.float64]] = []
    while len(dark):
        gain = lights.sum(axis=0)
        best = _best_site(gain, sites, dark)
        if best is not None:
            added.append(sites[best])
            still = ~lights[:, best]
        else:
            added.append(dark[0])
            still = ~field.lit_by(dark[:1], reach_m, dark)[:, 0]
            still[0] = False
        dark, lights = dark[still], lights[still]
    return np.concatenate([lamps, np.array(added)])


def _best_site(
    gain: NDArray[np.int64], sites: NDArray[np.float64], dark: NDArray[np.float64]
) -> int | None:
    """The site that lights most points, of several the one in their midst; None if all light none.

    gain: (m,) how many of the points each site lights.
    """
    if not len(gain) or gain.max() == 0:
        return None
    alike = np.flatnonzero(gain == gain.max())
    away = np.linalg.norm(sites[alike] - dark.mean(axis=0), axis=1)
    return int(alike[away.argmin()])
