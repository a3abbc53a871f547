"""The things of a street that photos find again: points on facades and ground, and clutter."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.synthetic.streets.house import Street
from veduta.synthetic.streets.walls import TrueWall

Floats = NDArray[np.float64]
RECESSED, RECESS_M = 0.2, 0.2
"""Share of a facade's points that lie in openings, and how deep."""
PROUD, PROUD_M = 0.1, 0.5
"""Share on balconies and cornices, and how far they reach at most."""
UNEVEN_M = 0.008
GROUND_PER_M2 = 0.8
CLUTTER_PER_M = 8.0
"""Points on cars, trees and lamps by the metre of street."""
NO_WALL = -1


@dataclass(frozen=True)
class Cloud:
    """places_m: (n, 3) on the surface, to ask who sees it. points_m: (n, 3) what is found there.

    normals: (n, 3) unit. wall: (n,) the number of the wall, -1 on ground and clutter.
    """

    places_m: Floats
    points_m: Floats
    normals: Floats
    wall: NDArray[np.int64]


def street_cloud(
    street: Street, walls: Sequence[TrueWall], per_m2: float, rng: np.random.Generator
) -> Cloud:
    """Points at random; those of walls are as dense everywhere, seen or not."""
    clouds = [_on_wall(wall, number, per_m2, rng) for number, wall in enumerate(walls)]
    return _joined([*clouds, _on_ground(street, rng), _clutter(street, rng)])


def _on_wall(wall: TrueWall, number: int, per_m2: float, rng: np.random.Generator) -> Cloud:
    height = wall.top_m - wall.bottom_m
    count = int(rng.poisson(per_m2 * wall.width_m * height))
    along, up = rng.random(count), rng.random(count)
    foot = wall.start_m + along[:, None] * (wall.end_m - wall.start_m)
    places = np.column_stack([foot, wall.bottom_m + up * height])
    normals = np.tile([*wall.outward, 0.0], (count, 1))
    relief = rng.normal(0.0, UNEVEN_M, count)
    kind = rng.random(count)
    relief -= np.where(kind < RECESSED, RECESS_M, 0.0)
    relief += np.where(kind > 1.0 - PROUD, PROUD_M * rng.random(count), 0.0)
    return Cloud(places, places + relief[:, None] * normals, normals, np.full(count, number))


def _on_ground(street: Street, rng: np.random.Generator) -> Cloud:
    count = int(rng.poisson(GROUND_PER_M2 * street.length_m * street.width_m))
    places = np.column_stack([_beside(street, count, 0.5, rng), np.zeros(count)])
    normals = np.tile([0.0, 0.0, 1.0], (count, 1))
    points = places + rng.normal(0.0, 0.02, count)[:, None] * normals
    return Cloud(places, points, normals, np.full(count, NO_WALL))


def _clutter(street: Street, rng: np.random.Generator) -> Cloud:
    """Lumps at both kerbs: low and long ones (cars), high and round ones (trees)."""
    count = int(rng.poisson(CLUTTER_PER_M * street.length_m))
    lumps = max(3, round(street.length_m / 6))
    side = np.where(rng.random(lumps) < 0.5, -1.0, 1.0)
    along = rng.uniform(0.0, street.length_m, lumps)
    middles = np.array(
        [
            _aside(street, at, where * 0.36 * street.width_m)
            for at, where in zip(along, side, strict=True)
        ]
    )
    tree = rng.random(lumps) < 0.5
    of = rng.integers(0, lumps, count)
    spread = np.where(tree[of, None], (1.0, 1.0, 1.6), (1.3, 1.0, 0.5))
    heights = np.where(tree[of], 4.5, 0.7)
    normals = rng.standard_normal((count, 3))
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    points = np.column_stack([middles[of], heights]) + spread * normals * rng.uniform(
        0.5, 1.0, (count, 1)
    )
    points[:, 2] = np.maximum(points[:, 2], 0.05)
    return Cloud(points, points, normals, np.full(count, NO_WALL))


def _beside(street: Street, count: int, reach: float, rng: np.random.Generator) -> Floats:
    along = rng.uniform(0.0, street.length_m, count)
    aside = rng.uniform(-reach, reach, count) * street.width_m
    found = [_aside(street, at, off) for at, off in zip(along, aside, strict=True)]
    return np.array(found).reshape(-1, 2)


def _aside(street: Street, along: float, aside: float) -> Floats:
    middle, way = street.at(along)
    return np.asarray(middle + aside * np.array([-np.sin(way), np.cos(way)]), np.float64)


def _joined(clouds: Sequence[Cloud]) -> Cloud:
    return Cloud(
        np.concatenate([cloud.places_m for cloud in clouds]),
        np.concatenate([cloud.points_m for cloud in clouds]),
        np.concatenate([cloud.normals for cloud in clouds]),
        np.concatenate([cloud.wall for cloud in clouds]),
    )
