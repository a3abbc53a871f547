"""Regions of a sheet as upright lines of text."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.plan.text.engine import LINE_PX


def in_colour(pixels: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """(h, w, 3) of a picture that is (h, w) or (h, w, 3)."""
    return np.repeat(pixels[:, :, None], 3, axis=2) if pixels.ndim == 2 else pixels


def strip_of(pixels: NDArray[np.uint8], quad: NDArray[np.float64]) -> NDArray[np.uint8]:
    """The region inside `quad` (4, 2) as an upright line of text, LINE_PX high.

    The first side of `quad` becomes the top. Cubic interpolation: small text is enlarged by it.
    """
    across = float(np.linalg.norm(quad[1] - quad[0]) + np.linalg.norm(quad[2] - quad[3]))
    down = float(np.linalg.norm(quad[3] - quad[0]) + np.linalg.norm(quad[2] - quad[1]))
    width = int(np.clip(round(LINE_PX * across / max(down, 1e-9)), 8, 60 * LINE_PX))
    corners = np.array([(0, 0), (width, 0), (width, LINE_PX), (0, LINE_PX)], dtype=np.float32)
    matrix = cv2.getPerspectiveTransform(quad.astype(np.float32), corners)
    return np.asarray(
        cv2.warpPerspective(
            pixels,
            matrix,
            (width, LINE_PX),
            flags=cv2.INTER_CUBIC,
            borderMode=cv2.BORDER_REPLICATE,
        ),
        dtype=np.uint8,
    )
