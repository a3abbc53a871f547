"""The object with the photos on it."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

from veduta.carve.views import Floats, Mask, View
from veduta.place.mesh import Mesh
from veduta.run.progress import StepProgress
from veduta.surfaces import SurfaceView, TexturedMesh, TextureOptions, texture_mesh


def textured(
    mesh: Mesh, shift: Floats, views: Sequence[View], largest_px: int, progress: StepProgress
) -> TexturedMesh:
    """The mesh, whose origin lies at `shift` in the cameras' frame, textured from the silhouettes'
    insides: what is behind the object never gets on it.
    """
    moved = np.eye(4)
    moved[:3, 3] = -shift
    shown = [
        SurfaceView(view.camera.moved(moved), _reader(view), _behind(view)) for view in views
    ]
    return texture_mesh(mesh, shown, TextureOptions(largest_px=largest_px), progress)


def _reader(view: View) -> Callable[[], NDArray[np.uint8]]:
    return lambda: view.pixels


def _behind(view: View) -> Callable[[], Mask]:
    return lambda: ~view.mask
