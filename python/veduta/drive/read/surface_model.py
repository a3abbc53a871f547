"""An aerial surface model (GeoTIFF): its edges, its ground, and what a horizontal scan meets of it.

Frueh and Zakhor 2001 find edges in an aerial photo or a digital surface model and match horizontal
scans with them. Of a surface model those edges count that a scan in its height can meet: below the
scanner on one side, above it on the other.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import rasterio
from numpy.typing import NDArray
from rasterio.errors import RasterioError, RasterioIOError
from scipy import ndimage

from veduta.drive.record import HeightGrid
from veduta.formats.geotiff_grid import require_grid
from veduta.run.errors import InputError
from veduta.run.inputs import require_file
from veduta.run.limits import Limits, limited

Floats = NDArray[np.float64]
_MOST_BYTES, _MOST_CELLS = 4 << 30, 100_000_000


@dataclass(frozen=True)
class SurfaceParameters:
    """Thresholds of edges.

    step_m: heights that differ by more across a border of two cells are an edge: a storey less the
    error of airborne scans. widest_m: nothing that stands on the ground is wider on its narrower
    side; it is taken off to find the ground. low_m: so much over the ground the foot of an edge may
    lie below the scan's plane. canny: thresholds of edges of a photo. farthest_m: distances to
    edges are not told beyond. finest_m: cells are cut no smaller to lay edges on their borders.
    eaves_m: roofs stand out over walls by about so much. inside: cells, by which walls are behind
    the borders of cells that have the height of the highest thing in them.
    rough_m: heights that differ by more from the median around them, on average over
    `rough_over_m`, are of a tree: it has no edges. leaf_m, leaf_over_m: the same with less doubt
    where it is asked whether a beam may go through; a wall that is missed there does no harm.
    """

    step_m: float = 2.0
    widest_m: float = 60.0
    low_m: float = 2.5
    canny: tuple[int, int] = (60, 150)
    farthest_m: float = 25.0
    finest_m: float = 0.25
    eaves_m: float = 0.1
    inside: float = 0.4
    rough_m: float = 0.8
    rough_over_m: float = 3.5
    leaf_m: float = 0.3
    leaf_over_m: float = 2.5


@dataclass(frozen=True, eq=False)
class SurfaceModel:
    """A map. distance_m: (rows from the south, columns) float32 m to the nearest edge, negative
    where something stands that is higher than the scanner, NaN where nothing is known; cells of
    cell_m, the outer corner of the first at low (m, in the CRS).

    ground_m: (rows, columns) height of the ground, coarser by `coarser`; None of a photo.
    edges: share of cells within a metre of an edge.
    """

    distance_m: NDArray[np.float32]
    low: tuple[float, float]
    cell_m: float
    ground_m: NDArray[np.float32] | None
    coarser: int
    crs: str | None
    edges: float

    def ground_under(self, places: Floats) -> Floats:
        """(n,) heights of the ground at (n, 2) places in the CRS; NaN outside."""
        if self.ground_m is None:
            return np.full(len(places), np.nan)
        at = (places - np.array(self.low)) / (self.cell_m * self.coarser) - 0.5
        found = ndimage.map_coordinates(
            self.ground_m.astype(np.float64), [at[:, 1], at[:, 0]], order=1,
            mode="constant", cval=np.nan,
        )  # fmt: skip
        return np.asarray(found, dtype=np.float64)


LIMITS = Limits(memory_mb=4000, seconds=120)
"""The largest one that is read takes a third of this."""
_CUT = "Cut it to where the drive went."


def read_surface_model(
    path: Path, scanner_m: float, parameters: SurfaceParameters | None = None
) -> SurfaceModel:
    """scanner_m: height of the horizontal scanner over the road. InputError says what is wrong.

    One band of floats or 16-bit numbers is heights; three or four bands of bytes are a photo.
    """
    chosen = parameters or SurfaceParameters()
    bands, low, cell_m, crs = read_bands(path)
    if len(bands) == 1:
        return _of_heights(path, bands[0], low, cell_m, crs, scanner_m, chosen)
    edge = cv2.Canny(
        cv2.cvtColor(np.moveaxis(bands[:3], 0, 2).astype(np.uint8), cv2.COLOR_RGB2GRAY),
        *chosen.canny,
    )
    distance = _to_edges(edge > 0, cell_m, chosen)
    near = float((distance < 1.0).mean())
    return SurfaceModel(distance, low, cell_m, None, 1, crs, near)


def read_heights(path: Path, origin_m: tuple[float, float, float]) -> HeightGrid | None:
    """The surface itself in a frame about an origin; None of a photo. InputError as above."""
    bands, low, cell_m, _ = read_bands(path)
    if len(bands) != 1:
        return None
    heights = (bands[0] - origin_m[2]).astype(np.float32)
    return HeightGrid(heights, (low[0] - origin_m[0], low[1] - origin_m[1]), cell_m)


def read_bands(
    path: Path,
) -> tuple[NDArray[np.float32], tuple[float, float], float, str | None]:
    """(b, rows from the south, columns) of the file, as heights or colours, with NaN for no data;
    its lower corner, the side of a cell (m), its CRS. InputError as above.
    """
    return limited(_read, path, path, _CUT, LIMITS)


def _read(path: Path) -> tuple[NDArray[np.float32], tuple[float, float], float, str | None]:
    """(b, rows from the south, columns) with NaN for no data; corner, side of a cell, CRS."""
    if not path.is_file():
        raise InputError(path, "there is no such file", "Name the surface model (GeoTIFF).")
    require_file(path, _MOST_BYTES)
    try:
        with rasterio.open(path, driver="GTiff") as file:
            if file.width * file.height > _MOST_CELLS:
                fault = f"has {file.width} x {file.height} cells, more than {_MOST_CELLS:,}"
                raise InputError(path, fault, _CUT)
            if file.count not in (1, 3, 4):
                fault = f"has {file.count} bands"
                raise InputError(path, fault, "Give one band of heights, or a photo of three.")
            place = file.transform
            system = file.crs
            data = file.read(masked=True)
    except (RasterioError, RasterioIOError) as error:
        raise InputError(path, "is no GeoTIFF that can be read", "Copy it again.") from error
    require_grid(path, place, system)
    values = np.ma.filled(data.astype(np.float32), np.nan)[:, ::-1]
    low = (float(place.c), float(place.f + place.e * values.shape[1]))
    return values, low, float(place.a), None if system is None else system.to_string()


def _of_heights(
    path: Path,
    heights: NDArray[np.float32],
    low: tuple[float, float],
    cell_m: float,
    crs: str | None,
    scanner_m: float,
    chosen: SurfaceParameters,
) -> SurfaceModel:
    known = np.isfinite(heights)
    if not known.any():
        raise InputError(path, "has no heights", "Give a surface model of the place.")
    nearest = ndimage.distance_transform_edt(~known, return_distances=False, return_indices=True)
    filled = np.ascontiguousarray(heights[tuple(nearest)])
    ground = _ground(filled, cell_m, chosen)
    edge, times = _edges(filled, ground, cell_m, scanner_m, chosen)
    leaves = _trees(filled, cell_m, chosen.leaf_m, chosen.leaf_over_m, chosen.step_m)
    trees = _trees(filled, cell_m, chosen.rough_m, chosen.rough_over_m, chosen.step_m)
    edge &= ~_finer(trees, times)
    distance = _to_edges(edge, cell_m / times, chosen)
    near = float((distance < 1.0).mean())
    distance += cell_m / times / 2.0  # cells are told from their middles, edges lie between them
    high = filled - ground > scanner_m
    distance[_finer(high, times)] *= -1.0
    distance += chosen.eaves_m + chosen.inside * cell_m
    # Beams may go through leaves; a wall below rough eaves is as far behind them as any other.
    leafy = _finer(high & leaves, times)
    distance[leafy] = np.abs(distance[leafy])
    return SurfaceModel(distance, low, cell_m / times, ground, times, crs, near)


def _ground(
    heights: NDArray[np.float32], cell_m: float, chosen: SurfaceParameters
) -> NDArray[np.float32]:
    """What is left of the surface where everything narrower than `widest_m` is taken off."""
    side = max(round(chosen.widest_m / cell_m) | 1, 3)
    block = np.ones((side, side), dtype=np.uint8)
    low = cv2.morphologyEx(
        cv2.medianBlur(heights, 3), cv2.MORPH_OPEN, block, borderType=cv2.BORDER_REPLICATE
    )
    # Between buildings the surface itself is the ground.
    bare = np.minimum(heights, low + chosen.step_m)
    smooth = cv2.morphologyEx(
        bare, cv2.MORPH_OPEN, np.ones((3, 3), np.uint8), borderType=cv2.BORDER_REPLICATE
    )
    return np.asarray(smooth, dtype=np.float32)


def _edges(
    heights: NDArray[np.float32],
    ground: NDArray[np.float32],
    cell_m: float,
    scanner_m: float,
    chosen: SurfaceParameters,
) -> tuple[NDArray[np.bool_], int]:
    """Cells on both sides of the borders of cells that a scan meets, and how much finer they
    are.
    """
    times = 2 if cell_m >= 2 * chosen.finest_m else 1
    fine, base = _finer(heights, times), _finer(ground, times)
    edge = np.zeros(fine.shape, dtype=bool)
    for axis in (0, 1):
        one, other = _pair(fine, axis)
        floor, beside = _pair(base, axis)
        foot = np.minimum(floor, beside)
        step = np.abs(one - other) > chosen.step_m
        met = (np.minimum(one, other) - foot < min(chosen.low_m, scanner_m)) & (
            np.maximum(one, other) - foot > scanner_m
        )
        here, there = _pair(edge, axis)
        here |= step & met
        there |= step & met
    return edge, times


def _trees(
    heights: NDArray[np.float32], cell_m: float, rough_m: float, over_m: float, most_m: float
) -> NDArray[np.bool_]:
    """Cells where the surface is rough; a median keeps the steps of walls that run along cells. Of
    others each corner is off by the wall's height: no cell counts more than `most_m`.
    """
    off = np.minimum(np.abs(heights - cv2.medianBlur(heights, 3)), np.float32(most_m))
    side = max(round(over_m / cell_m) | 1, 3)
    return np.asarray(cv2.blur(off, (side, side)) > rough_m, dtype=bool)


def _finer(cells: NDArray[Any], times: int) -> NDArray[Any]:
    """Each cell as a square of so many."""
    return np.repeat(np.repeat(cells, times, axis=0), times, axis=1)


def _pair(cells: NDArray[Any], axis: int) -> tuple[NDArray[Any], NDArray[Any]]:
    """All cells but the last, and those after them along an axis (views)."""
    if axis == 0:
        return cells[:-1], cells[1:]
    return cells[:, :-1], cells[:, 1:]


def _to_edges(
    edge: NDArray[np.bool_], cell_m: float, chosen: SurfaceParameters
) -> NDArray[np.float32]:
    if not edge.any():
        return np.full(edge.shape, chosen.farthest_m, dtype=np.float32)
    distance = cv2.distanceTransform((~edge).astype(np.uint8), cv2.DIST_L2, 5) * cell_m
    return np.asarray(np.minimum(distance, chosen.farthest_m), dtype=np.float32)
