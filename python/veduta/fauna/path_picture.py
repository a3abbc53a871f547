"""The report's picture of a path: the terrain from above, shaded, with what is in the way."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.fauna.path.terrain import Terrain
from veduta.fauna.path.through import FoundPath

_LONGEST = 1100
_BLOCKED, _TIGHT = np.array([150.0, 60.0, 50.0]), np.array([214.0, 190.0, 170.0])
_PATH, _POINT = (30, 110, 200), (200, 60, 40)


def path_picture(terrain: Terrain, found: FoundPath) -> NDArray[np.uint8]:
    """North is up; brown: in the way, pale: too near to it; the path blue, its points red."""
    heights = np.nan_to_num(terrain.heights_m, nan=float(np.nanmean(terrain.heights_m)))
    north, east = np.gradient(heights, terrain.cell_m)
    light = (1.0 - 0.6 * east - 0.4 * north) / np.sqrt(1.0 + east**2 + north**2)
    shade = np.clip(118.0 + 92.0 * light, 60.0, 250.0)
    pixels = np.repeat(shade[..., None], 3, axis=2)
    pixels = np.where(found.ways.free[..., None], pixels, 0.5 * pixels + 0.5 * _TIGHT)
    pixels = np.where(terrain.blocked[..., None], _BLOCKED, pixels)[::-1]
    scale = min(_LONGEST / max(pixels.shape[:2]), 8.0)
    large = cv2.resize(
        pixels.astype(np.uint8), None, fx=scale, fy=scale,
        interpolation=cv2.INTER_AREA if scale < 1.0 else cv2.INTER_NEAREST,
    )  # fmt: skip
    canvas = np.ascontiguousarray(large, dtype=np.uint8)

    def on_canvas(points: NDArray[np.float64]) -> NDArray[np.int32]:
        cells = terrain.cell_of(points) + 0.5
        rows = canvas.shape[0] - cells[:, 0] * scale
        return np.round(np.stack([cells[:, 1] * scale, rows], axis=1) * 8).astype(np.int32)

    line = [on_canvas(found.points_m)]
    cv2.polylines(canvas, line, found.closed, (255, 255, 255), 5, cv2.LINE_AA, shift=3)
    cv2.polylines(canvas, line, found.closed, _PATH, 3, cv2.LINE_AA, shift=3)
    for x, y in on_canvas(found.through_m):
        cv2.circle(canvas, (int(x), int(y)), 5 * 8, _POINT, -1, cv2.LINE_AA, shift=3)
    return canvas
