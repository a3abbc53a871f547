"""A wall that the points speak for: an upright rectangle in a component's own frame."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class Wall:
    """An upright rectangle; z is up, and lengths are in the frame's own unit.

    id: "w000" and so on, that with most points first.
    start, end: (2,) its ends; one who looks at it from outside has `start` at the left.
    bottom, top: the heights between which points were seen on it.
    point_rows: (k,) rows of the structure's points that lie on it.
    rms: of their distances from its plane.
    """

    id: str
    start: NDArray[np.float64]
    end: NDArray[np.float64]
    bottom: float
    top: float
    point_rows: NDArray[np.int64]
    rms: float

    @property
    def width(self) -> float:
        """From end to end."""
        return float(np.linalg.norm(self.end - self.start))

    @property
    def height(self) -> float:
        """From the bottom to the top."""
        return self.top - self.bottom

    @property
    def along(self) -> NDArray[np.float64]:
        """(2,) unit, from the start to the end."""
        direction: NDArray[np.float64] = (self.end - self.start) / self.width
        return direction

    @property
    def outward(self) -> NDArray[np.float64]:
        """(2,) unit normal, to the side that it is seen from."""
        x, y = self.along
        return np.array([y, -x])
