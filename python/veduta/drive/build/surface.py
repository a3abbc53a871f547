"""The background's depth image as triangles, by the depth or angle rule (section 6.4)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.drive.build.fill import Source
from veduta.drive.build.frame import ColumnFrame


@dataclass(frozen=True)
class SurfaceParameters:
    """most_m: neighbours whose depths differ less are joined (s_max). angle_deg: or that lie on a
    line within it (phi_max), up to `longest_m` apart.
    """

    most_m: float = 0.5
    angle_deg: float = 25.0
    longest_m: float = 4.0


@dataclass(frozen=True, eq=False)
class Surface:
    """Triangles over the pixels of a depth image.

    vertices: (v, 3) world (m). pixel: (v, 2) row and column of each. triangles: (m, 3),
    counter-clockwise from the street. source: (m,) uint8 `Source`. wall: (m,) else ground.
    """

    vertices: NDArray[np.float64]
    pixel: NDArray[np.float64]
    triangles: NDArray[np.int64]
    source: NDArray[np.uint8]
    wall: NDArray[np.bool_]


def build_surface(
    depth: NDArray[np.float32],
    source: NDArray[np.uint8],
    wall: NDArray[np.bool_],
    frame: ColumnFrame,
    parameters: SurfaceParameters | None = None,
) -> Surface:
    """depth, source, wall: (r, c), NaN where nothing is."""
    return surface_over(frame.vertices(depth), depth, source, wall, frame, parameters)


def surface_over(
    grid: NDArray[np.float64],
    depth: NDArray[np.float32],
    source: NDArray[np.uint8],
    wall: NDArray[np.bool_],
    frame: ColumnFrame,
    parameters: SurfaceParameters | None = None,
) -> Surface:
    """grid: (r, c, 3) points that are neighbours (m), at these depths; NaN where nothing is."""
    chosen = parameters or SurfaceParameters()
    right = _joins(depth, grid, 1, chosen)[:-1]
    right_up = _joins(depth, grid, 1, chosen)[1:]
    up = _joins(depth, grid, 0, chosen)[:, :-1]
    up_right = _joins(depth, grid, 0, chosen)[:, 1:]
    number = np.arange(depth.size).reshape(depth.shape)
    a, b = number[:-1, :-1], number[:-1, 1:]
    c, d = number[1:, 1:], number[1:, :-1]
    lower = right & up_right
    higher = right_up & up
    first = np.stack([a[lower], b[lower], c[lower]], axis=1)
    second = np.stack([a[higher], c[higher], d[higher]], axis=1)
    triangles = np.concatenate([first, second])
    if _backwards(grid, triangles, frame):
        triangles = triangles[:, [0, 2, 1]]
    used, compact = np.unique(triangles, return_inverse=True)
    triangles = compact.reshape(-1, 3)
    flat_source, flat_wall = source.ravel()[used], wall.ravel()[used]
    # A triangle is as well known as its least known corner.
    worst = flat_source[triangles].max(axis=1) if len(triangles) else np.zeros(0, np.uint8)
    majority = flat_wall[triangles].sum(axis=1) >= 2 if len(triangles) else np.zeros(0, bool)
    pixel = np.stack(np.unravel_index(used, depth.shape), axis=1).astype(np.float64)
    return Surface(
        grid.reshape(-1, 3)[used], pixel, triangles, worst.astype(np.uint8), majority
    )


def _joins(
    depth: NDArray[np.float32],
    grid: NDArray[np.float64],
    axis: int,
    chosen: SurfaceParameters,
) -> NDArray[np.bool_]:
    """Whether each pixel is joined to the next along an axis; one shorter along it."""
    step = np.diff(grid, axis=axis)
    with np.errstate(invalid="ignore"):
        near = np.abs(np.diff(depth, axis=axis)) < chosen.most_m
        length = np.linalg.norm(step, axis=2)
        along = _straight(step, length, axis, np.cos(np.deg2rad(chosen.angle_deg)))
        return np.asarray(near | (along & (length < chosen.longest_m)))


def _straight(
    step: NDArray[np.float64], length: NDArray[np.float64], axis: int, cosine: float
) -> NDArray[np.bool_]:
    """Whether a step goes on in the direction of the one before or after it."""
    unit = step / np.maximum(length, 1e-9)[..., None]
    one = np.take(unit, range(unit.shape[axis] - 1), axis=axis)
    two = np.take(unit, range(1, unit.shape[axis]), axis=axis)
    straight = (one * two).sum(axis=2) > cosine
    pad = [(0, 0), (0, 0)]
    pad[axis] = (1, 0)
    after = np.pad(straight, pad)
    pad[axis] = (0, 1)
    return np.asarray(np.pad(straight, pad) | after)


def _backwards(
    grid: NDArray[np.float64], triangles: NDArray[np.int64], frame: ColumnFrame
) -> bool:
    """Whether most triangles turn their backs to the scanner."""
    if not len(triangles):
        return False
    corners = grid.reshape(-1, 3)[triangles[:: max(len(triangles) // 2000, 1)]]
    share = triangles[:: max(len(triangles) // 2000, 1), 0] % grid.shape[1] / grid.shape[1]
    columns = (share * frame.shape[1]).astype(np.int64)
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    to_scanner = frame.origins[columns] - corners[:, 0]
    return bool(((normals * to_scanner).sum(axis=1) > 0).mean() < 0.5)
