"""A straight street along y: a row of houses to the left, and what stands before it."""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum

import numpy as np
from numpy.typing import NDArray

from veduta.synthetic.drives import rays
from veduta.synthetic.drives.way import Way


class Kind(IntEnum):
    """What a ray meets."""

    NOTHING = 0
    GROUND = 1
    WALL = 2
    OBJECT = 3
    BEHIND_GLASS = 4


@dataclass(frozen=True)
class StreetOptions:
    """front_m: from the path to the facades. steps_m: houses stand back or forward by up to this.
    hedge: whether a hedge hides the foot of all walls. cars, trees, lamps: share of places taken.
    porches: share of houses with a roof on two posts before the door. near_trees: share of houses
    with a tree right before the wall: no image sees what is behind its crown.
    """

    length_m: float = 400.0
    front_m: float = 11.0
    steps_m: float = 0.6
    hedge: bool = False
    cars: float = 0.6
    trees: float = 0.5
    lamps: float = 1.0
    porches: float = 0.0
    near_trees: float = 0.0


@dataclass(frozen=True, eq=False)
class Street:
    """Boxes (b, 2, 3): lower and upper corner; upright cylinders (k, 5): x, y, radius, foot, top;
    balls (s, 4): x, y, z, radius. The ground is z = 0.

    walls: boxes of houses. objects: boxes of cars and hedges. panes: (p, 2, 3) boxes in the plane
    of a wall through which rays go. rooms: (r, 2, 3) what stands behind them.
    """

    walls: NDArray[np.float64]
    objects: NDArray[np.float64]
    cylinders: NDArray[np.float64]
    balls: NDArray[np.float64]
    panes: NDArray[np.float64]
    rooms: NDArray[np.float64]
    length_m: float

    def between(self, low: float, high: float) -> Street:
        """What of it lies between two places along it (m)."""

        def boxes(given: NDArray[np.float64]) -> NDArray[np.float64]:
            return np.asarray(given[(given[:, 1, 1] > low) & (given[:, 0, 1] < high)])

        def round_ones(given: NDArray[np.float64]) -> NDArray[np.float64]:
            away = np.abs(given[:, 1] - (low + high) / 2)
            return np.asarray(given[away < (high - low) / 2 + 2.0])

        return Street(
            boxes(self.walls), boxes(self.objects), round_ones(self.cylinders),
            round_ones(self.balls), boxes(self.panes), boxes(self.rooms), self.length_m,
        )  # fmt: skip

    @property
    def way(self) -> Way:
        """Straight along y."""
        return Way()

    def meet(
        self,
        origins: NDArray[np.float64],
        directions: NDArray[np.float64],
        passes: NDArray[np.bool_],
    ) -> tuple[NDArray[np.float64], NDArray[np.uint8]]:
        """See `Scenery`."""
        ground = rays.to_ground(origins, directions)
        wall = rays.to_boxes(origins, directions, self.walls)
        things = np.minimum(
            rays.to_boxes(origins, directions, self.objects),
            np.minimum(
                rays.to_cylinders(origins, directions, self.cylinders),
                rays.to_balls(origins, directions, self.balls),
            ),
        )
        glazed = np.isfinite(wall)
        glazed &= rays.to_boxes(origins, directions, self.panes) <= wall + 0.05
        room = rays.to_boxes(origins, directions, self.rooms)
        passed = glazed & passes
        behind = np.where(passed, np.minimum(room, ground), np.inf)
        solid = np.where(glazed & (wall < ground), behind, wall)
        distance = np.minimum(np.minimum(np.where(glazed & passed, np.inf, ground), solid), things)
        kind = np.full(len(origins), Kind.GROUND, dtype=np.uint8)
        kind[wall < ground] = Kind.WALL
        kind[glazed & (wall < ground)] = Kind.BEHIND_GLASS
        kind[things <= distance] = Kind.OBJECT
        kind[~np.isfinite(distance)] = Kind.NOTHING
        return distance, kind

    def facade(
        self, origins: NDArray[np.float64], directions: NDArray[np.float64]
    ) -> tuple[NDArray[np.float64], NDArray[np.bool_]]:
        """See `Scenery`."""
        ground = rays.to_ground(origins, directions)
        wall = rays.to_boxes(origins, directions, self.walls)
        return np.minimum(ground, wall), wall < ground


def build_street(options: StreetOptions, seed: int) -> Street:
    """The same street for the same seed. The path of a truck is the line x = 0."""
    random = np.random.default_rng(seed)
    walls, panes, rooms = [], [], []
    built_on = _Porches(options.porches, seed)
    close = _NearTrees(options.near_trees, seed)
    place = -20.0
    while place < options.length_m + 20.0:
        width, height = random.uniform(8.0, 18.0), random.uniform(7.0, 16.0)
        front = -options.front_m + random.uniform(-options.steps_m, options.steps_m)
        walls.append(_box(front - 0.3, front, place, place + width, 0.0, height))
        # A balcony on every third house.
        if random.uniform() < 0.33:
            middle = place + width / 2
            walls.append(_box(front - 0.1, front + 0.9, middle - 1.2, middle + 1.2, 3.2, 4.2))
        for storey in np.arange(0.9, height - 2.0, 3.1):
            for start in np.arange(place + 1.0, place + width - 2.0, 2.6):
                panes.append(
                    _box(front - 0.31, front + 0.01, start, start + 1.2, storey, storey + 1.5)
                )
        walls += built_on.before(front, place, width)
        close.plant(front, place, width)
        back = front - random.uniform(2.5, 4.5)
        rooms.append(_box(back - 0.2, back, place, place + width, 0.0, height))
        place += width + (3.0 if random.uniform() < 0.15 else 0.0)
    objects = _cars(options, random)
    if options.hedge:
        for start in np.arange(-10.0, options.length_m + 10.0, 6.0):
            away = -options.front_m + options.steps_m + 1.5
            objects.append(_box(away, away + 0.6, start, start + 5.6, 0.0, 1.3))
    cylinders, balls = _trees(options, random)
    posts = np.array(built_on.posts + close.trunks).reshape(-1, 5)
    cylinders = np.vstack([cylinders, posts])
    balls = np.vstack([balls, np.array(close.crowns).reshape(-1, 4)])
    return Street(
        np.array(walls), np.array(objects).reshape(-1, 2, 3), cylinders, balls,
        np.array(panes), np.array(rooms), options.length_m,
    )  # fmt: skip


def _box(
    x0: float, x1: float, y0: float, y1: float, z0: float, z1: float
) -> tuple[tuple[float, float, float], tuple[float, float, float]]:
    return (x0, y0, z0), (x1, y1, z1)


class _Porches:
    """Roofs on posts; their own draws leave the rest of the street as it is without them."""

    def __init__(self, share: float, seed: int) -> None:
        self._share, self._random = share, np.random.default_rng((seed, 1))
        self.posts: list[tuple[float, float, float, float, float]] = []

    def before(
        self, front: float, place: float, width: float
    ) -> list[tuple[tuple[float, float, float], tuple[float, float, float]]]:
        """The roof before a house, and its posts among `posts`."""
        if self._random.uniform() >= self._share:
            return []
        wide, deep = self._random.uniform(2.4, 3.6), self._random.uniform(1.4, 2.2)
        start = place + self._random.uniform(1.0, width - wide - 1.0)
        for end in (start + 0.15, start + wide - 0.15):
            self.posts.append((front + deep - 0.15, end, 0.15, 0.0, 2.6))
        return [_box(front - 0.1, front + deep, start, start + wide, 2.6, 2.85)]


class _NearTrees:
    """Trees right before walls, of draws of their own, too."""

    def __init__(self, share: float, seed: int) -> None:
        self._share, self._random = share, np.random.default_rng((seed, 2))
        self.trunks: list[tuple[float, float, float, float, float]] = []
        self.crowns: list[tuple[float, float, float, float]] = []

    def plant(self, front: float, place: float, width: float) -> None:
        """Before a house, or not."""
        if self._random.uniform() >= self._share:
            return
        x = front + self._random.uniform(1.7, 2.3)
        y = place + self._random.uniform(2.0, width - 2.0)
        high, radius = self._random.uniform(2.9, 3.8), self._random.uniform(1.2, 1.6)
        self.trunks.append((x, y, 0.15, 0.0, high))
        self.crowns.append((x, y, high, radius))


def _cars(
    options: StreetOptions, random: np.random.Generator
) -> list[tuple[tuple[float, float, float], tuple[float, float, float]]]:
    """A body and a lower cabin on it, in a row of parking places."""
    found = []
    for start in np.arange(2.0, options.length_m - 6.0, 6.0):
        if random.uniform() < options.cars:
            away = -5.5 + random.uniform(-0.2, 0.2)
            found.append(_box(away, away + 1.75, start, start + 4.3, 0.15, 0.9))
            found.append(_box(away + 0.1, away + 1.65, start + 1.0, start + 3.4, 0.9, 1.45))
    return found


def _trees(
    options: StreetOptions, random: np.random.Generator
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    cylinders, balls = [], []
    for start in np.arange(5.0, options.length_m, 9.0):
        if random.uniform() < options.trees:
            x, y = -7.0 + random.uniform(-0.3, 0.3), start + random.uniform(-1.0, 1.0)
            cylinders.append((x, y, random.uniform(0.12, 0.25), 0.0, 3.0))
            balls.append((x, y, random.uniform(4.2, 5.2), random.uniform(1.2, 2.0)))
    for start in np.arange(12.0, options.length_m, 25.0):
        if random.uniform() < options.lamps:
            cylinders.append((-6.6, start, 0.08, 0.0, 6.0))
    return np.array(cylinders).reshape(-1, 5), np.array(balls).reshape(-1, 4)
