"""A flat in a block of Japan: a hall from the way in to the open room before the balcony.

Rooms lie left and right of the hall; a room with mats opens to the open one by sliding panels, as
closets do to their rooms. The balcony is at y < 0, the way in at the top.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from veduta.synthetic.plans import curves
from veduta.synthetic.plans.dissect import Box, cell
from veduta.synthetic.plans.house import (
    DoorType,
    Hinge,
    Opening,
    OpeningKind,
    OpeningType,
    Storey,
    Use,
    Wall,
)
from veduta.synthetic.plans.network import Thickness, room_areas, room_of, walls_of
from veduta.synthetic.seeds import stream

USES: tuple[Use, ...] = (
    "living", "bedroom", "wardrobe", "hall", "kitchen", "bedroom", "wardrobe", "bedroom",
    "toilet", "utility", "bathroom",
)  # fmt: skip
CLEAR_M = 0.12
"""So much wall stays beside an opening, from the face of the wall at its end."""


@dataclass(frozen=True)
class Mansion:
    """Where walls stand, in metres between their middles.

    `mats` parts the open room from that with mats, `front` is the depth of both, `hall` its left
    and right; `left` are the ends of kitchen and closet up along the hall, `right` those of bath
    and the rooms for washing beside it.
    """

    wide: float
    deep: float
    mats: float
    front: float
    hall: tuple[float, float]
    left: tuple[float, float]
    right: tuple[float, float]
    toilet: float


def mansion(seed: int, thick: Thickness) -> tuple[Storey, Mansion]:
    """The one storey of a seed, and its sizes."""
    rng = stream(seed, "mansion")

    def some(low: float, high: float) -> float:
        return round(float(rng.uniform(low, high)), 2)

    hall, front = some(2.6, 3.0), some(3.4, 4.2)
    hall_to = round(hall + some(1.15, 1.35), 2)
    mats = round(hall_to + some(0.0, 0.5), 2)
    wide = round(mats + some(2.6, 3.1), 2)
    kitchen = round(front + some(2.2, 2.7), 2)
    closet = round(kitchen + some(0.75, 0.9), 2)
    bath = round(front + some(1.65, 1.9), 2)
    wash = round(bath + some(1.7, 2.0), 2)
    deep = round(max(closet, wash) + some(2.7, 3.5), 2)
    size = Mansion(
        wide, deep, mats, front, (hall, hall_to),
        (kitchen, closet), (bath, wash), round(wide - some(0.95, 1.1), 2),
    )  # fmt: skip
    return _storey(size, thick, rng), size


def _boxes(size: Mansion) -> tuple[Box, ...]:
    low, high = size.hall
    kitchen, closet = size.left
    bath, wash = size.right
    return (
        Box(0.0, 0.0, size.mats, size.front),
        Box(size.mats, 0.0, size.wide, round(size.front - 0.85, 2)),
        Box(size.mats, round(size.front - 0.85, 2), size.wide, size.front),
        Box(low, size.front, high, size.deep),
        Box(0.0, size.front, low, kitchen),
        Box(0.0, closet, low, size.deep),
        Box(0.0, kitchen, low, closet),
        Box(high, wash, size.wide, size.deep),
        Box(size.toilet, bath, size.wide, wash),
        Box(high, bath, size.toilet, wash),
        Box(high, size.front, size.wide, bath),
    )


def _storey(size: Mansion, thick: Thickness, rng: np.random.Generator) -> Storey:
    cells = [cell(one, use) for one, use in zip(_boxes(size), USES, strict=True)]
    ids = [f"r{index}" for index in range(len(cells))]
    walls = walls_of(cells, ids, thick)
    rooms = tuple(
        room_of(name, use, area)
        for name, use, area in zip(ids, USES, room_areas(cells, walls), strict=True)
    )
    return Storey(0, walls, tuple(_openings(walls, rng)), rooms)


def _openings(walls: Sequence[Wall], rng: np.random.Generator) -> list[Opening]:
    """Sliding where such flats slide: closets, mats, washing; leaves where they do not."""
    found: list[Opening] = []

    def some(*names: DoorType) -> DoorType:
        return names[int(rng.integers(len(names)))]

    def put(
        sides: tuple[str | None, str | None], kind: OpeningKind, form: OpeningType, width: float,
        share: float, top: bool | None = None,
    ) -> None:  # fmt: skip
        """In the longest wall between two; `top`: that above the other, outdoors being twice."""
        fitting = [one for one in walls if {one.left, one.right} == set(sides)]
        if top is not None:
            fitting = [one for one in fitting if one.start_m[1] == one.end_m[1]]
            level = (max if top else min)(one.start_m[1] for one in fitting)
            fitting = [one for one in fitting if one.start_m[1] == level]
        wall = max(fitting, key=curves.wall_length)
        clear = CLEAR_M + max(one.thickness_m for one in walls) / 2.0
        free = curves.wall_length(wall) - 2.0 * clear
        wide = min(width, free)
        if form == "pocket":
            wide = min(wide, 0.48 * free)
            share = 1.0  # the leaf slides into the wall before it
        along = round(clear + share * (free - wide), 3)
        hinge: Hinge = "none"
        if form in ("swing", "folding"):
            hinge = "start" if share < 0.5 else "end"
        if form == "double":
            hinge = "both"
        if form == "pocket":
            hinge = "start"
        turns = form in ("swing", "folding", "double")
        swing = "none" if not turns else "left" if wall.left == sides[1] else "right"
        name = f"{'n' if kind == 'window' else 'd'}{len(found)}"
        found.append(Opening(name, wall.id, kind, form, along, round(wide, 3), hinge, swing))  # type: ignore[arg-type]

    def end() -> float:
        return float(rng.choice([0.02, 0.98]))

    put((None, "r3"), "door", "swing", 0.85, 0.5, top=True)
    put(("r3", "r0"), "door", some("swing", "sliding"), 0.8, 0.5)
    put(("r0", "r1"), "door", "sliding", float(rng.uniform(1.6, 1.85)), float(rng.uniform(0, 1)))
    put(("r1", "r2"), "door", some("sliding", "sliding", "double"), 1.65, 0.5)
    put(("r0", "r4"), "gap", "plain", float(rng.uniform(1.2, 1.7)), float(rng.uniform(0.3, 0.7)))
    put(("r3", "r5"), "door", some("swing", "sliding", "pocket"), 0.75, end())
    put(("r5", "r6"), "door", some("folding", "sliding", "double"), 1.6, float(rng.uniform(0, 1)))
    put(("r3", "r7"), "door", some("swing", "sliding", "pocket"), 0.75, end())
    put(("r9", "r8"), "door", "swing", 0.65, end())
    put(("r3", "r9"), "door", some("sliding", "pocket", "swing"), 0.72, end())
    put(("r9", "r10"), "door", some("folding", "swing"), 0.66, 0.5)
    put(("r0", None), "window", "double-line", 2.4, 0.5, top=False)
    put(("r1", None), "window", "double-line", 1.75, 0.5, top=False)
    put(("r5", None), "window", "double-line", 1.5, 0.5, top=True)
    put(("r7", None), "window", "double-line", 1.3, 0.5, top=True)
    return found
