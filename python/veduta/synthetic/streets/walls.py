"""The facades of a street, and how much of each the photos see."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.synthetic.camera import Camera
from veduta.synthetic.scene import RayScene
from veduta.synthetic.streets.house import House

STEP_M = 0.25
"""Between the columns of places that are looked at."""
HEIGHTS = (0.12, 0.3, 0.5, 0.7, 0.88)
"""Rows of places, as shares of the height."""
FEWEST_CAMERAS = 3
FEWEST_ROWS = 2
"""A column of a wall is seen where so many cameras see so many of its places."""
GRAZING = 0.2
"""Cosine between the normal and the line of sight, under which nothing is recognised."""
FARTHEST_M = 35.0
_CLEAR_M = 0.02


@dataclass(frozen=True)
class TrueWall:
    """An upright rectangle; one who looks at it from outside has `start` at the left.

    id: the building's, and the number of the outline's edge. start_m, end_m: (2,). outward: (2,)
    unit. seen_m: how much of its width is seen; seen_from_m, seen_to_m: the ends of what is seen,
    from the start; equal where nothing is.
    """

    id: str
    house: str
    start_m: NDArray[np.float64]
    end_m: NDArray[np.float64]
    bottom_m: float
    top_m: float
    seen_m: float
    seen_from_m: float
    seen_to_m: float

    @property
    def width_m(self) -> float:
        """From end to end."""
        return float(np.linalg.norm(self.end_m - self.start_m))

    @property
    def outward(self) -> NDArray[np.float64]:
        """(2,) unit normal, away from the building."""
        x, y = (self.end_m - self.start_m) / self.width_m
        return np.array([y, -x])


def true_walls(
    houses: Sequence[House], cameras: Sequence[Camera], scene: RayScene
) -> tuple[TrueWall, ...]:
    """All edges of all outlines, in order."""
    walls = []
    for house in houses:
        outline = house.outline_m
        for number, start in enumerate(outline):
            end = outline[(number + 1) % len(outline)]
            seen = _seen_columns(start, end, house.base_m, house.top_m, cameras, scene)
            width = float(np.linalg.norm(end - start))
            step = width / len(seen)
            columns = np.flatnonzero(seen)
            first, last = (columns[0], columns[-1] + 1) if len(columns) else (0, 0)
            walls.append(
                TrueWall(
                    id=f"{house.id}/{number}",
                    house=house.id,
                    start_m=start,
                    end_m=end,
                    bottom_m=house.base_m,
                    top_m=house.top_m,
                    seen_m=step * len(columns),
                    seen_from_m=step * float(first),
                    seen_to_m=step * float(last),
                )
            )
    return tuple(walls)


def _seen_columns(
    start: NDArray[np.float64],
    end: NDArray[np.float64],
    bottom: float,
    top: float,
    cameras: Sequence[Camera],
    scene: RayScene,
) -> NDArray[np.bool_]:
    """(c,) whether each column of places is seen well enough."""
    width = float(np.linalg.norm(end - start))
    columns = max(1, round(width / STEP_M))
    shares = (np.arange(columns) + 0.5) / columns
    x, y = (end - start) / width
    outward = np.array([y, -x, 0.0])
    foot = start + shares[:, None] * (end - start)
    heights = bottom + np.array(HEIGHTS) * (top - bottom)
    places = np.concatenate(
        [
            np.repeat(foot, len(heights), axis=0),
            np.tile(heights, columns)[:, None],
        ],
        axis=1,
    )
    normals = np.broadcast_to(outward, places.shape)
    counts = np.sum([sees(camera, scene, places, normals) for camera in cameras], axis=0)
    rows = (counts.reshape(columns, len(heights)) >= FEWEST_CAMERAS).sum(axis=1)
    return np.asarray(rows >= FEWEST_ROWS)


def sees(
    camera: Camera,
    scene: RayScene,
    places: NDArray[np.float64],
    normals: NDArray[np.float64],
    grazing: float | NDArray[np.float64] = GRAZING,
    farthest_m: float = FARTHEST_M,
) -> NDArray[np.bool_]:
    """(n,) whether the camera has each place in its frame, free and not too much from aside."""
    pixels, depth = camera.project(places)
    towards = camera.position_m - places
    distance = np.linalg.norm(towards, axis=1)
    towards = towards / distance[:, None]
    size = np.array([camera.width_px, camera.height_px])
    found = np.asarray((depth > 0.3) & (distance < farthest_m))
    found &= ((pixels > 0) & (pixels < size)).all(axis=1)
    found &= np.sum(towards * normals, axis=1) > grazing
    rows = np.flatnonzero(found)
    if len(rows) == 0:
        return found
    origins = (places[rows] + _CLEAR_M * normals[rows]).astype(np.float32)
    blocked = scene.blocked(origins, towards[rows].astype(np.float32), distance[rows])
    found[rows[blocked]] = False
    return found
