"""Where openings lie on the page, and what their doors sweep."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from shapely.geometry import Polygon

from veduta.synthetic.plans import curves
from veduta.synthetic.plans.house import Opening, Wall

STAND_M = 0.3
Spot = NDArray[np.float64]


@dataclass(frozen=True)
class Place:
    """An opening on the page: its two jambs on the centre line, along and left, thickness."""

    first: Spot
    second: Spot
    along: Spot
    left: Spot
    half_m: float
    width_m: float

    def at(self, along_m: float, left_m: float) -> Spot:
        """A point so far from the first jamb and so far to the left of the centre line."""
        return self.first + along_m * self.along + left_m * self.left

    def sweep(
        self, hinge_m: tuple[float, float], length_m: float, side: float, points: int
    ) -> list[Spot]:
        """The quarter that the tip of a leaf sweeps, from where it stands open to where it is shut.

        It hangs so far along and left, opens to the left (1) or right (-1) of the wall, and closes
        by `length_m` (signed) along.
        """
        along_m, left_m = hinge_m
        towards, size = math.copysign(1.0, length_m), abs(length_m)
        return [
            self.at(
                along_m + towards * size * math.sin(turn), left_m + side * size * math.cos(turn)
            )
            for turn in np.linspace(0.0, math.pi / 2, points)
        ]

    def box(self, low: float, high: float, right: float, left: float) -> Polygon:
        """A rectangle in these coordinates."""
        return Polygon(
            [self.at(low, right), self.at(high, right), self.at(high, left), self.at(low, left)]
        )


def place_of(wall: Wall, opening: Opening) -> Place:
    """Where an opening of a straight wall lies."""
    size = curves.wall_length(wall)
    ends = np.array([opening.along_m, opening.along_m + opening.width_m]) / size
    first, second = curves.at(wall.start_m, wall.end_m, wall.bulge, ends)
    along = (second - first) / np.hypot(*(second - first))
    left = np.array([-along[1], along[0]])
    return Place(first, second, along, left, wall.thickness_m / 2, opening.width_m)


def swept(wall: Wall, opening: Opening) -> Polygon:
    """Where a door's leaf moves, and on its other side, where one stands before it."""
    place = place_of(wall, opening)
    reach = opening.width_m if opening.hinge != "both" else opening.width_m / 2
    stand = place.half_m + STAND_M
    if opening.swing == "none":
        return place.box(0, opening.width_m, -stand, stand)
    side = 1.0 if opening.swing == "left" else -1.0
    return place.box(0, opening.width_m, -side * stand, side * (place.half_m + reach + 0.05))
