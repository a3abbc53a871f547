"""Walls that go on behind balconies and bays: beside those they are the front itself.

Where balconies stand above each other, their fronts may be taken for the main depth; the wall between
them would then be held for a room behind glass. A wall is told from a room by where it is: at the
depth of the front in the columns beside.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from veduta.drive.build.frame import ColumnFrame, ColumnPoints

Floats = NDArray[np.float64]
Mask = NDArray[np.bool_]
_BESIDE, _ASIDE = 6, 8.0
"""Columns of a piece beside that tell its depth; a column is as far as so many rows."""


@dataclass(frozen=True)
class SetBackParameters:
    """All but shares in metres. nearest_m, farthest_m: of the wall behind the main depth. widest_m:
    of what is built before it, along the path. step_m: the main depth changes by more between two
    pieces. near_m: so near to the wall lies what is of it; lowest_m: over the ground. rows: a
    column shows the wall where it has so many points of it for one of the piece before it. share:
    of what is seen there behind the piece within farthest_m, what must be of that wall; a room's
    walls stand anywhere.
    """

    nearest_m: float = 0.6
    farthest_m: float = 3.0
    widest_m: float = 8.0
    step_m: float = 0.4
    near_m: float = 0.25
    lowest_m: float = 0.5
    share: float = 0.5
    rows: float = 0.15


def find_set_back(
    points: ColumnPoints,
    row: NDArray[np.int64],
    above: NDArray[np.floating],
    main: Floats,
    frame: ColumnFrame,
    parameters: SetBackParameters | None = None,
) -> Floats:
    """(c,) depth of the wall that goes on behind each column's main depth (m), NaN where none does.

    row: (n,) beam of each point, -1: none. above: (n,) over the ground (m). main: (c,) m.
    """
    chosen = parameters or SetBackParameters()
    found = np.full(len(main), np.nan)
    off = points.depth - main[points.column]
    with np.errstate(invalid="ignore"):
        upright = above > chosen.lowest_m
        front = upright & (np.abs(off) < chosen.near_m) & (row >= 0)
        behind = upright & (off > chosen.nearest_m) & (off < chosen.farthest_m)
    for first, last in _pieces(main, chosen.step_m):
        if (last - first) * frame.spacing_m > chosen.widest_m:
            continue
        for depth, onwards in _beside(main, first, last, chosen):
            near = behind & (np.abs(points.depth - depth) < chosen.near_m)
            piece = first, last, onwards
            shows = _grown(points.column, row, front, behind, near, piece, chosen)
            found[shows] = np.where(np.isnan(found[shows]), depth, found[shows])
    return found


def _grown(
    column: NDArray[np.int32], row: NDArray[np.int64], front: Mask, behind: Mask, near: Mask,
    piece: tuple[int, int, bool], chosen: SetBackParameters,
) -> NDArray[np.int64]:  # fmt: skip
    """Columns of a piece that show the wall, from the side on which it is the front. What one sees
    through the windows of a bay lies beyond the bay's edge: there the wall ends.
    """
    first, last, onwards = piece
    here = np.flatnonzero((column >= first) & (column < last) & (row >= 0))
    shape = (int(row[here].max(initial=0)) + 1, last - first)
    place = row[here], column[here] - first
    images = np.zeros((3, *shape), dtype=bool)
    for image, kind in zip(images, (front, behind, near), strict=True):
        image[place] = kind[here]
    if not onwards:
        images = images[:, :, ::-1]
    stands = np.maximum.accumulate(images[0], axis=1)
    free = ~ndimage.binary_dilation(stands, np.ones((3, 1), dtype=bool))
    own, room = (images[2] & free).sum(axis=0), (images[1] & free).sum(axis=0)
    shows = (own >= chosen.rows * images[0].sum(axis=0)) & (own > 0)
    if own[shows].sum() <= chosen.share * room[shows].sum():
        shows[:] = False
    columns = np.flatnonzero(shows)
    return first + columns if onwards else last - 1 - columns


def shown(found: Floats, building: NDArray[np.floating], near_m: float) -> NDArray[np.bool_]:
    """(r, c) pixels whose column's wall goes on behind, and that show that wall or are nearest, up or
    down, to one that does. building: (r, c) measured depths, NaN elsewhere.
    """
    columns = np.flatnonzero(np.isfinite(found))
    result = np.zeros(building.shape, dtype=bool)
    known = np.isfinite(building[:, columns])
    if not known.any():
        return result
    wall = np.abs(building[:, columns] - found[columns]) < near_m
    nearest = ndimage.distance_transform_edt(
        ~known, sampling=(1.0, _ASIDE), return_distances=False, return_indices=True
    )
    result[:, columns] = wall[tuple(nearest)]
    return result


def _beside(main: Floats, first: int, last: int, chosen: SetBackParameters) -> list[tuple[float, bool]]:
    """Depths of the fronts that go on to the left (True) and to the right, behind this one."""
    own = float(np.nanmedian(main[first:last]))
    found: list[tuple[float, bool]] = []
    sides = (main[max(first - _BESIDE, 0) : first], True), (main[last : last + _BESIDE], False)
    for beside, onwards in sides:
        if np.isfinite(beside).any():
            depth = float(np.nanmedian(beside))
            if chosen.nearest_m < depth - own < chosen.farthest_m:
                found.append((depth, onwards))
    return found


def _pieces(main: Floats, step_m: float) -> list[tuple[int, int]]:
    """First and one past the last column of pieces without a step."""
    with np.errstate(invalid="ignore"):
        cuts = np.flatnonzero(~(np.abs(np.diff(main)) < step_m)) + 1
    ends = [0, *cuts.tolist(), len(main)]
    return [(a, b) for a, b in zip(ends[:-1], ends[1:], strict=True) if np.isfinite(main[a])]
