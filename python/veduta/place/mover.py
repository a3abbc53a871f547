"""Pieces of a part that move: a door's leaf turns about its hinges, or slides."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Vector = tuple[float, float, float]


@dataclass(frozen=True)
class Mover:
    """Polygons of a part that move together.

    The part has them where they are when it is closed. polygons: (n,) int64, rows of the part.
    pivot_m: a point that the axis goes through. axis: unit vector. turn_rad: the angle about it
    (right hand) by which it is turned when it is open. shift_m: how far it is moved then.
    opened: how it stands in the place, from 0 (closed) to 1 (open).
    """

    name: str
    polygons: NDArray[np.int64]
    pivot_m: Vector
    axis: Vector = (0.0, 0.0, 1.0)
    turn_rad: float = 0.0
    shift_m: Vector = (0.0, 0.0, 0.0)
    opened: float = 0.0
