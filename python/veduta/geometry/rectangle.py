"""What the picture of a rectangle says about its shape."""

from __future__ import annotations

import numpy as np

from veduta.geometry.homography import Points, from_points
from veduta.geometry.polygon import rectangle


def aspect_of_rectangle(
    corners_px: Points, focal_px: float, centre_px: tuple[float, float]
) -> float:
    """Width / height in space of a rectangle seen by a pinhole camera with square pixels.

    Zhang and He, Whiteboard scanning and image enhancement (2007), section 3.3, equation 20: with
    H = [h1 h2 h3] from the unit square to the picture, the sides are |K^-1 h1| and |K^-1 h2|.
    Corners: upper left, upper right, lower right, lower left.
    """
    image_from_unit = from_points(rectangle(0.0, 0.0, 1.0, 1.0), corners_px)
    camera = np.array(
        [[focal_px, 0.0, centre_px[0]], [0.0, focal_px, centre_px[1]], [0.0, 0.0, 1.0]]
    )
    sides = np.linalg.norm(np.linalg.solve(camera, image_from_unit)[:, :2], axis=0)
    return float(sides[0] / sides[1])
