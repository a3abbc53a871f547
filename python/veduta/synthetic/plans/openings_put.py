"""Openings put into the longest wall between two rooms, one after the other."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from veduta.synthetic.plans import curves
from veduta.synthetic.plans.house import Hinge, Opening, OpeningType, Swing, Wall

Way = tuple[float, float]
TURNING: frozenset[OpeningType] = frozenset({"swing", "double", "folding", "french"})


@dataclass
class Openings:
    """The walls of a storey and the openings that they have so far."""

    walls: Sequence[Wall]
    clear_m: float = 0.12
    found: list[Opening] = field(default_factory=list)

    def put(
        self, sides: tuple[str | None, str | None], form: OpeningType, width: float, share: float,
        faces: Way | None = None, slanted: bool = False,
    ) -> None:  # fmt: skip
        """From `sides[0]` into `sides[1]`, at a share of the free length of the wall.

        `faces` is where the outside lies, of rooms with several outer walls, and the farthest out
        is taken; `slanted` is the wall across a corner. A leaf turns into
        `sides[1]` and hangs at the nearer end of the wall; a pocket's slides into the longer rest.
        """
        fitting = [one for one in self.walls if {one.left, one.right} == set(sides)]
        if faces is not None:
            fitting = [one for one in fitting if _faces(one, faces)]
            reach = max(np.dot(one.start_m, faces) for one in fitting)
            fitting = [one for one in fitting if np.dot(one.start_m, faces) > reach - 1e-6]
        fitting = [one for one in fitting if _slanted(one)] if slanted else fitting
        wall = max(fitting, key=curves.wall_length)
        clear = self.clear_m + max(one.thickness_m for one in self.walls) / 2.0
        free = curves.wall_length(wall) - 2.0 * clear
        wide = min(width, 0.47 * free if form == "pocket" else free)
        if form == "pocket":
            share = 0.0 if share < 0.5 else 1.0
        along = round(clear + share * (free - wide), 3)
        window = "line" in form
        swing: Swing = "none"
        if form in TURNING:
            swing = "left" if wall.left == sides[1] else "right"
        name = f"{'n' if window else 'd'}{len(self.found)}"
        kind = "window" if window else "gap" if form == "plain" else "door"
        self.found.append(
            Opening(name, wall.id, kind, form, along, round(wide, 3), _hinge(form, share), swing)  # type: ignore[arg-type]
        )


def _hinge(form: OpeningType, share: float) -> Hinge:
    if form in ("double", "french"):
        return "both"
    if form == "pocket":  # where the wall is that takes the leaf
        return "end" if share < 0.5 else "start"
    if form in ("swing", "folding"):
        return "start" if share < 0.5 else "end"
    return "none"


def _slanted(wall: Wall) -> bool:
    (x, y), (xx, yy) = wall.start_m, wall.end_m
    return min(abs(xx - x), abs(yy - y)) > 0.1


def _faces(wall: Wall, way: Way) -> bool:
    """Whether its outside lies that way."""
    (x, y), (xx, yy) = wall.start_m, wall.end_m
    left = np.array([-(yy - y), xx - x]) / np.hypot(xx - x, yy - y)
    outside = left if wall.left is None else -left
    return bool(outside @ np.array(way) > 0.999)
