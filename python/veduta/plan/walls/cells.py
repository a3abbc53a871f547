"""Cells: connected pieces of paper between lines, how broad and long they are, what lies beside.

The inside of a hollow wall is a cell: narrow, as broad at most places, long.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import cv2
import numpy as np
from numpy.typing import NDArray

NARROW = 0.045
"""Insides of walls are at most so wide, as a share of the drawing's longer side."""

ROOM = 0.06
"""Rooms are at least so wide, as a share of that side; beds and bathtubs may be, too."""

MOST_CELLS = 4000
"""Of more narrow cells the largest are looked at: no house has so many walls."""

TWO_WIDTHS = 2
"""A cell of walls is as broad as one wall at most places, or as one of two: outer and inner."""

SAME_BREADTH = 0.1
"""Breadths of one wall differ by this part, or by a pixel."""

POCKET = 0.2
"""The middle of a cell is at least so deep, as a part of its deepest place."""

ACROSS_LINES = 1.6
"""Cells are neighbours if so many line widths of ink part them at most."""


@dataclass(frozen=True)
class Cells:
    """Cells by their number; 0 is the ink. Lengths in pixels.

    `labels`, `depth` (h, w): each pixel's cell and how far it is from ink. `boxes` (n, 4): left,
    top, width, height. `breadth` (n,): how broad a cell is at most places. `narrow` (n,): whether
    it may be the inside of a wall. `ridges`: for each narrow cell how broad it is along its middle.
    `contacts` (m, 3): two cells that lines part, and how long their common line is.
    """

    labels: NDArray[np.int32]
    depth: NDArray[np.float32]
    boxes: NDArray[np.int32]
    area: NDArray[np.float64]
    breadth: NDArray[np.float64]
    narrow: NDArray[np.bool_]
    room: NDArray[np.bool_]
    ridges: dict[int, NDArray[np.float64]]
    contacts: NDArray[np.int64]

    @cached_property
    def length(self) -> NDArray[np.float64]:
        """(n,) how long each cell is along its middle."""
        return self.area / np.maximum(self.breadth, 1.0)

    @cached_property
    def beside(self) -> dict[int, list[tuple[int, int]]]:
        """For each cell its neighbours, each with the length of the common line."""
        found: dict[int, list[tuple[int, int]]] = {}
        for first, second, length in self.contacts.tolist():
            found.setdefault(first, []).append((second, length))
            found.setdefault(second, []).append((first, length))
        return found

    def points(self, cell: int) -> NDArray[np.float64]:
        """(n, 2) the middles of a cell's pixels."""
        left, top, width, height = self.boxes[cell]
        y, x = np.nonzero(self.labels[top : top + height, left : left + width] == cell)
        # The centre of the upper left pixel is (0.5, 0.5).
        return np.column_stack([x + left, y + top]) + 0.5

    def middle(self, cell: int) -> tuple[NDArray[np.float64], NDArray[np.float64], float, float]:
        """Centre and direction (2,) of the rectangle around a cell, its long and its short side."""
        centre, size, degrees = cv2.minAreaRect(self.points(cell).astype(np.float32))
        turn = np.radians(degrees)
        along = np.array([np.cos(turn), np.sin(turn)])
        if size[0] < size[1]:
            along = np.array([-along[1], along[0]])
        return np.array(centre), along, max(size) + 1.0, min(size) + 1.0

    def widths(self, cell: int) -> tuple[list[float], float]:
        """The one or two breadths that a cell mostly has, and for which part of its middle."""
        return common_values(self.ridges[cell], TWO_WIDTHS)


def common_values(values: NDArray[np.float64], most: int) -> tuple[list[float], float]:
    """Up to `most` values that are the commonest, and the part of all that are near them."""
    rest, found = np.sort(values), list[float]()
    while len(found) < most and len(rest) > 0.1 * len(values):
        near = np.searchsorted(rest, rest + tolerance(rest), "right") - np.searchsorted(
            rest, rest - tolerance(rest), "left"
        )
        first = rest[int(np.argmax(near))]
        best = float(np.median(rest[np.abs(rest - first) <= tolerance(first)]))
        found.append(best)
        rest = rest[np.abs(rest - best) > tolerance(np.array(best))]
    return found, 1.0 - len(rest) / max(1, len(values))


def tolerance(breadth: NDArray[np.float64]) -> NDArray[np.float64]:
    """By how much breadths differ that are one wall's."""
    return np.maximum(1.0, SAME_BREADTH * breadth)


def find_cells(ink: NDArray[np.bool_], line_px: float, cut_px: float | None = None) -> Cells:
    """The cells of an (h, w) mask of lines.

    With `cut_px`, what is narrower than that ends where it opens into what is wider, so that a wall
    whose end is not drawn does not run out into the room.
    """
    paper = (~ink).astype(np.uint8)
    count, labels, stats = _connected(paper) if cut_px is None else _cut(paper, cut_px)
    depth = np.asarray(cv2.distanceTransform(paper, cv2.DIST_L2, 5), np.float32)
    height, width = ink.shape
    boxes, area = stats[:, :4], stats[:, cv2.CC_STAT_AREA].astype(np.float64)
    ridge = (depth > 0) & (depth >= cv2.dilate(depth, np.ones((3, 3), np.uint8)) - 0.05)
    # Pockets of a ragged border are no middle.
    deepest = np.zeros(count, np.float32)
    np.maximum.at(deepest, labels[ridge].astype(np.intp), depth[ridge])
    ridge &= depth > POCKET * deepest[labels]
    extent = longer_side(ink)
    room = deepest > ROOM / 2 * extent
    cell, value = labels[ridge], _broad(depth, ridge)[ridge]
    order = np.lexsort((value, cell))
    cell, value = cell[order], value[order]
    starts = np.searchsorted(cell, np.arange(count + 1))
    size = np.diff(starts)
    breadth = np.zeros(count)
    some = size > 0
    breadth[some] = value[starts[:-1][some] + size[some] // 2]
    narrow = some & (breadth <= NARROW * extent) & (area > breadth**2 / 4)
    narrow &= deepest < NARROW * extent
    narrow[0] = room[0] = False
    # The sheet's border cuts cells: what touches it is paper.
    left, top = boxes[:, 0], boxes[:, 1]
    cut = (left == 0) | (top == 0)
    cut |= (left + boxes[:, 2] == width) | (top + boxes[:, 3] == height)
    narrow &= ~cut
    room |= cut & (np.arange(count) > 0)
    if narrow.sum() > MOST_CELLS:
        narrow &= area >= np.sort(area[narrow])[-MOST_CELLS]
    ridges = {int(one): value[starts[one] : starts[one + 1]] for one in np.flatnonzero(narrow)}
    contacts = _contacts(labels, paper, ACROSS_LINES * line_px / 2 + 1)
    return Cells(labels, depth, boxes, area, breadth, narrow, room, ridges, contacts)


def _broad(depth: NDArray[np.float32], ridge: NDArray[np.bool_]) -> NDArray[np.float64]:
    """(h, w) whole pixels between the lines on both sides of a middle.

    The middle of an odd breadth is one pixel wide, that of an even one two. Taken for one, a wall
    of 8.5 pixels would be 7 wide at one place and 9 at the next.
    """
    even = np.zeros_like(ridge)
    block = ridge[:-1, :-1] & ridge[1:, :-1] & ridge[:-1, 1:] & ridge[1:, 1:]
    for down, right in ((0, 0), (1, 0), (0, 1), (1, 1)):
        even[down : down + block.shape[0], right : right + block.shape[1]] |= block
    return np.asarray(2.0 * depth.astype(np.float64) - 1.0 + even)


def _connected(paper: NDArray[np.uint8]) -> tuple[int, NDArray[np.int32], NDArray[np.int32]]:
    count, labels, stats, _ = cv2.connectedComponentsWithStats(paper, connectivity=4)
    return count, np.asarray(labels, np.int32), np.asarray(stats, np.int32)


def _cut(
    paper: NDArray[np.uint8], cut_px: float
) -> tuple[int, NDArray[np.int32], NDArray[np.int32]]:
    """What is at least so wide, and then what is narrower, each connected by itself."""
    side = 2 * round(cut_px / 2) + 1
    opened = cv2.morphologyEx(paper, cv2.MORPH_OPEN, np.ones((side, side), np.uint8))
    wide = np.asarray(opened, np.uint8)
    rooms, labels, stats = _connected(wide)
    count, rest, more = _connected(paper - wide)
    labels = np.where(rest > 0, rest + np.int32(rooms - 1), labels)
    return rooms + count - 1, labels, np.concatenate([stats, more[1:]])


def longer_side(ink: NDArray[np.bool_]) -> float:
    """Of the rectangle around all ink."""
    rows, columns = np.flatnonzero(ink.any(axis=1)), np.flatnonzero(ink.any(axis=0))
    if len(rows) == 0:
        return 1.0
    return float(max(np.ptp(rows), np.ptp(columns)) + 1)


def _contacts(
    labels: NDArray[np.int32], paper: NDArray[np.uint8], reach_px: float
) -> NDArray[np.int64]:
    """Pairs of cells whose nearest ink is the same, with how much of it.

    Each pixel of ink belongs to the nearest cell; where two cells meet within a line, they touch.
    """
    away, nearest = cv2.distanceTransformWithLabels(
        1 - paper, cv2.DIST_L2, 5, labelType=cv2.DIST_LABEL_PIXEL
    )
    cell_of = np.zeros(int(nearest.max()) + 1, np.int64)
    cell_of[nearest[paper > 0]] = labels[paper > 0]
    owner = cell_of[nearest]
    pairs = []
    for first, second, far in (
        (owner[:, :-1], owner[:, 1:], np.maximum(away[:, :-1], away[:, 1:])),
        (owner[:-1], owner[1:], np.maximum(away[:-1], away[1:])),
    ):
        touch = (first != second) & (far <= reach_px)
        pairs.append(np.column_stack([first[touch], second[touch]]))
    both = np.sort(np.concatenate(pairs), axis=1)
    base = len(cell_of) + int(labels.max()) + 1
    keys, count = np.unique(both[:, 0] * base + both[:, 1], return_counts=True)
    return np.column_stack([keys // base, keys % base, count]).astype(np.int64)
