"""The facades of one call as one place: on their walls, or side by side along a street.

Where fronts were put on walls of one frame, they stand there. Otherwise nothing says where the
buildings stand to each other, and the arrangement is marked as invented: x along the street, y away
from it, z up; the fronts are at y = 0.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import chain, count
from pathlib import Path
from typing import cast

import numpy as np
from numpy.typing import NDArray
from pydantic import JsonValue

from veduta.facade.document import FacadeDocument
from veduta.facade.house_folders import Beside
from veduta.place.manifest import IDENTITY, Bounds, PlacePart, Start
from veduta.place.place import Place

GAP_M = 3.0
"""Between neighbours: wide enough to see the sides, too narrow to lose the street."""
EYE_M = 1.7
MIN_DISTANCE_M, MAX_DISTANCE_M = 12.0, 40.0
STANDS = "stands"
"""In an item's summary: where a building stands whose front was put on a wall."""

Vector = tuple[float, float, float]


@dataclass(frozen=True)
class Stand:
    """Where a building stands: world_from_part (4x4, column-major), in metres from an origin."""

    transform: tuple[float, ...]
    crs: str | None
    origin_m: Vector


@dataclass(frozen=True)
class Placed:
    """A finished building: the folder of its files, and its box in its own frame (m)."""

    name: str
    low: Vector
    high: Vector
    stand: Stand | None = None
    beside: tuple[Beside, ...] = ()

    @property
    def row(self) -> tuple[float, float]:
        """From where to where all houses of its photo stand, along x of its own frame (m)."""
        lows = [self.low[0], *(one.offset_m + one.low[0] for one in self.beside)]
        highs = [self.high[0], *(one.offset_m + one.high[0] for one in self.beside)]
        return min(lows), max(highs)


def stands(document: FacadeDocument) -> dict[str, JsonValue]:
    """What the summary of a building says of its wall; nothing where it has none."""
    wall = document.wall
    if wall is None:
        return {}
    matrix = wall.world_from_part(document.facade.width_m)
    return {
        STANDS: {
            "transform": list(matrix.T.ravel().tolist()),
            "crs": wall.crs,
            "origin_m": list(wall.origin_m),
            "told": wall.told,
        }
    }


def wall_line(summary: Mapping[str, JsonValue]) -> str:
    """Which wall the front was put on, in a line; empty where on none."""
    told = summary.get(STANDS)
    return f"on {told['told']}" if isinstance(told, dict) else ""


def stand_of(summary: Mapping[str, JsonValue]) -> Stand | None:
    """The same, read back."""
    told = summary.get(STANDS)
    if not isinstance(told, dict):
        return None
    transform = cast(list[float], told["transform"])
    x, y, z = cast(list[float], told["origin_m"])
    return Stand(tuple(transform), cast(str | None, told["crs"]), (x, y, z))


def arrange(buildings: Sequence[Placed], out: Path) -> Place:
    """The place of these buildings, each on its wall, or from left to right in the order given.

    Their models lie in OUT already, each written when its photo was done.
    """
    frames = {(one.stand.crs, one.stand.origin_m) if one.stand else None for one in buildings}
    if len(frames) == 1 and None not in frames:
        return _on_walls(buildings, out)
    place = Place()
    taken = {building.name for building in buildings}
    at_m = 0.0
    for building in buildings:
        left, right = building.row
        shift_m = at_m - left if place.parts else 0.0
        invented = len(buildings) > 1
        place.lay(_part(building, _along(shift_m), invented=invented), out)
        for one in building.beside:
            house = Placed(f"{building.name}/{one.folder}", one.low, one.high)
            part = _part(house, _along(shift_m + one.offset_m), invented=invented)
            place.lay(part.model_copy(update={"id": _free_id(part.id, taken)}), out)
        at_m = right + shift_m + GAP_M
    place.start = _start(buildings, at_m - GAP_M)
    return place


def _free_id(wanted: str, taken: set[str]) -> str:
    """The id, with a number where another photo is called so; it is taken from then on."""
    tries = chain([wanted], (f"{wanted}-{number}" for number in count(2)))
    free = next(name for name in tries if name not in taken)
    taken.add(free)
    return free


def _along(shift_m: float) -> tuple[float, ...]:
    """World from part: so far along the street."""
    transform = list(IDENTITY)
    transform[12] = shift_m
    return tuple(transform)


def _on_walls(buildings: Sequence[Placed], out: Path) -> Place:
    """All on their walls; a visitor begins before the first."""
    place = Place()
    for building in buildings:
        if building.stand is not None:
            place.crs, place.origin_m = building.stand.crs, building.stand.origin_m
            place.lay(_part(building, building.stand.transform, invented=False), out)
            if place.start is None:
                start = _start([building], building.high[0])
                matrix = np.array(building.stand.transform).reshape(4, 4).T
                eye, target = _moved(matrix, start.eye), _moved(matrix, start.target)
                place.start = Start(eye=eye, target=target)
    return place


def _moved(matrix: NDArray[np.float64], point: Vector) -> Vector:
    x, y, z = (matrix[:3, :3] @ np.array(point) + matrix[:3, 3]).tolist()
    return (x, y, z)


def _part(building: Placed, transform: tuple[float, ...], *, invented: bool) -> PlacePart:
    folder = building.name
    return PlacePart(
        id=folder.replace("/", "-"),
        name=folder,
        model=f"{folder}/model.glb",
        city_model=f"{folder}/model.city.json",
        document=f"{folder}/facade.json",
        photo=f"{folder}/rectified.jpg",
        transform=transform,
        arrangement="invented" if invented else "single",
        bounds=Bounds(min=building.low, max=building.high),
    )


def _start(buildings: Sequence[Placed], right_m: float) -> Start:
    """Before the middle of the row, far enough to see a whole front."""
    left_m = buildings[0].row[0]
    height_m = max(building.high[2] for building in buildings)
    middle_m = (left_m + right_m) / 2
    distance_m = min(max(MIN_DISTANCE_M, 1.3 * height_m), MAX_DISTANCE_M)
    front_m = min(building.low[1] for building in buildings)
    return Start(
        eye=(middle_m, front_m - distance_m, EYE_M), target=(middle_m, 0.0, 0.4 * height_m)
    )
