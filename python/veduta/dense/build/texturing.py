"""The mesh with the photos on it, or with a colour for each vertex."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from veduta.dense.document import Views
from veduta.place.mesh import Mesh
from veduta.run.progress import StepProgress
from veduta.surfaces import SurfaceView, TexturedMesh, TextureOptions, texture_mesh


def textured(
    mesh: Mesh,
    middle_m: NDArray[np.float64],
    views: Views,
    order: list[int],
    largest_px: int,
    progress: StepProgress,
) -> TexturedMesh:
    """The mesh, which lies about `middle_m`, textured from the photos of `order`."""
    moved = np.eye(4)
    moved[:3, 3] = -middle_m
    shown = [
        SurfaceView(views.cameras[view].moved(moved), _reader(views, view), _mask(views, view))
        for view in order
    ]
    return texture_mesh(mesh, shown, TextureOptions(largest_px=largest_px), progress)


def _reader(views: Views, view: int) -> Callable[[], NDArray[np.uint8]]:
    return lambda: views.pixels(view)


def _mask(views: Views, view: int) -> Callable[[], NDArray[np.bool_] | None]:
    return lambda: views.hidden(view)
