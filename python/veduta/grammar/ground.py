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
from veduta.grammar.lots import Lot

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


def is_level(lots: Sequence[Lot]) -> bool:
    """Whether all lots stand on a plane."""
    heights = [lot.anchor_m[2] for lot in lots]
    return not heights or max(heights) - min(heights) < LEVEL_M


def ground_of(blocks: Sequence[Block]) -> dict[str, Ground]:
    """The ground by the names of the blocks; none where all lots are level."""
    if is_level([lot for block in blocks for lot in block.lots]):
        return {}
    points, owner, edges = _corners(blocks)
    points[:, 2] -= SINK_M
    points, owner, inner = _joined(points, owner, edges)
    margin = margin_around(points, inner)
    inner = inner[_doubled(points, inner) > 2 * _SLIVER_M2]
    every = np.concatenate([points, margin.points_m])
    owner = np.concatenate([owner, owner[margin.base]])
    triangles = np.concatenate([inner, margin.triangles])
    block = owner[triangles].max(axis=1)
    found = {}
    for number, one in enumerate(blocks):
        own = np.flatnonzero(block == number)
        if len(own):
            used, corners = np.unique(triangles[own], return_inverse=True)
            shape = corners.reshape(-1, 3).astype(np.int32)
            found[one.name] = Ground(every[used], shape, int((own < len(inner)).sum()))
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


def _corners(
    blocks: Sequence[Block],
) -> tuple[NDArray[np.float64], NDArray[np.int64], NDArray[np.int64]]:
    """(n, 3) of all rings, the block of each, and (e, 2) the edges between them.

    Corners in one place are one, at the highest of their heights.
    """
    rings = [(row, lot, r) for row, b in enumerate(blocks) for lot in b.lots for r in lot.rings_m]
    sizes = np.array([len(ring) for _, _, ring in rings])
    flat = np.concatenate([ring + lot.anchor_m[:2] for _, lot, ring in rings])
    height = np.repeat([lot.anchor_m[2] for _, lot, _ in rings], sizes)
    owner = np.repeat([row for row, _, _ in rings], sizes)
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
