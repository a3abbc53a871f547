"""A flat in a block: rooms along the street, a hall behind them, the block's stairs in a corner.

The neighbours' flats lie behind the thick walls left and right, which have no windows; the way in
leads from the stairs of all into the hall.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from veduta.synthetic.plans import curves
from veduta.synthetic.plans.dissect import Box, cell
from veduta.synthetic.plans.house import Opening, Storey, Use, Wall
from veduta.synthetic.plans.network import Thickness, room_areas, room_of, walls_of
from veduta.synthetic.seeds import stream

USES: tuple[Use, ...] = (
    "living", "bedroom", "storage", "hall", "kitchen", "bathroom", "bedroom", "stairs",
)  # fmt: skip


@dataclass(frozen=True)
class BlockFlat:
    """The sizes of a flat in metres, between the middles of walls; the street is at y = 0."""

    living: float
    wide: float
    front: float
    hall: float
    back: float
    store: float
    cuts: tuple[float, float, float]
    party: float
    outer: float
    bearing: float
    inner: float

    @property
    def deep(self) -> float:
        """From front to back."""
        return round(self.front + self.hall + self.back, 3)


def block_flat(seed: int) -> tuple[Storey, BlockFlat]:
    """The one storey of a seed: the flat and the stairs, and its sizes."""
    rng = stream(seed, "block flat")

    def some(low: float, high: float) -> float:
        return round(float(rng.uniform(low, high)) * 40.0) / 40.0

    living, stairs = some(4.1, 5.2), some(2.6, 2.9)
    kitchen, bath = some(2.6, 3.2), some(1.9, 2.3)
    least = round(kitchen + bath + some(2.3, 2.9) + stairs, 3)  # a child's room between
    wide = max(round(living + some(4.3, 5.0), 3), least)
    size = BlockFlat(
        living, wide, some(3.9, 4.9), some(1.45, 1.75), some(3.3, 4.2), some(0.95, 1.1),
        (kitchen, round(kitchen + bath, 3), round(wide - stairs, 3)),
        0.3, float(rng.choice([0.3, 0.365, 0.4])), 0.24, 0.115,
    )  # fmt: skip
    return _storey(size, rng), size


def _storey(size: BlockFlat, rng: np.random.Generator) -> Storey:
    low, high = size.front, round(size.front + size.hall, 3)
    first, second, third = size.cuts
    top = size.deep
    boxes = (
        Box(0.0, 0.0, size.living, low), Box(size.living, 0.0, size.wide, low),
        Box(0.0, low, size.store, high), Box(size.store, low, third, high),
        Box(0.0, high, first, top), Box(first, high, second, top),
        Box(second, high, third, top), Box(third, low, size.wide, top),
    )  # fmt: skip
    cells = [cell(one, use) for one, use in zip(boxes, USES, strict=True)]
    ids = [f"r{index}" for index in range(len(cells))]
    walls = tuple(
        replace(wall, thickness_m=_thickness(wall, size))
        for wall in walls_of(cells, ids, Thickness(size.outer, size.inner))
    )
    areas = room_areas(cells, walls)
    rooms = tuple(
        room_of(name, use, area) for name, use, area in zip(ids, USES, areas, strict=True)
    )
    return Storey(0, walls, tuple(_openings(walls, rng)), rooms)


def _thickness(wall: Wall, size: BlockFlat) -> float:
    upright = wall.start_m[0] == wall.end_m[0]
    if wall.outer:
        return size.party if upright else size.outer
    bears = "r7" in (wall.left, wall.right) or (not upright and wall.start_m[1] == size.front)
    return size.bearing if bears else size.inner


def _openings(walls: tuple[Wall, ...], rng: np.random.Generator) -> list[Opening]:
    """The way in, a door to each room, windows to the street and the court, the balcony's door."""
    found: list[Opening] = []
    ways = ((7, 3, 1.01), (3, 0, 0.885), (3, 1, 0.885), (3, 2, 0.76), (3, 4, 0.885),
            (3, 5, 0.76), (3, 6, 0.885))  # fmt: skip
    for one, into, width in ways:
        wall = _longest(walls, {f"r{one}", f"r{into}"})
        free = curves.wall_length(wall) - width - 0.5
        share = float(rng.uniform(0.0, 1.0)) if into not in (0, 3) else 0.75
        along = round(0.25 + share * max(free, 0.0), 3)
        swing = "left" if wall.left == f"r{into}" else "right"
        hinge = "start" if share < 0.5 else "end"
        found.append(
            Opening(f"d{len(found)}", wall.id, "door", "swing", along, width, hinge, swing)  # type: ignore[arg-type]
        )
    wall = _longest(walls, {"r0", None}, lying=True)
    balcony = round(0.55 + float(rng.uniform(0.0, 0.3)), 3)
    swing = "left" if wall.left == "r0" else "right"
    found.append(Opening("d7", wall.id, "door", "swing", balcony, 0.885, "start", swing))  # type: ignore[arg-type]
    rest = curves.wall_length(wall) - balcony - 0.885
    wide = 1.26 if rest > 2.2 else 1.01
    place = round(balcony + 0.885 + (rest - wide) * 0.55, 3)
    found.append(Opening("n0", wall.id, "window", "double-line", place, wide))
    for room, width in (("r1", 1.51), ("r4", 1.01), ("r5", 0.635), ("r6", 1.26), ("r7", 1.01)):
        wall = _longest(walls, {room, None}, lying=True)
        along = round((curves.wall_length(wall) - width) * float(rng.uniform(0.42, 0.58)), 3)
        found.append(Opening(f"n{len(found)}", wall.id, "window", "double-line", along, width))
    return found


def _longest(walls: tuple[Wall, ...], rooms: set[str | None], lying: bool = False) -> Wall:
    fitting = [
        wall for wall in walls
        if {wall.left, wall.right} == rooms
        and (not lying or wall.start_m[1] == wall.end_m[1])
    ]  # fmt: skip
    return max(fitting, key=curves.wall_length)
