"""A photo without the distortion of its lens: as a pinhole camera would have taken it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import cv2
import numpy as np
import pycolmap
from numpy.typing import NDArray

STEP_PX = 8
"""A lens bends gently: its places are found on a grid of so many pixels (a wide lens of 6000 px is
off by 0.01 px in between), and the photo is drawn in bands that are small beside it."""
_BAND_PX = 64 * STEP_PX
_BORDER_PX = 2.0
_OUTSIDE_PX = -1e4
_SAME_PX = 0.01


@dataclass(frozen=True)
class Pinhole:
    """An ideal camera: focal lengths and principal point in pixels, and the picture's size."""

    width_px: int
    height_px: int
    focal_px: tuple[float, float]
    centre_px: tuple[float, float]


def pinhole_of(camera: pycolmap.Camera, longest_px: int | None = None) -> Pinhole:
    """The camera without distortion, of a picture at most so long; the photo's size if None."""
    longest = max(camera.width, camera.height)
    shrink = min(1.0, (longest_px or longest) / longest)
    width, height = round(shrink * camera.width), round(shrink * camera.height)
    across, down = width / camera.width, height / camera.height
    return Pinhole(
        width,
        height,
        (across * camera.focal_length_x, down * camera.focal_length_y),
        (across * camera.principal_point_x, down * camera.principal_point_y),
    )


def straightened(
    pixels: NDArray[np.uint8], camera: pycolmap.Camera, pinhole: Pinhole
) -> NDArray[np.uint8]:
    """(h, w, 3) a photo of `camera` as `pinhole` sees it; black where the photo shows nothing.

    The photo itself where the two are the same.
    """
    grid = _photo_places(camera, pinhole)
    same = (pinhole.width_px, pinhole.height_px) == (camera.width, camera.height)
    if same and np.abs(grid - _nodes(pinhole)).max() < _SAME_PX:
        return pixels
    shrink = pinhole.width_px / camera.width
    if shrink < 1.0:
        sigma = 0.5 * (1.0 / shrink - 1.0)
        pixels = cv2.GaussianBlur(pixels, (0, 0), max(sigma, 0.1)).astype(np.uint8)
    # What is drawn at the photo's own size is looked at closely: cubic keeps it sharp.
    how = cv2.INTER_LINEAR if shrink < 1.0 else cv2.INTER_CUBIC
    picture = np.zeros((pinhole.height_px, pinhole.width_px, 3), dtype=np.uint8)
    for top, rows in _bands(pinhole):
        # OpenCV puts the centre of the first pixel at 0, the engine and we at one half.
        columns, downs = (
            _at_pixels(grid[..., axis], top, rows, pinhole.width_px) - 0.5 for axis in (0, 1)
        )
        picture[top : top + rows] = cv2.remap(
            pixels, columns, downs, how, borderMode=cv2.BORDER_CONSTANT
        )
    return picture


def shown_px(camera: pycolmap.Camera, pinhole: Pinhole) -> NDArray[np.bool_]:
    """(h, w) where the picture without distortion shows a pixel of the photo."""
    grid = _photo_places(camera, pinhole)
    found = np.empty((pinhole.height_px, pinhole.width_px), dtype=np.bool_)
    for top, rows in _bands(pinhole):
        across, down = (_at_pixels(grid[..., a], top, rows, pinhole.width_px) for a in (0, 1))
        inner = np.minimum.reduce([across, camera.width - across, down, camera.height - down])
        found[top : top + rows] = inner >= _BORDER_PX
    return found


def _bands(pinhole: Pinhole) -> Iterator[tuple[int, int]]:
    """The first row and the number of rows of each."""
    for top in range(0, pinhole.height_px, _BAND_PX):
        yield top, min(_BAND_PX, pinhole.height_px - top)


def _nodes(pinhole: Pinhole) -> NDArray[np.float64]:
    """(r, c, 2) the grid's places in the picture: every `STEP_PX`, from its corner to beyond."""
    columns = np.arange(0, pinhole.width_px + STEP_PX, STEP_PX, dtype=np.float64)
    rows = np.arange(0, pinhole.height_px + STEP_PX, STEP_PX, dtype=np.float64)
    return np.stack(np.meshgrid(columns, rows), axis=-1)


def _photo_places(camera: pycolmap.Camera, pinhole: Pinhole) -> NDArray[np.float64]:
    """(r, c, 2) where the grid's places lie in the photo; far outside where the lens has none."""
    nodes = _nodes(pinhole)
    local = (nodes - pinhole.centre_px) / pinhole.focal_px
    rays = np.concatenate([local, np.ones((*local.shape[:2], 1))], axis=-1)
    found = np.asarray(camera.img_from_cam(rays.reshape(-1, 3)))
    return np.asarray(np.nan_to_num(found, nan=_OUTSIDE_PX), dtype=np.float64).reshape(nodes.shape)


def _at_pixels(values: NDArray[np.float64], top: int, rows: int, width: int) -> NDArray[np.float32]:
    """(rows, width) the grid's values at the middles of the pixels of a band.

    `top` is one of the grid's rows. Steps of a half pixel are exact in OpenCV's 32nds of a node.
    """
    first = top // STEP_PX
    own = values[first : first + rows // STEP_PX + 2].astype(np.float32)
    step = 1.0 / STEP_PX
    move = np.array([[step, 0, 0.5 * step], [0, step, 0.5 * step]])
    flags = cv2.INTER_LINEAR | cv2.WARP_INVERSE_MAP
    found = cv2.warpAffine(own, move, (width, rows), flags=flags, borderMode=cv2.BORDER_REPLICATE)
    return np.asarray(found, dtype=np.float32)
