"""A tour as `place.json` has it."""

from __future__ import annotations

import numpy as np

from veduta.place.manifest import Tour as PlaceTour
from veduta.place.manifest import TourStretch
from veduta.plan.tour.find import Tour

ID = "tour"
NAME = "Tour of the house"
LONGEST_NAME = 256
"""The manifest takes no longer names."""


def placed_tour(tour: Tour, raised_m: float) -> PlaceTour:
    """In the world frame, which is higher than the plan's by `raised_m`; rounded to 0.1 mm."""
    path = tour.path
    eyes = path.eyes_m + np.array([0.0, 0.0, raised_m])
    return PlaceTour(
        id=ID,
        name=NAME,
        times_s=path.times_s.round(3).tolist(),
        eyes=eyes.round(4).tolist(),
        directions=path.directions.round(5).tolist(),
        stretches=[
            TourStretch(
                room=stretch.room,
                name=stretch.title[:LONGEST_NAME],
                start_s=round(stretch.start_s, 3),
                end_s=round(stretch.end_s, 3),
            )
            for stretch in tour.stretches
        ],
        shut=[*tour.shut_ids],
    )
