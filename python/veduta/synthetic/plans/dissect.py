"""A rectangle dissected into cells: bands along a corridor, or cuts of what is largest."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from veduta.synthetic.plans.house import Point, Use

SLANT_SHARE = 0.12
CURVED_SHARE = 0.05
STAIRS_M = (1.1, 2.2)
SMALL_ROOM_M = 1.6


@dataclass(frozen=True)
class Cell:
    """A room to be: its outline by wall centre lines, counter-clockwise.

    `bulges[i]` is that of the side from corner i to the next (`house.Wall`).
    """

    corners: tuple[Point, ...]
    bulges: tuple[float, ...]
    use: Use | None = None


@dataclass(frozen=True)
class Box:
    """An upright rectangle in metres."""

    left: float
    bottom: float
    right: float
    top: float

    @property
    def width(self) -> float:
        """From left to right."""
        return self.right - self.left

    @property
    def height(self) -> float:
        """From bottom to top."""
        return self.top - self.bottom


def cell(box: Box, use: Use | None = None) -> Cell:
    """A rectangular cell."""
    corners = (
        (box.left, box.bottom), (box.right, box.bottom),
        (box.right, box.top), (box.left, box.top),
    )  # fmt: skip
    return Cell(corners, (0.0,) * 4, use)


@dataclass(frozen=True)
class Widening:
    """A house made larger where its stairs stand: they need more room than was drawn for them.

    What is at x in 0..`stairs.right` is stretched to `right`, what is farther is moved; so is what
    lies above `stairs.bottom` on the page. Nothing else changes, and nothing gets smaller.
    """

    stairs: Box
    right: float
    top: float

    def cell(self, one: Cell) -> Cell:
        """The same cell in the larger house."""
        return Cell(tuple(self._point(corner) for corner in one.corners), one.bulges, one.use)

    def _point(self, at: Point) -> Point:
        old = self.stairs
        x = _stretched(at[0], old.left, old.right, self.right)
        return x, _stretched(at[1], old.bottom, old.top, self.top)


def _stretched(at: float, start: float, end: float, to: float) -> float:
    if at <= start:
        return at
    if at >= end:
        return round(at + to - end, 2)
    return round(start + (at - start) * (to - start) / (end - start), 2)


def steps(
    rng: np.random.Generator, low: float, high: float, least: float, most: float
) -> list[float]:
    """Places from low to high that part it into pieces of about least to most metres."""
    places = [low]
    while high - places[-1] > most:
        rest = high - places[-1]
        places.append(round(places[-1] + rng.uniform(least, min(most, rest - least)), 2))
    return [*places, high]


def cut(rng: np.random.Generator, box: Box, least: float, most: float) -> list[Cell]:
    """The box in cells of at most `most` metres a side, the longer side cut first.

    The last cut of a pair of cells is slanted or curved now and then.
    """
    wide = box.width >= box.height
    size = box.width if wide else box.height
    if size <= most or size < 2 * least:
        return [cell(box)]
    place = round((box.left if wide else box.bottom) + size * rng.uniform(0.36, 0.64), 2)
    last = size <= 1.6 * most and min(box.width, box.height) <= most
    if last and rng.random() < SLANT_SHARE + CURVED_SHARE:
        return _uneven(rng, box, place, wide)
    if wide:
        first = Box(box.left, box.bottom, place, box.top)
        second = Box(place, box.bottom, box.right, box.top)
    else:
        first = Box(box.left, box.bottom, box.right, place)
        second = Box(box.left, place, box.right, box.top)
    return [*cut(rng, first, least, most), *cut(rng, second, least, most)]


def _uneven(rng: np.random.Generator, box: Box, place: float, wide: bool) -> list[Cell]:
    """Two cells with a slanted or a curved wall between them."""
    curved = rng.random() < CURVED_SHARE / (SLANT_SHARE + CURVED_SHARE)
    shift = 0.0 if curved else round(rng.uniform(0.3, 0.6) * rng.choice([-1, 1]), 2)
    bulge = round(rng.uniform(0.15, 0.3) * rng.choice([-1, 1]), 3) if curved else 0.0
    b = box
    if wide:
        low, high = (round(place - shift, 2), b.bottom), (round(place + shift, 2), b.top)
        first = ((b.left, b.bottom), low, high, (b.left, b.top))
        second = (low, (b.right, b.bottom), (b.right, b.top), high)
        return [Cell(first, (0.0, bulge, 0.0, 0.0)), Cell(second, (0.0, 0.0, 0.0, -bulge))]
    low, high = (b.left, round(place - shift, 2)), (b.right, round(place + shift, 2))
    first = ((b.left, b.bottom), (b.right, b.bottom), high, low)
    second = (low, high, (b.right, b.top), (b.left, b.top))
    return [Cell(first, (0.0, 0.0, bulge, 0.0)), Cell(second, (-bulge, 0.0, 0.0, 0.0))]


def band(rng: np.random.Generator, box: Box, door_below: bool, spare: Box | None) -> list[Cell]:
    """A row of rooms along a corridor; `door_below` says that the corridor lies below it.

    `spare` is a piece at the box's left that is taken (the stairs).
    """
    left = spare.right if spare else box.left
    places = steps(rng, left, box.right, 1.7, 4.6)
    cells: list[Cell] = []
    for start, end in pairwise(places):
        piece = Box(start, box.bottom, end, box.top)
        if piece.height > 3.4 and 1.7 <= piece.width <= 3.4 and rng.random() < 0.4:
            share = rng.uniform(0.4, 0.6)
            at = round(piece.bottom + share * piece.height, 2)
            cells += [cell(Box(start, box.bottom, end, at)), cell(Box(start, at, end, box.top))]
        elif piece.width > 3.6 and piece.height > 3.2 and rng.random() < 0.3:
            cells += _with_closet(rng, piece, door_below)
        else:
            cells.append(cell(piece))
    return cells


def _with_closet(rng: np.random.Generator, box: Box, door_below: bool) -> list[Cell]:
    """A room with a closet cut out of the corner at its back and right: an L."""
    wide, deep = round(rng.uniform(1.3, 1.8), 2), round(rng.uniform(0.9, 1.4), 2)
    b, x = box, round(box.right - wide, 2)
    if door_below:
        y = round(b.top - deep, 2)
        outline = (
            (b.left, b.bottom),
            (b.right, b.bottom),
            (b.right, y),
            (x, y),
            (x, b.top),
            (b.left, b.top),
        )
        closet = cell(Box(x, y, b.right, b.top), "wardrobe")
    else:
        y = round(b.bottom + deep, 2)
        outline = (
            (b.left, b.bottom),
            (x, b.bottom),
            (x, y),
            (b.right, y),
            (b.right, b.top),
            (b.left, b.top),
        )
        closet = cell(Box(x, b.bottom, b.right, y), "wardrobe")
    return [Cell(outline, (0.0,) * 6), closet]


def corridor_cells(
    rng: np.random.Generator, box: Box, corridor: Box, stairs: Box | None, hall: bool
) -> list[Cell]:
    """Rooms above and below a corridor; the stairs stand at the left of the band above it."""
    above = Box(box.left, corridor.top, box.right, box.top)
    below = Box(box.left, box.bottom, box.right, corridor.bottom)
    cells = [cell(corridor, "hall" if hall else "corridor")]
    if stairs:
        cells.append(cell(stairs, "stairs"))
        if stairs.top < above.top:
            cells.append(cell(Box(stairs.left, stairs.top, stairs.right, above.top)))
    cells += band(rng, above, True, stairs)
    cells += band(rng, below, False, None)
    if corridor.left > box.left:
        cells.append(cell(Box(box.left, corridor.bottom, corridor.left, corridor.top)))
    if corridor.right < box.right:
        cells.append(cell(Box(corridor.right, corridor.bottom, box.right, corridor.top)))
    return cells
