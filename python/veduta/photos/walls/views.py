"""Which photos see which cells of a wall, and how well.

A cell is a square of pixels of the wall's picture. What stands before the wall is known from the
other walls and from the points that the same photo sees there.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.photos.cameras.folding import undistorts
from veduta.photos.structure import Structure
from veduta.photos.walls.grid import WallGrid
from veduta.photos.walls.wall import Wall

CELLS = 64
"""Cells along the longest side of a wall."""
SMALLEST_CELL_PX = 8
MOST_PHOTOS = 24
"""Photos that a wall's picture is made of at most: those that see most of its points."""
LEAST_POINTS = 4
"""Points of a wall that a photo has to see."""
MOST_OBLIQUE = 0.17
"""Least cosine between the line of sight and the wall's normal: 80 degrees."""
BORDER = 0.04
"""Part of a photo's width at its border that counts less and less."""
OCCLUDERS = 2
"""Points before the wall in a cell and those around it that hide it."""


@dataclass(frozen=True)
class WallView:
    """A wall as a photo sees it, by cells (r, c) of `cell_px` pixels.

    photo: row of the structure. quality: (r, c) the photo's pixels per unit of length across, as
    far as they are of use; 0 where it does not see the cell. places_px: (r, c, 2) in the photo.
    """

    photo: int
    quality: NDArray[np.float64]
    places_px: NDArray[np.float64]


def cell_size_px(grid: WallGrid) -> int:
    """Pixels along a cell's side."""
    return max(SMALLEST_CELL_PX, -(-max(grid.width_px, grid.height_px) // CELLS))


def cell_points(grid: WallGrid) -> NDArray[np.float64]:
    """(r, c, 3) the cells' centres."""
    cell = cell_size_px(grid)
    columns = (np.arange(-(-grid.width_px // cell)) + 0.5) * cell
    rows = (np.arange(-(-grid.height_px // cell)) + 0.5) * cell
    return grid.points(columns, rows)


def wall_views(
    structure: Structure, grid: WallGrid, walls: Sequence[Wall], relief: float
) -> list[WallView]:
    """The photos that see something of a wall. relief: what lies nearer to it belongs to it."""
    on_wall = np.zeros(len(structure.points), dtype=bool)
    on_wall[grid.wall.point_rows] = True
    counts = np.bincount(
        structure.image_of[on_wall[structure.point_of]], minlength=len(structure.names)
    )
    best = np.argsort(-counts, kind="stable")[:MOST_PHOTOS]
    centres = cell_points(grid)
    found = []
    for photo in sorted(int(row) for row in best if counts[row] >= LEAST_POINTS):
        view = _seen(structure, photo, grid, centres)
        if not view.quality.any():
            continue
        hidden = _behind_walls(structure.centres()[photo], centres, grid.wall, walls, relief)
        hidden |= _behind_points(structure, photo, grid, hidden.shape, relief)
        view.quality[hidden] = 0.0
        if view.quality.any():
            found.append(view)
    return found


def _seen(
    structure: Structure, photo: int, grid: WallGrid, centres: NDArray[np.float64]
) -> WallView:
    """Where the cells come to lie in a photo, and how large, whatever stands before them."""
    pose, camera = structure.cam_from_world[photo], structure.camera(photo)
    shape = centres.shape[:2]
    points = centres.reshape(-1, 3) @ pose[:, :3].T + pose[:, 3]
    distance = np.linalg.norm(points, axis=1)
    outward = pose[:, :2] @ grid.wall.outward
    cosine = -(points @ outward) / np.maximum(distance, 1e-300)
    ahead = (points[:, 2] > 1e-3 * distance) & (cosine > MOST_OBLIQUE)
    places = np.full((len(points), 2), -1.0)
    places[ahead] = camera.img_from_cam(points[ahead])
    size = np.array([camera.width, camera.height])
    margin = np.nan_to_num(np.minimum(places, size - places).min(axis=1), nan=-1.0)
    seen = ahead & (margin > 1.0)
    seen[seen] = undistorts(camera, points[seen], places[seen])
    sharp = np.minimum(camera.mean_focal_length() / distance, 1.0 / grid.pixel)
    inner = np.clip(margin / (BORDER * camera.width), 0.1, 1.0)
    quality = np.where(seen, sharp * cosine * inner, 0.0)
    return WallView(photo, quality.reshape(shape), places.reshape(*shape, 2))


def _behind_walls(
    eye: NDArray[np.float64],
    centres: NDArray[np.float64],
    own: Wall,
    walls: Sequence[Wall],
    relief: float,
) -> NDArray[np.bool_]:
    """(r, c) the cells between which and the eye another wall stands."""
    hidden = np.zeros(centres.shape[:2], dtype=bool)
    length = np.linalg.norm(centres[..., :2] - eye[:2], axis=-1)
    for wall in walls:
        if wall is own:
            continue
        before = float((eye[:2] - wall.start) @ wall.outward)
        behind = (centres[..., :2] - wall.start) @ wall.outward
        crosses = (before * behind < 0.0) & (np.abs(behind) > 1e-12)
        part = before / np.where(crosses, before - behind, np.inf)
        place = eye + part[..., None] * (centres - eye)
        along = (place[..., :2] - wall.start) @ wall.along
        inside = (along > 0.0) & (along < wall.width)
        inside &= (place[..., 2] > wall.bottom) & (place[..., 2] < wall.top)
        hidden |= crosses & inside & ((1.0 - part) * length > relief)
    return hidden


def _behind_points(
    structure: Structure, photo: int, grid: WallGrid, shape: tuple[int, ...], relief: float
) -> NDArray[np.bool_]:
    """(r, c) the cells before which the photo sees points."""
    wall, eye = grid.wall, structure.centres()[photo]
    seen = structure.points[structure.point_of[structure.image_of == photo]]
    ahead = (seen[:, :2] - wall.start) @ wall.outward
    height = float((eye[:2] - wall.start) @ wall.outward)
    near = (ahead > relief) & (ahead < height - relief)
    seen, ahead = seen[near], ahead[near]
    place = eye + (height / (height - ahead))[:, None] * (seen - eye)
    cell = cell_size_px(grid) * grid.pixel
    columns = np.floor(((place[:, :2] - wall.start) @ wall.along - grid.left) / cell)
    rows = np.floor((grid.upper - place[:, 2]) / cell)
    inside = (columns >= 0) & (columns < shape[1]) & (rows >= 0) & (rows < shape[0])
    counts = np.zeros(shape, dtype=np.float32)
    np.add.at(counts, (rows[inside].astype(int), columns[inside].astype(int)), 1.0)
    around = cv2.boxFilter(counts, -1, (3, 3), normalize=False, borderType=cv2.BORDER_CONSTANT)
    found: NDArray[np.bool_] = (around > OCCLUDERS - 0.5).astype(bool)
    return found
