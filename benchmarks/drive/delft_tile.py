"""The Delft tile as a surface model, and as walls that a simulated scanner sees.

The surface model comes from all of the airborne points (trees and cars as well). The walls come
from the building outlines, and, where a building has none, from the shape of its points: no code
is shared.
"""

from __future__ import annotations

import sqlite3
from pathlib import Path

import laspy
import numpy as np
import rasterio
import shapely
from numpy.typing import NDArray
from rasterio.transform import from_origin

LOW, HIGH = (85000.0, 447412.5), (85072.5, 447641.5)
SCANNER_M = 3.6
Floats = NDArray[np.float64]

ROUTES = {
    "quay": [(3.0, 156.0), (20.0, 137.0), (36.0, 118.5), (50.0, 101.0), (60.0, 86.0), (64.5, 68.0),
             (62.0, 52.0)],
    "square": [(3.0, 208.0), (14.0, 199.0), (24.0, 191.5), (34.0, 193.5), (44.0, 199.0),
               (50.5, 208.0), (50.5, 224.0)],
    "south": [(64.0, 78.0), (63.0, 62.0), (62.0, 52.0), (55.0, 44.0), (42.0, 41.0), (26.0, 42.5),
              (10.0, 45.0)],
}  # fmt: skip
"""Where one can drive, in metres from the tile's corner: streets and quays of the tile."""


def read_points(folder: Path) -> tuple[Floats, NDArray[np.uint8]]:
    """(n, 3) points in metres from the tile's corner, and their classes."""
    cloud = laspy.read(folder / "ahn3_cropped_2.laz")
    points = np.stack([cloud.x - LOW[0], cloud.y - LOW[1], np.asarray(cloud.z)], axis=1)
    return points.astype(np.float64), np.asarray(cloud.classification, dtype=np.uint8)


def write_surface(points: Floats, path: Path, cell_m: float, mirrored: bool = False) -> None:
    """The highest point of each cell, as GeoTIFF in RD; mirrored: another place of its kind."""
    shape = tuple(int(np.ceil((HIGH[k] - LOW[k]) / cell_m)) for k in (1, 0))
    cells = np.full(shape, -np.inf, dtype=np.float32)
    at = (points[:, :2] / cell_m).astype(int)
    inside = (at >= 0).all(axis=1) & (at[:, 1] < shape[0]) & (at[:, 0] < shape[1])
    np.maximum.at(cells, (at[inside, 1], at[inside, 0]), points[inside, 2].astype(np.float32))
    cells[~np.isfinite(cells)] = -9999.0
    if mirrored:
        cells = cells[:, ::-1]
    place = from_origin(LOW[0], LOW[1] + shape[0] * cell_m, cell_m, cell_m)
    with rasterio.open(
        path, "w", driver="GTiff", width=shape[1], height=shape[0], count=1, dtype="float32",
        crs="EPSG:28992", transform=place, nodata=-9999.0,
    ) as file:  # fmt: skip
        file.write(cells[::-1], 1)


def walls_and_trunks(
    folder: Path, points: Floats, classes: NDArray[np.uint8], scratch: Path
) -> tuple[Floats, Floats]:
    """(w, 2, 2) ends of walls that reach above the scanner, and (t, 3) trunks, by the tile's
    corner.
    """
    ground_m = float(np.median(points[classes == 2, 2]))
    tall = (classes == 6) & (points[:, 2] > ground_m + SCANNER_M)
    copy = scratch / "outlines.sqlite"
    copy.write_bytes((folder / "bgt_pand.sqlite").read_bytes())
    with sqlite3.connect(copy) as base:
        shapes = [
            shapely.from_wkb(row[0]) for row in base.execute("SELECT GEOMETRY FROM buildingpart")
        ]
    shapes = [shapely.transform(shapely.force_2d(shape), lambda xy: xy - LOW) for shape in shapes]
    of_tall = np.asarray(shapely.points(points[tall, :2]))
    tree = shapely.STRtree(of_tall)
    kept = [shape for shape in shapes if len(tree.query(shape, "contains")) > 3 * shape.area]
    outlined = shapely.union_all(kept)
    rest = of_tall[~shapely.contains(outlined.buffer(1.0), of_tall)]
    other = shapely.union_all(rest.tolist()).buffer(0.6).buffer(-0.5).simplify(0.2)
    other = shapely.multipolygons([one for one in shapely.get_parts(other) if one.area > 20.0])
    solid = shapely.union(outlined, other)
    rings = shapely.get_rings(shapely.get_parts(solid))
    ends = [
        np.stack([xy[:-1], xy[1:]], axis=1)
        for ring in rings
        if len(xy := shapely.get_coordinates(ring))
    ]
    leaves = points[(classes == 1) & (points[:, 2] > ground_m + 4.0), :2]
    random = np.random.default_rng(5)
    middles = leaves[random.choice(len(leaves), 25, replace=False)]
    trunks = np.column_stack([middles, random.uniform(0.1, 0.3, len(middles))])
    return np.concatenate(ends), trunks


def driven(name: str, backwards: bool, spacing_m: float) -> Floats:
    """(s, 3) poses along a route, smooth, in metres from the tile's corner."""
    corners = np.array(ROUTES[name][::-1] if backwards else ROUTES[name])
    for _ in range(3):  # Chaikin's corners: a car does not turn on the spot
        cut = np.stack(
            [0.75 * corners[:-1] + 0.25 * corners[1:], 0.25 * corners[:-1] + 0.75 * corners[1:]],
            axis=1,
        )
        corners = np.concatenate([corners[:1], cut.reshape(-1, 2), corners[-1:]])
    station = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(corners, axis=0), axis=1))])
    at = np.arange(0.0, station[-1], spacing_m)
    line = np.stack([np.interp(at, station, corners[:, k]) for k in (0, 1)], axis=1)
    step = np.gradient(line, axis=0)
    return np.column_stack([line, np.unwrap(np.arctan2(step[:, 1], step[:, 0]))])
