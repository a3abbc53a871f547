"""Where a component lies in the world, how well that is known, and whether it is believed."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

Method = Literal["model", "gps", "gcp"]


@dataclass(frozen=True)
class Similarity:
    """world = scale * rotation @ model + shift; the world in metres about its origin.

    rotation: (3, 3), proper. shift: (3,).
    """

    scale: float
    rotation: NDArray[np.float64]
    shift: NDArray[np.float64]

    def moved(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """(n, 3) of the model in the world."""
        found: NDArray[np.float64] = self.scale * points @ self.rotation.T + self.shift
        return found


@dataclass(frozen=True)
class Residual:
    """What is left at one facade, photo or control point (m)."""

    name: str
    distance_m: float


@dataclass(frozen=True)
class Fit:
    """One way to lay the model into the world.

    scale_sd: relative. rotation_sd_rad: (3,) about east, north and up. shift_sd_m: (3,), of the
    middle of the photos. rms_m: of the residuals that count; score: the higher the better.
    """

    world_from_model: Similarity
    scale_sd: float
    rotation_sd_rad: NDArray[np.float64]
    shift_sd_m: NDArray[np.float64]
    rms_m: float
    score: float
    residuals: tuple[Residual, ...]


@dataclass(frozen=True)
class Georeference:
    """The best fit and the second best, where there are any, and whether the best is believed.

    crs: EPSG code, None where the reference names none. origin_m: where the world's axes meet, in
    that CRS. why: one sentence, for a person. notes: what else must be known of how it was found.
    suspect: the control point that is most likely wrong where they contradict each other.
    dropped: those that are clearly wrong, and were left out.
    """

    method: Method
    accepted: bool
    why: str
    crs: str | None
    origin_m: tuple[float, float, float]
    best: Fit | None
    second: Fit | None = None
    notes: tuple[str, ...] = ()
    suspect: str | None = None
    dropped: tuple[str, ...] = ()
