"""What can be said of the object in figures, and how sure it is."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta import _core
from veduta.carve.views import View, camera_rows
from veduta.surfaces import vertex_normals, vertex_pieces

Floats = NDArray[np.float64]
Triangles = NDArray[np.uint32]


@dataclass(frozen=True)
class Measures:
    """Of the mesh, in the cameras' unit (metres where the scale is known).

    volume_error: the area times what a silhouette's outline may be off (`outline_px`). area_error: by
    how much the area changes where the surface moves as far out or in.
    """

    volume: float
    volume_error: float
    area: float
    area_error: float
    size: tuple[float, float, float]
    pieces: int


def measure_mesh(
    positions: Floats, triangles: Triangles, views: Sequence[View], outline_px: float = 1.0
) -> Measures:
    """The figures of a closed mesh."""
    corners = positions[triangles]
    cross = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    area = _area(positions, triangles)
    volume = float((corners[:, 0] * cross).sum() / 6.0)
    middle = positions.mean(axis=0)
    pixel = float(
        np.median(
            [
                float(view.camera.project(middle)[1][0]) / max(view.camera.focal_px)
                for view in views
            ]
        )
    )
    x, y, z = np.ptp(positions, axis=0).tolist()
    off = pixel * outline_px
    normals = vertex_normals(positions, triangles)
    moved = [_area(positions + side * off * normals, triangles) for side in (1.0, -1.0)]
    pieces = int(vertex_pieces(triangles, len(positions)).max()) + 1
    return Measures(
        volume, area * off, area, 0.5 * abs(moved[0] - moved[1]), (x, y, z), pieces
    )


def _area(positions: Floats, triangles: Triangles) -> float:
    corners = positions[triangles]
    cross = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    return 0.5 * float(np.linalg.norm(cross, axis=1).sum())


def overlaps(views: Sequence[View], positions: Floats, triangles: Triangles) -> Floats:
    """(n,) of each view, the intersection over union of its silhouette and the mesh's."""
    sizes = [(view.camera.width_px, view.camera.height_px) for view in views]
    rows = camera_rows([view.camera for view in views])
    seen = _core.seen_triangles(rows, sizes, positions, triangles)
    found = []
    for view, one in zip(views, seen, strict=True):
        drawn = one >= 0
        either = int((drawn | view.mask).sum())
        found.append(int((drawn & view.mask).sum()) / either if either else 1.0)
    return np.array(found)
