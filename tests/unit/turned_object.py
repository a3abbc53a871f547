"""A body of balls and a beam on a turntable, seen by one camera: truth for angles and cameras."""

from __future__ import annotations

import numpy as np
import trimesh
from numpy.typing import NDArray

from veduta import _core
from veduta.cameras import Camera
from veduta.carve.read.turning import Table
from veduta.carve.views import camera_rows

BALLS = (
    (0.0, 0.0, 0.0, 0.10),
    (0.12, 0.03, 0.07, 0.06),
    (-0.08, 0.10, -0.05, 0.05),
    (0.02, -0.13, 0.12, 0.045),
    (0.0, 0.02, 0.16, 0.05),
)
"""Centre and radius, of the camera's distance."""


def body() -> trimesh.Trimesh:
    """The body about the axis z."""
    parts = []
    for x, y, z, radius in BALLS:
        ball = trimesh.creation.icosphere(subdivisions=3, radius=radius)
        ball.apply_translation([x, y, z])
        parts.append(ball)
    beam = trimesh.creation.box((0.34, 0.04, 0.05))
    beam.apply_translation([0.02, 0.0, -0.1])
    found = trimesh.util.concatenate([*parts, beam])
    if not isinstance(found, trimesh.Trimesh):
        raise TypeError("no mesh")
    return found


def silhouettes(
    table: Table, size: tuple[int, int], mesh: trimesh.Trimesh | None = None
) -> list[NDArray[np.bool_]]:
    """(h, w) of each photo of a table. size: width and height (px)."""
    mesh = mesh or body()
    centre = (size[0] / 2.0, size[1] / 2.0)
    focal = (table.focal_px, table.focal_px)
    cameras = [Camera(str(n), *size, focal, centre, pose) for n, pose in enumerate(table.poses())]
    seen = _core.seen_triangles(
        camera_rows(cameras),
        [size] * len(cameras),
        np.asarray(mesh.vertices, dtype=np.float64),
        np.asarray(mesh.faces, dtype=np.uint32),
    )
    return [one >= 0 for one in seen]
