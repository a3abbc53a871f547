"""The cells of a room: pieces of paper that thin lines enclose within it.

A symbol on a plan is a few closed lines, so what it is shows in the cells between them: an oval
with a box behind it, a rounded box in a box, a square in four triangles.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import cv2
import numpy as np
from numpy.typing import NDArray
from shapely.geometry import Polygon

LEAST_M2 = 0.003
"""A smaller cell is a letter's eye or a gap between two strokes."""
MOST_M2 = 5.0
"""No symbol that is looked for has a larger one: a double bed is as large as that."""
MOST_SHARE = 0.6
"""A cell with more of its room is its floor."""
CORNER, CUT = 0.2, 0.85
"""In the corners of a box, squares of this share of its width, less than that is missing."""
MOST_CELLS = 400
"""A room with more is tiled, hatched, or full of writing."""
LEAST_PX = 9
"""Nothing can be told of the shape of fewer pixels."""


@dataclass(frozen=True)
class Cell:
    """A cell without regard to what is in it: its outline, and the least rectangle around it.

    outline_px: (n, 2). middle_px: (2,) of the rectangle; along: (2,) unit vector of its longer
    side; length_m, width_m: its sides with half of the line around it; fill: share of it that the
    cell has, 1 for a box, pi / 4 for an ellipse, 1 / 2 for a triangle. hollow: share of the cell
    that lines and other cells within it take. length_px, width_px: its sides without lines.
    """

    outline_px: NDArray[np.float64]
    middle_px: NDArray[np.float64]
    along: NDArray[np.float64]
    length_m: float
    width_m: float
    fill: float
    hollow: float
    length_px: float = 0.0
    width_px: float = 0.0

    @cached_property
    def shape(self) -> Polygon:
        """Its outline as a polygon."""
        return Polygon(self.outline_px).buffer(0)

    @cached_property
    def round_corners(self) -> int:
        """How many of its rectangle's corners are cut off, of four."""
        side = CORNER * self.width_px
        half = np.array([self.length_px, self.width_px]) / 2
        axes = np.stack([self.along, self.across])
        cut = 0
        for signs in ((-1, -1), (-1, 1), (1, 1), (1, -1)):
            corner = half * signs
            inner = corner - side * np.array(signs)
            ring = [corner, (corner[0], inner[1]), inner, (inner[0], corner[1])]
            square = Polygon(self.middle_px + np.asarray(ring) @ axes)
            cut += square.intersection(self.shape).area < CUT * square.area
        return cut

    @property
    def aspect(self) -> float:
        """Longer side over shorter."""
        return self.length_m / max(self.width_m, 1e-6)

    @property
    def across(self) -> NDArray[np.float64]:
        """The unit vector of its shorter side."""
        return np.array([-self.along[1], self.along[0]])


def cells_of(
    room: Polygon, ink: NDArray[np.bool_], line_px: float, metres_per_px: float
) -> list[Cell]:
    """The cells of a room, the largest first; none where it has too many.

    room: in pixels of the (h, w) mask of ink.
    """
    height, width = ink.shape
    left, low = (max(0, int(np.floor(side)) - 1) for side in room.bounds[:2])
    right, high = int(np.ceil(room.bounds[2])) + 2, int(np.ceil(room.bounds[3])) + 2
    crop = ink[low : min(height, high), left : min(width, right)]
    if crop.size == 0:
        return []
    inside = np.zeros(crop.shape, np.uint8)
    ring = np.round(np.asarray(room.exterior.coords) - (left, low) - 0.5).astype(np.int32)
    cv2.fillPoly(inside, [ring], (1,))
    paper = ((inside > 0) & ~crop).view(np.uint8)
    count, found_labels, stats, _ = cv2.connectedComponentsWithStats(paper, connectivity=4)
    labels = np.asarray(found_labels, dtype=np.int32)
    area_m2 = stats[:, cv2.CC_STAT_AREA] * metres_per_px**2
    sized = (area_m2 >= LEAST_M2) & (
        area_m2 <= min(MOST_M2, MOST_SHARE * room.area * metres_per_px**2)
    )
    sized &= stats[:, cv2.CC_STAT_AREA] >= LEAST_PX
    sized[0] = False
    chosen = np.flatnonzero(sized)
    if count - 1 > 20 * MOST_CELLS or chosen.size > MOST_CELLS:
        return []
    found = [
        cell
        for number in chosen
        if (cell := _cell(labels, stats[number], int(number), (left, low), line_px, metres_per_px))
    ]
    return sorted(found, key=lambda cell: -cell.length_m * cell.width_m)


def _cell(
    labels: NDArray[np.int32],
    stats: NDArray[np.int32],
    number: int,
    offset: tuple[int, int],
    line_px: float,
    metres_per_px: float,
) -> Cell | None:
    x, y, width, height, area = (int(one) for one in stats)
    mask = (labels[y : y + height, x : x + width] == number).astype(np.uint8)
    contours, _ = cv2.findContours(
        cv2.copyMakeBorder(mask, 1, 1, 1, 1, cv2.BORDER_CONSTANT, value=0),
        cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_NONE,
    )  # fmt: skip
    outline = max(contours, key=cv2.contourArea)
    # Through the middles of the pixels at its rim: half a pixel on each side is missing.
    filled = cv2.contourArea(outline) + 0.5 * len(outline) + 1
    (cx, cy), (w, h), turn = cv2.minAreaRect(outline)
    w, h = w + 1.0, h + 1.0
    if min(w, h) < 2.0:
        return None
    angle = np.deg2rad(turn)
    along = np.array([np.cos(angle), np.sin(angle)])
    if h > w:
        w, h, along = h, w, np.array([-along[1], along[0]])
    origin = np.array([offset[0] + x - 1, offset[1] + y - 1]) + 0.5
    return Cell(
        outline[:, 0, :].astype(np.float64) + origin,
        np.array([cx, cy]) + origin,
        along,
        (w + line_px) * metres_per_px,
        (h + line_px) * metres_per_px,
        min(1.0, filled / (w * h)),
        max(0.0, 1.0 - area / filled),
        w,
        h,
    )
