"""The silhouette of a posed figure."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.fauna.motion.figure import Figure, Floats

_SHIFT = 4
"""OpenCV draws with so many bits of a pixel."""


def drawn_figure(
    figure: Figure, joints: Floats, deep: Floats, shape: tuple[int, int]
) -> NDArray[np.bool_]:
    """(h, w) what the figure's segments cover. joints: (j, 2) px, y down. deep: (j,) px."""
    canvas = np.zeros(shape, dtype=np.uint8)
    turn = np.linspace(0.0, 2.0 * np.pi, 24, endpoint=False)
    ring = np.stack([np.cos(turn), np.sin(turn)], axis=1)
    for start, end in zip(figure.start, figure.end, strict=True):
        both = np.concatenate([joints[k] + deep[k] * ring for k in (start, end)]) - 0.5
        hull = cv2.convexHull(np.round(both * 2**_SHIFT).astype(np.int32))
        cv2.fillConvexPoly(canvas, hull, 1, shift=_SHIFT)
    return canvas.astype(np.bool_)
