"""Positions that GPS gave, in metres of a projected CRS."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.geometry.utm import epsg_of, zone_of
from veduta.photos.city.crs import between
from veduta.photos.intake.read import PhotoRecord
from veduta.photos.structure import Structure

_WORLD = "EPSG:4326"


@dataclass(frozen=True)
class GpsPositions:
    """Where k photos were taken, about `origin_m` in `crs`.

    rows: (k,) of the structure's photos. east_north: (k, 2). height: (k,) NaN where not told.
    """

    crs: str
    origin_m: tuple[float, float, float]
    rows: NDArray[np.int64]
    east_north: NDArray[np.float64]
    height: NDArray[np.float64]


def gps_positions(
    structure: Structure,
    photos: Sequence[PhotoRecord],
    crs: str | None,
    origin_m: tuple[float, float, float] | None,
) -> GpsPositions | None:
    """None where no placed photo has any. crs and origin_m: those of a model, else UTM."""
    known = {photo.name: photo.position for photo in photos if photo.position is not None}
    rows = [row for row, name in enumerate(structure.names) if name in known]
    if not rows:
        return None
    told = [known[structure.names[row]] for row in rows]
    longitude = np.array([position.longitude_deg for position in told])
    latitude = np.array([position.latitude_deg for position in told])
    height = np.array(
        [np.nan if one.altitude_m is None else one.altitude_m for one in told], dtype=np.float64
    )
    if crs is None:
        zone = zone_of(float(np.median(longitude)))
        crs = f"EPSG:{epsg_of(zone, south=bool(np.median(latitude) < 0))}"
    flat = np.column_stack(between(_WORLD, crs).transform(longitude, latitude))
    # EXIF may name the other side of the Earth, where a projection ends.
    known_there = np.isfinite(flat).all(axis=1)
    if not known_there.any():
        return None
    flat, height = flat[known_there], height[known_there]
    rows = np.array(rows)[known_there].tolist()
    if origin_m is None:
        low = np.floor(np.median(flat, axis=0))
        level = float(np.floor(np.nanmedian(height))) if np.isfinite(height).any() else 0.0
        origin_m = (float(low[0]), float(low[1]), level)
    return GpsPositions(
        crs,
        origin_m,
        np.array(rows, dtype=np.int64),
        flat - np.array(origin_m[:2]),
        height - origin_m[2],
    )
