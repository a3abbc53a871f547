"""The paper of a sheet in pieces that lines and walls part, and which of them are of one room."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray
from shapely.geometry import Polygon

MARGIN = 4
"""Paper around the sheet, in pixels."""

COUNTER = 0.1
"""Furniture and strips at a room's outline cover at most this part of what its paper does."""

IN_BOX, BROAD = 0.9, 1.5
"""Strips along an outline lie in its room's box for so much, and are in so many thin walls'
thicknesses deep somewhere."""

SWEPT = 1.15
"""Arcs of doors part from a room what is at most so many times as wide as a door."""

Mask = NDArray[np.bool_]


@dataclass(frozen=True)
class Raster:
    """A sheet with a margin of MARGIN px: paper, how far it is from the outdoors and from walls.

    `free` (h, w): the number of each pixel's piece of paper, of `count`; 0 on lines and walls, and
    `outside` around the house. `outdoors`, `walls` (h, w): how far a pixel is from there.
    """

    free: NDArray[np.int32]
    count: int
    outside: int
    outdoors: NDArray[np.float32]
    walls: NDArray[np.float32]


def raster_of(bodies: Sequence[Polygon], drawn: Mask, shut_px: int = 3) -> Raster:
    """Of what is drawn on a sheet (h, w), and of the bodies of walls, their openings closed.

    Gaps between lines that are narrower than `shut_px` are closed.
    """
    solid = np.zeros((drawn.shape[0] + 2 * MARGIN, drawn.shape[1] + 2 * MARGIN), np.uint8)
    for body in bodies:
        corners = np.round(np.asarray(body.exterior.coords) - 0.5 + MARGIN).astype(np.int32)
        cv2.fillPoly(solid, [corners], 1)
    # One can go all around, whatever is drawn at the border.
    border = np.ones(solid.shape, np.bool_)
    border[MARGIN:-MARGIN, MARGIN:-MARGIN] = False
    solid[border] = 0
    lines = solid.copy()
    lines[MARGIN:-MARGIN, MARGIN:-MARGIN] |= drawn.astype(np.uint8)
    lines = cv2.morphologyEx(lines, cv2.MORPH_CLOSE, np.ones((shut_px, shut_px), np.uint8))
    lines[border] = 0
    count, free = cv2.connectedComponents(1 - lines, connectivity=4)
    outside = int(free[0, 0])
    away = cv2.distanceTransform((free != outside).astype(np.uint8), cv2.DIST_L2, 5)
    from_walls = cv2.distanceTransform(1 - solid, cv2.DIST_L2, 5)
    return Raster(
        np.asarray(free), count, outside,
        np.asarray(away, np.float32), np.asarray(from_walls, np.float32),
    )  # fmt: skip


def with_sweeps(room: Mask, raster: Raster, door_px: float) -> Mask:
    """A room with what leaves of doors sweep in it, which their arcs part from its paper."""
    size = 2 * max(1, round(SWEPT * door_px / 2)) + 1
    wide = np.pad(room.astype(np.uint8), size)
    shut = cv2.morphologyEx(wide, cv2.MORPH_CLOSE, np.ones((size, size), np.uint8))
    whole = shut[size:-size, size:-size].astype(np.bool_) & (raster.walls > 0)
    whole &= (raster.free != raster.outside) | room
    return _largest_of(whole, room)


def with_strips(room: Mask, raster: Raster, thin_px: float) -> Mask:
    """A room with what lines part from it at its outline: where a roof is low, say.

    Such a strip lies within the room's length and breadth, and is broader than what lies between
    the lines of a window. What stands outdoors does not.
    """
    box = cv2.boundingRect(room.astype(np.uint8))
    here = np.s_[box[1] : box[1] + box[3], box[0] : box[0] + box[2]]
    size_px = np.bincount(raster.free.ravel(), minlength=raster.count)
    within = np.bincount(raster.free[here].ravel(), minlength=raster.count)
    strip = (within >= IN_BOX * size_px) & (size_px <= COUNTER * room.sum())
    broad = np.zeros(raster.count, np.bool_)
    broad[np.unique(raster.free[raster.outdoors >= BROAD * thin_px])] = True
    strip &= broad
    strip[[0, raster.outside]] = False
    size = 2 * max(1, round(thin_px / 2)) + 1
    whole = cv2.morphologyEx(
        (room | strip[raster.free]).astype(np.uint8),
        cv2.MORPH_CLOSE,
        np.ones((size, size), np.uint8),
    ).astype(np.bool_)
    whole &= (raster.walls > 0) & ((raster.free != raster.outside) | room)
    return _largest_of(whole, room)


def _largest_of(whole: Mask, room: Mask) -> Mask:
    """The connected part that has most of a room in it."""
    _, labels = cv2.connectedComponents(whole.astype(np.uint8), connectivity=4)
    inside = np.bincount(labels[room], minlength=1)
    inside[0] = 0
    return np.asarray(labels == int(inside.argmax()), dtype=np.bool_)
