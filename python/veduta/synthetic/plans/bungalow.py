"""A house on one floor: an open plan on one side, bedrooms along a hall that turns to the door.

The open side may end in a wall that slants; a garage may stand beside the house.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from veduta.synthetic.plans import curves
from veduta.synthetic.plans.dissect import Box, Cell, cell
from veduta.synthetic.plans.house import Opening, OpeningKind, OpeningType, Storey, Use, Wall
from veduta.synthetic.plans.network import Thickness, room_areas, room_of, walls_of
from veduta.synthetic.seeds import stream

JAMB_M = 0.3
"""So much wall stays beside an opening, from the middle of the wall that it ends at."""


@dataclass(frozen=True)
class Bungalow:
    """Where walls stand, in metres between their middles.

    `low` and `high` are the hall's sides, `leg` the left and right of its piece to the front door,
    `slant` how far the open side's wall leans, 0 for one that is upright.
    """

    wide: float
    deep: float
    open_to: float
    low: float
    high: float
    leg: tuple[float, float]
    back: tuple[float, float]
    suite: float
    slant: float
    garage: float


def bungalow(seed: int, outer_m: float, inner_m: float) -> tuple[Storey, Bungalow]:
    """The one storey of a seed and its sizes."""
    rng = stream(seed, "bungalow")

    def some(low: float, high: float) -> float:
        return round(float(rng.uniform(low, high)), 2)

    open_to, low = some(4.4, 6.2), some(3.3, 4.2)
    high = round(low + some(1.25, 1.7), 2)
    leg = round(open_to + some(2.7, 3.5), 2)
    leg_end = round(leg + some(1.6, 2.2), 2)
    suite = round(leg_end + some(3.0, 3.8), 2)
    wide = round(suite + some(1.9, 2.6), 2)
    first = round(open_to + some(2.9, 3.7), 2)
    size = Bungalow(
        wide, round(high + some(3.2, 4.2), 2), open_to, low, high, (leg, leg_end),
        (first, round(first + some(2.0, 2.6), 2)), suite,
        some(0.6, 1.3) if rng.random() < 0.35 else 0.0,
        some(3.2, 3.8) if rng.random() < 0.4 else 0.0,
    )  # fmt: skip
    return _storey(size, Thickness(outer_m, inner_m), rng), size


def _cells(size: Bungalow) -> list[Cell]:
    left, right = size.leg
    first, second = size.back
    living = ((0.0, 0.0), (size.open_to, 0.0), (size.open_to, size.deep), (size.slant, size.deep))
    hall = (
        (left, 0.0), (right, 0.0), (right, size.low), (size.wide, size.low),
        (size.wide, size.high), (size.open_to, size.high), (size.open_to, size.low),
        (left, size.low),
    )  # fmt: skip
    boxes: list[tuple[Box, Use]] = [
        (Box(size.open_to, size.high, first, size.deep), "bedroom"),
        (Box(first, size.high, second, size.deep), "bathroom"),
        (Box(second, size.high, size.wide, size.deep), "bedroom"),
        (Box(size.open_to, 0.0, left, size.low), "study"),
        (Box(right, 0.0, size.suite, size.low), "bedroom"),
        (Box(size.suite, 0.0, size.wide, size.low), "bathroom"),
    ]
    if size.garage:
        boxes.append((Box(size.wide, 0.0, size.wide + size.garage, 5.6), "garage"))
    return [
        Cell(living, (0.0,) * 4, "living"),
        Cell(hall, (0.0,) * len(hall), "hall"),
        *(cell(box, use) for box, use in boxes),
    ]


def _storey(size: Bungalow, thick: Thickness, rng: np.random.Generator) -> Storey:
    cells = _cells(size)
    ids = [f"r{index}" for index in range(len(cells))]
    walls = tuple(
        replace(wall, thickness_m=thick.outer_m) if _is_bearing(wall) else wall
        for wall in walls_of(cells, ids, thick)
    )
    rooms = tuple(
        room_of(name, one.use or "storage", area)
        for name, one, area in zip(ids, cells, room_areas(cells, walls), strict=True)
    )
    return Storey(0, walls, tuple(_openings(walls, size, rng)), rooms)


def _is_bearing(wall: Wall) -> bool:
    """Whether it parts the garage from the house: as thick as outer walls."""
    return "r8" in (wall.left, wall.right)


def _openings(walls: tuple[Wall, ...], size: Bungalow, rng: np.random.Generator) -> list[Opening]:
    found: list[Opening] = []

    def put(
        sides: tuple[str | None, str | None], kind: OpeningKind, form: OpeningType,
        width: float, share: float, towards: tuple[float, float] | None = None,
    ) -> None:  # fmt: skip
        """In the longest wall between two rooms, or the one whose outside lies that way."""
        fitting = [one for one in walls if {one.left, one.right} == set(sides)]
        fitting = [one for one in fitting if towards is None or _faces(one, towards)]
        wall = max(fitting, key=curves.wall_length)
        clear = JAMB_M + wall.thickness_m / 2.0
        free = curves.wall_length(wall) - width - 2.0 * clear
        along = round(clear + share * max(free, 0.0), 3)
        name = f"{'n' if kind == 'window' else 'd'}{len(found)}"
        if form != "swing":
            found.append(Opening(name, wall.id, kind, form, along, width))
            return
        swing = "left" if wall.left == sides[1] else "right"
        hinge = "start" if share < 0.5 else "end"
        found.append(Opening(name, wall.id, kind, form, along, width, hinge, swing))  # type: ignore[arg-type]

    def end() -> float:
        return float(rng.choice([0.02, 0.98]))

    put((None, "r1"), "door", "swing", 0.95, 0.5, (0.0, -1.0))
    put(("r1", "r0"), "door", "swing", 0.85, 0.5)
    for room, width in (("r2", 0.8), ("r3", 0.72), ("r4", 0.8), ("r5", 0.8), ("r6", 0.8)):
        put(("r1", room), "door", "swing", width, end())
    put(("r6", "r7"), "door", "swing", 0.72, end())
    for room, width, way in (
        ("r0", 2.2, (0.0, -1.0)), ("r0", 1.6, (0.0, 1.0)), ("r2", 1.4, (0.0, 1.0)),
        ("r3", 0.7, (0.0, 1.0)), ("r4", 1.5, (0.0, 1.0)), ("r5", 1.3, (0.0, -1.0)),
        ("r6", 1.5, (0.0, -1.0)), ("r7", 0.7, (0.0, -1.0)),
    ):  # fmt: skip
        put((room, None), "window", "double-line", width, float(rng.uniform(0.35, 0.65)), way)
    if not size.slant:
        put(("r0", None), "window", "double-line", 1.8, 0.5, (-1.0, 0.0))
    if size.garage:
        put((None, "r8"), "door", "garage", 2.5, 0.5, (0.0, -1.0))
    return found


def _faces(wall: Wall, way: tuple[float, float]) -> bool:
    """Whether its outside lies that way."""
    (x, y), (xx, yy) = wall.start_m, wall.end_m
    left = np.array([-(yy - y), xx - x]) / np.hypot(xx - x, yy - y)
    outside = left if wall.left is None else -left
    return bool(outside @ np.array(way) > 0.999)
