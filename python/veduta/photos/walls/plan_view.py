"""The points as walls are looked for in them: from above, with what each is worth there."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from veduta.photos.walls.point_quality import PointQuality

STEEPEST = 0.5
"""A normal may rise so much (sine: 30 degrees) where the neighbourhood is that of a wall."""
FLAT_ENOUGH = 0.3
"""Flatness under which a neighbourhood is a blob, whose normal says nothing."""
TOLERANCE = 3.0
"""Standard deviations that a point of a line may lie off it."""
TURNED = 0.7
"""Least cosine between the normals of a line and of a point's neighbourhood: 45 degrees."""


@dataclass(frozen=True)
class PlanView:
    """n points from above, and how sure each is.

    rows: (n,) of the structure's points. xy: (n, 2); z: (n,). facing: (n, 2) unit normal towards
    the photos, or zero where the neighbourhood is no wall's. seen_from: (n, 2). covariance:
    (n, 2, 2). roughness: what a wall's points scatter by, besides. reach: a typical distance
    between point and photo.
    """

    rows: NDArray[np.int64]
    xy: NDArray[np.float64]
    z: NDArray[np.float64]
    facing: NDArray[np.float64]
    seen_from: NDArray[np.float64]
    covariance: NDArray[np.float64]
    roughness: float
    reach: float

    def __len__(self) -> int:
        return len(self.rows)

    def only(self, kept: NDArray[np.bool_] | NDArray[np.int64]) -> PlanView:
        """The same with some of the points."""
        return replace(
            self,
            rows=self.rows[kept],
            xy=self.xy[kept],
            z=self.z[kept],
            facing=self.facing[kept],
            seen_from=self.seen_from[kept],
            covariance=self.covariance[kept],
        )

    def sigma(self, normal: NDArray[np.float64]) -> NDArray[np.float64]:
        """(n,) standard deviation across a line with this (2,) normal."""
        spread = np.einsum("i,nij,j->n", normal, self.covariance, normal)
        found: NDArray[np.float64] = np.sqrt(spread + self.roughness**2)
        return found

    def on_line(
        self, normal: NDArray[np.float64], offset: float, turned: float = TURNED
    ) -> NDArray[np.bool_]:
        """(n,) whether a point lies on the line, turned as it is, and is seen from its side."""
        off = self.xy @ normal - offset
        near = np.abs(off) <= TOLERANCE * self.sigma(normal)
        ahead = self.seen_from @ normal > offset
        plain = ~self.facing.any(axis=1)
        return near & ahead & (plain | (self.facing @ normal >= turned))


def plan_view(points: NDArray[np.float64], quality: PointQuality) -> PlanView:
    """The view from above of (p, 3) points with z up.

    The roughness is that of the neighbourhoods of walls, and at least the median of what the
    observations leave open: no length is assumed, for the scale is not known.
    """
    steep = (np.abs(quality.normal[:, 2]) <= STEEPEST) & (quality.flatness >= FLAT_ENOUGH)
    level = quality.normal[:, :2]
    facing = np.where(
        steep[:, None], level / np.maximum(np.linalg.norm(level, axis=1), 1e-12)[:, None], 0.0
    )
    # A flat neighbourhood that lies level is ground or a roof, and no point of a wall.
    level_ground = (np.abs(quality.normal[:, 2]) > TURNED) & (quality.flatness >= FLAT_ENOUGH)
    rows = np.flatnonzero(~level_ground)
    deviation = np.sqrt(np.einsum("pii->p", quality.covariance))
    thickness = quality.thickness[steep] if steep.any() else quality.thickness
    return PlanView(
        rows=rows,
        xy=points[rows, :2],
        z=points[rows, 2],
        facing=facing[rows],
        seen_from=quality.seen_from[rows, :2],
        covariance=quality.covariance[rows, :2, :2],
        roughness=max(float(np.median(thickness)), float(np.median(deviation))),
        reach=float(np.median(quality.distance)),
    )
