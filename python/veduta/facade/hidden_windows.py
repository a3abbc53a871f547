"""Windows that something before the front hides: as those of the same row and column."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.facade.boxes import Box
from veduta.facade.columns import Columns


@dataclass(frozen=True)
class HiddenParameters:
    """When a window is taken to be where none is seen.

    hidden: share of its place that something stands before. row, column: how many windows the row
    and the column have elsewhere, at least; share: of the other floors on which the column has one.
    free: how far from others it stays, in shares of its width.
    """

    hidden: float = 0.5
    row: int = 2
    column: int = 2
    share: float = 0.6
    free: float = 0.1


def hidden_windows(
    boxes: Sequence[Box],
    columns: Columns,
    floors: int,
    hidden: NDArray[np.floating],
    parameters: HiddenParameters | None = None,
) -> list[Box]:
    """Windows (`inferred`) that the rows and columns of others have where these are hidden.

    floors: above the ground floor; hidden: (h, w) the chance that something stands before the
    front. Their score is the share of the other floors on which their column has a window.
    """
    p = parameters or HiddenParameters()
    windows = [box for box in boxes if box.kind == "window" and box.floor]
    found: list[Box] = []
    for floor in range(1, floors + 1):
        row = [box for box in windows if box.floor == floor]
        if len(row) < p.row:
            continue
        top = round(float(np.median([box.y for box in row])))
        high = round(float(np.median([box.height for box in row])))
        for number in range(len(columns.stripes)):
            own = [box for box in windows if box.column == number]
            share = len({box.floor for box in own}) / max(1, floors - 1)
            if any(box.floor == floor for box in own) or len(own) < p.column or share < p.share:
                continue
            left = round(float(np.median([box.x for box in own])))
            wide = round(float(np.median([box.width for box in own])))
            place = Box("window", left, top, wide, high, floor, number, min(1.0, share), (), True)
            part = hidden[place.part()]
            is_free = not any(_near(place, box, p.free) for box in (*boxes, *found))
            if part.size and float(part.mean()) >= p.hidden and is_free:
                found.append(place)
    return found


def _near(one: Box, other: Box, free: float) -> bool:
    """Whether two boxes are nearer than a share of the first one's width."""
    apart = free * one.width
    return (
        one.x - apart < other.x + other.width
        and other.x < one.x + one.width + apart
        and one.y - apart < other.y + other.height
        and other.y < one.y + one.height + apart
    )
