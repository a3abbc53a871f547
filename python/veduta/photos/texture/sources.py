"""The photos of a structure that lies in the world as views of the city model."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from veduta.photos.straight import pinhole_of, shown_px, straightened
from veduta.photos.structure import Structure
from veduta.photos.texture.views import View

ReadPhoto = Callable[[int], NDArray[np.uint8]]
"""Gives (h, w, 3) sRGB of a photo, by its image id."""


def views_of(structure: Structure, read_photo: ReadPhoto) -> list[View]:
    """A view per photo of a structure in metres about the city model's origin, at its full size."""
    return [_view(structure, row, read_photo) for row in range(len(structure.image_ids))]


def _view(structure: Structure, row: int, read_photo: ReadPhoto) -> View:
    camera = structure.camera(row)
    pinhole = pinhole_of(camera)
    image_id = structure.image_ids[row]
    return View(
        name=structure.names[row],
        camera=pinhole,
        cam_from_world=structure.cam_from_world[row],
        pixels=lambda: straightened(read_photo(image_id), camera, pinhole),
        valid=lambda: shown_px(camera, pinhole),
    )
