"""The photos of a structure that lies in the world as views of the city model."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

import cv2
import numpy as np
import pycolmap
from numpy.typing import NDArray

from veduta.imaging.read import read_image
from veduta.photos.pictures import Pinhole, picture_name
from veduta.photos.structure import Structure
from veduta.photos.texture.views import View

_STEP_PX = 8
_BORDER_PX = 2.0


def views_of(structure: Structure, pinholes: Sequence[Pinhole], pictures: Path) -> list[View]:
    """A view per photo of a structure in metres about the city model's origin.

    pinholes: of the pictures in the folder, in the structure's order.
    """
    return [
        View(
            name=structure.names[row],
            camera=pinhole,
            cam_from_world=structure.cam_from_world[row],
            pixels=_reader(pictures / picture_name(structure.image_ids[row])),
            valid=_shown(structure.camera(row), pinhole),
        )
        for row, pinhole in enumerate(pinholes)
    ]


def _reader(path: Path) -> Callable[[], NDArray[np.uint8]]:
    return lambda: read_image(path).pixels


def _shown(camera: pycolmap.Camera, pinhole: Pinhole) -> Callable[[], NDArray[np.bool_]]:
    return lambda: shown_px(camera, pinhole)


def shown_px(camera: pycolmap.Camera, pinhole: Pinhole) -> NDArray[np.bool_]:
    """(h, w) where the picture without distortion shows a pixel of the photo.

    Found on a coarse grid: a lens bends gently.
    """
    columns = np.arange(0, pinhole.width_px + _STEP_PX, _STEP_PX, dtype=np.float64)
    rows = np.arange(0, pinhole.height_px + _STEP_PX, _STEP_PX, dtype=np.float64)
    x, y = np.meshgrid(columns, rows)
    rays = np.column_stack(
        [
            (x.ravel() - pinhole.centre_px[0]) / pinhole.focal_px[0],
            (y.ravel() - pinhole.centre_px[1]) / pinhole.focal_px[1],
            np.ones(x.size),
        ]
    )
    found = np.asarray(camera.img_from_cam(rays))
    across, down = found.T.reshape(2, *x.shape)
    inner = np.minimum.reduce([across, camera.width - across, down, camera.height - down])
    inner = np.nan_to_num(inner, nan=-1.0).astype(np.float32)
    step = 1.0 / _STEP_PX
    move = np.array([[step, 0, 0.5 * step], [0, step, 0.5 * step]])
    size = (pinhole.width_px, pinhole.height_px)
    flags = cv2.INTER_LINEAR | cv2.WARP_INVERSE_MAP
    smooth = cv2.warpAffine(inner, move, size, flags=flags, borderMode=cv2.BORDER_REPLICATE)
    return np.asarray(smooth >= _BORDER_PX)
