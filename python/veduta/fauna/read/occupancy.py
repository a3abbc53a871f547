"""How well a figure covers silhouettes, and how that changes when its joints move."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta._core import capsules_cover
from veduta.fauna.motion.figure import Figure, Floats

Singles = NDArray[np.float32]


@dataclass(frozen=True, eq=False)
class Cover:
    """loss: (t,) squared difference for the silhouette's area. by_joint: (t, j, 2) and by_deep:
    (t, j) its gradients.
    """

    loss: Floats
    by_joint: Floats
    by_deep: Floats


def cover(
    figure: Figure, joints: Floats, deep: Floats, pixels: Singles, shares: Singles,
    weights: Singles, soft: float,
) -> Cover:  # fmt: skip
    """Soft occupancy of tapered capsules against silhouettes.

    joints: (t, j, 2). deep: (j,) half of the thickness. pixels: (p, 2) the places that are looked
    at, shares: (t, p) how much of each the silhouette has, weights: (p,) how much it counts, soft:
    how wide an edge is; all in one unit. Capsules are joined as what is in none: 1 - prod(1 - o),
    so every one of them feels every pixel that is near to it.
    """
    loss, by_joint, by_deep = capsules_cover(
        figure.start, figure.end, joints.astype(np.float32), deep.astype(np.float32), pixels,
        shares, weights, soft,
    )  # fmt: skip
    return Cover(loss, by_joint, by_deep)
