"""A street of whole houses, by the facade generator or a grammar, and what stands before them.

Windows have reveals, balconies railings, roofs eaves; behind glass there are rooms. The street may
swing to both sides, houses may step back, a hedge may hide the foot of all of them. Rays meet
triangles (Embree); nothing here is used by what makes facades of drives.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from veduta.place.semantics import SemanticClass
from veduta.synthetic.drives.houses import HouseMaker, MadeHouse, generated_house
from veduta.synthetic.drives.street import Kind
from veduta.synthetic.drives.things import Placed, ground_part, hedge_parts, parked, rooms_part
from veduta.synthetic.drives.way import Way
from veduta.synthetic.scene import Hits, RayScene
from veduta.synthetic.seeds import stream

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]
_BEFORE_M = 20.0
_MOST_PANES = 6
_BEYOND_M = 2e-3
_GLASS, _SQUARE = 0.5, 0.9995
"""Glass mirrors by more than this; a beam that meets it within 1.8 degrees of square comes back."""
_GLAZED = {SemanticClass.WINDOW, SemanticClass.DOOR, SemanticClass.SHOP, SemanticClass.OTHER}


@dataclass(frozen=True)
class MadeStreetOptions:
    """front_m: from the path to the fronts, which stand forward or back by up to steps_m. way: its
    line. gaps: share of houses that stand apart from the next one. cars, trees, lamps: share of
    places taken. hedge: one stands before all walls.
    """

    length_m: float = 100.0
    front_m: float = 11.0
    steps_m: float = 0.4
    way: Way = field(default_factory=Way)
    gaps: float = 0.15
    cars: float = 0.6
    trees: float = 0.5
    lamps: float = 1.0
    hedge: bool = False


@dataclass(frozen=True, eq=False)
class MadeStreet:
    """scene: all of it. bare: without what stands before the houses.

    kinds, bare_kinds: uint8 `Kind` of each feature of theirs. bare_codes: uint8 semantic class of
    each of `bare`. glazed: (f,) whether a feature of `scene` may have glass.
    """

    scene: RayScene
    bare: RayScene
    kinds: NDArray[np.uint8]
    bare_kinds: NDArray[np.uint8]
    bare_codes: NDArray[np.uint8]
    glazed: Bools
    length_m: float
    way: Way

    def between(self, low: float, high: float) -> MadeStreet:
        """All of it: the tracer finds what is near by itself."""
        return self

    def meet(
        self, origins: Floats, directions: Floats, passes: Bools
    ) -> tuple[Floats, NDArray[np.uint8]]:
        """See `Scenery`. What is seen through the glass of a house is behind glass."""
        distance = np.full(len(origins), np.inf)
        kind = np.full(len(origins), Kind.NOTHING, dtype=np.uint8)
        gone, behind = np.zeros(len(origins)), np.zeros(len(origins), dtype=bool)
        left = np.arange(len(origins))
        for _ in range(_MOST_PANES):
            if not len(left):
                break
            begin = origins[left] + gone[left, None] * directions[left]
            hits = self.scene.cast(_singles(begin), _singles(directions[left]))
            if not len(hits.ray):
                break
            ray = left[hits.ray]
            gone[ray] += hits.distance
            own = self.kinds[self.scene.feature[hits.triangle]]
            glass = self._is_glass(hits)
            square = np.abs((self.scene.normal[hits.triangle] * directions[ray]).sum(axis=1))
            ends = ~glass | (square > _SQUARE)
            distance[ray[ends]] = gone[ray[ends]]
            kind[ray[ends]] = np.where(behind[ray[ends]], np.uint8(Kind.BEHIND_GLASS), own[ends])
            left = ray[~ends & passes[ray]]
            behind[ray[~ends]] |= own[~ends] == Kind.WALL
            gone[left] += _BEYOND_M
        return distance, kind

    def facade(self, origins: Floats, directions: Floats) -> tuple[Floats, Bools]:
        """See `Scenery`."""
        hits = self.bare.cast(_singles(origins), _singles(directions))
        distance, wall = np.full(len(origins), np.inf), np.zeros(len(origins), dtype=bool)
        distance[hits.ray] = hits.distance
        wall[hits.ray] = self.bare_kinds[self.bare.feature[hits.triangle]] == Kind.WALL
        return distance, wall

    def _is_glass(self, hits: Hits) -> Bools:
        scene = self.scene
        glass = scene.opacity[scene.material[hits.triangle]] < 1.0
        may = np.flatnonzero(self.glazed[scene.feature[hits.triangle]] & ~glass)
        if len(may):
            own = Hits(hits.ray[may], hits.triangle[may], hits.distance[may], hits.weight[may])
            glass[may] = scene.surface(own)[1] > _GLASS
        return np.asarray(glass)


def _singles(values: Floats) -> NDArray[np.float32]:
    return np.ascontiguousarray(values, dtype=np.float32)


def make_street(
    options: MadeStreetOptions, seed: int, make: HouseMaker = generated_house
) -> MadeStreet:
    """The same street for the same seed and maker. The truck's path is the street's way."""
    random = stream(seed, "made street")
    houses = _houses(options, seed, random, make)
    ground = ground_part(options.way, options.length_m, seed)
    bare = [Placed(ground, np.eye(4), Kind.GROUND)]
    bare += [Placed(one.part, where, Kind.WALL, one.mirrors) for one, where in houses]
    bare += [rooms_part(one, where, random) for one, where in houses]
    before = parked(options, seed, random)
    if options.hedge:
        before += hedge_parts(options, seed)
    scene, kinds, glazed = _scene([*bare, *before])
    plain, bare_kinds, _ = _scene(bare)
    codes = np.concatenate([one.part.features.class_code for one in bare]).astype(np.uint8)
    length_m, way = options.length_m, options.way
    return MadeStreet(scene, plain, kinds, bare_kinds, codes, glazed, length_m, way)


def _houses(
    options: MadeStreetOptions, seed: int, random: np.random.Generator, make: HouseMaker
) -> list[tuple[MadeHouse, Floats]]:
    """Side by side to the left of the way, each with its front along it in its middle; and
    (4, 4) world_from_part.
    """
    found: list[tuple[MadeHouse, Floats]] = []
    place = -_BEFORE_M
    while place < options.length_m + _BEFORE_M:
        house = make(1000 * seed + len(found))
        step = float(random.uniform(-options.steps_m, options.steps_m))
        frame = np.eye(4)
        frame[:3] = options.way.frames(np.array([place + house.width_m / 2]))[0]
        corner = np.eye(4)
        corner[:2, 3] = -house.width_m / 2, options.front_m + step
        found.append((house, frame @ corner))
        apart = float(random.uniform(1.5, 4.0)) if random.uniform() < options.gaps else 0.0
        place += house.width_m + apart
    return found


def _scene(placed: list[Placed]) -> tuple[RayScene, NDArray[np.uint8], Bools]:
    glass = {name: texels for one in placed for name, texels in one.mirrors.items()}
    scene = RayScene([(one.part, one.world_from_part) for one in placed], glass)
    kinds, glazed = [], []
    codes = [one.code for one in _GLAZED]
    for one in placed:
        count = len(one.part.features)
        kinds.append(np.full(count, one.kind, dtype=np.uint8))
        glazed.append(np.isin(one.part.features.class_code, codes))
    return scene, np.concatenate(kinds), np.concatenate(glazed)
