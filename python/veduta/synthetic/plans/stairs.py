"""Stairs in the room that is kept for them, with free floor where one steps on and off.

The room is entered from its lower side on the page, on both storeys: stairs that come back to that
side end before it, others leave a way along them.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from shapely.affinity import affine_transform
from shapely.geometry import LineString, Polygon, box
from shapely.ops import unary_union

from veduta.synthetic.plans.house import Point, Stairs, StairsKind

FREE_M = 0.95
"""Floor before the first step and behind the last."""
NEWEL_M = 0.08
"""Radius of a spiral's column."""
SPIRAL_M = 0.98
SPIRAL_TREADS = 13
SPIRAL_GAP_RAD = math.radians(84.0)
"""Where one comes to a spiral and leaves it."""
WALK = 0.62
"""Where one walks on a spiral, as a share of its radius."""
KINDS: tuple[StairsKind, ...] = (
    "straight", "quarter-winding", "quarter-landing", "half-winding", "half-landing", "spiral",
)  # fmt: skip

Path = list[Point]


@dataclass(frozen=True)
class StairPlan:
    """What kind of stairs a house has; `first` and `second` are the treads of its flights."""

    kind: StairsKind
    mirrored: bool
    width_m: float
    tread_m: float
    first: int
    second: int

    @property
    def room_m(self) -> tuple[float, float]:
        """Width and depth of the room that they need, between its walls."""
        width, tread = self.width_m, self.tread_m
        beyond = FREE_M + self.first * tread
        if self.kind == "straight":
            return width + FREE_M, beyond + FREE_M
        if self.kind == "spiral":
            return 2.0 * SPIRAL_M, FREE_M + 2.0 * SPIRAL_M
        if self.kind.startswith("half"):
            return 2.0 * width, beyond + width
        return width + self.second * tread + FREE_M, beyond + width


def stair_plan(rng: np.random.Generator) -> StairPlan:
    """Stairs that one can climb: steps of 17 to 21 cm in a storey of 2.8 m."""
    kind = KINDS[int(rng.integers(len(KINDS)))]
    mirrored = bool(rng.random() < 0.5)
    width, tread = round(rng.uniform(0.85, 1.0), 2), round(rng.uniform(0.25, 0.28), 3)
    more = int(rng.integers(2))
    first, second = {
        "straight": (13 + more, 0),
        "quarter-winding": (6 + more, 4),
        "quarter-landing": (8 + more, 4),
        "half-winding": (4 + more, 4 + more),
        "half-landing": (6 + more, 6 + more),
        "spiral": (0, 0),
    }[kind]
    return StairPlan(kind, mirrored, width, tread, first, second)


def stairs_in(area: Polygon, plan: StairPlan) -> Stairs:
    """The stairs of a plan in an upright room."""
    left, bottom, right, top = area.bounds
    wide, deep = right - left, top - bottom
    if plan.kind == "straight":
        steps, path = _straight(plan)
    elif plan.kind == "spiral":
        steps, path = _spiral(wide, deep)
    elif plan.kind.startswith("half"):
        steps, path = _half(plan, wide)
    else:
        steps, path = _quarter(plan)
    # The room's own frame: x from the side of the first flight, y from the door's side.
    turn = (-1.0 if plan.mirrored else 1.0, 0.0, 0.0, 1.0)
    placed = (*turn, right if plan.mirrored else left, bottom)
    shapes = [affine_transform(step, placed) for step in steps]
    line = affine_transform(LineString(path), placed)
    return _stairs(shapes, _rounded(line.coords), plan.kind)


def _stairs(steps: Sequence[Polygon], path: tuple[Point, ...], kind: StairsKind) -> Stairs:
    outline = unary_union([step.buffer(1e-4, join_style="mitre") for step in steps])
    way = np.array(path[1]) - np.array(path[0])
    way /= np.hypot(*way)
    up = (round(float(way[0]), 6), round(float(way[1]), 6))
    ring = outline.buffer(-1e-4, join_style="mitre").simplify(1e-3).boundary.coords[:-1]
    if kind == "straight":
        return Stairs(_rounded(ring), len(steps), up)
    rings = tuple(_rounded(step.exterior.coords[:-1]) for step in steps)
    return Stairs(_rounded(ring), len(steps), up, rings, path, kind)


def _straight(plan: StairPlan) -> tuple[list[Polygon], Path]:
    steps = _flight_up(plan, plan.first)
    x = plan.width_m / 2.0
    return steps, [(x, FREE_M), (x, FREE_M + plan.first * plan.tread_m)]


def _flight_up(plan: StairPlan, treads: int) -> list[Polygon]:
    """The lower flight of all but spirals: up the page, at the left."""
    lows = [FREE_M + number * plan.tread_m for number in range(treads)]
    return [box(0.0, low, plan.width_m, low + plan.tread_m) for low in lows]


def _quarter(plan: StairPlan) -> tuple[list[Polygon], Path]:
    """Up the page, then to the right."""
    width, tread = plan.width_m, plan.tread_m
    turn = FREE_M + plan.first * tread
    corner = box(0.0, turn, width, turn + width)
    middle = (width / 2.0, turn + width / 2.0)
    path: Path = [(width / 2.0, FREE_M)]
    if plan.kind == "quarter-winding":
        newel = (width, turn)
        steps = [*_flight_up(plan, plan.first), *_fan(newel, corner, math.pi, math.pi / 2, 3)]
        path += _arc(newel, width / 2.0, math.pi, math.pi / 2)
    else:
        steps = [*_flight_up(plan, plan.first), corner]
        path += [middle]
    lefts = [width + number * tread for number in range(plan.second)]
    steps += [box(x, turn, x + tread, turn + width) for x in lefts]
    return steps, [*path, (width + plan.second * tread, middle[1])]


def _half(plan: StairPlan, wide: float) -> tuple[list[Polygon], Path]:
    """Up the page and back down it on the other side; the room may be wider than two flights."""
    width, tread = plan.width_m, plan.tread_m
    turn = FREE_M + plan.first * tread
    winding = plan.kind == "half-winding"
    far = 2.0 * width if winding else max(wide, 2.0 * width)
    landing = box(0.0, turn, far, turn + width)
    there = far - width / 2.0
    path: Path = [(width / 2.0, FREE_M)]
    if winding:
        turned = _fan((width, turn), landing, math.pi, 0.0, 6)
        path += _arc((width, turn), width / 2.0, math.pi, 0.0)
    else:
        turned = [landing]
        path += [(width / 2.0, turn + width / 2.0), (there, turn + width / 2.0)]
    tops = [turn - number * tread for number in range(plan.second)]
    down = [box(far - width, high - tread, far, high) for high in tops]
    steps = [*_flight_up(plan, plan.first), *turned, *down]
    return steps, [*path, (there, turn - plan.second * tread)]


def _spiral(wide: float, deep: float) -> tuple[list[Polygon], Path]:
    """Around a column, to the left as one goes up; its free sector is on the door's side."""
    middle = (wide / 2.0, deep - SPIRAL_M)
    start = -math.pi / 2 + SPIRAL_GAP_RAD / 2
    end = 1.5 * math.pi - SPIRAL_GAP_RAD / 2
    angles = np.linspace(start, end, SPIRAL_TREADS + 1)
    inner, outer = (_arc_at(middle, radius, angles) for radius in (NEWEL_M, SPIRAL_M))
    steps = [
        Polygon([inner[index], outer[index], outer[index + 1], inner[index + 1]])
        for index in range(SPIRAL_TREADS)
    ]
    return steps, _arc(middle, WALK * SPIRAL_M, start, end)


def _fan(newel: Point, within: Polygon, start: float, end: float, count: int) -> list[Polygon]:
    """A region cut into equal angles about a newel."""
    angles = np.linspace(start, end, count + 1)
    far = _arc_at(newel, 10.0, angles)
    wedges = [Polygon([newel, far[index], far[index + 1]]) for index in range(count)]
    cut = [wedge.intersection(within) for wedge in wedges]
    return [piece for piece in cut if isinstance(piece, Polygon)]


def _arc(middle: Point, radius: float, start: float, end: float) -> Path:
    count = max(4, math.ceil(abs(end - start) * radius / 0.06))
    return _arc_at(middle, radius, np.linspace(start, end, count + 1))


def _arc_at(middle: Point, radius: float, angles: Sequence[float] | np.ndarray) -> Path:
    return [
        (middle[0] + radius * math.cos(angle), middle[1] + radius * math.sin(angle))
        for angle in angles
    ]


def _rounded(points: Iterable[Sequence[float]]) -> tuple[Point, ...]:
    return tuple((round(float(one[0]), 4), round(float(one[1]), 4)) for one in points)
