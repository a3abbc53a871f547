"""The colours of a mesh's vertices, from the photos that see them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta import _core
from veduta.dense.document import DepthMap, Views, camera_row

UNSEEN = 128


@dataclass(frozen=True, eq=False)
class VertexColours:
    """colours: (v, 3) uint8 sRGB, grey where no photo sees a vertex. views: (v,) how many do."""

    colours: NDArray[np.uint8]
    views: NDArray[np.int32]


def colour_vertices(
    points: NDArray[np.float64],
    normals: NDArray[np.float32],
    views: Views,
    depth_map: Callable[[int], DepthMap],
    order: list[int],
    within_m: float,
) -> VertexColours:
    """Means over the photos; within_m: how far a depth may lie from a vertex that it shows."""
    sums = np.zeros((len(points), 5), dtype=np.float32)
    for view in order:
        sums = _core.add_point_colours(
            points,
            normals,
            depth_map(view).depths_m,
            camera_row(views.cameras[view]),
            views.pixels(view).reshape(-1, 3),
            within_m,
            sums,
        )
    seen = sums[:, 3] > 0.0
    colours = np.full((len(points), 3), UNSEEN, dtype=np.uint8)
    colours[seen] = np.clip(np.round(sums[seen, :3] / sums[seen, 3:4]), 0, 255).astype(np.uint8)
    return VertexColours(colours, sums[:, 4].astype(np.int32))
