"""Points along a wall, straight or an arc, and the band that it covers."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray
from shapely.geometry import Polygon

from veduta.synthetic.plans.house import Point, Wall

STEP_RAD = 0.04
Line = NDArray[np.float64]


def length(start: Point, end: Point, bulge: float) -> float:
    """How long the piece is along its centre line, in metres."""
    chord = math.dist(start, end)
    angle = 4.0 * math.atan(abs(bulge))
    return chord if angle < 1e-9 else chord * angle / (2.0 * math.sin(angle / 2.0))


def wall_length(wall: Wall) -> float:
    """How long the wall is along its centre line, in metres."""
    return length(wall.start_m, wall.end_m, wall.bulge)


def at(
    start: Point, end: Point, bulge: float, shares: NDArray[np.float64], offset: float = 0.0
) -> Line:
    """The points (n, 2) at these shares (0 to 1) of the length, `offset` metres to the left.

    The arc's angle is 4 atan(bulge) and its sagitta chord * bulge / 2, to the right of the chord
    where the bulge is positive (y up).
    """
    a, b = np.asarray(start, float), np.asarray(end, float)
    chord = b - a
    size = float(np.hypot(*chord))
    along = chord / max(size, 1e-12)
    left = np.array([-along[1], along[0]])
    if abs(bulge) < 1e-9:
        return np.asarray(a + shares[:, None] * chord + offset * left)
    angle = 4.0 * math.atan(bulge)
    radius = size / (2.0 * math.sin(angle / 2.0))
    centre = (a + b) / 2.0 + left * radius * math.cos(angle / 2.0)
    turn = -angle / 2.0 + shares * angle
    outward = -left[None] * np.cos(turn)[:, None] + along[None] * np.sin(turn)[:, None]
    return np.asarray(centre + (radius - offset) * outward)


def line(wall: Wall, low: float = 0.0, high: float = 1.0, offset: float = 0.0) -> Line:
    """The wall's centre line between two shares of its length, fine enough to pass for an arc."""
    angle = 4.0 * math.atan(abs(wall.bulge)) * (high - low)
    steps = max(1, math.ceil(angle / STEP_RAD))
    shares = np.linspace(low, high, steps + 1)
    return at(wall.start_m, wall.end_m, wall.bulge, shares, offset)


def band(wall: Wall, low_m: float, high_m: float, thickness_m: float | None = None) -> Polygon:
    """What the wall covers between two places along it, in metres from its start."""
    size = wall_length(wall)
    half = (wall.thickness_m if thickness_m is None else thickness_m) / 2.0
    low, high = low_m / size, high_m / size
    left, right = line(wall, low, high, half), line(wall, low, high, -half)
    return Polygon(np.vstack([left, right[::-1]]))
