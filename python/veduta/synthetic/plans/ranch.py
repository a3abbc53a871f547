"""A house on one floor as American builders sell it from a catalogue.

The great room lies behind the foyer, the owners' rooms on one side, the kitchen with its bay and
the children's rooms on the other; a wall across a corner has the door to the owners' bedroom.
Closets slide, fold or are walked into, baths have doors that slide into the wall.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from veduta.synthetic.plans.dissect import Box, Cell, cell
from veduta.synthetic.plans.house import DoorType, Storey, Use, Wall, WindowType
from veduta.synthetic.plans.network import Thickness, room_areas, room_of, walls_of
from veduta.synthetic.plans.openings_put import Openings
from veduta.synthetic.seeds import stream

GREAT, KITCHEN, FOYER, HALL, BATH, BED_2, BED_3, CLOSET_2, CLOSET_3 = (f"r{n}" for n in range(9))
LAUNDRY, OWNERS, OWNERS_BATH, WALK_IN, GARAGE = (f"r{n}" for n in range(9, 14))
WINDOW: WindowType = "double-line"


@dataclass(frozen=True)
class Ranch:
    """Where walls stand, in metres between their middles.

    `suite`, `great` and `wide` are the right sides of the owners' rooms, the great room and the
    house; `front` is where the rooms behind begin; `corner` the length of the wall across.
    """

    suite: float
    great: float
    wide: float
    front: float
    deep: float
    porch: float
    foyer: float
    bath: float
    hall: float
    closets: tuple[float, float]
    laundry: float
    walk_in: float
    corner: float
    bay: tuple[float, float, float]
    garage: float


def ranch(seed: int, thick: Thickness) -> tuple[Storey, Ranch]:
    """The one storey of a seed, and its sizes."""
    rng = stream(seed, "ranch")

    def some(low: float, high: float) -> float:
        return round(float(rng.uniform(low, high)), 2)

    suite = some(4.3, 5.0)
    great = round(suite + some(4.6, 5.8), 2)
    wide = round(great + some(5.4, 6.6), 2)
    front, foyer = some(4.3, 4.9), round(suite + some(1.9, 2.4), 2)
    bath = round(foyer + some(1.75, 2.1), 2)
    middle = round((bath + wide) / 2.0, 2)
    bay = round(great + some(1.2, 1.6), 2)
    size = Ranch(
        suite, great, wide, front, round(front + some(4.3, 5.2), 2), some(0.9, 1.5), foyer, bath,
        round(front - some(1.15, 1.35), 2), (round(middle - 0.36, 2), round(middle + 0.36, 2)),
        round(wide - some(1.9, 2.3), 2), some(1.8, 2.3),
        some(1.05, 1.3) if rng.random() < 0.7 else 0.0,
        (bay, round(bay + some(2.2, 2.8), 2), some(0.6, 0.9)), some(5.6, 6.3),
    )  # fmt: skip
    return _storey(size, thick, rng), size


def _cells(size: Ranch) -> list[Cell]:
    f, t, s, g, w = size.front, size.deep, size.suite, size.great, size.wide
    low, high = size.closets
    half = round(size.hall / 2.0, 2)
    bay_from, bay_to, out = size.bay
    cut = size.corner
    great = [(s, f), (g, f), (g, t), (s, t)]
    owners = [(0.0, f), (s, f), (s, t), (0.0, t)]
    if cut:
        great = [(round(s - cut, 2), f), (g, f), (g, t), (s, t), (s, round(f + cut, 2))]
        owners = [(0.0, f), (round(s - cut, 2), f), (s, round(f + cut, 2)), (s, t), (0.0, t)]
    kitchen = [(g, f), (w, f), (w, t), (bay_to, t), (bay_to, round(t + out, 2)),
               (bay_from, round(t + out, 2)), (bay_from, t), (g, t)]  # fmt: skip

    def ring(corners: list[tuple[float, float]], use: Use) -> Cell:
        return Cell(tuple(corners), (0.0,) * len(corners), use)

    return [
        ring(great, "living"),
        ring(kitchen, "kitchen"),
        cell(Box(s, size.porch, size.foyer, f), "hall"),
        cell(Box(size.foyer, size.hall, size.laundry, f), "corridor"),
        cell(Box(size.foyer, 0.0, size.bath, size.hall), "bathroom"),
        cell(Box(size.bath, 0.0, low, size.hall), "bedroom"),
        cell(Box(high, 0.0, w, size.hall), "bedroom"),
        cell(Box(low, 0.0, high, half), "wardrobe"),
        cell(Box(low, half, high, size.hall), "wardrobe"),
        cell(Box(size.laundry, size.hall, w, f), "utility"),
        ring(owners, "bedroom"),
        cell(Box(0.0, 0.0, round(s - size.walk_in, 2), f), "bathroom"),
        cell(Box(round(s - size.walk_in, 2), 0.0, s, f), "wardrobe"),
        cell(Box(w, 0.0, round(w + size.garage, 2), 6.1), "garage"),
    ]


def _storey(size: Ranch, thick: Thickness, rng: np.random.Generator) -> Storey:
    cells = _cells(size)
    ids = [f"r{index}" for index in range(len(cells))]
    walls = walls_of(cells, ids, thick)
    rooms = tuple(
        room_of(name, one.use or "storage", area)
        for name, one, area in zip(ids, cells, room_areas(cells, walls), strict=True)
    )
    return Storey(0, walls, tuple(_openings(walls, size, rng).found), rooms)


def _openings(walls: tuple[Wall, ...], size: Ranch, rng: np.random.Generator) -> Openings:
    made = Openings(walls)

    def end() -> float:
        return float(rng.choice([0.02, 0.98]))

    def some(*names: DoorType) -> DoorType:
        return names[int(rng.integers(len(names)))]

    made.put((None, FOYER), "swing", 0.96, 0.5, (0.0, -1.0))
    made.put((FOYER, GREAT), "plain", 1.5, 0.5)
    made.put((GREAT, KITCHEN), "plain", float(rng.uniform(1.8, 2.8)), 0.6)
    made.put((FOYER, HALL), "plain", 0.95, 0.5)
    made.put((GREAT, OWNERS), "swing", 0.86, 0.5 if size.corner else 0.02, None, size.corner > 0.0)
    made.put((OWNERS, OWNERS_BATH), some("pocket", "pocket", "double", "swing"), 0.9, 0.98)
    made.put((OWNERS_BATH, WALK_IN), some("pocket", "swing"), 0.76, 0.98)
    made.put((HALL, BATH), some("pocket", "swing"), 0.76, 0.98)
    made.put((HALL, BED_2), "swing", 0.81, end())
    made.put((HALL, BED_3), "swing", 0.81, 0.02)
    made.put((HALL, LAUNDRY), some("swing", "pocket"), 0.81, 0.5)
    made.put((CLOSET_2, BED_2), some("sliding", "folding", "double"), 1.25, 0.5)
    made.put((CLOSET_3, BED_3), some("sliding", "folding", "double"), 1.25, 0.5)
    made.put((LAUNDRY, GARAGE), "swing", 0.86, 0.5)
    made.put((None, GARAGE), "garage", 4.88, 0.5, (0.0, -1.0))
    made.put((GREAT, None), some("sliding", "french"), 1.83, 0.5, (0.0, 1.0))
    for room, width, way in (
        (OWNERS, 1.8, (0.0, 1.0)), (OWNERS_BATH, 0.9, (-1.0, 0.0)), (KITCHEN, 1.6, (0.0, 1.0)),
        (BED_2, 1.5, (0.0, -1.0)), (BED_3, 1.5, (0.0, -1.0)), (BATH, 0.6, (0.0, -1.0)),
    ):  # fmt: skip
        made.put((room, None), WINDOW, width, float(rng.uniform(0.4, 0.6)), way)
    return made
