"""Colours of what no photo shows: those of what lies around it on the surface."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from veduta.surfaces.texturing.charts import SWATCH_PX

Floats = NDArray[np.float64]
_SMOOTH = 10
_MOST_ROUNDS = 5_000
_GREY = 128.0


def spread_colours(
    triangles: NDArray[np.int64], known: NDArray[np.bool_], colours: Floats, count: int
) -> Floats:
    """(v, 3) a colour for each vertex; known: (v,) those whose colour (v, 3) is given.

    It grows from the known ones ring by ring, each the mean of its neighbours, and is then
    smoothed; a piece of the surface without any known colour has the mean of all.
    """
    edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    edges = np.concatenate([edges, edges[:, ::-1]])
    found = np.where(known[:, None], colours, 0.0)
    has = known.copy()
    wanted = ~known[edges[:, 0]]
    into, source = edges[wanted].T
    for _ in range(_MOST_ROUNDS):
        usable = has[source] & ~has[into]
        if not usable.any():
            break
        mean, counts = _mean(found, into[usable], source[usable], count)
        found = np.where((counts > 0)[:, None], mean, found)
        has |= counts > 0
    found[~has] = colours[known].mean(axis=0) if known.any() else _GREY
    for _ in range(_SMOOTH):
        mean, counts = _mean(found, into, source, count)
        found = np.where((counts > 0)[:, None], mean, found)
    return found


def _mean(
    values: Floats, into: NDArray[np.int64], source: NDArray[np.int64], count: int
) -> tuple[Floats, NDArray[np.int64]]:
    counts = np.bincount(into, minlength=count)
    sums = [np.bincount(into, values[source, axis], minlength=count) for axis in range(3)]
    return np.stack(sums, axis=1) / np.maximum(counts, 1)[:, None], counts


def swatches(colours: Floats) -> Floats:
    """(s, 3, 3, 3) squares of texels for (s, 3, 3) colours of triangles' corners.

    The corners are the middles of the first texel, the last of its row, and the last of its
    column; between these a texture that is filtered linearly has the colours in between.
    """
    steps = np.arange(SWATCH_PX) / (SWATCH_PX - 1)
    first, across, down = (
        colours[:, 0],
        colours[:, 1] - colours[:, 0],
        colours[:, 2] - colours[:, 0],
    )
    along_x = steps[None, None, :, None] * across[:, None, None]
    along_y = steps[None, :, None, None] * down[:, None, None]
    return np.asarray(first[:, None, None] + along_x + along_y)


def swatch_places(corners: NDArray[np.int64]) -> Floats:
    """(s, 3, 2) px in the atlas of the corners of triangles whose squares lie at (s, 2)."""
    last = SWATCH_PX - 0.5
    inner = np.array([[0.5, 0.5], [last, 0.5], [0.5, last]])
    return np.asarray(corners[:, None] + inner)
