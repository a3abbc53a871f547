"""From the page to the compass: a place whose y is north, of one in which y is up on the page."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from veduta.place.manifest import Vector
from veduta.place.place import Place


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

    parts = {}
    for placed in place.parts.values():
        standing = replace(placed.standing, transform=turn @ placed.standing.transform)
        parts[placed.id] = replace(placed, standing=standing)
    tours = [
        tour.model_copy(update={"eyes": moved(tour.eyes), "directions": moved(tour.directions)})
        for tour in place.tours
    ]
    start = place.start
    if start is not None:
        eye, target = moved([start.eye, start.target])
        start = start.model_copy(update={"eye": eye, "target": target})
    return replace(place, parts=parts, tours=tours, start=start)
