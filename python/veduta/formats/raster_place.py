"""A GeoTIFF as a place: heights as a surface, an orthophoto as a picture on level ground.

Larger rasters are read with larger cells: heights as the mean, pictures as the mean colour.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import rasterio
from numpy.typing import NDArray
from rasterio import DatasetReader
from rasterio.enums import Resampling
from rasterio.errors import RasterioError

from veduta.formats.geotiff_grid import require_grid
from veduta.place.place import Place, Standing
from veduta.place.raster import Raster
from veduta.run.errors import InputError
from veduta.run.inputs import require_file
from veduta.run.limits import limited

_MOST_BYTES = 4 << 30
_MOST_HEIGHTS, _MOST_PIXELS = 512, 4096
"""Along the longer side: half a million triangles, and a texture that graphics cards take."""
_HEIGHTS_M = (-12_000.0, 100_000.0)
"""What lies outside is a sign for nothing known that the file does not call so."""
_REMEDY = "Save it anew (gdal_translate)."


@dataclass(frozen=True, eq=False)
class _Read:
    """A raster about its lower left corner, which lies at west_m, south_m and base_m."""

    raster: Raster
    west_m: float
    south_m: float
    base_m: float
    epsg: int | None


def read_raster_place(path: Path) -> Place:
    """The raster as a part that one walks on; InputError where it is none that can be used."""
    read = limited(_read, path, path, _REMEDY)
    try:
        mesh = read.raster.mesh()
    except ValueError as error:
        raise InputError(path, "has no heights that lie beside each other", _REMEDY) from error
    place = Place(title=path.stem, crs=None if read.epsg is None else f"EPSG:{read.epsg}")
    place.origin_m = (read.west_m, read.south_m, read.base_m)
    place.add(mesh, Standing(name=path.stem, ground=True))
    return place


def _read(path: Path) -> _Read:
    require_file(path, _MOST_BYTES)
    try:
        with rasterio.open(path) as file:
            place, crs = file.transform, file.crs
            require_grid(path, place, crs)
            size_m = (file.width * place.a, file.height * place.a)
            if file.dtypes[0] == "uint8":
                raster, base_m = Raster(path.stem, size_m, picture=_picture(file)), 0.0
            else:
                heights = _heights(file)
                known = heights[np.isfinite(heights)]
                base_m = math.floor(float(known.min())) if len(known) else 0.0
                raster = Raster(path.stem, size_m, heights - np.float32(base_m))
            epsg = crs.to_epsg() if crs else None
    except (RasterioError, ValueError) as error:
        raise InputError(path, "is no GeoTIFF that can be read", _REMEDY) from error
    return _Read(raster, place.c, place.f - size_m[1], base_m, epsg)


def _heights(file: DatasetReader) -> NDArray[np.float32]:
    """(h, w) of the first band, NaN where nothing is known."""
    shape = _shape(file, _MOST_HEIGHTS)
    found = file.read(1, out_shape=shape, masked=True, resampling=Resampling.average)
    heights = np.ma.filled(found.astype(np.float32), np.nan)
    low, high = _HEIGHTS_M
    heights[~((heights > low) & (heights < high))] = np.nan
    return np.asarray(heights, dtype=np.float32)


def _picture(file: DatasetReader) -> NDArray[np.uint8]:
    """(h, w, 3) of the first three bands, or of the first one where there are fewer."""
    bands = [1, 2, 3] if file.count >= 3 else [1, 1, 1]
    shape = (3, *_shape(file, _MOST_PIXELS))
    found = file.read(bands, out_shape=shape, resampling=Resampling.average)
    return np.ascontiguousarray(found.transpose(1, 2, 0), dtype=np.uint8)


def _shape(file: DatasetReader, most: int) -> tuple[int, int]:
    """Rows and columns to read, so that the longer side has no more."""
    times = max(1.0, max(file.height, file.width) / most)
    return max(1, round(file.height / times)), max(1, round(file.width / times))
