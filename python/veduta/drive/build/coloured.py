"""The colours of scan points, from the images."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from veduta.drive.build.pictures_of import Seen

_HIDDEN_M = 1.0
"""A point so far behind what hides it is not seen."""


def coloured(
    points: NDArray[np.float64], seen: Sequence[Seen], unseen: tuple[int, int, int]
) -> NDArray[np.uint8]:
    """(n, 3) the colours of points in the image that shows each from nearest; else `unseen`."""
    colours = np.tile(np.array(unseen, dtype=np.uint8), (len(points), 1))
    nearest = np.full(len(points), np.inf)
    for one in seen:
        pixels, depth = one.shot.project(points)
        height, width = one.hidden_m.shape
        at = np.floor(np.clip(pixels, -1, 1e6)).astype(np.int64)
        inside = (depth > 1.0) & (at >= 0).all(axis=1) & (at[:, 0] < width) & (at[:, 1] < height)
        at = np.where(inside[:, None], at, 0)
        inside &= (depth < one.hidden_m[at[:, 1], at[:, 0]] + _HIDDEN_M) & (depth < nearest)
        colours[inside] = one.pixels[at[inside, 1], at[inside, 0]]
        nearest[inside] = depth[inside]
    return colours
