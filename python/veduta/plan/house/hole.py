"""An opening as it is cut into its wall, with the way in which its leaf hangs."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np
from numpy.typing import NDArray
from shapely.geometry import Polygon

from veduta.plan.document import DoorType, Opening, OpeningType, Room
from veduta.plan.house.lines import WallLine

End = Literal["start", "end"]
ENDS: tuple[End, End] = ("start", "end")
Hinge = Literal["start", "end", "both"]
Swing = Literal["left", "right", "both"]
_JOIN_M = 1e-3
_SECTOR_STEPS = 6


@dataclass(frozen=True)
class Hole:
    """An opening as it is cut: from `start_m` to `end_m` along its wall.

    start, end: (2,) the ends on the centre line. low_m, high_m: above the storey's floor.
    left, right: the rooms on its sides; None is outdoors. hinge, swing: how its leaf hangs, as
    it is drawn or as `hanging` has it. guess: what `hanging` takes a door for whose type is not
    drawn; None for others.
    """

    opening: Opening
    line: WallLine
    start_m: float
    end_m: float
    low_m: float
    high_m: float
    left: Room | None = None
    right: Room | None = None
    hinge: Hinge = "start"
    swing: Swing = "left"
    guess: DoorType | None = None

    @property
    def type(self) -> OpeningType:
        """What is built: as it is drawn, or the guess."""
        return self.guess or self.opening.type

    @cached_property
    def start(self) -> NDArray[np.float64]:
        """The end that is nearer to the wall's start."""
        return self.line.at(self.start_m)

    @cached_property
    def width_m(self) -> float:
        """From end to end, straight."""
        return float(np.linalg.norm(self.line.at(self.end_m) - self.start))

    @cached_property
    def along(self) -> NDArray[np.float64]:
        """(2,) unit vector along the wall."""
        return (self.line.at(self.end_m) - self.start) / self.width_m

    @property
    def is_outer(self) -> bool:
        """Whether it leads out of the house, or onto a balcony."""
        return any(room is None or room.outdoors for room in (self.left, self.right))

    @property
    def reaches_floor(self) -> bool:
        """Whether one can walk through it."""
        return self.low_m <= 0.0

    @cached_property
    def outline(self) -> Polygon:
        """What it takes from the wall's footprint."""
        return self.line.piece(self.start_m, self.end_m, self.line.half_m + _JOIN_M)

    @cached_property
    def middle(self) -> NDArray[np.float64]:
        """Half-way between its ends, straight."""
        return self.start + self.along * self.width_m / 2.0

    @cached_property
    def leftward(self) -> NDArray[np.float64]:
        """(2,) unit vector to the left of the wall."""
        return np.array([-self.along[1], self.along[0]])

    def sweep(self, end: End, side: float, radius_m: float) -> Polygon:
        """What a leaf sweeps that is hung at an end; side: +1 to the left of the wall, -1 right."""
        face = self.line.half_m * side * self.leftward
        at_start = end == "start"
        hinge = self.start + face + (0.0 if at_start else self.width_m) * self.along
        closed = self.along if at_start else -self.along
        turn = np.linspace(0.0, np.pi / 2.0, _SECTOR_STEPS + 1)[:, None]
        arc = hinge + radius_m * (np.cos(turn) * closed + np.sin(turn) * side * self.leftward)
        return Polygon([hinge, *arc])
