"""The buildings of a city model as triangles, where the cameras are."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True, eq=False)
class CityMesh:
    """positions_m: (v, 3) float64 in the cameras' frame. triangles: (m, 3) uint32,
    counter-clockwise seen from outside. buildings: how many there are. notes: what was assumed or
    left out, for the report.
    """

    positions_m: NDArray[np.float64]
    triangles: NDArray[np.uint32]
    buildings: int
    notes: tuple[str, ...] = ()
