"""Photos that a model puts in one place although each shows what the other does not.

A building with equal sides is folded: the photos of one side come to lie on those of another, for
the facade agrees. What is beside it does not: two photos from nearly the same place, which should
show the same, each have points in the same part of the picture that the other lacks. These
conflicting observations are those of Heinly, Dunn and Frahm (Correcting for duplicate scene
structure in sparse 3D reconstruction, ECCV 2014), counted here in the cells of a grid instead of
superpixels.

A point that the other photo would see from another side says nothing: from 30 degrees on SIFT loses
an honest surface, too.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pycolmap
from numpy.typing import NDArray

from veduta.photos.cameras.folding import undistorts
from veduta.photos.structure import Structure

WIDEST_DEG = 20.0
"""Angle between the rays to a point up to which two photos must both show it."""
LARGEST_ZOOM = 1.6
"""Ratio of the distances to what both see up to which they must."""
GRID = 8
"""Cells along the longer side of a photo."""
ENOUGH = 4
"""Points that say something of a cell."""
FEW_SHARED = 0.1
"""In a conflict fewer than this share of the points of a cell are seen by both."""
BEHIND = 1.2
"""What is so much further off than all that the other photo sees there may be hidden from it."""
FEWEST_SHARED = 15
"""Points that both must see for their places to be compared."""


@dataclass(frozen=True)
class ClosePair:
    """Two photos (image ids) that a model puts near each other.

    cells: parts of the two pictures that say something. conflicting: those of them where each
    shows what the other lacks. apart_deg: the median angle between the rays to what both see.
    """

    first: int
    second: int
    apart_deg: float
    cells: int
    conflicting: int

    @property
    def ids(self) -> tuple[int, int]:
        """The two image ids, the lesser first."""
        return (min(self.first, self.second), max(self.first, self.second))

    @property
    def share(self) -> float:
        """Share of the cells that conflict."""
        return self.conflicting / max(1, self.cells)


def close_pairs(structure: Structure) -> list[ClosePair]:
    """All pairs of a model that are near enough to be compared, in the order of their ids."""
    seen = _points_seen(structure)
    shared = _shared_counts(structure, seen)
    centres = structure.centres()
    found = []
    for first, second in np.argwhere(np.triu(shared >= FEWEST_SHARED, 1)).tolist():
        both = np.intersect1d(seen[first], seen[second], assume_unique=True)
        rays = [structure.points[both] - centres[row] for row in (first, second)]
        apart = float(np.median(_angles_deg(rays[0], rays[1])))
        reach = [float(np.median(np.linalg.norm(ray, axis=1))) for ray in rays]
        if apart > WIDEST_DEG or max(reach) > LARGEST_ZOOM * min(reach):
            continue
        ways = [
            _conflicts(structure, [seen[a], seen[b]], centres[[a, b]], both, b)
            for a, b in ((first, second), (second, first))
        ]
        ids = (structure.image_ids[first], structure.image_ids[second])
        found.append(
            ClosePair(*ids, apart, ways[0][0] + ways[1][0], ways[0][1] + ways[1][1]),
        )
    return found


def _points_seen(structure: Structure) -> list[NDArray[np.int64]]:
    """The points that each photo sees, sorted and once each."""
    return [
        np.unique(structure.point_of[structure.image_of == row])
        for row in range(len(structure.image_ids))
    ]


def _shared_counts(structure: Structure, seen: list[NDArray[np.int64]]) -> NDArray[np.int64]:
    """(n, n) how many points two photos both see."""
    count = len(seen)
    shared = np.zeros((count, count), dtype=np.int64)
    for row, own in enumerate(seen):
        sees = np.zeros(len(structure.points), dtype=bool)
        sees[own] = True
        hits = structure.image_of[sees[structure.point_of]]
        shared[row] = np.bincount(hits, minlength=count)
    return shared


def _angles_deg(first: NDArray[np.float64], second: NDArray[np.float64]) -> NDArray[np.float64]:
    """(n,) the angles between rays (n, 3) to the same points."""
    lengths = np.linalg.norm(first, axis=1) * np.linalg.norm(second, axis=1)
    cosines = (first * second).sum(axis=1) / np.maximum(lengths, 1e-12)
    return np.asarray(np.rad2deg(np.arccos(np.clip(cosines, -1.0, 1.0))))


def _conflicts(
    structure: Structure,
    seen: list[NDArray[np.int64]],
    centres: NDArray[np.float64],
    both: NDArray[np.int64],
    row: int,
) -> tuple[int, int]:
    """Cells of a photo's picture that say something, and that conflict.

    seen, centres: of the other photo and of this one. In a conflict both have points of their own
    there, which the other would see from nearly the same side and not hidden behind what is there,
    and hardly any point is shared.
    """
    theirs, own = (np.setdiff1d(seen[way], seen[1 - way], assume_unique=True) for way in (0, 1))
    all_cells, all_depths = cells_of(structure, seen[1], row)
    furthest = np.zeros(GRID * GRID)
    np.maximum.at(furthest, all_cells, all_depths)
    their_cells, their_depths = cells_of(structure, _alike(structure, theirs, centres), row)
    visible = their_depths <= BEHIND * furthest[their_cells]
    alone, lacking, shared = (
        np.bincount(cells, minlength=GRID * GRID)
        for cells in (
            cells_of(structure, _alike(structure, own, centres), row)[0],
            their_cells[visible],
            cells_of(structure, both, row)[0],
        )
    )
    torn = (alone >= ENOUGH) & (lacking >= ENOUGH)
    torn &= shared < FEW_SHARED * np.minimum(alone, lacking)
    return int((torn | (shared >= ENOUGH)).sum()), int(torn.sum())


def _alike(
    structure: Structure, points: NDArray[np.int64], centres: NDArray[np.float64]
) -> NDArray[np.int64]:
    """Those of the points that two photos see, or would see, from nearly the same side."""
    rays = [structure.points[points] - centre for centre in centres]
    return points[_angles_deg(rays[0], rays[1]) <= WIDEST_DEG]


def cells_of(
    structure: Structure, points: NDArray[np.int64], row: int
) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
    """Cell (k,) and depth (k,) of those of the points that come to lie within a photo."""
    _, cells, depths = within(structure, points, row)
    return cells, depths


def within(
    structure: Structure, points: NDArray[np.int64], row: int
) -> tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.float64]]:
    """Those of the points (k,) that come to lie within a photo, with the cell and depth of each."""
    camera, pose = structure.camera(row), structure.cam_from_world[row]
    local = structure.points[points] @ pose[:, :3].T + pose[:, 3]
    points, local = points[local[:, 2] > 0], local[local[:, 2] > 0]
    places = camera.img_from_cam(local)
    inside = ((places >= 0) & (places < (camera.width, camera.height))).all(axis=1)
    inside[inside] = undistorts(camera, local[inside], places[inside])
    return points[inside], cell_numbers(camera, places[inside]), local[inside, 2]


def cell_numbers(camera: pycolmap.Camera, places: NDArray[np.float64]) -> NDArray[np.int64]:
    """(k,) the cell of each of (k, 2) places within a camera's photo."""
    across = (places / (max(camera.width, camera.height) / GRID)).astype(np.int64)
    numbers: NDArray[np.int64] = across[:, 1] * GRID + across[:, 0]
    return numbers
