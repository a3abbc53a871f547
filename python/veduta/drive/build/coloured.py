"""The colours of scan points, from the images."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.drive.build.pictures_of import Seen


@dataclass(frozen=True)
class ColourParameters:
    """hidden_m: a point so far behind what hides it is not seen. nearest_m: nor is one so near."""

    hidden_m: float = 1.0
    nearest_m: float = 1.0


def coloured(
    points: NDArray[np.float64],
    seen: Sequence[Seen],
    unseen: tuple[int, int, int],
    parameters: ColourParameters | None = None,
) -> NDArray[np.uint8]:
    """(n, 3) the colours of points in the image that shows each from nearest; else `unseen`."""
    chosen = parameters or ColourParameters()
    colours = np.tile(np.array(unseen, dtype=np.uint8), (len(points), 1))
    nearest = np.full(len(points), np.inf)
    for one in seen:
        pixels, depth = one.shot.project(points)
        height, width = one.hidden_m.shape
        at = np.floor(np.clip(pixels, -1, 1e6)).astype(np.int64)
        inside = (depth > chosen.nearest_m) & (at >= 0).all(axis=1)
        inside &= (at[:, 0] < width) & (at[:, 1] < height)
        at = np.where(inside[:, None], at, 0)
        inside &= (depth < one.hidden_m[at[:, 1], at[:, 0]] + chosen.hidden_m) & (depth < nearest)
        colours[inside] = one.pixels[at[inside, 1], at[inside, 0]]
        nearest[inside] = depth[inside]
    return colours
