"""Roads beside lots: which edge of a lot is its front, and how wide the street there is.

Roads are lines with a width, from the file of lots itself or from one of their own. A lot's front
is the edge that looks at a road and is nearest to it; it becomes the first edge of the lot, which
rule files have for `front` and `street.front`.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from veduta.grammar.lot_names import measured
from veduta.grammar.outline import Attribute, Road

WIDTHS_M: dict[str, float] = {
    "motorway": 14.0, "trunk": 12.0, "primary": 11.0, "secondary": 9.0, "tertiary": 8.0,
    "unclassified": 6.0, "residential": 6.0, "living_street": 5.5, "pedestrian": 6.0,
    "service": 4.0, "track": 3.0, "bus_guideway": 4.0, "busway": 4.0,
}  # fmt: skip
"""Carriageways by the tag `highway` of OpenStreetMap, where no width is told."""
PATHS_M: dict[str, float] = {
    "footway": 2.0, "path": 1.5, "cycleway": 2.0, "steps": 2.0, "bridleway": 2.0, "corridor": 2.0,
}  # fmt: skip
"""Ways that no house has its front to where there is a road."""
USUAL_M, LANE_M = 6.0, 3.1
"""Width of a road of which nothing is known, and of a lane."""
NO_ROADS = (
    "waterway", "railway", "barrier", "power", "boundary", "natural", "aeroway", "man_made",
    "aerialway", "route", "pipeline", "contour", "elevation",
)  # fmt: skip
"""A line with one of these properties is no road, unless it has `highway`."""


@dataclass(frozen=True)
class FrontParameters:
    """How a front is told.

    reach_m: roads farther from an edge are not its street. facing: cosine between where an edge
    looks and where its street lies. path_m: so much farther off a path counts than it is.
    length_share: of the longest edge; shorter ones are no fronts. length_gain: so much nearer (m)
    an edge counts for each metre of its own, up to `length_most_m`: gables have less of a front
    than long sides.
    corner_m, corner_cos: another edge that looks elsewhere makes a corner where its street is no
    farther than this beyond the front's. Values that were tried on two towns by eye.
    """

    reach_m: float = 45.0
    facing: float = 0.5
    path_m: float = 15.0
    length_share: float = 0.3
    length_gain: float = 0.1
    length_most_m: float = 25.0
    corner_m: float = 4.0
    corner_cos: float = 0.6


@dataclass(frozen=True)
class Front:
    """The front of a lot.

    edge: the number of its first point. width_m: of the street. gap_m: from the edge to the
    carriageway. corner: whether another edge looks at a street in another direction. widths_m: of
    the street before each edge, 0 where there is none.
    """

    edge: int
    width_m: float
    gap_m: float
    corner: bool
    widths_m: tuple[float, ...] = ()

    def attributes(self) -> dict[str, Attribute]:
        """What rule files may ask for."""
        return {
            "streetWidth": self.width_m,
            "streetDistance": self.gap_m,
            "streetCorner": self.corner,
        }


def road_of(properties: Any, points: NDArray[np.float64]) -> Road | None:
    """The road that a line of a file is; None of a line that is something else.

    points: (n, 2) or (n, 3) in the file's own frame.
    """
    told: Mapping[str, Any] = properties if isinstance(properties, dict) else {}
    kind = str(told.get("highway") or "")
    if len(points) < 2 or kind in ("proposed", "construction", "platform", "elevator"):
        return None
    if not kind and any(told.get(name) not in (None, "", "no") for name in NO_ROADS):
        return None
    level = np.zeros((len(points), 3))
    level[:, : min(points.shape[1], 3)] = points[:, :3]
    return Road(level, _width_m(told, kind), kind in PATHS_M)


def _width_m(told: Mapping[str, Any], kind: str) -> float:
    for name in ("width", "WIDTH", "largeur", "LARGEUR", "streetWidth", "est_width"):
        value = told.get(name)
        metres = measured(str(value)) if value is not None else None
        if metres is not None and 0.5 <= metres <= 100.0:
            return metres
    usual = PATHS_M.get(kind) or WIDTHS_M.get(kind.removesuffix("_link"), USUAL_M)
    lanes = measured(str(told.get("lanes", "")))
    return usual if lanes is None or not 1.0 <= lanes <= 12.0 else max(usual, lanes * LANE_M)


class Roads:
    """The roads of a town, to ask which are near a lot."""

    def __init__(self, roads: Sequence[Road], parameters: FrontParameters | None = None) -> None:
        """roads: their points in metres from the origin of all lots."""
        self._parameters = parameters or FrontParameters()
        self.lines = tuple(roads)
        pieces = [
            (road.points[:-1, :2], road.points[1:, :2], road)
            for road in roads
            if len(road.points) > 1
        ]
        none = np.zeros((0, 2))
        self._from = np.concatenate([piece[0] for piece in pieces]) if pieces else none
        self._to = np.concatenate([piece[1] for piece in pieces]) if pieces else none
        counts = [len(piece[0]) for piece in pieces]
        widths = [road.width_m for _, _, road in pieces]
        paths = [road.is_path for _, _, road in pieces]
        self._width_m = np.repeat(np.array(widths, dtype=np.float64), counts)
        self._is_path = np.repeat(np.array(paths, dtype=bool), counts)
        ends = np.stack([self._from, self._to], axis=1)
        lines: NDArray[np.object_] = np.atleast_1d(np.asarray(shapely.linestrings(ends)))
        self._tree = shapely.STRtree(lines) if len(ends) else None

    def __len__(self) -> int:
        return len(self._from)

    def front_of(self, ring_m: NDArray[np.float64]) -> Front | None:
        """The front of an outline, (n, 2) counter-clockwise in metres; None without a road near."""
        if self._tree is None:
            return None
        reach = self._parameters.reach_m
        low, high = ring_m.min(axis=0) - reach, ring_m.max(axis=0) + reach
        near = self._tree.query(shapely.box(*low, *high))
        return None if len(near) == 0 else self._chosen(ring_m, near)

    def _chosen(self, ring_m: NDArray[np.float64], near: NDArray[np.int64]) -> Front | None:
        parameters = self._parameters
        along = np.roll(ring_m, -1, axis=0) - ring_m
        length = np.linalg.norm(along, axis=1)
        outward = np.column_stack([along[:, 1], -along[:, 0]]) / np.maximum(length, 1e-9)[:, None]
        middle = ring_m + along / 2
        offset = _to_segments(middle, self._from[near], self._to[near])
        distance = np.linalg.norm(offset, axis=2)
        ahead = np.einsum("ij,ikj->ik", outward, offset)
        faces = (ahead >= parameters.facing * distance) & (distance <= parameters.reach_m)
        gap = np.maximum(distance - self._width_m[near] / 2, 0.0)
        counted = gap + np.where(self._is_path[near], parameters.path_m, 0.0)
        counted = np.where(faces, counted, np.inf)
        best = counted.argmin(axis=1)
        rows = np.arange(len(ring_m))
        own = counted[rows, best]
        own = np.where(length >= parameters.length_share * length.max(), own, np.inf)
        if not np.isfinite(own).any():
            return None
        edge = int(
            np.argmin(own - parameters.length_gain * np.minimum(length, parameters.length_most_m))
        )
        elsewhere = outward @ outward[edge] < parameters.corner_cos
        at_street = own <= own[edge] + parameters.corner_m
        corner = bool(at_street[elsewhere].any())
        street = near[best[edge]]
        widths = tuple(np.where(at_street, self._width_m[near[best]], 0.0).tolist())
        return Front(
            edge, float(self._width_m[street]), float(gap[edge, best[edge]]), corner, widths
        )


def _to_segments(
    points: NDArray[np.float64], start: NDArray[np.float64], end: NDArray[np.float64]
) -> NDArray[np.float64]:
    """(n, m, 2) from each of (n, 2) points to the nearest place of each segment."""
    along = end - start
    away = points[:, None, :] - start[None]
    squared = np.maximum((along**2).sum(axis=1), 1e-18)
    share = np.clip((away * along[None]).sum(axis=2) / squared, 0.0, 1.0)
    nearest: NDArray[np.float64] = start[None] + share[..., None] * along[None] - points[:, None, :]
    return nearest


def lines_of(geometry: Any) -> Iterable[NDArray[np.float64]]:
    """The lines of a GeoJSON geometry, (n, 2) or (n, 3); none of one that cannot be read."""
    kind, coordinates = geometry.get("type"), geometry.get("coordinates")
    lines = [coordinates] if kind == "LineString" else coordinates
    if kind not in ("LineString", "MultiLineString") or not isinstance(lines, list):
        return
    for line in lines:
        try:
            points = np.array([point[:3] for point in line], dtype=np.float64)
        except (TypeError, ValueError, IndexError):
            continue  # a road that cannot be read is none to look at
        if points.ndim == 2 and points.shape[1] >= 2 and np.isfinite(points).all():
            yield points
