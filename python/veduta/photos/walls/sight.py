"""What photos saw through a wall: a line through foliage, or between things, is no wall.

Equal windows beside each other are taken for one another: points then seem to lie far behind the
wall, where the lines of sight to the wrong windows meet. From a third place they do not meet, so
that points which are seen from two places alone say nothing where enough are seen from more.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from veduta.photos.structure import Structure
from veduta.photos.walls.wall import Wall

MOST_RAYS = 200_000
SAME_PLACE = 0.01
"""Photos nearer to each other than this part of the typical distance of points are of one place."""
SURE_PLACES, SURE_SHARE = 3, 0.2


@dataclass(frozen=True)
class Sights:
    """r lines of sight, from the photos to the points that they see. eye, point: (r, 3)."""

    eye: NDArray[np.float64]
    point: NDArray[np.float64]


def sights_of(structure: Structure, places: NDArray[np.int64], rng: np.random.Generator) -> Sights:
    """The observations of a structure as lines of sight; of very many, some drawn at random.

    Those of points that are seen from three places; of any where hardly a point is. places: (p,) as
    of `places_of`.
    """
    least = SURE_PLACES if (places >= SURE_PLACES).mean() >= SURE_SHARE else 0
    rows = np.flatnonzero(places[structure.point_of] >= least)
    if len(rows) > MOST_RAYS:
        rows = np.sort(rng.choice(rows, MOST_RAYS, replace=False))
    return _sights(structure, rows)


def _sights(structure: Structure, rows: NDArray[np.int64]) -> Sights:
    return Sights(
        structure.centres()[structure.image_of[rows]], structure.points[structure.point_of[rows]]
    )


def places_of(structure: Structure, reach: float) -> NDArray[np.int64]:
    """(p,) from how many places each point is seen. reach: the typical distance of points."""
    centres = structure.centres()
    # The first photo within reach names the place.
    near = cKDTree(centres).query_ball_point(centres, SAME_PLACE * reach, return_sorted=True)
    place = np.array([np.atleast_1d(rows)[0] for rows in near])
    seen = np.unique(np.stack([structure.point_of, place[structure.image_of]]), axis=1)
    return np.bincount(seen[0], minlength=len(structure.points))


def share_seen_through(wall: Wall, sights: Sights, thickness: float) -> float:
    """Of the lines of sight that meet a wall's rectangle from outside, those that go on behind it.

    0 where none meets it.
    """
    inside, through = _met(wall, sights, thickness)
    return int(through.sum()) / max(1, int(inside.sum()))


def share_hidden(
    wall: Wall, walls: Sequence[Wall], structure: Structure, thickness: float
) -> float:
    """Of all lines of sight to a wall's points, those that go through other walls."""
    rows = np.flatnonzero(np.isin(structure.point_of, wall.point_rows))
    sights = _sights(structure, rows)
    hidden = np.zeros(len(rows), dtype=bool)
    for other in walls:
        hidden |= _met(other, sights, thickness)[1]
    return float(hidden.mean()) if len(rows) else 0.0


def _met(
    wall: Wall, sights: Sights, thickness: float
) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
    """(r,) Which lines of sight meet a wall's rectangle from outside; which go on behind it."""
    before = (sights.eye[:, :2] - wall.start) @ wall.outward
    behind = (sights.point[:, :2] - wall.start) @ wall.outward
    meets = (before > thickness) & (behind < thickness)
    # A line that ends within the thickness ends on the wall: taken where it ends.
    part = np.minimum(1.0, before / np.where(meets, before - behind, 1.0))[:, None]
    place = sights.eye + part * (sights.point - sights.eye)
    along = (place[:, :2] - wall.start) @ wall.along
    inside = meets & (along > 0.0) & (along < wall.width)
    inside &= (place[:, 2] > wall.bottom) & (place[:, 2] < wall.top)
    return inside, inside & (behind < -thickness)
