"""How the ground of a town ends: it falls to the plane of the place, gently and without an edge."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

MARGIN_M = 25.0
"""The ground reaches so far beyond the lots at least."""
REACH = 3.0
"""And so many times the height from which it falls: it can be walked, at 27 degrees at most."""
BELOW_M = -0.3
"""The end: below the plane, into which it dips with its last ring. An end that is level with
the plane would meet it in a ragged line."""
RINGS = 10
_SPACING_M = 6.0
_MOST_SPANS = 400
_TURN_RAD = np.radians(12)
_STRAIGHT_RAD = np.radians(1)


@dataclass(frozen=True)
class Margin:
    """What lies around a town.

    points_m: (n, 3). base: (n,) the corner of the town from which each was led away. triangles:
    (m, 3) of the town's points, and of these as if they followed them.
    """

    points_m: NDArray[np.float64]
    base: NDArray[np.int64]
    triangles: NDArray[np.int32]


def edges_of(triangles: NDArray[np.int32]) -> NDArray[np.int64]:
    """(3 m, 2) the edges, as the triangles go round."""
    pairs = [triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]
    return np.concatenate(pairs).astype(np.int64)


def is_border(triangles: NDArray[np.int32]) -> NDArray[np.bool_]:
    """(3 m,) which of their edges no other triangle has."""
    edges = edges_of(triangles)
    count = int(triangles.max()) + 1
    there, back = edges[:, 0] * count + edges[:, 1], edges[:, 1] * count + edges[:, 0]
    return ~np.isin(there, back)


def on_long_edges(
    points: NDArray[np.float64], triangles: NDArray[np.int32]
) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """(n, 3) places on the border between corners far apart, and (n,) the corner before each.

    With them what lies around is as smooth as where corners are near each other.
    """
    border = edges_of(triangles)[is_border(triangles)]
    there = points[border[:, 1]] - points[border[:, 0]]
    along = np.linalg.norm(there[:, :2], axis=1)
    most = max(_SPACING_M, float(along.sum()) / _MOST_SPANS)
    parts = np.ceil(along / most).astype(np.int64)
    which = np.repeat(np.arange(len(border)), parts - 1)
    number = np.arange(len(which)) - np.repeat(np.cumsum(parts - 1) - (parts - 1), parts - 1) + 1
    base = border[which, 0]
    return points[base] + (number / parts[which])[:, None] * there[which], base


def margin_around(
    points: NDArray[np.float64], triangles: NDArray[np.int32], highest_m: float
) -> Margin:
    """Rings around (n, 3) points and their triangles, whose border is convex.

    highest_m: of the whole town, which says how wide they are.

    Each corner of the border is led away at right angles to it; on the way its height becomes that
    of its neighbours, and falls as the cubic that is level at both ends.
    """
    base, away = _rays(points, triangles)
    width = max(MARGIN_M, REACH * highest_m)
    steps = np.arange(1, RINGS + 1) / RINGS
    flat = points[base, :2] + (steps[:, None, None] * width) * away
    heights = _blurred(flat, points[base, 2], steps * width / 2)
    fallen = (steps * steps * (3 - 2 * steps))[:, None]
    heights = heights * (1 - fallen)
    heights[-1] = BELOW_M
    found = np.dstack([flat, heights]).reshape(-1, 3)
    first = len(points) + len(base) * np.arange(RINGS)[:, None] + np.arange(len(base))
    rings = np.concatenate([base[None], first])
    return Margin(found, np.tile(base, RINGS), _strips(rings))


def _rays(
    points: NDArray[np.float64], triangles: NDArray[np.int32]
) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
    """(r,) corners of the border, counter-clockwise, some of them often; (r, 2) where each goes."""
    border = edges_of(triangles)[is_border(triangles)]
    following = dict(border.tolist())
    loop = [int(border[0, 0])]
    for _ in range(len(border) - 1):
        loop.append(following[loop[-1]])
    corners = np.array(loop)
    along = points[np.roll(corners, -1), :2] - points[corners, :2]
    heading = np.arctan2(-along[:, 0], along[:, 1])
    before = np.roll(heading, 1)
    turn = (heading - before + np.pi) % (2 * np.pi) - np.pi
    counts = np.where(turn > _STRAIGHT_RAD, np.ceil(turn / _TURN_RAD) + 1, 1).astype(np.int64)
    which = np.repeat(np.arange(len(corners)), counts)
    number = np.arange(len(which)) - np.repeat(np.cumsum(counts) - counts, counts)
    share = np.where(counts[which] > 1, number / np.maximum(counts[which] - 1, 1), 0.5)
    angle = before[which] + share * turn[which]
    return corners[which], np.column_stack([np.cos(angle), np.sin(angle)])


def _blurred(
    flat: NDArray[np.float64], heights: NDArray[np.float64], reach_m: NDArray[np.float64]
) -> NDArray[np.float64]:
    """(k, r) heights along rings of (k, r, 2) points, each ring blurred over its own reach."""
    found = []
    for ring, reach in zip(flat, reach_m.tolist(), strict=True):
        step = np.linalg.norm(ring - np.roll(ring, 1, axis=0), axis=1)
        at, whole = np.cumsum(step), step.sum()
        own = (step + np.roll(step, -1)) / 2
        apart = np.abs(at[:, None] - at[None])
        apart = np.minimum(apart, whole - apart)
        weight = own * np.exp(-0.5 * (apart / reach) ** 2)
        found.append(weight @ heights / weight.sum(axis=1))
    return np.array(found)


def _strips(rings: NDArray[np.int64]) -> NDArray[np.int32]:
    """(m, 3) triangles between (k, r) rings of points, counter-clockwise from above."""
    a, b = rings[:-1], rings[1:]
    c, d = np.roll(b, -1, axis=1), np.roll(a, -1, axis=1)
    outer = np.stack([a, b, c], axis=2).reshape(-1, 3)
    inner = np.stack([a, c, d], axis=2).reshape(-1, 3)
    apart = inner[:, 0] != inner[:, 2]
    return np.concatenate([outer, inner[apart]]).astype(np.int32)
