"""Walls that a hand has scribbled full: strokes to and fro between two faces, as close as it went.

No stroke of it is thick and no line of it is straight; what lies between the strokes is no broader
than some lines, and closing that makes walls (dilation and erosion, Serra 1982).
"""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.plan.walls.solid import Thickness, stroke_length, wall_thickness

BETWEEN = 2.0
"""Strokes of a scribble are so many lines apart, or less."""

MORE_WALL = 1.2
"""Closing makes so many times as much wall as the ink is by itself."""

INKED = (0.5, 0.92)
"""This part of scribbled walls is ink: of walls of two lines less, of solid ones more."""


def scribbled_walls(
    ink: NDArray[np.bool_], line_px: float
) -> tuple[NDArray[np.bool_], Thickness] | None:
    """The mask (h, w) of scribbled walls with all ink, and how thick they are; None of other."""
    reach = 2 * round(BETWEEN * line_px / 2.0) + 1
    square = np.ones((reach, reach), np.uint8)
    closed = cv2.morphologyEx(ink.astype(np.uint8), cv2.MORPH_CLOSE, square) > 0
    thickness = wall_thickness(closed, line_px)
    if thickness is None:
        return None
    least_px = 0.9 * thickness.least_px
    if stroke_length(closed, least_px) <= MORE_WALL * stroke_length(ink, least_px):
        return None
    side = max(3, round(least_px))
    solid = cv2.morphologyEx(
        closed.astype(np.uint8), cv2.MORPH_OPEN, np.ones((side, side), np.uint8)
    )
    inside = solid > 0
    share = float(ink[inside].mean()) if inside.any() else 0.0
    return (closed, thickness) if INKED[0] <= share <= INKED[1] else None
