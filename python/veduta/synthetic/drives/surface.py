"""The street from above: a surface model with cells of a metre and the errors of one."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import rasterio
from numpy.typing import NDArray
from rasterio.transform import from_origin

from veduta.synthetic.drives.made_street import MadeStreet
from veduta.synthetic.drives.street import Street

HOUSE_M = 10.0
"""Depth of houses behind their fronts."""
_MARGIN_M = 30.0
_ASIDE_M, _ABOVE_M, _BEAMS = 35.0, 80.0, 4


def surface_of(
    street: Street | MadeStreet, cell_m: float = 1.0, seed: int = 1
) -> tuple[NDArray[np.float32], tuple[float, float]]:
    """(rows from the south, columns) heights, NaN where nothing came back, and the lower corner.

    Crowns and cars are in it, heights err by 0.1 m, cells lie where they lie, a fiftieth is empty.
    """
    if isinstance(street, MadeStreet):
        return _seen_from_above(street, cell_m, np.random.default_rng(seed))
    random = np.random.default_rng(seed)
    low = (-40.0 + random.uniform(0, cell_m), -_MARGIN_M + random.uniform(0, cell_m))
    rows = int((street.length_m + 2 * _MARGIN_M) / cell_m)
    columns = int(70.0 / cell_m)
    heights = np.zeros((rows, columns))

    def raise_to(x0: float, x1: float, y0: float, y1: float, top: float) -> None:
        first = [max(int((v - o) / cell_m), 0) for v, o in ((x0, low[0]), (y0, low[1]))]
        last = [max(int((v - o) / cell_m) + 1, 0) for v, o in ((x1, low[0]), (y1, low[1]))]
        part = heights[first[1] : last[1], first[0] : last[0]]
        np.maximum(part, top, out=part)

    for (x0, y0, z0), (x1, y1, z1) in street.walls.tolist():
        if z0 == 0.0:
            raise_to(x1 - HOUSE_M, x1, y0, y1, z1)
        else:
            raise_to(x0, x1, y0, y1, z1)
    for (x0, y0, _), (x1, y1, z1) in street.objects.tolist():
        raise_to(x0, x1, y0, y1, z1)
    for x, y, z, radius in street.balls.tolist():
        raise_to(x - radius, x + radius, y - radius, y + radius, z + 0.5 * radius)
    return _with_errors(heights, random), low


def _seen_from_above(
    street: MadeStreet, cell_m: float, random: np.random.Generator
) -> tuple[NDArray[np.float32], tuple[float, float]]:
    """The highest of what some beams from above meet in each cell."""
    along = np.arange(-_MARGIN_M, street.length_m + _MARGIN_M, 1.0)
    places, _ = street.way.at(along)
    low = places.min(axis=0) - _ASIDE_M + random.uniform(0, cell_m, 2)
    columns, rows = np.ceil((places.max(axis=0) + _ASIDE_M - low) / cell_m).astype(int).tolist()
    heights = np.full((rows, columns), -np.inf)
    y, x = np.indices((rows, columns), dtype=np.float64)
    down = np.broadcast_to([0.0, 0.0, -1.0], (rows * columns, 3))
    open_ = np.ones(rows * columns, dtype=bool)
    for _ in range(_BEAMS):
        at = [low[0] + cell_m * (x + random.uniform(size=x.shape)),
              low[1] + cell_m * (y + random.uniform(size=y.shape)),
              np.full_like(x, _ABOVE_M)]  # fmt: skip
        away, _ = street.meet(np.stack(at, axis=2).reshape(-1, 3), down, open_)
        top = np.where(np.isfinite(away), _ABOVE_M - away, 0.0).reshape(rows, columns)
        heights = np.maximum(heights, top)
    return _with_errors(heights, random), (float(low[0]), float(low[1]))


def _with_errors(heights: NDArray[np.float64], random: np.random.Generator) -> NDArray[np.float32]:
    noisy = heights + random.normal(0.0, 0.1, heights.shape)
    noisy[random.uniform(size=heights.shape) < 0.02] = np.nan
    return noisy.astype(np.float32)


def write_surface(
    heights: NDArray[np.float32],
    low: tuple[float, float],
    path: Path,
    cell_m: float = 1.0,
    crs: str | None = "EPSG:25832",
) -> None:
    """As GeoTIFF."""
    top = low[1] + cell_m * len(heights)
    with rasterio.open(
        path, "w", driver="GTiff", width=heights.shape[1], height=len(heights), count=1,
        dtype="float32", crs=crs, nodata=float("nan"),
        transform=from_origin(low[0], top, cell_m, cell_m),
    ) as file:  # fmt: skip
        file.write(heights[::-1], 1)
