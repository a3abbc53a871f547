"""Rectangles that lie as tiles do: a lattice on one plane, seen in perspective.

A lattice grows from a rectangle to its neighbours, and its homography is fitted anew each time, as
boards of squares are found for calibration. Every other row may be shifted by half a tile.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal

import cv2
import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from veduta.geometry import homography
from veduta.geometry.homography import Matrix
from veduta.plan.photos.rectangles import Rectangles

Bond = Literal["none", "rows", "columns"]
"""Whether every other row (column) is shifted by half a tile."""
BONDS: tuple[Bond, ...] = ("none", "rows", "columns")

LEAST_TILES = 6
LARGEST_RESIDUAL = 0.06
_SEEDS = 40
_OFF = 0.22
"""How far a neighbour's middle may be from where it is expected, in tiles."""
_CORNER_OFF = 0.3
_ROUNDS = 60
_FITS = 3
_DEGENERATE = 1e-9
_LOOSE = 0.2
_WIDEST_JOINT = 0.4
_FAR = 1e6
_STRAY = 2.5
_NO_STRAY = 0.05
"""A corner that is further off than so many medians, and than this (in tiles), is a stray."""
_MOST_FITTED = 400
"""A lattice that grows is fitted to so many of its tiles; the one that has grown, to all."""
_REACH = 2.5
"""A neighbour's middle is no further off than so many diagonals of a rectangle."""
_BESIDE = np.array([(x, y) for x in (-2, 2) for y in (-1, 0, 1)])
"""From a tile to those at its left and right, in halves of a tile; a bond shifts them."""
_AROUND = np.array([(x, y) for x in (-1, 0, 1) for y in (-1, 0, 1)])
_HERE = np.zeros((1, 2), dtype=np.int64)
_SPAN = 1 << 24
_UNIT = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])


@dataclass(frozen=True)
class Lattice:
    """Tiles on a plane.

    photo_from_tiles: homography; a tile with half of its joints is a unit square, x to the right.
    cells: (n, 2) whole numbers, column and row of each tile. corners_px: (n, 4, 2) of its
    rectangle in the photo. joint: (2,) widths of the joints, in tiles. residual: root mean square
    of the corners, in tiles.
    """

    photo_from_tiles: Matrix
    cells: NDArray[np.int64]
    corners_px: NDArray[np.float64]
    bond: Bond
    joint: NDArray[np.float64]
    residual: float

    def __len__(self) -> int:
        return len(self.cells)

    @property
    def is_tiling(self) -> bool:
        """Whether there are enough of them with neighbours beside and above or below, and they fit.

        A row of railings or doors is no tiling, nor with a stray rectangle above it.
        """
        halves = (2.0 * origins(self.cells, self.bond)).astype(np.int64)
        beside = _has_any(halves, halves, _BESIDE)
        above = _has_any(halves, halves, _BESIDE[:, ::-1])
        return int((beside & above).sum()) >= LEAST_TILES and self.residual <= LARGEST_RESIDUAL


def origins(cells: NDArray[np.int64], bond: Bond) -> NDArray[np.float64]:
    """(n, 2) upper left corners of cells, in tiles."""
    at = cells.astype(np.float64)
    if bond == "rows":
        at[:, 0] += 0.5 * (cells[:, 1] % 2)
    elif bond == "columns":
        at[:, 1] += 0.5 * (cells[:, 0] % 2)
    return at


def find_lattices(rectangles: Rectangles) -> list[Lattice]:
    """Those that are tilings, the one of most tiles first; no rectangle is in two of them."""
    left = np.ones(len(rectangles), dtype=np.bool_)
    tried = np.zeros(len(rectangles), dtype=np.bool_)
    found: list[Lattice] = []
    order = np.argsort(-rectangles.area_px, kind="stable")
    around = _Around(rectangles)
    for _ in range(_SEEDS):
        seeds = order[left[order] & ~tried[order]]
        if len(seeds) < LEAST_TILES:
            break
        seed = int(seeds[len(seeds) // 2])  # neither a wall nor a crumb
        tried[seed] = True
        for bond in BONDS:
            lattice, used = _grown(around, left, seed, bond)
            tried[used] = True
            if lattice is not None and lattice.is_tiling:
                left[used] = False
                found.append(lattice)
                break
    return sorted(found, key=len, reverse=True)


class _Around:
    """Rectangles, and which of them lie near others."""

    def __init__(self, rectangles: Rectangles) -> None:
        self.corners_px = rectangles.corners_px
        self._middles = rectangles.middles_px
        self._tree = cKDTree(self._middles)

    def near(self, rows: NDArray[np.int64]) -> NDArray[np.int64]:
        """The numbers of all that may be neighbours of some, and their own, in order."""
        corners = self.corners_px[rows]
        across = np.linalg.norm(corners[:, :2] - corners[:, 2:], axis=2).max(axis=1)
        found = self._tree.query_ball_point(self._middles[rows], _REACH * across)
        return np.unique(np.concatenate([np.asarray(one, dtype=np.int64) for one in found]))


def _grown(
    around: _Around, free: NDArray[np.bool_], seed: int, bond: Bond
) -> tuple[Lattice | None, NDArray[np.int64]]:
    """The lattice that one rectangle belongs to, and the numbers of its rectangles."""
    used = np.array([seed])
    first = around.corners_px[used]
    near = around.near(used)
    lattice = _fitted(first, np.zeros((1, 2), dtype=np.int64), bond, np.zeros(2))
    if lattice is None:
        return None, used
    for _ in range(_ROUNDS):
        near = np.setdiff1d(near[free[near]], used)
        new = _neighbours(around.corners_px[near], near, lattice)
        if not len(new.rows):
            break
        corners = np.concatenate([lattice.corners_px, new.corners_px])
        cells = np.concatenate([lattice.cells, new.cells])
        wider = _fitted(corners, cells, bond, lattice.joint, _MOST_FITTED)
        if wider is None or wider.residual > LARGEST_RESIDUAL:
            break
        used, lattice = np.concatenate([used, new.rows]), wider
        near = np.union1d(near, around.near(new.rows))
    return _settled(lattice, used)


def _settled(lattice: Lattice, used: NDArray[np.int64]) -> tuple[Lattice | None, NDArray[np.int64]]:
    """Without rectangles that lie otherwise than most: what grew at the edge may be no tile."""
    start = origins(lattice.cells, lattice.bond)
    expected = start[:, None] + _inset(lattice.joint)
    tiles_from_photo = homography.inverse(lattice.photo_from_tiles)
    flat = homography.apply(tiles_from_photo, lattice.corners_px.reshape(-1, 2))
    off = np.linalg.norm(flat.reshape(-1, 4, 2) - expected, axis=2).max(axis=1)
    kept = off <= max(_STRAY * float(np.median(off)), _NO_STRAY)
    fitted = _fitted(lattice.corners_px[kept], lattice.cells[kept], lattice.bond, lattice.joint)
    return None if fitted is None else _by_middles(fitted), used[kept]


def _by_middles(lattice: Lattice) -> Lattice:
    """With the homography of the tiles' middles, where their diagonals meet.

    A contour is as wide far away as near, so that joints seem wider there: corners lie further in,
    on all sides alike. The middles stay where they are.
    """
    if not lattice.is_tiling:
        return lattice
    quads = np.concatenate([lattice.corners_px, np.ones((len(lattice), 4, 1))], axis=2)
    diagonals = np.cross(quads[:, [0, 1]], quads[:, [2, 3]])
    met = np.cross(diagonals[:, 0], diagonals[:, 1])
    middles = met[:, :2] / met[:, 2:]
    model = origins(lattice.cells, lattice.bond) + 0.5
    found, _ = cv2.findHomography(model, middles)
    if found is None or abs(np.linalg.det(found)) < _DEGENERATE:
        return lattice
    return replace(lattice, photo_from_tiles=np.asarray(found, dtype=np.float64))


@dataclass(frozen=True)
class _Neighbours:
    """rows: (n,) of rectangles. cells: (n, 2). corners_px: (n, 4, 2), turned as the lattice's."""

    rows: NDArray[np.int64]
    cells: NDArray[np.int64]
    corners_px: NDArray[np.float64]


def _neighbours(
    corners_px: NDArray[np.float64], numbers: NDArray[np.int64], lattice: Lattice
) -> _Neighbours:
    """Those of some rectangles, by their corners and numbers, that lie beside the lattice's."""
    tiles_from_photo = homography.inverse(lattice.photo_from_tiles)
    corners = homography.apply(tiles_from_photo, corners_px.reshape(-1, 2))
    corners = np.nan_to_num(corners.reshape(-1, 4, 2), nan=_FAR, posinf=_FAR, neginf=-_FAR)
    corners = corners.clip(-_FAR, _FAR)
    cells = _cells_of(corners.mean(axis=1), lattice.bond)
    expected = origins(cells, lattice.bond)[:, None] + _inset(lattice.joint)
    # One rectangle alone knows neither its joints nor much of the perspective.
    loose = _LOOSE if len(lattice) == 1 else 0.0
    turn = _turns(corners, expected)
    off = np.abs(corners.mean(axis=1) - expected.mean(axis=1)).max(axis=1)
    corner_off = np.abs(_turned(corners, turn) - expected).max(axis=(1, 2))
    fits = (off < _OFF + loose) & (corner_off < _CORNER_OFF + loose)
    beside = _has_any(cells, lattice.cells, _AROUND) & ~_has_any(cells, lattice.cells, _HERE)
    rows = np.flatnonzero(fits & beside)
    rows = rows[np.argsort(off[rows], kind="stable")]
    _, first = np.unique(_keys(cells[rows]), return_index=True)  # the one that fits a cell best
    rows = rows[np.sort(first)]
    return _Neighbours(numbers[rows], cells[rows], _turned(corners_px[rows], turn[rows]))


def _has_any(
    of: NDArray[np.int64], cells: NDArray[np.int64], ways: NDArray[np.int64]
) -> NDArray[np.bool_]:
    """(n,) whether any of (m, 2) cells lies one of (k, 2) ways from each of (n, 2)."""
    there = np.isin(_keys(of[:, None] + ways), _keys(cells))
    return np.asarray(there.any(axis=1), dtype=np.bool_)


def _keys(cells: NDArray[np.int64]) -> NDArray[np.int64]:
    """(...) a number of its own for each (..., 2) cell that is less than `_FAR` from the first."""
    keys: NDArray[np.int64] = cells[..., 0] * _SPAN + cells[..., 1]
    return keys


def _cells_of(middles: NDArray[np.float64], bond: Bond) -> NDArray[np.int64]:
    """(n, 2) the cell in which each point of the plane lies, in tiles."""
    cells = np.floor(middles).astype(np.int64)
    if bond == "rows":
        cells[:, 0] = np.floor(middles[:, 0] - 0.5 * (cells[:, 1] % 2))
    elif bond == "columns":
        cells[:, 1] = np.floor(middles[:, 1] - 0.5 * (cells[:, 0] % 2))
    return cells


def _inset(joint: NDArray[np.float64]) -> NDArray[np.float64]:
    """(4, 2) corners of a tile in its cell, without half of a joint on each side."""
    return joint / 2.0 + _UNIT * (1.0 - joint)


def _turns(corners: NDArray[np.float64], expected: NDArray[np.float64]) -> NDArray[np.int64]:
    """(n,) which corner of each (4, 2) is the one that is expected first."""
    turns = np.stack([np.roll(corners, -turn, axis=1) for turn in range(4)])
    best: NDArray[np.int64] = np.abs(turns - expected).sum(axis=(2, 3)).argmin(axis=0)
    return best


def _turned(corners: NDArray[np.float64], turn: NDArray[np.int64]) -> NDArray[np.float64]:
    """Each (4, 2) of (n, 4, 2) begun with another of its corners."""
    order = (np.arange(4) + turn[:, None]) % 4
    found: NDArray[np.float64] = np.take_along_axis(corners, order[..., None], axis=1)
    return found


def _fitted(
    corners_px: NDArray[np.float64],
    cells: NDArray[np.int64],
    bond: Bond,
    joint: NDArray[np.float64],
    most: int | None = None,
) -> Lattice | None:
    """The homography of rectangles in cells, with the joints that fit; None if none does.

    most: how many of them are fitted, from the first to the last evenly; all are measured.
    Joints along a direction are known from the second row on: till then they stay as they are.
    """
    start = origins(cells, bond)
    several = len(cells) > 1
    step = 1 if most is None else -(-len(cells) // most)
    for _ in range(_FITS if several else 1):
        model = start[:, None] + _inset(joint)
        found, _ = cv2.findHomography(
            model[::step].reshape(-1, 2), corners_px[::step].reshape(-1, 2)
        )
        if found is None or abs(np.linalg.det(found)) < _DEGENERATE:
            return None
        matrix = np.asarray(found, dtype=np.float64)
        flat = homography.apply(homography.inverse(matrix), corners_px.reshape(-1, 2))
        flat = flat.reshape(-1, 4, 2)
        residual = float(np.sqrt(((flat - model) ** 2).sum(axis=2).mean()))
        if several:
            inner = flat[:, [1, 2]].mean(axis=1) - flat[:, [0, 3]].mean(axis=1)
            upright = flat[:, [2, 3]].mean(axis=1) - flat[:, [0, 1]].mean(axis=1)
            joint = 1.0 - np.median(np.stack([inner[:, 0], upright[:, 1]], axis=1), axis=0)
            joint = joint.clip(0.0, _WIDEST_JOINT)
    return Lattice(matrix, cells, corners_px, bond, joint, residual)
