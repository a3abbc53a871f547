"""What is true of a synthetic house plan: walls, openings, rooms and stairs in metres.

Plan frame: metres, x right and y up on the page, the same for all storeys of a house. A wall goes
from its start to its end; left and right are those of who goes along it. The words are those of
`plan.json`, so that a scorer needs no table between them.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

Point = tuple[float, float]
Language = Literal["en", "pt", "fr", "de", "fi"]
Use = Literal[
    "living", "dining", "kitchen", "bedroom", "bathroom", "toilet", "utility", "storage",
    "wardrobe", "hall", "corridor", "stairs", "study", "sauna", "garage",
]  # fmt: skip
DoorType = Literal[
    "swing", "double", "sliding", "pocket", "folding", "french", "garage", "plain"
]  # fmt: skip
WindowType = Literal["single-line", "double-line", "triple-line", "filled", "bay"]
OpeningType = DoorType | WindowType
OpeningKind = Literal["door", "window", "gap"]
Hinge = Literal["start", "end", "both", "none"]
Swing = Literal["left", "right", "both", "none"]
StairsKind = Literal[
    "straight", "quarter-winding", "quarter-landing", "half-winding", "half-landing", "spiral"
]


@dataclass(frozen=True)
class Wall:
    """A piece of wall between two junctions, with the same two sides all along.

    `bulge` is the tangent of a quarter of the arc's angle, as in DXF, here positive where the wall
    bows to the right. `left` and `right` are ids of rooms, None outdoors.
    """

    id: str
    start_m: Point
    end_m: Point
    bulge: float
    thickness_m: float
    left: str | None
    right: str | None

    @property
    def outer(self) -> bool:
        """Whether one of its sides is outdoors."""
        return self.left is None or self.right is None


@dataclass(frozen=True)
class Opening:
    """A door, window or plain gap; `along_m` is from the wall's start, on its centre line."""

    id: str
    wall: str
    kind: OpeningKind
    type: OpeningType
    along_m: float
    width_m: float
    hinge: Hinge = "none"
    swing: Swing = "none"


@dataclass(frozen=True)
class Room:
    """A room: `outline_m` is the inner faces of its walls, counter-clockwise, not closed twice."""

    id: str
    use: Use
    outline_m: tuple[Point, ...]
    area_m2: float


@dataclass(frozen=True)
class Stairs:
    """Stairs in a room; `up` is the direction in which they rise at their foot.

    Of those that are no straight flight, `steps_m` has the treads from the lowest up, a landing is
    one, and `path_m` the walking line over them.
    """

    outline_m: tuple[Point, ...]
    treads: int
    up: Point
    steps_m: tuple[tuple[Point, ...], ...] = ()
    path_m: tuple[Point, ...] = ()
    kind: StairsKind = "straight"


FittingKind = Literal[
    "toilet", "basin", "bathtub", "shower", "washer", "hob", "kitchen-sink", "bed"
]  # fmt: skip


@dataclass(frozen=True)
class Fitting:
    """What is drawn in a room and stays there: an upright rectangle, left, bottom, right, top."""

    kind: FittingKind
    box_m: tuple[float, float, float, float]


@dataclass(frozen=True)
class Storey:
    """One floor, the ground floor first."""

    number: int
    walls: tuple[Wall, ...]
    openings: tuple[Opening, ...]
    rooms: tuple[Room, ...]
    stairs: tuple[Stairs, ...] = ()

    def wall(self, identifier: str) -> Wall:
        """The wall of that id."""
        return next(wall for wall in self.walls if wall.id == identifier)


@dataclass(frozen=True)
class House:
    """A house and the seed that it grew from."""

    seed: int
    storeys: tuple[Storey, ...]
