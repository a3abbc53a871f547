"""Arcs: places along and beside a line that is straight or curved, and lines that stand for it.

Frame of `Arc`: x right, y down (pixels); of `arc_points`: x right, y up (m). An arc is told by its
ends and its bulge, the tan of a quarter of its angle: 0 is straight, positive bows to the right of
who walks from start to end, as one sees the page.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

Points = NDArray[np.float64]
STRAIGHT = 1e-6
"""A smaller bulge is none."""
ARC_STEP_RAD = math.radians(6.0)
"""A curved line is drawn as a polygonal line with at most this angle between two of its pieces."""


@dataclass(frozen=True)
class Arc:
    """A line from `start` to `end`, (2,) pixels, of a bulge.

    Along is the distance from the start on the line, across that to the right of it as seen.
    """

    start: Points
    end: Points
    bulge: float = 0.0

    @cached_property
    def chord_px(self) -> float:
        """From end to end, straight."""
        return float(np.hypot(*(self.end - self.start)))

    @cached_property
    def direction(self) -> Points:
        """Unit vector from start to end."""
        return np.asarray((self.end - self.start) / max(self.chord_px, 1e-9))

    @cached_property
    def angle_rad(self) -> float:
        """By how much it turns: positive to the left, as one sees it."""
        return 4.0 * math.atan(self.bulge)

    @cached_property
    def radius_px(self) -> float:
        """Infinite where it is straight."""
        if abs(self.bulge) < STRAIGHT:
            return math.inf
        return self.chord_px * (1.0 + self.bulge**2) / (4.0 * abs(self.bulge))

    @cached_property
    def centre(self) -> Points:
        """(2,) of its circle; there is none where it is straight."""
        right = np.array([-self.direction[1], self.direction[0]])
        away = self.chord_px * (1.0 - self.bulge**2) / (4.0 * self.bulge)
        return np.asarray((self.start + self.end) / 2.0 - away * right)

    @cached_property
    def length_px(self) -> float:
        """On the line, from end to end."""
        if abs(self.bulge) < STRAIGHT:
            return self.chord_px
        return self.radius_px * abs(self.angle_rad)

    def at(self, along: Points | float, across: Points | float = 0.0) -> Points:
        """(..., 2) points at places along and across (broadcast); it goes on beyond its ends."""
        along, across = np.asarray(along, float), np.asarray(across, float)
        if abs(self.bulge) < STRAIGHT:
            right = np.array([-self.direction[1], self.direction[0]])
            return np.asarray(
                self.start + along[..., None] * self.direction + across[..., None] * right
            )
        along, across = np.broadcast_arrays(along, across)
        side = math.copysign(1.0, self.bulge)
        turn = -side * along / self.radius_px
        out = self.start - self.centre
        reach = 1.0 + side * across / self.radius_px
        x = np.cos(turn) * out[0] - np.sin(turn) * out[1]
        y = np.sin(turn) * out[0] + np.cos(turn) * out[1]
        return np.asarray(self.centre + reach[..., None] * np.stack([x, y], axis=-1))

    def way(self, along: Points | float) -> Points:
        """(..., 2) unit vectors of who walks on it."""
        along = np.asarray(along, float)
        if abs(self.bulge) < STRAIGHT:
            return np.asarray(np.broadcast_to(self.direction, (*along.shape, 2)))
        turn = self.angle_rad / 2.0 - along / self.length_px * self.angle_rad
        # As seen, the walk begins half of the angle to the right of the chord where it turns left.
        x = np.cos(turn) * self.direction[0] - np.sin(turn) * self.direction[1]
        y = np.sin(turn) * self.direction[0] + np.cos(turn) * self.direction[1]
        return np.asarray(np.stack([x, y], axis=-1))

    def place(self, points: Points) -> tuple[Points, Points]:
        """Along and across of points (..., 2), where they are nearest."""
        points = np.asarray(points, float)
        if abs(self.bulge) < STRAIGHT:
            away = points - self.start
            across = away[..., 1] * self.direction[0] - away[..., 0] * self.direction[1]
            return away @ self.direction, across
        side = math.copysign(1.0, self.bulge)
        out, middle = points - self.centre, self.at(self.length_px / 2.0) - self.centre
        cross = middle[0] * out[..., 1] - middle[1] * out[..., 0]
        turn = np.arctan2(cross, out @ middle)
        along = self.length_px / 2.0 - side * turn * self.radius_px
        return along, side * (np.hypot(out[..., 0], out[..., 1]) - self.radius_px)

    def bulge_of(self, low: float, high: float) -> float:
        """The bulge of a part of it, from one place along to another."""
        if abs(self.bulge) < STRAIGHT:
            return 0.0
        return math.tan(self.angle_rad * (high - low) / self.length_px / 4.0)

    def points(self, step_rad: float) -> Points:
        """(n, 2) points on it, both ends with it, at most `step_rad` of its turn apart."""
        count = max(1, math.ceil(abs(self.angle_rad) / step_rad - 1e-9))
        places = self.at(np.linspace(0.0, self.length_px, count + 1))
        places[0], places[-1] = self.start, self.end
        return places


def bulge_through(start: Points, middle: Points, end: Points) -> float:
    """The bulge of the arc from start to end that is nearest to a point amid it (all (2,))."""
    run = end - start
    size = float(np.hypot(*run))
    if size < 1e-9:
        return 0.0
    away = middle - start
    along = float(away @ run) / size - size / 2.0
    across = float(run[0] * away[1] - run[1] * away[0]) / size
    # Of the circle through both ends and that point: its sagitta s fulfils s^2 + 2 k s = h^2.
    half = size / 2.0
    if abs(across) < 1e-9:
        return 0.0
    lift = (along**2 + across**2 - half**2) / (2.0 * across)
    radius = math.hypot(half, lift)
    sagitta = lift + math.copysign(radius, across)
    return sagitta / half


def arc_points(
    start: tuple[float, float], end: tuple[float, float], bulge: float
) -> NDArray[np.float64]:
    """(n, 2) points of a straight or curved line, both ends with it.

    bulge: tan of a quarter of the arc's angle, as in DXF: positive turns left on the way, and so
    bows to the right.
    """
    first, last = np.array(start, dtype=np.float64), np.array(end, dtype=np.float64)
    if abs(bulge) < 1e-6:
        return np.stack([first, last])
    angle = 4.0 * math.atan(bulge)
    chord = last - first
    left = np.array([-chord[1], chord[0]])
    centre = (first + last) / 2.0 + left * (1.0 - bulge**2) / (4.0 * bulge)
    steps = max(2, math.ceil(abs(angle) / ARC_STEP_RAD))
    turn = np.linspace(0.0, angle, steps + 1)
    about = first - centre
    points = np.stack(
        [
            centre[0] + np.cos(turn) * about[0] - np.sin(turn) * about[1],
            centre[1] + np.sin(turn) * about[0] + np.cos(turn) * about[1],
        ],
        axis=1,
    )
    points[0], points[-1] = first, last
    return points
