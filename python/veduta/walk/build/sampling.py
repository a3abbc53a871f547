"""Values of a map between its pixels, whose centres are at (0.5, 0.5)."""

from __future__ import annotations

from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray


def sampled(
    values: NDArray[Any], pixels: NDArray[np.floating], *, nearest: bool = False
) -> NDArray[np.float32]:
    """(h, w) or (h, w, c) float32 at (h, w, 2) pixels: linear in between, or those of the nearest.

    Beyond the border is what is on it.
    """
    x, y = (np.ascontiguousarray(pixels[..., axis] - 0.5, dtype=np.float32) for axis in (0, 1))
    how = cv2.INTER_NEAREST if nearest else cv2.INTER_LINEAR
    given = values.astype(np.uint8) if values.dtype == np.bool_ else values
    seen = cv2.remap(given, x, y, how, borderMode=cv2.BORDER_REPLICATE)
    return np.asarray(seen, dtype=np.float32)
