"""A camera that moves: a guided tour, as columns of keys."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True, eq=False)
class CameraPath:
    """Where a camera is and looks, from key to key on straight lines and great circles.

    Frame: the part's (z up, m). times_s: (n,) ascending from 0, n >= 2. eyes_m: (n, 3).
    directions: (n, 3) unit vectors, none of them straight up or down; the picture is upright.
    fov_rad: the vertical angle of view.
    """

    name: str
    times_s: NDArray[np.float64]
    eyes_m: NDArray[np.float64]
    directions: NDArray[np.float64]
    fov_rad: float

    def __post_init__(self) -> None:
        count = len(self.times_s)
        if count < 2 or self.eyes_m.shape != (count, 3) or self.directions.shape != (count, 3):
            raise ValueError(f"camera path {self.name!r}: columns do not belong together")
        if self.times_s[0] != 0.0 or (np.diff(self.times_s) <= 0.0).any():
            raise ValueError(f"camera path {self.name!r}: times do not ascend from 0")
        if np.abs(np.linalg.norm(self.directions, axis=1) - 1.0).max() > 1e-6:
            raise ValueError(f"camera path {self.name!r}: directions are no unit vectors")
        if (np.abs(self.directions[:, 2]) > 0.999).any():
            raise ValueError(f"camera path {self.name!r}: looks straight up or down")
