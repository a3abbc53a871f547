"""Points whose lines of sight are nearly parallel are left out, by angles between all pairs."""

from __future__ import annotations

from dataclasses import replace
from itertools import combinations

import numpy as np
from numpy.typing import NDArray
from simulated_street import simulated_street

from veduta.photos.structure import Structure, without_parallel


def _widest_rad(structure: Structure) -> NDArray[np.float64]:
    """The largest angle between two lines of sight to each point."""
    centres, found = structure.centres(), np.zeros(len(structure.points))
    for point, place in enumerate(structure.points):
        photos = structure.image_of[structure.point_of == point]
        rays = place - centres[photos]
        rays /= np.linalg.norm(rays, axis=1)[:, None]
        for one, two in combinations(rays, 2):
            angle = float(np.arccos(np.clip(one @ two, -1.0, 1.0)))
            found[point] = max(found[point], angle)
    return found


def test_what_lies_nobody_knows_how_far_off_is_left_out() -> None:
    _, _, street = simulated_street(4)
    few = street.sampled(300, np.random.default_rng(1))
    points = few.points.copy()
    points[:40] = few.centres()[0] + 1e5 * (points[:40] - few.centres()[0])
    far = replace(few, points=points)
    widest = _widest_rad(far)
    left = without_parallel(far, 0.01)
    assert 200 < len(left.points) <= 260
    # By the mean direction, half of the widest angle is between it and all but the same.
    kept = {tuple(point) for point in left.points}
    for point, angle in zip(far.points, widest, strict=True):
        if angle > 0.02:
            assert tuple(point) in kept
        if angle < 0.005:
            assert tuple(point) not in kept
    assert (np.bincount(left.point_of) >= 2).all()


def test_all_parallel_stays_as_it_is() -> None:
    _, _, street = simulated_street(4)
    some = street.sampled(400, np.random.default_rng(2))
    assert without_parallel(some, 3.0) is some
    widest = np.quantile(_widest_rad(some), 0.7)
    assert without_parallel(some, 2.0 * float(widest)) is some  # less than half would be left
