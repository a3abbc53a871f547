"""Where rays meet boxes, cylinders and balls: closed forms, on arrays."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


def to_boxes(origins: Floats, directions: Floats, boxes: Floats) -> Floats:
    """(n,) distance to the first of (b, 2, 3) boxes, inf where a ray meets none (slabs)."""
    nearest = np.full(len(origins), np.inf)
    with np.errstate(divide="ignore", invalid="ignore"):
        inverse = 1.0 / directions
        for low, high in boxes:
            one, two = (low - origins) * inverse, (high - origins) * inverse
            enter = np.nanmax(np.minimum(one, two), axis=1)
            leave = np.nanmin(np.maximum(one, two), axis=1)
            hit = (enter <= leave) & (enter > 0.0)
            nearest = np.where(hit & (enter < nearest), enter, nearest)
    return nearest


def to_cylinders(origins: Floats, directions: Floats, cylinders: Floats) -> Floats:
    """(n,) distance to the first upright cylinder's side."""
    nearest = np.full(len(origins), np.inf)
    flat = directions[:, :2]
    a = np.maximum((flat**2).sum(axis=1), 1e-12)
    for x, y, radius, foot, top in cylinders:
        offset = origins[:, :2] - (x, y)
        b = (offset * flat).sum(axis=1)
        inside = b * b - a * ((offset**2).sum(axis=1) - radius**2)
        distance = (-b - np.sqrt(np.maximum(inside, 0.0))) / a
        height = origins[:, 2] + distance * directions[:, 2]
        hit = (inside > 0.0) & (distance > 0.0) & (height >= foot) & (height <= top)
        nearest = np.where(hit & (distance < nearest), distance, nearest)
    return nearest


def to_balls(origins: Floats, directions: Floats, balls: Floats) -> Floats:
    """(n,) distance to the first ball; directions are unit vectors."""
    nearest = np.full(len(origins), np.inf)
    for x, y, z, radius in balls:
        offset = origins - (x, y, z)
        b = (offset * directions).sum(axis=1)
        inside = b * b - ((offset**2).sum(axis=1) - radius**2)
        distance = -b - np.sqrt(np.maximum(inside, 0.0))
        hit = (inside > 0.0) & (distance > 0.0)
        nearest = np.where(hit & (distance < nearest), distance, nearest)
    return nearest


def to_ground(origins: Floats, directions: Floats) -> Floats:
    """(n,) distance to the plane z = 0."""
    down = directions[:, 2] < -1e-9
    safe = np.where(down, directions[:, 2], -1.0)
    return np.where(down, -origins[:, 2] / safe, np.inf)
