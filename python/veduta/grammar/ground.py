"""The ground between buildings that stand at different heights: invented, so that none floats.

The corners of the lots, each at the height of its lot, are joined by Delaunay triangles that keep
to the edges of the lots, so that a lot is level; where neighbours of different height meet, the
higher counts. Around the town the ground falls to the plane of the place (`ground_margin`).
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import Delaunay

from veduta.grammar.block import Block
from veduta.grammar.ground_margin import edges_of, is_border, margin_around, on_long_edges
from veduta.grammar.lot import Lot

LEVEL_M = 0.05
"""Lots whose heights differ by less stand on a plane."""
SINK_M = 0.02
"""The ground lies so far below the lots: what the rules lay on them covers it."""
_MERGED_M = 0.01
_ROUNDS = 5
"""Edges of lots that the triangles cross are halved so often."""
_MOST_MENDED = 50_000
"""In towns of more corners they are not: each time takes as long as all triangles do."""
_SLIVER_M2 = 1e-6


@dataclass(frozen=True)
class Ground:
    """The ground of a block.

    points_m: (n, 3) about the origin of all lots, z up. triangles: (m, 3), counter-clockwise from
    above; the first `between` of them lie between the lots, the others around the town.
    """

    points_m: NDArray[np.float64]
    triangles: NDArray[np.int32]
    between: int


def is_level(anchors_m: NDArray[np.float64]) -> bool:
    """Whether all lots stand on a plane; (n, 3) where they are."""
    return not len(anchors_m) or float(np.ptp(anchors_m[:, 2])) < LEVEL_M


def ground_of(blocks: Iterable[Block], highest_m: float | None = None) -> dict[str, Ground]:
    """The ground by the names of the blocks; none where all lots are level.

    The lots of one block are looked at at a time. highest_m: of a town of which these are a part.
    """
    names, rings = [], []
    for block in blocks:
        names.append(block.name)
        rings.append(_rings(block.lots))
    if not rings or is_level(np.concatenate([own.corners for own in rings])):
        return {}
    points, owner, edges = _corners(rings)
    rings.clear()
    points[:, 2] -= SINK_M
    points, owner, inner = _joined(points, owner, edges)
    highest = points[:, 2].max() if highest_m is None else highest_m - SINK_M
    margin = margin_around(points, inner, float(highest))
    inner = inner[_doubled(points, inner) > 2 * _SLIVER_M2]
    every = np.concatenate([points, margin.points_m])
    owner = np.concatenate([owner, owner[margin.base]])
    triangles = np.concatenate([inner, margin.triangles])
    block = owner[triangles].max(axis=1)
    found = {}
    for number, name in enumerate(names):
        own = np.flatnonzero(block == number)
        if len(own):
            used, corners = np.unique(triangles[own], return_inverse=True)
            shape = corners.reshape(-1, 3).astype(np.int32)
            found[name] = Ground(every[used], shape, int((own < len(inner)).sum()))
    return found


def height_at(grounds: Iterable[Ground], x: float, y: float) -> float | None:
    """The height of the ground at a place (m); None where there is none."""
    for ground in grounds:
        a, b, c = (ground.points_m[ground.triangles[:, k]] for k in range(3))
        (ux, uy), (vx, vy), (px, py) = (b - a)[:, :2].T, (c - a)[:, :2].T, ([x, y] - a[:, :2]).T
        area = ux * vy - uy * vx
        s, t = (px * vy - py * vx) / area, (ux * py - uy * px) / area
        within = np.flatnonzero(np.minimum(np.minimum(s, t), 1 - s - t) >= -1e-9)
        if len(within):
            row = within[0]
            rise = s[row] * (b - a)[row, 2] + t[row] * (c - a)[row, 2]
            return float(a[row, 2] + rise)
    return None


@dataclass(frozen=True)
class _Rings:
    """The corners of rings, (n, 3), one ring after the other, and how many each has, (r,)."""

    corners: NDArray[np.float64]
    sizes: NDArray[np.int64]


def _rings(lots: Sequence[Lot]) -> _Rings:
    rings = [(lot, ring) for lot in lots for ring in lot.rings_m]
    sizes = np.array([len(ring) for _, ring in rings], dtype=np.int64)
    flat = np.concatenate([ring + lot.anchor_m[:2] for lot, ring in rings])
    heights = np.repeat([lot.anchor_m[2] for lot, _ in rings], sizes)
    return _Rings(np.column_stack([flat, heights]), sizes)


def _corners(
    rings: Sequence[_Rings],
) -> tuple[NDArray[np.float64], NDArray[np.int64], NDArray[np.int64]]:
    """(n, 3) of all rings, the block of each, and (e, 2) the edges between them.

    Corners in one place are one, at the highest of their heights.
    """
    every = np.concatenate([own.corners for own in rings])
    sizes = np.concatenate([own.sizes for own in rings])
    flat, height = every[:, :2], every[:, 2]
    owner = np.repeat(np.arange(len(rings)), [len(own.corners) for own in rings])
    ends = np.cumsum(sizes)
    following = np.arange(1, len(flat) + 1)
    following[ends - 1] = ends - sizes
    cells = np.round(flat / _MERGED_M).astype(np.int64)
    _, first, place = np.unique(cells, axis=0, return_index=True, return_inverse=True)
    place = place.reshape(-1)
    points = np.column_stack([flat[first], height[first]])
    np.maximum.at(points[:, 2], place, height)
    edges = np.column_stack([place, place[following]])
    return points, owner[first], edges[edges[:, 0] != edges[:, 1]]


def _joined(
    points: NDArray[np.float64], owner: NDArray[np.int64], edges: NDArray[np.int64]
) -> tuple[NDArray[np.float64], NDArray[np.int64], NDArray[np.int32]]:
    """The points with those that were put on edges, their blocks, and the triangles."""
    added, base = on_long_edges(points, _delaunay(points))
    points, owner = np.concatenate([points, added]), np.concatenate([owner, owner[base]])
    triangles = _delaunay(points)
    for _ in range(_ROUNDS if len(points) < _MOST_MENDED else 0):
        missing = ~np.isin(_keys(edges, len(points)), _keys(edges_of(triangles), len(points)))
        crossed = edges[missing]
        if len(crossed) == 0:
            break
        middle = len(points) + np.arange(len(crossed))
        halves = np.stack([crossed[:, 0], middle, middle, crossed[:, 1]], axis=1).reshape(-1, 2)
        edges = np.concatenate([edges[~missing], halves])
        points = np.concatenate([points, points[crossed].mean(axis=1)])
        owner = np.concatenate([owner, owner[crossed[:, 0]]])
        triangles = _delaunay(points)
    return points, owner, triangles


def _keys(edges: NDArray[np.int64], count: int) -> NDArray[np.int64]:
    """One number for an edge, whichever way it goes."""
    found: NDArray[np.int64] = edges.min(axis=1) * count + edges.max(axis=1)
    return found


def _delaunay(points: NDArray[np.float64]) -> NDArray[np.int32]:
    """The triangles counter-clockwise seen from above, without slivers at the border."""
    triangles = Delaunay(points[:, :2]).simplices.astype(np.int32)
    area = _doubled(points, triangles)
    found: NDArray[np.int32] = np.where((area < 0)[:, None], triangles[:, ::-1], triangles)
    return _peeled(found, np.abs(area) < 2 * _SLIVER_M2)


def _doubled(points: NDArray[np.float64], triangles: NDArray[np.int32]) -> NDArray[np.float64]:
    """Twice the areas of triangles on the map; above zero where counter-clockwise from above."""
    a, b, c = (points[triangles[:, k], :2] for k in range(3))
    (ux, uy), (vx, vy) = (b - a).T, (c - a).T
    found: NDArray[np.float64] = ux * vy - uy * vx
    return found


def _peeled(triangles: NDArray[np.int32], is_thin: NDArray[np.bool_]) -> NDArray[np.int32]:
    """Without the thin ones at the border: a corner on a straight border lies in it."""
    while is_thin.any():
        border = is_border(triangles).reshape(3, -1).any(axis=0)
        kept = ~(border & is_thin)
        if kept.all():
            break
        triangles, is_thin = triangles[kept], is_thin[kept]
    return triangles
