"""The photos of a set of cameras as views that give texture."""

from __future__ import annotations

from functools import partial
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from veduta.cameras import Camera, CameraSet, shown, straight_camera, undistorted
from veduta.imaging.read import read_image
from veduta.run.errors import InputError
from veduta.surfaces.texturing.options import Pixels, SurfaceView

_BLACK = 128


def surface_views(cameras: CameraSet) -> list[SurfaceView]:
    """A view of each camera whose picture is there, undistorted when it is read.

    What lies beyond a picture's border after that, and where its mask is black, is hidden.
    InputError where none has a picture.
    """
    there = [camera for camera in cameras.cameras if camera.picture is not None]
    if not there:
        remedy = "Put the photos beside the cameras, or name their folder."
        raise InputError(cameras.source or "the cameras", "have no pictures", remedy)
    return [
        SurfaceView(
            straight_camera(camera),
            partial(_pixels, camera),
            partial(_hidden, camera, cameras.masks.get(camera.name)),
        )
        for camera in there
    ]


def _pixels(camera: Camera) -> Pixels:
    return undistorted(camera, _read(camera, Path(str(camera.picture))))[1]


def _hidden(camera: Camera, mask: Path | None) -> NDArray[np.bool_] | None:
    hidden = ~shown(camera) if camera.distorted else None
    if mask is None:
        return hidden
    grey = np.ascontiguousarray(_read(camera, mask)[..., 0])
    black = np.asarray(undistorted(camera, grey, nearest=True)[1] < _BLACK)
    return black if hidden is None else black | hidden


def _read(camera: Camera, path: Path) -> Pixels:
    pixels = read_image(path).pixels
    height, width = pixels.shape[:2]
    if (width, height) != (camera.width_px, camera.height_px):
        wanted = f"{camera.width_px} x {camera.height_px}"
        fault = f"has {width} x {height} px, and its camera {wanted}"
        raise InputError(path, fault, "Give pictures and masks at the size of their cameras.")
    return pixels
