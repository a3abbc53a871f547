"""What may not be: cameras inside of buildings, and sight lines that pass through them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.photos.city.facades import Facades
from veduta.photos.structure import Structure
from veduta.photos.world.georeference import Similarity

MOST_LINES = 2000
BEHIND_M = 1.0
"""A point this far behind a wall that the line enters cannot be seen through it."""
OVER_M = 0.7
"""A line passes over a wall that it meets no lower than this under its top."""
FAR = 3.0
"""Lines longer than this many times the middle one are of points that are not well known."""
_AT_ONCE = 200_000


@dataclass(frozen=True)
class SightLines:
    """Lines from cameras to points, in the structure's own frame.

    centre, point: (n, 3). point_of: (n,) rows of the structure's points. centres: (c, 3) of all
    photos.
    """

    centre: NDArray[np.float64]
    point: NDArray[np.float64]
    point_of: NDArray[np.int64]
    centres: NDArray[np.float64]


@dataclass(frozen=True)
class Violations:
    """blocked: (n,) of the lines. inside: (c,) of the cameras."""

    blocked: NDArray[np.bool_]
    inside: NDArray[np.bool_]

    @property
    def blocked_share(self) -> float:
        """Of the lines."""
        return float(self.blocked.mean()) if len(self.blocked) else 0.0

    @property
    def inside_share(self) -> float:
        """Of the cameras."""
        return float(self.inside.mean()) if len(self.inside) else 0.0


def sight_lines(structure: Structure, seed: int) -> SightLines:
    """Some of the lines, drawn at random."""
    centres = structure.centres()
    starts = centres[structure.image_of]
    ends = structure.points[structure.point_of]
    length = np.linalg.norm(ends - starts, axis=1)
    near = np.flatnonzero(length <= FAR * np.median(length))
    rng = np.random.default_rng(seed)
    rows = np.sort(rng.choice(near, min(MOST_LINES, len(near)), replace=False))
    return SightLines(starts[rows], ends[rows], structure.point_of[rows], centres)


def violations(lines: SightLines, facades: Facades, world_from_model: Similarity) -> Violations:
    """Which lines and cameras cannot be, with the model laid so into the world."""
    start, end = world_from_model.moved(lines.centre), world_from_model.moved(lines.point)
    centres = world_from_model.moved(lines.centres)
    every = np.concatenate([start, end, centres])[:, :2]
    low, high = every.min(axis=0), every.max(axis=0)
    reach = np.maximum(facades.start, facades.end), np.minimum(facades.start, facades.end)
    near = np.flatnonzero(((reach[0] > low) & (reach[1] < high)).all(axis=1))
    blocked = np.zeros(len(start), dtype=bool)
    step = max(1, _AT_ONCE // max(1, len(near)))
    for first in range(0, len(start), step):
        own = slice(first, first + step)
        blocked[own] = _blocked(start[own], end[own], facades, near)
    return Violations(blocked, _inside(centres, facades))


def _blocked(
    start: NDArray[np.float64],
    end: NDArray[np.float64],
    facades: Facades,
    near: NDArray[np.int64],
) -> NDArray[np.bool_]:
    """(n,) lines that enter a building from its front and end well behind that."""
    base, outward = facades.start[near], facades.outward[near]
    along, width = facades.along[near], facades.width[near]
    ahead = np.einsum("nfi,fi->nf", start[:, None, :2] - base, outward)
    behind = np.einsum("nfi,fi->nf", end[:, None, :2] - base, outward)
    enters = (ahead > 0.0) & (behind < -BEHIND_M)
    share = np.where(enters, ahead / np.where(enters, ahead - behind, 1.0), 0.0)
    meets = start[:, None] + share[:, :, None] * (end - start)[:, None]
    place = np.einsum("nfi,fi->nf", meets[..., :2] - base, along)
    on = (place > 0.0) & (place < width) & (meets[..., 2] < facades.top[near] - OVER_M)
    found: NDArray[np.bool_] = (enters & on).any(axis=1)
    return found


def _inside(centres: NDArray[np.float64], facades: Facades) -> NDArray[np.bool_]:
    """(c,) under a roof; where the model has none, within the walls of a building."""
    if len(facades) == 0:
        return np.zeros(len(centres), dtype=bool)
    if facades.roofs is None or len(facades.roofs) == 0:
        return _within_walls(centres, facades)
    flat = facades.roofs[:, :, :2]
    low, high = centres[:, :2].min(axis=0), centres[:, :2].max(axis=0)
    near = ((flat.max(axis=1) >= low) & (flat.min(axis=1) <= high)).all(axis=1)
    roofs = facades.roofs[near]
    inside = np.zeros(len(centres), dtype=bool)
    step = max(1, _AT_ONCE // max(1, len(roofs)))
    for first in range(0, len(centres), step):
        own = slice(first, first + step)
        inside[own] = _under(centres[own], roofs)
    return inside


def _under(centres: NDArray[np.float64], roofs: NDArray[np.float64]) -> NDArray[np.bool_]:
    """(c,) below one of (t, 3, 3) triangles that look up."""
    corner, edge = roofs[:, :, :2], np.roll(roofs, -1, axis=1)[:, :, :2] - roofs[:, :, :2]
    away = centres[:, None, None, :2] - corner
    left = edge[..., 0] * away[..., 1] - edge[..., 1] * away[..., 0]
    below = centres[:, 2, None] < roofs[:, :, 2].max(axis=1)
    found: NDArray[np.bool_] = ((left >= 0.0).all(axis=2) & below).any(axis=1)
    return found


def _within_walls(centres: NDArray[np.float64], facades: Facades) -> NDArray[np.bool_]:
    """(c,) by the even-odd rule in each building, under its top: short walls are no facades, and
    leave gaps through which the rule fails.
    """
    x, y = facades.start.T
    to_x, to_y = facades.end.T
    across = (y <= centres[:, 1, None]) != (to_y <= centres[:, 1, None])
    rise = np.where(to_y == y, 1.0, to_y - y)
    meets = x + (centres[:, 1, None] - y) / rise * (to_x - x)
    hits = across & (meets > centres[:, 0, None])
    buildings = int(facades.building.max()) + 1
    counts = np.zeros((buildings, len(centres)), dtype=np.int64)
    np.add.at(counts, facades.building, hits.T)
    tops = np.full(buildings, -np.inf)
    np.maximum.at(tops, facades.building, facades.top)
    inside = (counts % 2 == 1) & (centres[:, 2] < tops[:, None])
    found: NDArray[np.bool_] = inside.any(axis=0)
    return found
