"""Photos that a model puts in one place although what is around the building differs.

From one place two photos show the same, whatever its depth: no model of it is needed. So features
are compared as they are, turned from one photo into the other, also those that no point of the
model comes from: of surroundings that a folded model tears apart few do. (Missing correspondences:
Zach, Irschara and Bischof, CVPR 2008.)
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

import numpy as np
import pycolmap
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from veduta.photos.cameras.folding import undistorts
from veduta.photos.mapping.conflicts import GRID, ClosePair, cell_numbers
from veduta.photos.mapping.votes import Matched, Pair
from veduta.photos.structure import Structure

SAME_DEG = 2.0
"""Angle between the rays to what both see up to which two photos stand in one place."""
AHEAD = 0.035
"""Way along the view as a share of how far off that is, up to which they do: what `SAME_DEG` allows
to the side. Who goes ahead sees all under small angles and, at the rim, other things."""
ALONG = 0.9
"""Cosine, in the middle of all photos, between the view and the way to the nearest other place from
which on photos go ahead. Around a building that is folded they go to the side.
"""
STILL = 0.03
"""Share of the longer side of a photo by which what matches may move from one to the other in the
middle: where it moves more they do not stand in one place, whatever the model says."""
ENOUGH = 6
"""Features of each of the photos that say something of a cell."""
FEW_SHARED = 0.1
"""In a cell that differs fewer than this share of them match."""
SHARED = 4
"""Matches of a cell from which on it agrees."""
DIFFERS = 0.2
"""Share of the cells that differ from which on the places do. Rendered towers with four equal sides
on which this was found: false pairs 0.24 and more; no true pair stands in one place there."""
FEWEST = 5
"""Cells that must differ, besides."""


def different_places(
    structure: Structure, close: Iterable[ClosePair], matched: Matched
) -> frozenset[Pair]:
    """The pairs (image ids) that a model puts in one place, and that show different ones.

    `close` are pairs of photos of this structure.
    """
    near = [one.ids for one in close if one.apart_deg <= SAME_DEG]
    if not near:
        return frozenset()
    row_of = {image: row for row, image in enumerate(structure.image_ids)}
    repeated = _repeated(matched)
    found = []
    for pair in near:
        rows = (row_of[pair[0]], row_of[pair[1]])
        differing, telling = _compared(structure, rows, pair, matched, repeated)
        if differing >= max(FEWEST, DIFFERS * telling):
            found.append((pair, rows))
    if not found or not _goes_ahead(structure):
        return frozenset(pair for pair, _ in found)
    seen = _seen_points(structure, sorted({row for _, rows in found for row in rows}))
    return frozenset(pair for pair, rows in found if _ahead(structure, rows, seen) <= AHEAD)


def _goes_ahead(structure: Structure) -> bool:
    """Whether photos were taken on a way along their views, as from the front of a vehicle."""
    centres, views = structure.centres(), structure.cam_from_world[:, 2, :3]
    places, place = np.unique(centres, axis=0, return_inverse=True)
    if len(places) < 2:
        return False
    nearest = np.asarray(cKDTree(places).query(places, k=2)[1])[:, 1]
    way = places[nearest[place.ravel()]] - centres
    along = np.abs((way * views).sum(axis=1)) / np.linalg.norm(way, axis=1)
    return bool(np.median(along) >= ALONG)


def _seen_points(structure: Structure, rows: Sequence[int]) -> dict[int, NDArray[np.int64]]:
    """The points (rows) that some of the photos see, by the row of the photo."""
    wanted = np.zeros(len(structure.image_ids), dtype=bool)
    wanted[rows] = True
    kept = wanted[structure.image_of]
    photo_of, points = structure.image_of[kept], structure.point_of[kept]
    order = np.argsort(photo_of, kind="stable")
    photo_of, points = photo_of[order], points[order]
    return {row: points[slice(*np.searchsorted(photo_of, (row, row + 1)))] for row in rows}


def _ahead(
    structure: Structure, rows: tuple[int, int], seen: Mapping[int, NDArray[np.int64]]
) -> float:
    """How far the second photo (rows) was taken before or behind the first, along its view, as a
    share of the middle distance of what both see; 0 where they see nothing together.

    seen: the points that each of them sees.
    """
    first, second = rows
    both = structure.points[np.intersect1d(seen[first], seen[second])]
    if not len(both):
        return 0.0
    places, view = structure.centres()[[first, second]], structure.cam_from_world[first, 2, :3]
    off = float(np.median(np.linalg.norm(both - places[0], axis=1)))
    return abs(float(view @ (places[1] - places[0]))) / max(off, 1e-12)


def _repeated(matched: Matched) -> dict[int, NDArray[np.int64]]:
    """In how many pairs each feature of a photo matches, by its id."""
    counts = {
        image: np.zeros(len(px), dtype=np.int64) for image, px in matched.keypoints_px.items()
    }
    for pair, rows in matched.matches.items():
        for side, image in enumerate(pair):
            counts[image][np.unique(rows[:, side])] += 1
    return counts


def _compared(
    structure: Structure,
    rows: Sequence[int],
    pair: Pair,
    matched: Matched,
    repeated: dict[int, NDArray[np.int64]],
) -> tuple[int, int]:
    """Cells of the first photo that differ in the second, and that say something.

    Nothing is said where what matches moves. Only features that are found again in a third photo
    count: others say nothing by missing.
    """
    matches = matched.matches.get(pair, np.empty((0, 2), dtype=np.int64))
    places = [
        matched.keypoints_px[pair[0]],
        _turned_px(structure, rows, matched.keypoints_px[pair[1]]),
    ]
    camera = structure.camera(rows[0])
    moved = np.linalg.norm(places[0][matches[:, 0]] - places[1][matches[:, 1]], axis=1)
    if not len(moved) or not np.median(moved) <= STILL * max(camera.width, camera.height):
        return 0, 0
    own = []
    for side, image in enumerate(pair):
        others = repeated[image].copy()
        others[np.unique(matches[:, side])] -= 1
        own.append(_counts(camera, places[side][others > 0]))
    shared = _counts(camera, places[0][matches[:, 0]])
    least = np.minimum(*own)
    differing = (least >= ENOUGH) & (shared < FEW_SHARED * least)
    return int(differing.sum()), int((differing | (shared >= SHARED)).sum())


def _turned_px(
    structure: Structure, rows: Sequence[int], keypoints_px: NDArray[np.float64]
) -> NDArray[np.float64]:
    """(k, 2) where the first photo would show the features of the second.

    NaN behind it, and where its lens folds over.
    """
    first, second = (structure.cam_from_world[row][:, :3] for row in rows)
    flat = np.asarray(structure.camera(rows[1]).cam_from_img(keypoints_px))
    rays = np.column_stack([flat, np.ones(len(flat))]) @ second @ first.T
    found = np.full((len(rays), 2), np.nan)
    camera, ahead = structure.camera(rows[0]), rays[:, 2] > 0
    places = np.asarray(camera.img_from_cam(rays[ahead]))
    places[~undistorts(camera, rays[ahead], places)] = np.nan
    found[ahead] = places
    return found


def _counts(camera: pycolmap.Camera, places: NDArray[np.float64]) -> NDArray[np.int64]:
    """(GRID²,) how many places lie in each cell of a photo."""
    inside = ((places >= 0) & (places < (camera.width, camera.height))).all(axis=1)
    counts: NDArray[np.int64] = np.bincount(
        cell_numbers(camera, places[inside]), minlength=GRID * GRID
    )
    return counts
