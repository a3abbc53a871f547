"""Windows in outer walls, clear of doors and corners."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from veduta.synthetic.plans import curves
from veduta.synthetic.plans.house import Opening, Use, Wall, WindowType

SHARES: Mapping[Use, float] = {
    "living": 1.0, "dining": 1.0, "kitchen": 1.0, "bedroom": 1.0, "study": 1.0, "bathroom": 0.8,
    "toilet": 0.5, "utility": 0.5, "hall": 0.3, "corridor": 0.6, "stairs": 0.5, "sauna": 0.6,
    "garage": 0.3, "storage": 0.1, "wardrobe": 0.0,
}  # fmt: skip
WET: tuple[Use, ...] = ("bathroom", "toilet", "utility", "sauna", "storage", "stairs")
CLEAR_M = 0.35
LEAST_M = 0.5


def windows_of(
    rng: np.random.Generator,
    walls: Sequence[Wall],
    uses: Mapping[str, Use],
    doors: Sequence[Opening],
    kind: WindowType,
) -> list[Opening]:
    """Windows for the rooms that want them; long walls get two."""
    found: list[Opening] = []
    for wall in walls:
        room = wall.left or wall.right
        if not wall.outer or room is None or rng.random() >= SHARES[uses[room]]:
            continue
        small = uses[room] in WET
        for low, high in _free(wall, [door for door in doors if door.wall == wall.id]):
            most = 0.9 if small else 2.4
            pieces = 2 if high - low > 4.5 and not small else 1
            size = (high - low) / pieces
            for piece in range(pieces):
                width = round(min(size - 0.1, rng.uniform(0.5 if small else 0.9, most)), 2)
                if width < LEAST_M:
                    continue
                slack = size - width
                along = round(low + piece * size + slack * rng.uniform(0.35, 0.65), 3)
                number = f"n{len(found)}"
                found.append(Opening(number, wall.id, "window", kind, along, width))
    return found


def _free(wall: Wall, doors: Sequence[Opening]) -> list[tuple[float, float]]:
    """The stretches of a wall without doors and corners."""
    places = [CLEAR_M]
    for door in sorted(doors, key=lambda door: door.along_m):
        places += [door.along_m - CLEAR_M, door.along_m + door.width_m + CLEAR_M]
    places.append(curves.wall_length(wall) - CLEAR_M)
    return [
        (low, high)
        for low, high in zip(places[::2], places[1::2], strict=True)
        if high - low > LEAST_M
    ]
