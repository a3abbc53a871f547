"""An old house with thick walls on its plot: two rooms beside a hall, small ones behind.

The hall lies between two rooms that have their fireplaces in the gables; behind stand a bedroom or
two, a bath and a store in a lower range. The gables are thick, the range is thinner.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from veduta.synthetic.plans import curves
from veduta.synthetic.plans.dissect import Box, cell
from veduta.synthetic.plans.house import Opening, Storey, Use, Wall
from veduta.synthetic.plans.network import Thickness, room_areas, room_of, walls_of
from veduta.synthetic.seeds import stream


@dataclass(frozen=True)
class Cottage:
    """The sizes of a house in metres, between the middles of walls; the door faces down."""

    left: float
    hall: float
    right: float
    deep: float
    behind: float
    cuts: tuple[float, ...]
    gable: float
    outer: float
    inner: float

    @property
    def wide(self) -> float:
        """From gable to gable."""
        return self.left + self.hall + self.right


def cottage(seed: int) -> tuple[Storey, Cottage]:
    """The one storey of a seed, and its sizes."""
    rng = stream(seed, "cottage")

    def some(low: float, high: float) -> float:
        return round(float(rng.uniform(low, high)), 2)

    left, hall, right = some(3.8, 5.2), some(1.7, 2.2), some(3.6, 5.0)
    wide = left + hall + right
    # Where the range behind is cut: the middle piece stands behind the hall and reaches beyond it.
    cuts = (0.0, round(left - some(0.3, 1.2), 2), round(left + hall + some(0.3, 0.9), 2), wide)
    size = Cottage(
        left, hall, right, some(4.2, 5.4), some(2.7, 3.6), cuts,
        some(0.5, 0.65), some(0.36, 0.48), some(0.11, 0.2),
    )  # fmt: skip
    return _storey(size, rng), size


def _storey(size: Cottage, rng: np.random.Generator) -> Storey:
    deep, top = size.deep, size.deep + size.behind
    first, second = size.left, size.left + size.hall
    uses: tuple[Use, ...] = ("living", "hall", "kitchen", "bedroom", "bathroom", "bedroom")
    boxes = [
        Box(0.0, 0.0, first, deep), Box(first, 0.0, second, deep),
        Box(second, 0.0, size.wide, deep),
        *(Box(a, deep, b, top) for a, b in zip(size.cuts, size.cuts[1:], strict=False)),
    ]  # fmt: skip
    cells = [cell(one, use) for one, use in zip(boxes, uses, strict=True)]
    ids = [f"r{index}" for index in range(len(cells))]
    walls = tuple(
        replace(wall, thickness_m=size.gable) if _in_gable(wall, size) else wall
        for wall in walls_of(cells, ids, Thickness(size.outer, size.inner))
    )
    openings = _doors(walls, size, rng) + _windows(walls, uses, rng)
    areas = room_areas(cells, walls)
    rooms = tuple(
        room_of(name, one.use or "storage", area)
        for name, one, area in zip(ids, cells, areas, strict=True)
    )
    return Storey(0, walls, tuple(openings), rooms)


def _in_gable(wall: Wall, size: Cottage) -> bool:
    """Gables are the sides of the front part alone."""
    x = {wall.start_m[0], wall.end_m[0]}
    low = max(wall.start_m[1], wall.end_m[1]) <= size.deep + 1e-6
    return low and (x == {0.0} or x == {round(size.wide, 3)})


def _doors(walls: tuple[Wall, ...], size: Cottage, rng: np.random.Generator) -> list[Opening]:
    """One way to each room: from the hall to all but the last, which lies behind the kitchen."""
    ways = [(None, 1), (1, 0), (1, 2), (0, 3), (1, 4), (2, 5)]
    doors = []
    for number, (a, b) in enumerate(ways):
        names = {None if one is None else f"r{one}" for one in (a, b)}
        fitting = [wall for wall in walls if {wall.left, wall.right} == names]
        wall = max(fitting, key=curves.wall_length)
        width = round(float(rng.uniform(0.8, 0.92)), 2) if a is None else 0.78
        room = curves.wall_length(wall) - width - 0.6
        share = 0.5 if a is None else float(rng.uniform(0.05, 0.95))
        along = round(0.3 + share * max(room, 0.0), 3)
        swing = "left" if wall.left == f"r{b}" else "right"
        hinge = "start" if share < 0.5 else "end"
        doors.append(Opening(f"d{number}", wall.id, "door", "swing", along, width, hinge, swing))  # type: ignore[arg-type]
    return doors


def _windows(
    walls: tuple[Wall, ...], uses: tuple[Use, ...], rng: np.random.Generator
) -> list[Opening]:
    """Small ones, one or two in each outer wall but the gables and the hall's."""
    found: list[Opening] = []
    for wall in walls:
        room = wall.left or wall.right
        upright = wall.start_m[0] == wall.end_m[0]
        if not wall.outer or room is None or upright or uses[int(room[1:])] == "hall":
            continue
        length = curves.wall_length(wall)
        count = 2 if length > 4.4 and rng.random() < 0.5 else 1
        width = 0.6 if uses[int(room[1:])] == "bathroom" else round(float(rng.uniform(0.9, 1.2)), 2)
        for index in range(count):
            along = round((index + 0.5) * length / count - width / 2.0, 3)
            name = f"n{len(found)}"
            found.append(Opening(name, wall.id, "window", "triple-line", along, width))
    return found
