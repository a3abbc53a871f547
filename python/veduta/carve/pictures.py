"""The report's pictures: silhouettes on the photos, and the object from several sides."""

from __future__ import annotations

from collections.abc import Sequence

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta import _core
from veduta.cameras import Camera
from veduta.carve.build.place import Shape
from veduta.carve.views import View, camera_rows

Floats = NDArray[np.float64]
Pixels = NDArray[np.uint8]
TILE_PX = 300
OUTLINE = (255, 40, 160)
SHEET = 12


def outlines_picture(views: Sequence[View], columns: int = 4) -> Pixels:
    """Up to twelve photos, spread over all, with the outlines of their silhouettes."""
    chosen = np.unique(np.linspace(0, len(views) - 1, min(SHEET, len(views))).round().astype(int))
    return _sheet([_outlined(views[number]) for number in chosen], columns)


def sides_picture(shape: Shape, columns: int = 3) -> Pixels:
    """The object from four sides, from above and from below, in its colours."""
    ways = [(-90.0, 15.0), (0.0, 15.0), (90.0, 15.0), (180.0, 15.0), (-60.0, 60.0), (-60.0, -45.0)]
    return _sheet([render(shape, *way) for way in ways], columns)


def carved_picture(shape: Shape, columns: int = 3) -> Pixels:
    """The same object in grey, and orange where colours carved it."""
    plain = np.full((len(shape.positions), 3), 205, dtype=np.uint8)
    plain[shape.triangles[shape.carved].ravel()] = (240, 120, 30)
    grey = Shape(shape.positions, shape.triangles, plain, shape.carved)
    return sides_picture(grey, columns)


def render(
    shape: Shape, azimuth_deg: float, height_deg: float, side_px: int = 2 * TILE_PX
) -> Pixels:
    """(side, side, 3) the object from a side, lit from the camera."""
    camera = _around(shape.positions, azimuth_deg, height_deg, side_px)
    seen = _core.seen_triangles(
        camera_rows([camera]), [(side_px, side_px)], shape.positions, shape.triangles
    )[0]
    corners = shape.positions[shape.triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300)
    towards = -camera.cam_from_world[2, :3]
    light = 0.35 + 0.65 * np.clip(normals @ towards, 0.0, 1.0)
    colours = shape.colours[shape.triangles].mean(axis=1) * light[:, None]
    pixels = np.full((side_px, side_px, 3), 255.0)
    pixels[seen >= 0] = colours[seen[seen >= 0]]
    half = cv2.resize(pixels, (side_px // 2, side_px // 2), interpolation=cv2.INTER_AREA)
    return np.asarray(half.round().clip(0, 255), dtype=np.uint8)


def _around(positions: Floats, azimuth_deg: float, height_deg: float, side_px: int) -> Camera:
    """A camera at three times the object's size, whose picture it fills."""
    low, high = positions.min(axis=0), positions.max(axis=0)
    middle, size = (low + high) / 2.0, float(np.linalg.norm(high - low))
    azimuth, height = np.radians([azimuth_deg, height_deg])
    back = np.array(
        [np.cos(azimuth) * np.cos(height), np.sin(azimuth) * np.cos(height), np.sin(height)]
    )
    right = np.array([-np.sin(azimuth), np.cos(azimuth), 0.0])
    turn = np.array([right, np.cross(-back, right), -back])
    eye = middle + 3.0 * size * back
    pose = np.column_stack([turn, -turn @ eye])
    plain = Camera("side", side_px, side_px, (1.0, 1.0), (0.0, 0.0), pose)
    seen, _ = plain.project(positions)
    left, right = seen.min(axis=0), seen.max(axis=0)
    focal = 0.94 * side_px / float((right - left).max())
    x, y = (side_px / 2 - focal * (left + right) / 2.0).tolist()
    return Camera("side", side_px, side_px, (focal, focal), (x, y), pose)


def _outlined(view: View) -> Pixels:
    drawn = view.pixels.copy()
    width = max(1, round(max(drawn.shape[:2]) / 300))
    found, _ = cv2.findContours(view.mask.astype(np.uint8), cv2.RETR_CCOMP, cv2.CHAIN_APPROX_NONE)
    cv2.drawContours(drawn, found, -1, OUTLINE, width)
    return drawn


def _sheet(tiles: Sequence[Pixels], columns: int) -> Pixels:
    """Tiles in rows, all of one width, the rows as high as the highest tile."""
    columns = min(columns, len(tiles))
    rows = -(-len(tiles) // columns)
    heights = [max(1, round(tile.shape[0] * TILE_PX / tile.shape[1])) for tile in tiles]
    high = min(max(heights), 2 * TILE_PX)
    sheet = np.full((rows * high, columns * TILE_PX, 3), 255, dtype=np.uint8)
    for number, tile in enumerate(tiles):
        scale = min(TILE_PX / tile.shape[1], high / tile.shape[0])
        size = (max(1, round(tile.shape[1] * scale)), max(1, round(tile.shape[0] * scale)))
        small = cv2.resize(tile, size, interpolation=cv2.INTER_AREA)
        top, left = number // columns * high, number % columns * TILE_PX
        sheet[top : top + size[1], left : left + size[0]] = small
    return sheet
