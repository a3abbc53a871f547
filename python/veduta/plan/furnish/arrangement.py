"""Things that belong together, in a frame of their own, and how they come into a room.

Frame of an arrangement: that of the thing at the wall (or, where it stands free, of its middle):
x to the right as one looks at its front, y = 0 at the wall behind it, the room at y < 0.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Literal

import numpy as np

from veduta.plan.furnish.catalogue.entry import Entry, Side, Size
from veduta.plan.furnish.layout import Stood, rectangle
from veduta.plan.furnish.room import RoomSpace, Stretch

Order = Literal["near", "far", "any"]
"""Of walls, by their distance from the door."""
Prefer = Literal["ends", "middle", "window", "beside", "any"]
"""Where on a wall: at its ends, in its middle, near a window, near what is of its class."""
OFF_WALL_M = 0.02
BACK: frozenset[Side] = frozenset({"back"})


@dataclass(frozen=True)
class Piece:
    """A thing of an arrangement. x, y: the middle of its base. on: the number of another piece.

    needed: without it the arrangement does not stand; others are left out where they do not fit.
    """

    entry: Entry
    size_m: Size
    x: float
    y: float
    turn: float = 0.0
    above_m: float = 0.0
    needed: bool = True
    on: int | None = None


@dataclass(frozen=True)
class Arrangement:
    """Pieces, and rectangles (x, y spans) that stay free; the first piece leads."""

    pieces: tuple[Piece, ...]
    zones: tuple[tuple[tuple[float, float], tuple[float, float]], ...] = ()


@dataclass(frozen=True)
class Spot:
    """Where an arrangement may come: the origin of its frame, and its turn."""

    space: RoomSpace
    at: np.ndarray
    turn: float
    stretch: Stretch | None

    def place(self, piece: Piece, group: int, on: Stood | None) -> Stood:
        """A piece in the plan."""
        c, s = np.cos(self.turn), np.sin(self.turn)
        at = self.at + np.array([c * piece.x - s * piece.y, s * piece.x + c * piece.y])
        turn = float((self.turn + piece.turn + np.pi) % (2.0 * np.pi) - np.pi)
        return Stood(
            piece.entry, piece.size_m, (round(float(at[0]), 4), round(float(at[1]), 4)),
            round(turn, 5), round(piece.above_m, 4), on, group,
        )  # fmt: skip

    def zone(self, x: tuple[float, float], y: tuple[float, float]):  # type: ignore[no-untyped-def]
        """A rectangle of the frame in the plan."""
        return rectangle(self.at, self.turn, x, y)

    @property
    def door_m(self) -> float:
        """The distance to the door."""
        return float(np.linalg.norm(self.at - self.space.door_way))


@dataclass(frozen=True)
class Variant:
    """One way to do it: how wide it is along the wall, and what it is at a spot.

    sides: of what stands at its ends, those that may touch a wall. side_m: else the distance to it.
    free: it stands in the room, not at a wall.
    """

    width_m: float
    make: Callable[[Spot], Iterable[Arrangement]]
    order: Order = "any"
    prefer: Prefer = "any"
    sides: frozenset[Side] = BACK
    side_m: float = 0.05
    free: bool = False
    corner: bool = False
    """Whether its left side must touch a wall, too."""


def alone(
    entry: Entry, size_m: Size, *, needed: bool = True, x: float = 0.0, y: float = 0.0
) -> Piece:
    """A thing with its back at the wall, where the catalogue says that it hangs or stands."""
    off = OFF_WALL_M if entry.stands == "floor" else 0.005
    return Piece(entry, size_m, x, y - off - size_m[1] / 2.0, above_m=entry.above_m, needed=needed)


def fixed(
    pieces: Iterable[Piece], zones: Iterable[tuple[tuple[float, float], tuple[float, float]]] = ()
) -> Callable[[Spot], list[Arrangement]]:
    """The same arrangement at every spot."""
    made = [Arrangement(tuple(pieces), tuple(zones))]
    return lambda _: made


def widths_of(entry: Entry, *shares: float) -> list[float]:
    """Widths in which a thing comes: as usual, then shares between that and its least."""
    usual, least = entry.size_m[0], entry.widths_m[0]
    return list(dict.fromkeys(round(least + share * (usual - least), 3) for share in shares))
