"""What a view shows that does not keep still or mirrors: grass and water, told and not hidden."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.walk.build.ground import height_above_ground
from veduta.walk.build.screen import Screen
from veduta.walk.build.water import find_water
from veduta.walk.rig import Image

Mask = NDArray[np.bool_]
BLUE, GREEN, RED = (20, 90, 255), (60, 220, 40), (255, 40, 30)


@dataclass(frozen=True)
class GrassLimits:
    """green: least of 2 g - r - b over r + g + b. low_m, high_m: of the ground's plane. flat: how
    level it is: 1 as the ground, 0 as a hedge. window_px: over which the green is meant, and rows_px
    over which it must be level (chosen on four frames of `laser/kitti00`). piece: smallest piece, as a share of the picture.
    """

    green: float = 0.08
    low_m: float = -0.7
    high_m: float = 0.3
    flat: float = 0.3
    window_px: int = 5
    rows_px: int = 7
    piece: float = 0.0008


@dataclass(frozen=True, eq=False)
class Marks:
    """(h, w) each: where the view shows still water, and where grass."""

    water: Mask
    grass: Mask


def find_marks(
    image: Image, points: NDArray[np.float64], measured: Mask, sky: Mask, screen: Screen
) -> Marks:
    """Of a local model's maps (section 3.2)."""
    water = find_water(image, points, measured, sky, screen)
    return Marks(water, find_grass(image, points, measured) & ~water & ~sky)


def painted(image: Image, masks: tuple[tuple[Mask, tuple[int, int, int]], ...]) -> Image:
    """A picture with what is marked in colours."""
    shown = image.copy()
    for mask, colour in masks:
        shown[mask] = (shown[mask] // 2 + np.array(colour) // 2).astype(np.uint8)
    return shown


def find_grass(
    image: Image, points: NDArray[np.float64], measured: Mask, limits: GrassLimits = GrassLimits()
) -> Mask:
    """(h, w) green that lies on the ground. Leaves higher up are none."""
    nothing = np.zeros(measured.shape, dtype=np.bool_)
    height = height_above_ground(points, measured)
    if height is None:
        return nothing
    colour = cv2.blur(image, (limits.window_px, limits.window_px)).astype(np.float32)
    total = np.maximum(colour.sum(axis=-1), 30.0)
    green = (2.0 * colour[..., 1] - colour[..., 0] - colour[..., 2]) / total
    found = (green > limits.green) & (height > limits.low_m) & (height < limits.high_m)
    found &= (points[..., 1] > 0.2) & (_level(points, height, limits) > limits.flat)
    return pieces(found, limits.piece)


def _level(
    points: NDArray[np.float64], height: NDArray[np.float64], limits: GrassLimits
) -> NDArray[np.float64]:
    """(h, w) 1 where the view's rows go away from the camera as on the ground, 0 as on a wall."""
    depth = np.hypot(points[..., 0], points[..., 2])
    nearness = cv2.blur(1.0 / depth, (limits.window_px, limits.window_px))
    reach = limits.rows_px // 2
    change = np.roll(nearness, -reach, axis=0) - np.roll(nearness, reach, axis=0)
    slope = points[..., 1] / depth
    rows = np.roll(slope, -reach, axis=0) - np.roll(slope, reach, axis=0)
    below_m = points[..., 1] + height
    ratio = change * below_m / np.where(np.abs(rows) > 1e-9, rows, np.inf)
    ratio[:reach] = 0.0
    ratio[-reach:] = ratio[-reach - 1]
    return np.asarray(cv2.blur(np.clip(ratio, -1.0, 2.0), (limits.rows_px, limits.rows_px)))


def pieces(found: Mask, least: float) -> Mask:
    """Without specks and pinholes; least: smallest piece, as a share of the picture."""
    opened = cv2.morphologyEx(found.astype(np.uint8), cv2.MORPH_OPEN, np.ones((3, 3), np.uint8))
    closed = cv2.morphologyEx(opened, cv2.MORPH_CLOSE, np.ones((7, 7), np.uint8))
    _, numbers, stats, _ = cv2.connectedComponentsWithStats(closed, connectivity=8)
    large = stats[:, cv2.CC_STAT_AREA] >= least * found.size
    large[0] = False
    return np.asarray(large[numbers], dtype=np.bool_)
