"""The pixels of a wall's picture in space: a metric orthophoto, as figures 5.10 and 5.11 show."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from veduta.photos.structure import Structure
from veduta.photos.walls.wall import Wall

MARGIN = 0.04
"""What the picture shows beyond the wall's rectangle, as a part of its shorter side."""
FINEST = 0.25
"""The resolution is that of the photos: the quantile of their pixels' sizes on the wall."""
MOST_PIXELS = 24_000_000
"""Of the pictures of all walls together; they are made coarser alike where they would have more."""


@dataclass(frozen=True)
class WallGrid:
    """A wall's pixels: row 0 at the top, column 0 at the left of one who looks at the wall.

    pixel: the side of a pixel in the frame's unit. left: of column 0, from the wall's start along
    it. upper: the height of row 0.
    """

    wall: Wall
    pixel: float
    left: float
    upper: float
    width_px: int
    height_px: int

    def points(
        self, columns: NDArray[np.floating[Any]], rows: NDArray[np.floating[Any]]
    ) -> NDArray[np.float64]:
        """(r, c, 3) in space of (c,) columns and (r,) rows; 0.5 is the centre of the first."""
        place = self.wall.start + (self.left + self.pixel * columns)[:, None] * self.wall.along
        found = np.empty((len(rows), len(columns), 3))
        found[:, :, :2] = place
        found[:, :, 2] = (self.upper - self.pixel * rows)[:, None]
        return found


def wall_grids(
    structure: Structure, walls: Sequence[Wall], longest_px: int
) -> tuple[WallGrid, ...]:
    """A grid for each wall, as fine as the photos and the bounds allow."""
    if not walls:
        return ()
    footprints = _footprints(structure)
    sides = []
    for wall in walls:
        own = np.zeros(len(structure.points), dtype=bool)
        own[wall.point_rows] = True
        finest = float(np.quantile(footprints[own[structure.point_of]], FINEST))
        longest = (1.0 + 2.0 * MARGIN) * max(wall.width, wall.height)
        sides.append(max(finest, longest / longest_px))
    areas = [wall.width * wall.height / side**2 for wall, side in zip(walls, sides, strict=True)]
    coarser = max(1.0, float(np.sqrt(sum(areas) * (1.0 + 2.0 * MARGIN) ** 2 / MOST_PIXELS)))
    return tuple(
        _grid(wall, coarser * side, longest_px) for wall, side in zip(walls, sides, strict=True)
    )


def _grid(wall: Wall, pixel: float, longest_px: int) -> WallGrid:
    margin = MARGIN * min(wall.width, wall.height)
    return WallGrid(
        wall=wall,
        pixel=pixel,
        left=-margin,
        upper=wall.top + margin,
        width_px=min(longest_px, max(1, round((wall.width + 2.0 * margin) / pixel))),
        height_px=min(longest_px, max(1, round((wall.height + 2.0 * margin) / pixel))),
    )


def _footprints(structure: Structure) -> NDArray[np.float64]:
    """(o,) side of a photo's pixel at the distance of each observed point."""
    apart = structure.points[structure.point_of] - structure.centres()[structure.image_of]
    focal = np.array(
        [structure.camera(row).mean_focal_length() for row in range(len(structure.names))]
    )
    found: NDArray[np.float64] = np.linalg.norm(apart, axis=1) / focal[structure.image_of]
    return found
