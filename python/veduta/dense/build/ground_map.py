"""What lies under the sky: a surface model and a true orthophoto of a georeferenced cloud."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from veduta.dense.build.cloud import DenseCloud

MOST_CELLS = 64_000_000
SAMPLE = 5_000


@dataclass(frozen=True, eq=False)
class GroundMap:
    """heights_m: (h, w) float32 of the highest point in each cell, NaN without one; row 0 is the
    north. colours: (h, w, 3) uint8 of those points. west_m, north_m: the borders, in the cameras'
    frame. cell_m: side of a cell.
    """

    heights_m: NDArray[np.float32]
    colours: NDArray[np.uint8]
    west_m: float
    north_m: float
    cell_m: float


def ground_map(cloud: DenseCloud, seed: int) -> GroundMap:
    """The map of a cloud whose z is up, in cells twice as wide as its points lie apart."""
    points = cloud.points_m
    draw = np.random.default_rng(seed)
    some = draw.choice(len(points), min(len(points), SAMPLE), replace=False)
    beside = np.asarray(cKDTree(points[:, :2]).query(points[some, :2], k=2)[0])[:, -1]
    low, high = points[:, :2].min(axis=0), points[:, :2].max(axis=0)
    span = np.maximum(high - low, 1e-6)
    apart = float(np.median(beside[np.isfinite(beside)])) if len(points) > 1 else float(span.max())
    cell = max(2.0 * apart, float(np.sqrt(span.prod() / MOST_CELLS)), 1e-6 * float(span.max()))
    columns, rows = (int(one) + 1 for one in span / cell)
    column = ((points[:, 0] - low[0]) / cell).astype(np.intp)
    row = ((high[1] - points[:, 1]) / cell).astype(np.intp)
    # The highest point of each cell comes last, and stays.
    order = np.argsort(points[:, 2], kind="stable")
    at = (row * columns + column)[order]
    heights = np.full(rows * columns, np.nan, dtype=np.float32)
    colours = np.zeros((rows * columns, 3), dtype=np.uint8)
    heights[at] = points[order, 2]
    colours[at] = cloud.colours[order]
    return GroundMap(
        heights.reshape(rows, columns),
        colours.reshape(rows, columns, 3),
        float(low[0]),
        float(high[1]),
        cell,
    )


def write_maps(
    found: GroundMap, crs: str, origin_m: tuple[float, float, float], dsm: Path, ortho: Path
) -> None:
    """As cloud-optimised GeoTIFF in the CRS: heights with NaN, colours with a mask of alpha."""
    import rasterio
    from rasterio.transform import from_origin

    rows, columns = found.heights_m.shape
    west, north = origin_m[0] + found.west_m, origin_m[1] + found.north_m
    shared = {
        "driver": "COG",
        "height": rows,
        "width": columns,
        "crs": rasterio.crs.CRS.from_user_input(crs),
        "transform": from_origin(west, north, found.cell_m, found.cell_m),
        "compress": "DEFLATE",
    }
    heights = found.heights_m + np.float32(origin_m[2])
    with rasterio.open(dsm, "w", count=1, dtype="float32", nodata=np.nan, **shared) as file:
        file.write(heights, 1)
    alpha = np.where(np.isfinite(found.heights_m), 255, 0).astype(np.uint8)
    with rasterio.open(ortho, "w", count=4, dtype="uint8", **shared) as file:
        file.write(np.concatenate([found.colours.transpose(2, 0, 1), alpha[None]]))
