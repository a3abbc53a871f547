"""Walls of several layers filled: narrow cells between lines are the insides of walls.

For sheets on which `outlined` finds none, as no cell runs on through a whole wall: insulation and
concrete are drawn with patterns of their own. A cell is a connected piece of paper; a wall is a
long narrow one, or a heap of small cells. Panes of windows are narrow, too, but lie side by side in
the same wall: a long cell in a band that is much broader than itself is a pane, and stays open.
"""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.plan.walls.cells import longer_side

NARROW = 0.04
"""Insides of walls are at most so wide, as a share of the drawing's longer side."""

PANE_BREADTH = 1.45
"""The band is so many times as broad as a pane with its two lines, or more."""

BROADER = 1.3
"""Cells broader than the usual insides of the thickest walls, by this factor, are furniture."""

SMALL_SHARE = 0.5
"""Walls are hatched if so much of the area of all narrow cells is in short ones."""

PANE_LENGTH = 1.7
"""A pane is so many times as long as its wall is thick; cells of hatching are shorter."""


def fill_cells(ink: NDArray[np.bool_], line_px: float) -> NDArray[np.bool_]:
    """The mask of ink with narrow cells filled, but for panes."""
    extent = longer_side(ink)
    paper = (~ink).astype(np.uint8)
    count, found, places, _ = cv2.connectedComponentsWithStats(paper, connectivity=4)
    labels, stats = np.asarray(found, np.int32), np.asarray(places, np.int32)
    inside = np.asarray(cv2.distanceTransform(paper, cv2.DIST_L2, 3), np.float32)
    breadth = 2 * _most(inside, labels, count)
    narrow = breadth <= NARROW * extent
    narrow[0] = False
    # The sheet's border cuts cells: what touches it is paper.
    height, width = ink.shape
    left, top = stats[:, cv2.CC_STAT_LEFT], stats[:, cv2.CC_STAT_TOP]
    right, bottom = left + stats[:, cv2.CC_STAT_WIDTH], top + stats[:, cv2.CC_STAT_HEIGHT]
    narrow &= (left > 0) & (top > 0) & (right < width) & (bottom < height)
    narrow &= breadth <= BROADER * _common_breadth(breadth, stats[:, cv2.CC_STAT_AREA], narrow)
    filled = ink | narrow[labels]
    # A cell beside the middle of a band must see how broad the band is there.
    depth = cv2.distanceTransform(filled.astype(np.uint8), cv2.DIST_L2, 3)
    reach = 2 * round(0.25 * NARROW * extent) + 1
    depth = cv2.dilate(depth, np.ones((reach, reach), np.uint8))
    band = 2 * _usual(np.asarray(depth, np.float32), inside, breadth, labels)
    long_side = np.maximum(stats[:, cv2.CC_STAT_WIDTH], stats[:, cv2.CC_STAT_HEIGHT])
    area = stats[:, cv2.CC_STAT_AREA]
    long = long_side > PANE_LENGTH * band
    small = float(area[narrow & ~long].sum()) > SMALL_SHARE * float(area[narrow].sum())
    # Among small cells any long one is a pane; among long ones only what lies side by side.
    broader = small | (band > PANE_BREADTH * (breadth + 2 * line_px))
    pane = narrow & long & broader & (area > 0.6 * (breadth * long_side - breadth**2))
    return np.asarray(filled & ~pane[labels], dtype=np.bool_)


def _common_breadth(
    breadth: NDArray[np.float64], area: NDArray[np.int32], narrow: NDArray[np.bool_]
) -> float:
    """The largest breadth of long cells that is no exception; infinite where few cells are long."""
    length = area / np.maximum(breadth, 1.0)
    long = narrow & (length >= 5 * breadth)
    if area[long].sum() < SMALL_SHARE * area[narrow].sum() or not long.any():
        return float("inf")
    order = np.argsort(-breadth[long])
    total = np.cumsum(length[long][order])
    return float(breadth[long][order][np.searchsorted(total, 0.2 * total[-1])])


def _most(
    values: NDArray[np.float32], labels: NDArray[np.int32], count: int
) -> NDArray[np.float64]:
    """The largest value of each label."""
    most = np.zeros(count, dtype=np.float32)
    # Types that need no cast are several times as fast.
    np.maximum.at(most, labels.ravel().astype(np.intp), values.ravel())
    return most.astype(np.float64)


def _usual(
    values: NDArray[np.float32],
    inside: NDArray[np.float32],
    breadth: NDArray[np.float64],
    labels: NDArray[np.int32],
) -> NDArray[np.float64]:
    """The mean of values along the middle of each cell, whatever stands beside a part of it."""
    ridge = (inside > 0) & (inside >= 0.35 * breadth[labels])
    total = np.bincount(labels[ridge], weights=values[ridge], minlength=len(breadth))
    return total / np.maximum(1, np.bincount(labels[ridge], minlength=len(breadth)))
