"""A wall that the test draws, and photographs of it from known cameras."""

from __future__ import annotations

from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.geometry import homography, polygon
from veduta.geometry.homography import Matrix
from veduta.geometry.vanishing import FacadeView
from veduta.imaging.read import Photo


def photo_of(pixels: NDArray[np.uint8], focal_px: float | None = None) -> Photo:
    """A photo as if it had been read."""
    return Photo(pixels, "0" * 64, None, focal_px, Path("drawn.png"))


def draw_wall(columns: int = 6, floors: int = 5, seed: int = 0) -> NDArray[np.uint8]:
    """Windows with frames, cornices and a textured wall; 120 px a column, 150 px a floor."""
    rng = np.random.default_rng(seed)
    height, width = 150 * floors, 120 * columns
    wall = np.empty((height, width, 3), dtype=np.float64)
    wall[:] = rng.uniform(140, 200, 3)
    wall += cv2.GaussianBlur(rng.normal(0, 12, (height, width)), (0, 0), 1.5)[:, :, None]
    image = np.clip(wall, 0, 255).astype(np.uint8)
    for floor in range(floors):
        y = 150 * floor
        cv2.rectangle(image, (0, y + 4), (width, y + 10), (120, 110, 100), -1)
        for column in range(columns):
            x = 120 * column
            cv2.rectangle(image, (x + 35, y + 35), (x + 85, y + 125), (235, 230, 225), -1)
            cv2.rectangle(image, (x + 41, y + 41), (x + 79, y + 119), (60, 70, 80), -1)
            cv2.line(image, (x + 60, y + 41), (x + 60, y + 119), (235, 230, 225), 3)
    return image


def view_from_wall(
    view: FacadeView, wall_size: tuple[int, int], fill: float, view_size: tuple[int, int]
) -> Matrix:
    """A homography that shows the wall's middle at the principal point, `fill` of the view wide."""
    width, height = wall_size
    distance = view.focal_px * max(width / view_size[0], height / view_size[1]) / fill
    rotation = view.rotation()
    columns = np.stack([rotation[:, 0], rotation[:, 1], np.array([0.0, 0.0, distance])], axis=1)
    return np.asarray(view.camera() @ columns @ homography.translation(-width / 2, -height / 2))


def take(
    wall: NDArray[np.uint8], view: FacadeView, fill: float, view_size: tuple[int, int]
) -> tuple[NDArray[np.uint8], Matrix]:
    """The picture (h, w, 3) of the wall before a plain sky, and view_from_wall."""
    matrix = view_from_wall(view, wall.shape[1::-1], fill, view_size)
    half = homography.translation(0.5, 0.5)
    picture = cv2.warpPerspective(
        wall,
        np.linalg.inv(half) @ matrix @ half,
        view_size,
        flags=cv2.INTER_AREA,
        borderMode=cv2.BORDER_CONSTANT,
        borderValue=(190, 205, 220),
    )
    return np.asarray(picture, dtype=np.uint8), matrix


def corner_error(found: Matrix, view_from_wall_: Matrix, size: tuple[int, int]) -> float:
    """Largest corner error, part of the width, after the best shift and scale of x and y."""
    truth = polygon.rectangle(0, 0, *size)
    estimate = homography.apply(found @ view_from_wall_, truth)
    e, t = estimate - estimate.mean(axis=0), truth - truth.mean(axis=0)
    fitted = e * (e * t).sum(axis=0) / (e * e).sum(axis=0)
    return float(np.linalg.norm(fitted - t, axis=1).max()) / size[0]


def aspect_ratio(found: Matrix, view_from_wall_: Matrix, size: tuple[int, int]) -> float:
    """Found over true ratio of width to height."""
    truth = polygon.rectangle(0, 0, *size)
    spread = np.ptp(homography.apply(found @ view_from_wall_, truth), axis=0)
    return float(spread[0] / spread[1] / (size[0] / size[1]))


def view_of(
    yaw: float, pitch: float, roll: float, focal: float, size: tuple[int, int]
) -> FacadeView:
    """A view from degrees; `focal` as a part of the diagonal."""
    angles = (float(np.deg2rad(v)) for v in (yaw, pitch, roll))
    return FacadeView(*angles, focal * float(np.hypot(*size)), size[0] / 2, size[1] / 2)
