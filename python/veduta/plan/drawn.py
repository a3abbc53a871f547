"""What the drawing of one storey shows, in pixels: what `reading` gives and `compose` takes.

Frame: the cleaned image (mirrored back, upright, straight, possibly resampled): x right, y down,
origin at the upper left corner of the upper left pixel, whose centre is at (0.5, 0.5). Left and
right of a wall are those of who goes along it from `start` to `end` on the page, as one sees it.
The fields are those of `document`, whose metres are `_px` here.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal

import numpy as np
from numpy.typing import NDArray
from shapely.geometry import Polygon

from veduta.plan.document import (
    FittingKind,
    JunctionType,
    OpeningType,
    Origin,
    Text,
    WallDrawing,
)


@dataclass(frozen=True)
class Cleaned:
    """A sheet laid straight.

    `pixels` (h, w, 3) uint8 sRGB; `ink` (h, w) float32, 0 paper to 1 ink, after the light was made
    even; `clean_from_scan` (3, 3) takes pixel coordinates of the scan to those of `pixels`.
    `rotation_rad` is by how much the scan was turned, counter-clockwise as one sees it.
    `line_px` is the width of the thin lines.
    """

    pixels: NDArray[np.uint8]
    ink: NDArray[np.float32]
    clean_from_scan: NDArray[np.float64]
    mirrored: bool
    rotation_rad: float
    line_px: float
    notes: tuple[str, ...] = ()


@dataclass(frozen=True)
class DrawnJunction:
    """Where centre lines meet or end; `at_px` is (x, y)."""

    id: str
    at_px: tuple[float, float]
    type: JunctionType


@dataclass(frozen=True)
class DrawnWall:
    """A piece of wall between two junctions; openings lie in it.

    `bulge` is the tan of a quarter of the arc's angle; positive bows to the right of who walks
    from start to end, as seen on the page (as in `document.Wall`).
    """

    id: str
    start: str
    end: str
    thickness_px: float
    drawing: WallDrawing
    outer: bool
    score: float
    bulge: float = 0.0
    origin: Origin = "measured"


@dataclass(frozen=True)
class DrawnOpening:
    """A door, a window or a gap; `along_px` runs on the centre line from the wall's start."""

    id: str
    wall: str
    kind: Literal["door", "window", "gap"]
    type: OpeningType
    along_px: float
    width_px: float
    hinge: Literal["start", "end", "both", "none"]
    swing: Literal["left", "right", "both", "none"]
    score: float
    origin: Origin = "measured"


@dataclass(frozen=True)
class DrawnRoom:
    """A closed space: its outline of inner faces, (n, 2), counter-clockwise as one sees it."""

    id: str
    outline_px: NDArray[np.float64]
    holes_px: tuple[NDArray[np.float64], ...]
    walls: tuple[str, ...]
    openings: tuple[str, ...]
    mended: bool
    score: float
    outdoors: bool = False

    @property
    def area_px2(self) -> float:
        """Its area without its holes."""
        return float(self.polygon().area)

    def polygon(self) -> Polygon:
        """As a polygon in pixels, with its holes."""
        return Polygon(self.outline_px, self.holes_px)


@dataclass(frozen=True)
class DrawnStairs:
    """A flight of stairs; `up_px` has length 1, or is (0, 0) where no arrow is drawn.

    `across`: its treads are upright lines, so that it runs along x. Stairs that turn have their
    treads, landings with them, as `steps_px` from the lowest up (in either order where no arrow is
    drawn), and `path_px` (n, 2), the walking line over them.
    """

    id: str
    outline_px: NDArray[np.float64]
    treads: int
    up_px: tuple[float, float]
    score: float
    across: bool = False
    steps_px: tuple[NDArray[np.float64], ...] = ()
    path_px: NDArray[np.float64] | None = None


@dataclass(frozen=True)
class DrawnFitting:
    """A bath, a toilet, a bed: `middle_px` (2,) of its rectangle, `back` (2,) the way to its back.

    `width_px` is along its back, `depth_px` from back to front.
    """

    id: str
    kind: FittingKind
    room: str
    middle_px: NDArray[np.float64]
    back: NDArray[np.float64]
    width_px: float
    depth_px: float
    score: float


@dataclass(frozen=True)
class Drawn:
    """All that was found on one sheet, in pixels of `cleaned.pixels`."""

    cleaned: Cleaned
    junctions: tuple[DrawnJunction, ...]
    walls: tuple[DrawnWall, ...]
    openings: tuple[DrawnOpening, ...]
    rooms: tuple[DrawnRoom, ...]
    stairs: tuple[DrawnStairs, ...] = ()
    texts: tuple[Text, ...] = ()
    notes: tuple[str, ...] = field(default=())
    fittings: tuple[DrawnFitting, ...] = ()

    @property
    def size_px(self) -> tuple[int, int]:
        """Width and height of the cleaned image."""
        height, width = self.cleaned.pixels.shape[:2]
        return width, height

    def junction(self, name: str) -> DrawnJunction:
        """The junction of that id."""
        return next(one for one in self.junctions if one.id == name)

    def wall_ends(self, wall: DrawnWall) -> NDArray[np.float64]:
        """The centre line's two ends, (2, 2)."""
        return np.array([self.junction(wall.start).at_px, self.junction(wall.end).at_px])
