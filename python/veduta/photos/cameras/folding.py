"""Where a lens model holds: far outside of the photo that it was found in, it may fold over."""

from __future__ import annotations

import numpy as np
import pycolmap
from numpy.typing import NDArray

CLOSE = 0.01
"""Distance of a ray from itself, there and back, as a share of its distance from the axis."""


def undistorts(
    camera: pycolmap.Camera, points: NDArray[np.float64], places: NDArray[np.float64]
) -> NDArray[np.bool_]:
    """Whether the way back from the photo finds each ray.

    points: (n, 3) before the camera, in its frame. places: (n, 2) where it shows them (px).
    """
    rays = points[:, :2] / points[:, 2:]
    back = np.asarray(camera.cam_from_img(places))
    apart = np.linalg.norm(np.nan_to_num(back, nan=np.inf) - rays, axis=1)
    found: NDArray[np.bool_] = apart < CLOSE * (1.0 + np.linalg.norm(rays, axis=1))
    return found
