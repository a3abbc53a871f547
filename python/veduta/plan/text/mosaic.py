"""Cutouts around small marks of a large sheet, laid side by side in few pictures.

What the network costs grows with the area that it sees. Blocks of text are a small part of a large
sheet, but lie all over it: tiles of the sheet that hold them all are mostly empty paper.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import cv2
import numpy as np
from numpy.typing import NDArray

GAP_PX = 32
"""Empty paper between two cutouts, so that nothing reaches from one into the other."""

STEP_PX = 32
"""The network takes pictures whose sides are multiples of this; others it would distort."""

JOINED_PX = 48
"""Marks so near to each other are of one block: letters of a word, and lines below each other."""

MOST_BLOCKS = 300
"""Of a sheet of noise: those with most marks."""

_CELL_PX = 8  # blocks of marks are told on a grid of so many pixels


@dataclass(frozen=True)
class Cutout:
    """`size` (width, height) px of the sheet from `source` (x, y) on; in the mosaic at `target`."""

    source: tuple[int, int]
    target: tuple[int, int]
    size: tuple[int, int]


@dataclass(frozen=True)
class Mosaic:
    """A picture (h, w, 3) of cutouts that do not touch."""

    pixels: NDArray[np.uint8]
    cutouts: tuple[Cutout, ...]

    def in_sheet(self, quads: NDArray[np.float64]) -> NDArray[np.float64]:
        """Quadrangles (n, 4, 2) of the picture in pixels of the sheet.

        Each is moved with the cutout that holds its middle, and cut at its border; those in the
        empty paper between cutouts are left out.
        """
        moved = []
        for one in self.cutouts:
            low, size = np.array(one.target, float), np.array(one.size, float)
            middles = quads.mean(axis=1)
            inside = np.all((middles >= low) & (middles < low + size), axis=1)
            moved.append(np.clip(quads[inside] - low, 0.0, size) + np.array(one.source, float))
        return np.concatenate([np.zeros((0, 4, 2)), *moved])


@dataclass(frozen=True)
class Box:
    """A part of the sheet from `low` up to `high` (x, y), with so many marks in it."""

    low: tuple[int, int]
    high: tuple[int, int]
    marks: int

    @property
    def size(self) -> tuple[int, int]:
        """Width and height."""
        return self.high[0] - self.low[0], self.high[1] - self.low[1]

    @property
    def taken_px2(self) -> int:
        """What it takes of a mosaic, with the gaps beside and below it."""
        return (self.size[0] + GAP_PX) * (self.size[1] + GAP_PX)

    def holds(self, points: NDArray[np.float64]) -> NDArray[np.bool_]:
        """(n,) which of the points (n, 2) lie in it."""
        return np.asarray(np.all((points >= self.low) & (points < self.high), axis=1))


def boxes_of_marks(
    marks: NDArray[np.float64],
    size_px: tuple[int, int],
    margin_px: float,
    least: int,
    most_px: int,
    step: int,
) -> list[Box]:
    """Boxes around the blocks that `least` marks (n, 2) and more form, most marks first.

    Marks within JOINED_PX of each other are of one block, and `margin_px` around it belong to its
    box. Boxes may overlap, where one around both would be larger than the two. A block that is
    larger than `most_px` is divided into boxes of that size, `step` apart. `size_px` is the width
    and height of the sheet.
    """
    bounds = _blocks(marks, size_px, least)
    if not len(bounds):
        return []
    grown = bounds + margin_px * np.array([-1.0, -1.0, 1.0, 1.0])
    pixels = np.clip(np.round(grown), 0, [*size_px, *size_px]).astype(int)
    found = []
    for x0, y0, x1, y1 in _merged(pixels).tolist():
        found += _divided((x0, y0), (x1, y1), marks, most_px, step)
    return sorted(found, key=lambda one: (-one.marks, one.low))


def _blocks(
    marks: NDArray[np.float64], size_px: tuple[int, int], least: int
) -> NDArray[np.float64]:
    """(m, 4) left, top, right and bottom of blocks of marks, at most MOST_BLOCKS of them."""
    shape = [-(-side // _CELL_PX) for side in reversed(size_px)]
    grid = np.zeros(shape, np.uint8)
    cells = np.clip((marks // _CELL_PX).astype(int), 0, [shape[1] - 1, shape[0] - 1])
    grid[cells[:, 1], cells[:, 0]] = 1
    reach = 2 * round(JOINED_PX / 2 / _CELL_PX) + 1
    around = cv2.dilate(grid, np.ones((reach, reach), np.uint8))
    _, labels = cv2.connectedComponents(around, connectivity=8)
    block = labels[cells[:, 1], cells[:, 0]]
    counts = np.bincount(block, minlength=1)
    chosen = np.argsort(-counts, kind="stable")[:MOST_BLOCKS]
    found = [marks[block == one] for one in chosen if counts[one] >= least]
    bounds = [[*some.min(axis=0), *some.max(axis=0)] for some in found]
    return np.array(bounds, dtype=np.float64).reshape(-1, 4)


def _merged(bounds: NDArray[np.int_]) -> NDArray[np.int_]:
    """(m, 4) with one instead of two where it is no larger than both together."""
    place = 0
    while place < len(bounds):
        low = np.minimum(bounds[:, :2], bounds[place, :2])
        high = np.maximum(bounds[:, 2:], bounds[place, 2:])
        both = np.prod(high - low, axis=1)
        area = np.prod(bounds[:, 2:] - bounds[:, :2], axis=1)
        saves = area + area[place] - both
        saves[place] = -1
        other = int(saves.argmax())
        if saves[other] < 0:
            place += 1
            continue
        bounds[place] = [*low[other], *high[other]]
        bounds = np.delete(bounds, other, axis=0)
        place = 0
    return bounds


def _divided(
    low: tuple[int, int],
    high: tuple[int, int],
    marks: NDArray[np.float64],
    most_px: int,
    step: int,
) -> list[Box]:
    """The box, or boxes of `most_px` in it that are `step` apart."""
    found = []
    overlap = most_px - step
    for x in range(low[0], max(low[0] + 1, high[0] - overlap), step):
        for y in range(low[1], max(low[1] + 1, high[1] - overlap), step):
            part = Box((x, y), (min(x + most_px, high[0]), min(y + most_px, high[1])), 0)
            found.append(replace(part, marks=int(part.holds(marks).sum())))
    return found


def mosaics(
    pixels: NDArray[np.uint8], boxes: Sequence[Box], side_px: int, paper: NDArray[np.uint8]
) -> list[Mosaic]:
    """Pictures at most `side_px` wide and high that hold all boxes, none of which is larger.

    `pixels` is the sheet (h, w, 3); `paper` (3,) is the colour between the cutouts. Boxes stand in
    rows, the tallest first.
    """
    rows = _rows(boxes, side_px)
    pages: list[list[Cutout]] = []
    used = side_px
    for row in rows:
        tall = max(box.size[1] for box in row)
        if used + tall > side_px:
            pages.append([])
            used = 0
        x = 0
        for box in row:
            pages[-1].append(Cutout(box.low, (x, used), box.size))
            x += box.size[0] + GAP_PX
        used += tall + GAP_PX
    return [_painted(pixels, page, paper) for page in pages]


def _rows(boxes: Sequence[Box], side_px: int) -> list[list[Box]]:
    """Boxes row by row, each in the first row that has room for it."""
    rows: list[list[Box]] = []
    widths: list[int] = []
    for box in sorted(boxes, key=lambda one: (-one.size[1], one.low)):
        free = (index for index, width in enumerate(widths) if width + box.size[0] <= side_px)
        index = next(free, len(rows))
        if index == len(rows):
            rows.append([])
            widths.append(0)
        rows[index].append(box)
        widths[index] += box.size[0] + GAP_PX
    return rows


def _painted(
    pixels: NDArray[np.uint8], cutouts: Sequence[Cutout], paper: NDArray[np.uint8]
) -> Mosaic:
    high = [max(one.target[axis] + one.size[axis] for one in cutouts) for axis in (0, 1)]
    width, height = (-(-side // STEP_PX) * STEP_PX for side in high)
    picture = np.empty((height, width, 3), np.uint8)
    picture[:] = paper
    for one in cutouts:
        (x, y), (left, top), (wide, tall) = one.source, one.target, one.size
        picture[top : top + tall, left : left + wide] = pixels[y : y + tall, x : x + wide]
    return Mosaic(picture, tuple(cutouts))
