"""What lies between windows that stand one above another: wall, or more window.

A storey ends in a slab, and a slab is not of glass: between the windows of one column there is
wall, or a ledge. Where floors were fitted to something else (the panes of one large window, the
arch of a gateway, courses of stone), what lies between two "windows" looks as unlike the wall as
they do.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import product

import numpy as np

from veduta.facade.appearance import Wall
from veduta.facade.boxes import Box
from veduta.facade.document import SURE_SCORE
from veduta.facade.floors import Floors

# Least part of the narrower of two windows that the other covers for them to be of one column.
_SHARED = 0.5
# Colour distance from the wall of what is between, as a part of that of the windows, up to which
# it is wall. Of 463 windows of 20 facades of Paris 81 % are right, of 530 of other places 50 %; of
# those above this 45 % and 17 %.
_LIKE_WALL = 0.8
# Energy per row of floors so alike that nothing else needs to confirm them (close views of parts of
# facades: at least -0.33).
_VERY_ALIKE = -0.38
# Score of what stands on floors that nothing parts: under that of what is sure.
_DOUBTED = 0.9 * SURE_SCORE


@dataclass(frozen=True)
class Between:
    """Two windows of one column on neighbouring floors; how unlike wall what is between them is.

    `unlike` is the median colour distance from the wall as a part of the windows' own, 1 where
    there is nothing between them.
    """

    upper: Box
    lower: Box
    unlike: float

    @property
    def is_wall(self) -> bool:
        """Whether it is wall that parts the two."""
        return self.unlike <= _LIKE_WALL


def look_between(boxes: list[Box], wall: Wall, floors: Floors) -> list[Between]:
    """What parts each two windows of one column; railings belong to the window above them."""
    windows = [box for box in boxes if box.kind == "window" and box.floor]
    railings = [box for box in boxes if box.kind == "balcony" and box.floor]
    return [
        Between(a, b, _unlike(a, b, _foot(a, railings), wall, floors))
        for a, b in product(windows, windows)
        if a.floor == (b.floor or 0) + 1 and _is_one_column(a, b)
    ]


def are_floors(pairs: list[Between], floors: Floors) -> bool:
    """Whether wall parts most of the floors' windows; also where none stand one above another.

    Floors that are very alike are floors whatever is between (fire escapes, bays of metal).
    """
    if not pairs or floors.energy < _VERY_ALIKE:
        return True
    return float(np.median([pair.unlike for pair in pairs])) <= _LIKE_WALL


def doubt_unparted(boxes: list[Box], pairs: list[Between], floors: Floors) -> list[Box]:
    """The boxes, with the windows in doubt that no wall parts from those above and below.

    Where the floors are none, all that was found on them is in doubt.
    """
    looked_at = {id(box) for pair in pairs for box in (pair.upper, pair.lower)}
    parted = {id(box) for pair in pairs if pair.is_wall for box in (pair.upper, pair.lower)}
    doubted = looked_at - parted
    if not are_floors(pairs, floors):
        doubted = {id(box) for box in boxes if box.floor}
    return [
        replace(box, score=min(box.score, _DOUBTED)) if id(box) in doubted else box for box in boxes
    ]


def _is_one_column(a: Box, b: Box) -> bool:
    return _shared(a, b) > _SHARED * min(a.width, b.width)


def _shared(a: Box, b: Box) -> int:
    return min(a.x + a.width, b.x + b.width) - max(a.x, b.x)


def _foot(window: Box, railings: list[Box]) -> int:
    """Row at which a window ends, with the railing before it."""
    own = [r for r in railings if r.floor == window.floor and _shared(r, window) > 0]
    return max([window.y + window.height, *(r.y + r.height for r in own)])


def _unlike(upper: Box, lower: Box, foot: int, wall: Wall, floors: Floors) -> float:
    """The distance of what is between from the wall's colour, as a part of that of both windows."""
    if lower.y <= foot:
        return 1.0
    columns = slice(max(upper.x, lower.x), min(upper.x + upper.width, lower.x + lower.width))
    between = wall.unlike[foot - floors.eaves : lower.y - floors.eaves, columns]
    both = [wall.unlike[box.part(floors.eaves)].ravel() for box in (upper, lower)]
    return float(np.median(between) / max(1.0, float(np.median(np.concatenate(both)))))
