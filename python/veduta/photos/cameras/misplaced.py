"""Photos that a model puts where they would show much that they do not.

A window or a door that several buildings share is enough to place a photo before the wrong one:
what agrees is consistent in itself, and no other photo need contradict it. What is missing does
(Zach, Irschara and Bischof, What can missing correspondences tell us about 3D structure and
motion?, CVPR 2008): from its place the photo would see points that others see from the same side,
and does not.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from veduta.photos.mapping.conflicts import GRID, LARGEST_ZOOM, WIDEST_DEG, cells_of, within
from veduta.photos.structure import Structure

ENOUGH = 8
"""Points that should be seen in a cell of a photo for it to say something."""
EMPTY = 0.1
"""A cell with fewer than this share of them is empty."""
FEWEST_CELLS = 5
"""Cells that must be empty, at least."""
MISPLACED = 0.5
"""Share of the cells that are empty from which on a photo is misplaced. Rendered streets: false
photos 0.77, true ones at most 0.25; fountain-P11, lund-door: at most 0.03."""


def without_misplaced(structure: Structure) -> tuple[Structure, tuple[str, ...]]:
    """The same without photos that are misplaced.

    A photo of a rig is where the others of its frame say. Where fewer than two would be left all
    stay: then the second names those that are misplaced.
    """
    frame, shares = structure.by_frame(), np.array(empty_shares(structure))
    least = np.full(frame.max() + 1, np.inf)
    np.minimum.at(least, frame, shares)
    return structure.without_doubtful(least[frame] >= MISPLACED)


def empty_shares(structure: Structure) -> NDArray[np.float64]:
    """(n,) the share of each photo's cells in which it lacks what it should show.

    A point counts by how often photos that should show it do: of what lies far off at a grazing
    angle, as in the upper part of an oblique photo from the air, few are found again in any photo.
    0 where too few cells are empty to say something.
    """
    centres = structure.centres()
    rows = range(len(structure.names))
    own = [np.unique(structure.point_of[structure.image_of == row]) for row in rows]
    wanted = [within(structure, expected(structure, centres, row), row)[:2] for row in rows]
    seen = np.zeros(len(structure.points))
    asked = np.zeros(len(structure.points))
    for row in rows:
        seen[own[row]] += 1.0
        asked[np.union1d(own[row], wanted[row][0])] += 1.0
    shares = np.zeros(len(structure.names))
    for row in rows:
        others = seen.copy()
        others[own[row]] -= 1.0
        found_again = others / np.maximum(asked - 1.0, 1.0)
        points, cells = wanted[row]
        should = np.bincount(cells, weights=found_again[points], minlength=GRID * GRID)
        here = np.bincount(cells_of(structure, own[row], row)[0], minlength=GRID * GRID)
        telling = should >= ENOUGH
        empty = telling & (here < EMPTY * should)
        if empty.sum() >= FEWEST_CELLS:
            shares[row] = empty.sum() / telling.sum()
    return shares


def expected(structure: Structure, centres: NDArray[np.float64], row: int) -> NDArray[np.int64]:
    """The points that another photo sees from the side and the distance that this one would."""
    other = structure.image_of != row
    points = structure.point_of[other]
    rays = structure.points[points] - centres[row]
    theirs = structure.points[points] - centres[structure.image_of[other]]
    far, their_far = np.linalg.norm(rays, axis=1), np.linalg.norm(theirs, axis=1)
    cosines = (rays * theirs).sum(axis=1) / np.maximum(far * their_far, 1e-12)
    alike = cosines >= np.cos(np.deg2rad(WIDEST_DEG))
    alike &= np.maximum(far, their_far) <= LARGEST_ZOOM * np.minimum(far, their_far)
    return np.unique(points[alike])
