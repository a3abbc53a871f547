"""A drive as it was recorded, in the world's frame: what readers give and all later steps take."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True, eq=False)
class Sweep:
    """One turn of the scanner. world_from_sensor: (4, 4).

    read: its points (n, 3), sensor frame (m).

    What `read` gives has no NaN, no zero ranges and nothing of the vehicle itself.
    """

    name: str
    time_s: float
    world_from_sensor: NDArray[np.float64]
    read: Callable[[], NDArray[np.float64]]

    def world_points(self) -> NDArray[np.float64]:
        """(n, 3) its points in the world (m)."""
        turn, move = self.world_from_sensor[:3, :3], self.world_from_sensor[:3, 3]
        return np.asarray(self.read() @ turn.T + move, dtype=np.float64)


@dataclass(frozen=True, eq=False)
class Shot:
    """One image of the drive, without lens distortion. world_from_cam: (4, 4), x right, z forward.

    focal_px, centre_px: along x and y; the centre of the upper left pixel is (0.5, 0.5).
    """

    name: str
    path: Path
    time_s: float
    width_px: int
    height_px: int
    focal_px: tuple[float, float]
    centre_px: tuple[float, float]
    world_from_cam: NDArray[np.float64]

    def project(
        self, points: NDArray[np.float64]
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """(n, 2) pixels and (n,) depths (m, negative behind the camera) of points (n, 3)."""
        turn, eye = self.world_from_cam[:3, :3], self.world_from_cam[:3, 3]
        local = (points - eye) @ turn
        depth = local[:, 2]
        safe = np.where(np.abs(depth) < 1e-9, 1e-9, depth)
        pixels = local[:, :2] / safe[:, None] * np.array(self.focal_px) + np.array(self.centre_px)
        return pixels, depth


@dataclass(frozen=True, eq=False)
class HeightGrid:
    """What stands around, from above. heights_m: (rows from the south, columns), NaN where nothing
    is known; cells of cell_m, the outer corner of the first at low (m). All in the world's frame.
    """

    heights_m: NDArray[np.float32]
    low: tuple[float, float]
    cell_m: float

    def at(self, places: NDArray[np.float64]) -> NDArray[np.float64]:
        """(n,) heights of the cells in which (n, 2) places lie (m); NaN outside."""
        at = np.floor((places - np.array(self.low)) / self.cell_m).astype(np.int64)
        rows, columns = self.heights_m.shape
        inside = (at >= 0).all(axis=1) & (at[:, 0] < columns) & (at[:, 1] < rows)
        at = np.where(inside[:, None], at, 0)
        return np.where(inside, self.heights_m[at[:, 1], at[:, 0]], np.nan).astype(np.float64)


@dataclass(frozen=True, eq=False)
class Overview:
    """A picture of the place from above. pixels: (rows from the south, columns, 3) uint8; cells of
    cell_m, the outer corner of the first at low (m, world).
    """

    pixels: NDArray[np.uint8]
    low: tuple[float, float]
    cell_m: float


@dataclass(frozen=True, eq=False)
class DriveRecord:
    """All of a drive. World: z up, z = 0 at the road under the first sweep; metres.

    given_poses: whether the path came with the record. notes: what was assumed while reading;
    doubts: why the path may be wrong.
    height_m: of the scanner over the road. full: whether a sweep goes all around, else it is one
    vertical scan.
    """

    name: str
    sweeps: tuple[Sweep, ...]
    shots: tuple[Shot, ...]
    given_poses: bool
    height_m: float
    full: bool
    crs: str | None = None
    origin_m: tuple[float, float, float] = (0.0, 0.0, 0.0)
    notes: tuple[str, ...] = ()
    path_from: str = "poses of the log"
    corrections: tuple[tuple[float, NDArray[np.float64], str], ...] = ()
    """What was changed of the path: time (s), by how much (3,) m, why."""
    doubts: tuple[str, ...] = ()
    roofs: Callable[[], HeightGrid | None] | None = None
    """Reads the surface model, where the record has one; None of one that is a photo."""
    overview: Callable[[tuple[float, float], tuple[float, float]], Overview] | None = None
    """Draws the surface model between two corners (m), where the record has one."""
    vertical_datum: str | None = None
    """What heights count from, as the user says it."""
    level: tuple[Sweep, ...] = ()
    """Scans of a second scanner that looks level: they see behind some of what hides walls."""

    def path(self) -> NDArray[np.float64]:
        """(s, 3) where the scanner was at each sweep (m)."""
        return np.array([sweep.world_from_sensor[:3, 3] for sweep in self.sweeps])
