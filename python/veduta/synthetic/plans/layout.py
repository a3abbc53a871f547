"""A whole house from a seed: cells, walls, doors, windows, stairs."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from shapely.geometry import Polygon

from veduta.synthetic.plans import doors
from veduta.synthetic.plans.dissect import Box, Cell, Widening, cell, corridor_cells, cut
from veduta.synthetic.plans.house import (
    DoorType,
    House,
    Language,
    Opening,
    Room,
    Storey,
    Use,
    Wall,
    WindowType,
)
from veduta.synthetic.plans.network import (
    Thickness,
    cell_area,
    is_sound,
    room_areas,
    room_of,
    walls_of,
)
from veduta.synthetic.plans.outline import with_features
from veduta.synthetic.plans.places import swept
from veduta.synthetic.plans.stairs import StairPlan, stair_plan, stairs_in
from veduta.synthetic.plans.uses import uses_of
from veduta.synthetic.plans.windows import windows_of
from veduta.synthetic.seeds import stream

ATTEMPTS = 60
LEAST_CORRIDOR_M = 1.15
WINDOWS: tuple[WindowType, ...] = ("single-line", "double-line", "triple-line", "filled")
WING_SHARE = 0.25
PLACE_ATTEMPTS = 8
CLASH_M2 = 0.03
OUTSIDE_DOORS: tuple[tuple[Use, DoorType, float], ...] = (
    ("garage", "garage", 1.0), ("living", "french", 0.35), ("living", "sliding", 0.5),
)  # fmt: skip
"""Where they lead from, of which type, and how often."""

FEATURES = {"corner": 0.15, "bay": 0.22, "bow": 0.12}


class LayoutFault(Exception):
    """No sound layout was found for a seed."""


@dataclass(frozen=True)
class Frame:
    """What all storeys of a house share."""

    box: Box
    corridor: Box | None
    stairs: Box | None
    thickness: Thickness
    windows: WindowType
    climb: StairPlan | None = None

    @property
    def widening(self) -> Widening | None:
        """What makes room for the stairs."""
        if self.stairs is None or self.climb is None:
            return None
        walls = (self.thickness.outer_m + self.thickness.inner_m) / 2.0
        wide, deep = (round(side + walls + 0.005, 2) for side in self.climb.room_m)
        old = self.stairs
        return Widening(
            old, max(old.right, old.left + wide), max(old.top, round(old.bottom + deep, 2))
        )


def make_house(seed: int, language: Language = "en", storeys: int | None = None) -> House:
    """The house of this seed; one or two storeys unless told. Raises LayoutFault."""
    rng = stream(seed, "house")
    count = storeys or int(rng.choice([1, 2], p=[0.8, 0.2]))
    frame = _frame(stream(seed, "frame"), count)
    if frame.stairs is not None:
        frame = replace(frame, climb=stair_plan(stream(seed, "stairs")))
    made = tuple(_storey(seed, number, frame, language) for number in range(count))
    return House(seed, made)


def _frame(rng: np.random.Generator, storeys: int) -> Frame:
    thickness = Thickness(round(rng.uniform(0.22, 0.4), 2), round(rng.uniform(0.1, 0.16), 2))
    windows = WINDOWS[int(rng.integers(len(WINDOWS)))]
    banded = storeys > 1 or rng.random() < 0.6
    if not banded:
        wide, high = round(rng.uniform(6.5, 12.0), 2), round(rng.uniform(6.0, 10.0), 2)
        return Frame(Box(0.0, 0.0, wide, high), None, None, thickness, windows)
    wide = round(rng.uniform(8.0, 15.0), 2)
    below, across, above = (
        round(rng.uniform(*size), 2) for size in ((2.8, 4.6), (1.5, 2.0), (2.8, 4.6))
    )
    corridor = Box(0.0, below, wide, round(below + across, 2))
    if rng.random() < 0.5 and wide > 9.5:
        left = round(rng.uniform(2.4, 3.2), 2) if rng.random() < 0.5 and storeys == 1 else 0.0
        right = wide if left else round(wide - rng.uniform(2.4, 3.4), 2)
        corridor = Box(left, below, right, corridor.top)
    box = Box(0.0, 0.0, wide, round(corridor.top + above, 2))
    stairs = None
    if storeys > 1:
        length = round(rng.uniform(2.9, 3.6), 2)
        stairs = Box(
            0.0, corridor.top, round(rng.uniform(1.2, 1.5), 2), round(corridor.top + length, 2)
        )
        if box.top - stairs.top < 1.4:
            stairs = Box(0.0, corridor.top, stairs.right, box.top)
    return Frame(box, corridor, stairs, thickness, windows)


def _cells(rng: np.random.Generator, frame: Frame, number: int) -> list[Cell]:
    if frame.corridor:
        cells = corridor_cells(rng, frame.box, frame.corridor, frame.stairs, number == 0)
    else:
        cells = _cut_with_hall(rng, frame.box)
    box = frame.box
    if frame.stairs is None and rng.random() < WING_SHARE:
        wide, deep = round(rng.uniform(3.4, 5.5), 2), round(rng.uniform(2.6, 3.8), 2)
        left = float(rng.choice([box.left, box.right - wide]))
        cells += cut(rng, Box(left, box.top, round(left + wide, 2), box.top + deep), 1.6, 4.0)
    if number == 0 and rng.random() < 0.25:
        deep = round(rng.uniform(3.2, 3.8), 2)
        top = round(rng.uniform(5.2, 6.2), 2)
        cells.append(
            cell(Box(box.right, box.bottom, box.right + deep, min(top, box.top)), "garage")
        )
    wider = frame.widening
    return with_features(rng, [wider.cell(one) for one in cells] if wider else cells, FEATURES)


def _cut_with_hall(rng: np.random.Generator, box: Box) -> list[Cell]:
    """Cuts of what is largest, with a hall cut off at the middle of a side first."""
    wide = round(rng.uniform(1.6, 2.2), 2)
    left = round(rng.uniform(0.35, 0.6) * box.width, 2)
    deep = round(rng.uniform(0.45, 0.6) * box.height, 2)
    hall = cell(Box(left, 0.0, left + wide, deep), "hall")
    least, most = 1.6, float(rng.uniform(3.6, 4.8))
    return [
        hall,
        *cut(rng, Box(0.0, 0.0, left, deep), least, most),
        *cut(rng, Box(left + wide, 0.0, box.right, deep), least, most),
        *cut(rng, Box(0.0, deep, box.right, box.top), least, most),
    ]


def _storey(seed: int, number: int, frame: Frame, language: Language) -> Storey:
    for attempt in range(ATTEMPTS):
        rng = stream(seed, f"storey {number} attempt {attempt}")
        cells = _cells(rng, frame, number)
        if not is_sound(cells):
            continue
        storey = _furnished_with_openings(rng, cells, number, frame, language)
        if storey is not None:
            return storey
    raise LayoutFault(f"no sound layout of storey {number} for seed {seed}")


def _furnished_with_openings(
    rng: np.random.Generator, cells: Sequence[Cell], number: int, frame: Frame, language: Language
) -> Storey | None:
    ids = [f"r{index}" for index in range(len(cells))]
    walls = walls_of(cells, ids, frame.thickness)
    areas = [cell_area(cell) for cell in cells]
    beside: list[set[int]] = [set() for _ in cells]
    for wall in walls:
        if wall.left and wall.right:
            first, second = ids.index(wall.left), ids.index(wall.right)
            beside[first].add(second)
            beside[second].add(first)
    given = [cell.use for cell in cells]
    uses = dict(zip(ids, uses_of(rng, areas, given, beside, number, language), strict=True))
    rooms = _rooms(ids, uses, room_areas(cells, walls))
    steps = tuple(
        stairs_in(Polygon(room.outline_m), frame.climb)
        for room in rooms
        if room.use == "stairs" and frame.climb
    )
    ways = _doors(rng, walls, uses, number, [Polygon(one.outline_m) for one in steps])
    if ways is None:
        return None
    windows = windows_of(rng, walls, uses, ways, frame.windows)
    return Storey(number, walls, (*ways, *windows), rooms, steps)


def _rooms(ids: Sequence[str], uses: dict[str, Use], areas: Sequence[Polygon]) -> tuple[Room, ...]:
    return tuple(room_of(name, uses[name], area) for name, area in zip(ids, areas, strict=True))


def _doors(
    rng: np.random.Generator,
    walls: Sequence[Wall],
    uses: dict[str, Use],
    number: int,
    stairs: Sequence[Polygon],
) -> list[Opening] | None:
    """Doors to all rooms, the entrance, and a few more; None where a room cannot be entered.

    None opens onto stairs, or swings into their room.
    """
    front = None if number else doors.entrance(rng, walls, uses)
    root = front[0] if front else next((n for n, use in uses.items() if use == "stairs"), None)
    ways = doors.way_to_all(walls, uses, root) if root else None
    if ways is None or root is None or (front is None and number == 0):
        return None
    placed = _Placed(rng, stairs)
    for name, wall in ways:
        other = wall.right if wall.left == name else wall.left
        kind = doors.inner_type(rng, uses[name], uses[other or name])
        outward = uses[name] in ("toilet", "storage", "wardrobe", "stairs")
        into = other if outward else name
        if not (placed.put(wall, kind, into) or placed.put(wall, "swing", into)):
            return None
    if front:
        kind = "double" if rng.random() < 0.15 else "swing"
        if not (placed.put(front[1], kind, root) or placed.put(front[1], "swing", root)):
            return None
        _more_outside(rng, walls, uses, placed)
    return placed.doors


class _Placed:
    """Doors so far, none of which swings into another."""

    def __init__(self, rng: np.random.Generator, taken: Sequence[Polygon]) -> None:
        self.rng = rng
        self.doors: list[Opening] = []
        self.taken = [*taken]

    def put(self, wall: Wall, kind: DoorType, into: str | None) -> bool:
        """Place a door in the wall; false where none fits clear of the others."""
        for _ in range(PLACE_ATTEMPTS):
            door = doors.place_door(self.rng, wall, kind, into, len(self.doors))
            if door is None:
                return False
            area = swept(wall, door)
            if not any(area.intersection(other).area > CLASH_M2 for other in self.taken):
                self.doors.append(door)
                self.taken.append(area)
                return True
        return False


def _more_outside(
    rng: np.random.Generator, walls: Sequence[Wall], uses: dict[str, Use], placed: _Placed
) -> None:
    """The garage's door and one to the garden."""
    taken = {door.wall for door in placed.doors}
    for use, kind, share in OUTSIDE_DOORS:
        for room in [name for name, of in uses.items() if of == use]:
            wall = doors.entrance_wall(rng, walls, room)
            if wall is None or wall.id in taken or rng.random() >= share:
                continue
            if placed.put(wall, kind, None):
                taken.add(wall.id)
                break
