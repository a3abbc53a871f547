"""A path through a place for an animal: where it is led to, or a round where it has room."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.fauna.motion.angles import Floats
from veduta.fauna.path.corners import parted_path
from veduta.fauna.path.limits import PathLimits, RoundLimits
from veduta.fauna.path.plan import Ways, free_cells, planned_way
from veduta.fauna.path.smooth import smooth_path
from veduta.fauna.path.terrain import Terrain
from veduta.run.errors import NotFoundError


@dataclass(frozen=True, eq=False)
class FoundPath:
    """points_m: (n, 3) on the ground. through_m: (k, 2) the points that were asked for. corners:
    rows of points_m at which the animal turns on the spot.
    """

    points_m: Floats
    through_m: Floats
    closed: bool
    ways: Ways
    corners: tuple[int, ...] = ()


def path_through(
    terrain: Terrain, points_m: Floats | None, limits: PathLimits, length_m: float, *,
    turns: bool = False,
) -> FoundPath:  # fmt: skip
    """The path through the points (k, 2); None: a round in the middle of the open ground.

    turns: whether the animal can turn on the spot. It does so at points from which it goes back
    the way it came, more or less, and where there is room for its body all around.
    """
    ways = free_cells(terrain, limits, length_m)
    closed = points_m is None
    through = _round(terrain, ways, limits.round, length_m) if points_m is None else points_m
    way = planned_way(terrain, ways, through, limits, length_m)
    cells = terrain.cell_of(through)
    if turns and not closed:
        parted = parted_path(terrain, ways, way, cells, limits, length_m)
        if parted is not None:
            return FoundPath(parted.points_m, through, closed, ways, parted.corners)
    found = smooth_path(terrain, ways, way, cells, limits.smooth, length_m, closed=closed)
    return FoundPath(found, through, closed, ways)


def _round(terrain: Terrain, ways: Ways, limits: RoundLimits, length_m: float) -> Floats:
    """Corners of a round about the place that is farthest from all obstacles."""
    count, labels, stats, _ = cv2.connectedComponentsWithStats(
        ways.free.astype(np.uint8), connectivity=4
    )
    if count < 2:
        raise NotFoundError(
            "room for the animal",
            "obstacles leave no open ground of its width",
            "Name another place, or a smaller animal (--length-m).",
        )
    open_ground = labels == 1 + int(stats[1:, cv2.CC_STAT_AREA].argmax())
    padded = np.pad(open_ground.astype(np.uint8), 1)
    room: NDArray[np.float32] = np.asarray(
        cv2.distanceTransform(padded, cv2.DIST_L2, 5), dtype=np.float32
    )[1:-1, 1:-1]
    # The middle of the terrain is preferred: its end is seldom what one comes to see.
    row, column = np.indices(room.shape)
    rows, columns = room.shape
    centred = 1.0 - 0.7 * np.hypot(row / rows - 0.5, column / columns - 0.5)
    middle = np.unravel_index(int((room * centred).argmax()), room.shape)
    radius = min(0.8 * float(room[middle]), 0.5 * limits.across * length_m / terrain.cell_m)
    turn = np.linspace(0.0, 2.0 * np.pi, limits.corners + 1)
    around = np.stack([middle[0] + radius * np.sin(turn), middle[1] + radius * np.cos(turn)], 1)
    around[-1] = around[0]
    return terrain.point_of(np.round(around))
