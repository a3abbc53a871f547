"""The nearest of marked places."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray


def nearest_marked(
    marked: NDArray[np.bool_],
) -> tuple[NDArray[np.int64], NDArray[np.float32]]:
    """(h, w) the number (in reading order) of the nearest marked place, and how far it is."""
    distance, label = cv2.distanceTransformWithLabels(
        (~marked).astype(np.uint8), cv2.DIST_L2, 5, labelType=cv2.DIST_LABEL_PIXEL
    )
    number = np.zeros(int(label.max()) + 1, dtype=np.int64)
    number[label[marked]] = np.arange(int(marked.sum()))
    return number[label], np.asarray(distance, dtype=np.float32)
