"""From the page to the compass: a place whose y is north, of one in which y is up on the page."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from veduta.place.manifest import Place, Vector


def turned_north(place: Place, north_deg: float) -> Place:
    """The place turned about the origin so that north comes to +y.

    north_deg: where it is now, clockwise from +y.
    """
    if north_deg == 0.0:
        return place
    angle = math.radians(north_deg)
    turn = np.eye(4)
    turn[:2, :2] = [[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]]

    def moved(points: Sequence[Vector]) -> list[Vector]:
        return [tuple(row) for row in (np.array(points) @ turn[:3, :3].T).tolist()]

    parts = [
        part.model_copy(
            update={"transform": tuple((turn @ _matrix(part.transform)).T.reshape(-1).tolist())}
        )
        for part in place.parts
    ]
    tours = [
        tour.model_copy(update={"eyes": moved(tour.eyes), "directions": moved(tour.directions)})
        for tour in place.tours
    ]
    eye, target = moved([place.start.eye, place.start.target])
    start = place.start.model_copy(update={"eye": eye, "target": target})
    return place.model_copy(update={"parts": parts, "tours": tours, "start": start})


def _matrix(column_major: Sequence[float]) -> np.ndarray:
    return np.array(column_major, dtype=np.float64).reshape(4, 4).T
