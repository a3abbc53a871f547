"""What of a house lies behind the main depth, and is seen: walls behind balconies, and in arcades.

The paper keeps what lies at the main depth, and takes what is farther for rooms behind glass.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.drive.build.arcades import Arcades, find_arcades
from veduta.drive.build.frame import ColumnFrame, ColumnPoints
from veduta.drive.build.set_back import SetBackParameters, find_set_back, shown

Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Behind:
    """set_back: (c,) depth of walls behind what is built before them (m), NaN where there is none.
    arcades: open ground floors.
    """

    set_back: Floats
    arcades: Arcades

    def of_walls(
        self, points: ColumnPoints, row: NDArray[np.int64], above: NDArray[np.floating]
    ) -> NDArray[np.bool_]:
        """(n,) points of such walls."""
        chosen = SetBackParameters()
        off = points.depth - self.set_back[points.column]
        with np.errstate(invalid="ignore"):
            near = (np.abs(off) < chosen.near_m) & (above > chosen.lowest_m)
        return near | self.arcades.behind(points, row, above)

    def depth(self, building: NDArray[np.floating]) -> Floats:
        """(r, c) depth of such a wall where one is behind a pixel, NaN elsewhere. building: (r, c)
        measured depths of walls, NaN where none is.
        """
        behind = shown(self.set_back, building, SetBackParameters().near_m)
        found = np.where(behind, self.set_back, np.nan)
        return np.where(self.arcades.inside(len(building)), self.arcades.depth, found)

    def floor(self, main: Floats) -> Floats:
        """(c,) depth at which walls stand on the ground: those of arcades, else the main depth."""
        return np.where(np.isfinite(self.arcades.depth), self.arcades.depth, main)


def find_behind(
    points: ColumnPoints,
    row: NDArray[np.int64],
    above: NDArray[np.floating],
    on_ground: NDArray[np.bool_],
    main: Floats,
    frame: ColumnFrame,
) -> Behind:
    """row: (n,) beam of each point. above: (n,) over the ground (m). on_ground: (n,). main: (c,)."""
    set_back = find_set_back(points, row, above, main, frame)
    wall = np.where(np.isfinite(set_back), set_back, main)
    arcades = find_arcades(points, row, above, on_ground, main, wall, frame)
    return Behind(set_back, arcades)
