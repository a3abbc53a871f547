"""What photos saw through a wall: a line through foliage, or between things, is no wall."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.photos.structure import Structure
from veduta.photos.walls.wall import Wall

MOST_RAYS = 200_000


@dataclass(frozen=True)
class Sights:
    """r lines of sight, from the photos to the points that they see. eye, point: (r, 3)."""

    eye: NDArray[np.float64]
    point: NDArray[np.float64]


def sights_of(structure: Structure, rng: np.random.Generator) -> Sights:
    """The observations of a structure as lines of sight; of very many, some drawn at random."""
    rows = np.arange(len(structure.point_of))
    if len(rows) > MOST_RAYS:
        rows = np.sort(rng.choice(rows, MOST_RAYS, replace=False))
    return Sights(
        structure.centres()[structure.image_of[rows]], structure.points[structure.point_of[rows]]
    )


def share_seen_through(wall: Wall, sights: Sights, thickness: float) -> float:
    """Of the lines of sight that meet a wall's rectangle from outside, those that go on behind it.

    0 where none meets it.
    """
    before = (sights.eye[:, :2] - wall.start) @ wall.outward
    behind = (sights.point[:, :2] - wall.start) @ wall.outward
    meets = (before > thickness) & (behind < thickness)
    eye, point = sights.eye[meets], sights.point[meets]
    before, behind = before[meets], behind[meets]
    # A line that ends within the thickness ends on the wall: taken where it ends.
    part = np.minimum(1.0, before / (before - behind))[:, None]
    place = eye + part * (point - eye)
    along = (place[:, :2] - wall.start) @ wall.along
    inside = (along > 0.0) & (along < wall.width)
    inside &= (place[:, 2] > wall.bottom) & (place[:, 2] < wall.top)
    through = int((behind[inside] < -thickness).sum())
    return through / max(1, int(inside.sum()))
