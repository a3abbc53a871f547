"""The ground floor: what is shop front, what is wall, and where the doors are.

Each pixel column is wall, door or shop, by two measures against the wall's colour above it: a
shop's sign makes the upper part unlike wall, a door only what is below its lintel. The labels are
a chain over the columns with a price for each change, solved exactly.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from veduta import _core
from veduta.facade.appearance import Wall
from veduta.facade.evidence import Evidence, Float, blur_line
from veduta.facade.floors import Floors
from veduta.facade.openings import Box

# Parts of the ground floor's height, from its top: where signs are, and what people and parked
# cars leave to be seen below the lintels.
_SIGN = (0.02, 0.25)
_LOWER = (0.35, 0.75)
# Colour distance at which a pixel is as likely wall as not.
_EVEN = 16.0
# Price of a change of label, in storeys of pixel columns that fully disagree.
_CHANGE = 0.25
# In storeys: widths of a door.
_DOOR = (0.22, 0.9)
_WALL, _DOORWAY, _SHOP = range(3)


def read_ground(evidence: Evidence, floors: Floors, wall: Wall) -> list[Box]:
    """Shop fronts and doors of the ground floor; what they leave is wall."""
    top, bottom = floors.ground_top, evidence.height
    storey = floors.mean_storey
    unlike = _unlike_wall(evidence, wall, top, storey)
    sign, lower = (_part(unlike, span, storey) for span in (_SIGN, _LOWER))
    cost = np.stack(
        [_cost(sign, 0) + _cost(lower, 0), _cost(sign, 0) + _cost(lower, 1), 2 * _cost(sign, 1)]
    ).astype(np.float32)
    change = float(_CHANGE * storey)
    labels = np.asarray(_core.skyline_chain(cost, change, change))
    boxes = []
    for start, end, label in _runs(labels):
        if label == _SHOP:
            boxes.append(Box("shop", start, top, end - start, bottom - top, 0, None, 0.5))
        elif label == _DOORWAY and _DOOR[0] * storey <= end - start <= _DOOR[1] * storey:
            lintel = top + _lintel(unlike[:, start:end])
            boxes.append(Box("door", start, lintel, end - start, bottom - lintel, 0, None, 0.5))
    return boxes


def _unlike_wall(evidence: Evidence, wall: Wall, top: int, storey: float) -> Float:
    """Colour distance (n, w) of the ground floor to the wall right above it."""
    above = max(2, int(0.3 * storey))
    colour = np.median(wall.colour[-above:], axis=0)
    scaled = (evidence.lab[top:] - colour) * np.array([0.5, 1.5, 1.5], np.float32)
    return np.asarray(np.sqrt((scaled**2).sum(-1)), np.float32)


def _part(unlike: Float, span: tuple[float, float], storey: float) -> Float:
    rows = unlike[int(span[0] * len(unlike)) : max(1, int(span[1] * len(unlike)))]
    return blur_line((rows > _EVEN).mean(0), storey / 30)


def _cost(share: Float, wanted: int) -> Float:
    return np.abs(share - wanted)


def _runs(labels: NDArray[np.int64]) -> list[tuple[int, int, int]]:
    changes = [0, *(np.flatnonzero(np.diff(labels)) + 1).tolist(), len(labels)]
    return [(a, b, int(labels[a])) for a, b in zip(changes[:-1], changes[1:], strict=True)]


def _lintel(unlike: Float) -> int:
    """Row at which a door begins: wall above it, not below, with the least error."""
    share = (unlike > _EVEN).mean(1) - 0.5
    reach = max(1, int(0.6 * len(share)))
    running = np.concatenate([[0.0], np.cumsum(share)])
    return int(np.argmin(running[: reach + 1]))
