"""A wall whose elevation gets its depth, and where its pixels lie on it."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True, eq=False)
class Elevation:
    """An upright wall and the grid of its picture, row 0 at the top.

    start_m, along, outward: (3,) of the cameras' frame: where the wall begins, on the ground's
    level 0, and unit vectors along it and towards who looks at it. left_m: of the picture's
    border, from the start along the wall; upper_m: the height of its upper border. pixel_m: side
    of a pixel. shape: rows and columns. height_m: of the wall.
    """

    id: str
    start_m: NDArray[np.float64]
    along: NDArray[np.float64]
    outward: NDArray[np.float64]
    left_m: float
    upper_m: float
    pixel_m: float
    shape: tuple[int, int]
    height_m: float

    def grown(self, times: float) -> Elevation:
        """The same where the cameras' unit is so many times as long."""
        return replace(
            self,
            start_m=self.start_m * times,
            left_m=self.left_m * times,
            upper_m=self.upper_m * times,
            pixel_m=self.pixel_m * times,
            height_m=self.height_m * times,
        )
