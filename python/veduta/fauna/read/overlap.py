"""How well the described animal, posed as in a frame, covers the silhouette that was seen there."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.fauna.motion.angles import Floats

_SHIFT = 4
"""OpenCV draws with so many bits of a pixel."""


def drawn_body(points: Floats, half_width: Floats, shape: tuple[int, int]) -> NDArray[np.bool_]:
    """(h, w) the silhouette of a body seen from above. points: (n, 2) px, y down; widths: (n,)."""
    ahead = np.gradient(points, axis=0)
    ahead /= np.maximum(np.linalg.norm(ahead, axis=1, keepdims=True), 1e-9)
    normal = np.stack([-ahead[:, 1], ahead[:, 0]], axis=1) * half_width[:, None]
    outline = np.concatenate([points + normal, (points - normal)[::-1]]) - 0.5
    canvas = np.zeros(shape, dtype=np.uint8)
    # Where it bends sharply an outline crosses itself: its pieces are filled one by one.
    left, right = outline[: len(points)], outline[len(points) :][::-1]
    for place in range(len(points) - 1):
        corners = np.stack([left[place], left[place + 1], right[place + 1], right[place]])
        hull = cv2.convexHull(np.round(corners * 2**_SHIFT).astype(np.int32))
        cv2.fillConvexPoly(canvas, hull, 1, shift=_SHIFT)
    return canvas.astype(np.bool_)


def overlap(first: NDArray[np.bool_], second: NDArray[np.bool_]) -> float:
    """Intersection over union of two silhouettes."""
    either = int((first | second).sum())
    return float((first & second).sum()) / either if either else 0.0
