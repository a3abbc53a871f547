"""The upper floor of such a house: bedrooms about a gallery that looks down into the great room.

What lies open to below has walls on three sides and a railing on the fourth; it has no floor, so
it is no room.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from veduta.synthetic.plans.dissect import Box, cell
from veduta.synthetic.plans.house import DoorType, Stairs, Storey, Use, Wall, WindowType
from veduta.synthetic.plans.network import Thickness, room_areas, room_of, walls_of
from veduta.synthetic.plans.openings_put import Openings
from veduta.synthetic.seeds import stream

LANDING, VOID, LEFT, LEFT_FRONT, RIGHT, RIGHT_FRONT, MIDDLE, BATH = (f"r{n}" for n in range(8))
CLOSETS = ("r8", "r9", "r10", "r11")
USES: tuple[Use, ...] = (
    "hall", "storage", "bedroom", "bedroom", "bedroom", "bedroom", "bedroom", "bathroom",
    "wardrobe", "wardrobe", "wardrobe", "wardrobe",
)  # fmt: skip
WINDOW: WindowType = "double-line"
TREADS = 14


@dataclass(frozen=True)
class Gallery:
    """Where walls stand, in metres between their middles.

    The middle part from `left` to `right` has the landing from `low` to `high` and the void above
    it on the page; `parts` is where the rooms on both sides are parted, `flight`
    the stairs' well on the landing: left, bottom, right, top.
    """

    left: float
    right: float
    wide: float
    low: float
    high: float
    deep: float
    bath: float
    closets: float
    parts: tuple[float, float]
    flight: tuple[float, float, float, float]


def gallery(seed: int, thick: Thickness) -> tuple[Storey, Gallery]:
    """The storey of a seed, whose void is left out of its rooms, and its sizes."""
    rng = stream(seed, "gallery")

    def some(low: float, high: float) -> float:
        return round(float(rng.uniform(low, high)), 2)

    left = some(3.6, 4.3)
    right = round(left + some(4.8, 5.8), 2)
    low = some(3.0, 3.5)
    high = round(low + some(2.2, 2.7), 2)
    edge = thick.inner_m / 2.0
    size = Gallery(
        left, right, round(right + some(3.6, 4.3), 2), low, high, round(high + some(3.6, 4.4), 2),
        some(1.7, 2.1), some(0.68, 0.8),
        (round(low + some(0.9, 1.3), 2), round(low + some(1.0, 1.3), 2)),
        (right - 3.4, high - 1.0, right - edge, high),
    )  # fmt: skip
    return _storey(size, thick, rng), size


def _boxes(size: Gallery) -> tuple[Box, ...]:
    bath = round(size.left + size.bath, 2)
    near, far = size.closets, round(size.wide - size.closets, 2)
    first, second = size.parts
    return (
        Box(size.left, size.low, size.right, size.high),
        Box(size.left, size.high, size.right, size.deep),
        Box(near, first, size.left, size.deep),
        Box(near, 0.0, size.left, first),
        Box(size.right, second, far, size.deep),
        Box(size.right, 0.0, far, second),
        Box(bath, 0.0, size.right, size.low),
        Box(size.left, 0.0, bath, size.low),
        Box(0.0, first, near, size.deep),
        Box(0.0, 0.0, near, first),
        Box(far, second, size.wide, size.deep),
        Box(far, 0.0, size.wide, second),
    )


def _storey(size: Gallery, thick: Thickness, rng: np.random.Generator) -> Storey:
    cells = [cell(one, use) for one, use in zip(_boxes(size), USES, strict=True)]
    ids = [f"r{index}" for index in range(len(cells))]
    walls = tuple(
        one for one in walls_of(cells, ids, thick) if {one.left, one.right} != {LANDING, VOID}
    )
    areas = room_areas(cells, walls)
    stairs = _stairs(size)
    rooms = tuple(
        room_of(name, use, area)
        for name, use, area in zip(ids, USES, areas, strict=True)
        if name != VOID
    )
    return Storey(1, walls, tuple(_openings(walls, rng).found), rooms, (stairs,))


def _stairs(size: Gallery) -> Stairs:
    """A straight flight along the railing, whose top is at the middle of the landing."""
    left, bottom, right, top = size.flight
    outline = ((left, bottom), (right, bottom), (right, top), (left, top))
    return Stairs(outline, TREADS, (-1.0, 0.0))


def _openings(walls: tuple[Wall, ...], rng: np.random.Generator) -> Openings:
    made = Openings(walls)

    def some(*names: DoorType) -> DoorType:
        return names[int(rng.integers(len(names)))]

    for room in (LEFT, LEFT_FRONT, RIGHT_FRONT, MIDDLE):
        made.put((LANDING, room), "swing", 0.81, float(rng.choice([0.02, 0.98])))
    made.put((LANDING, RIGHT), "swing", 0.81, 0.02)
    made.put((LANDING, BATH), some("pocket", "swing"), 0.76, 0.98)
    for room, closet in zip((LEFT, LEFT_FRONT, RIGHT, RIGHT_FRONT), CLOSETS, strict=True):
        form = some("sliding", "folding", "double")
        made.put((closet, room), form, 1.5, float(rng.uniform(0.3, 0.7)))
    for room, width, way in (
        (LEFT, 1.5, (0.0, 1.0)), (LEFT_FRONT, 1.5, (0.0, -1.0)), (RIGHT, 1.5, (0.0, 1.0)),
        (RIGHT_FRONT, 1.5, (0.0, -1.0)), (MIDDLE, 1.5, (0.0, -1.0)), (BATH, 0.6, (0.0, -1.0)),
        (VOID, 2.4, (0.0, 1.0)),
    ):  # fmt: skip
        made.put((room, None), WINDOW, width, float(rng.uniform(0.4, 0.6)), way)
    return made
