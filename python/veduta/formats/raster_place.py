"""A GeoTIFF as a place: heights as a surface, an orthophoto as a picture on level ground.

Larger rasters are read with larger cells: heights as the mean, pictures as the mean colour.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np
import rasterio
from numpy.typing import NDArray
from rasterio import DatasetReader
from rasterio.crs import CRS
from rasterio.enums import ColorInterp, Resampling
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
_HEIGHTS_M = (-500.0, 9_000.0)
"""No land lies lower or higher: what does is a sign for nothing known that no header names."""
_REMEDY = "Save it anew (gdal_translate)."


@dataclass(frozen=True, eq=False)
class _Read:
    """A raster about its lower left corner, which lies at west_m, south_m and base_m."""

    raster: Raster
    west_m: float
    south_m: float
    base_m: float
    epsg: int | None
    notes: tuple[str, ...] = ()


def read_raster_place(path: Path) -> Place:
    """The raster as a part that one walks on; InputError where it is none that can be used."""
    read = limited(_read, path, path, _REMEDY)
    try:
        mesh = read.raster.mesh()
    except ValueError as error:
        raise InputError(path, "has no heights that lie beside each other", _REMEDY) from error
    place = Place(title=path.stem, crs=None if read.epsg is None else f"EPSG:{read.epsg}")
    place.origin_m = (read.west_m, read.south_m, read.base_m)
    place.notes += read.notes
    place.add(mesh, Standing(name=path.stem, ground=True))
    return place


def _read(path: Path) -> _Read:
    require_file(path, _MOST_BYTES)
    try:
        with rasterio.open(path) as file:
            place, crs = file.transform, file.crs
            require_grid(path, place, crs)
            _require_metres(path, crs)
            size_m = (file.width * place.a, file.height * place.a)
            if file.dtypes[0] == "uint8":
                raster, base_m = Raster(path.stem, size_m, picture=_picture(file)), 0.0
            elif file.count > 1:
                fault = f"has {file.count} bands of {file.dtypes[0]}: neither heights nor a picture"
                raise InputError(path, fault, "Save it with 8 bits (gdal_translate -ot Byte).")
            else:
                heights = _heights(file)
                known = heights[np.isfinite(heights)]
                base_m = math.floor(float(known.min())) if len(known) else 0.0
                raster = Raster(path.stem, size_m, heights - np.float32(base_m))
            epsg = crs.to_epsg() if crs else None
    except (RasterioError, ValueError) as error:
        raise InputError(path, "is no GeoTIFF that can be read", _REMEDY) from error
    notes = [] if epsg or not crs else ["its coordinate system has no EPSG number: it is left out"]
    return _Read(raster, place.c, place.f - size_m[1], base_m, epsg, tuple(notes))


def _require_metres(path: Path, crs: CRS | None) -> None:
    """InputError where the CRS counts in feet."""
    if crs is not None and crs.is_projected and abs(crs.linear_units_factor[1] - 1.0) > 1e-9:
        fault = f"is not in metres ({crs.linear_units_factor[0]})"
        raise InputError(path, fault, "Project it to a CRS in metres (gdalwarp -t_srs).")


def _heights(file: DatasetReader) -> NDArray[np.float32]:
    """(h, w) of the first band, NaN where nothing is known: the mean of what is known in a cell."""
    every = np.ma.filled(file.read(1, masked=True).astype(np.float32), np.nan)
    low, high = _HEIGHTS_M
    every[~((every > low) & (every < high))] = np.nan
    rows, columns = _shape(file, _MOST_HEIGHTS)
    if (rows, columns) == every.shape:
        return np.asarray(every, dtype=np.float32)
    known = np.isfinite(every)
    size = (columns, rows)
    share = cv2.resize(known.astype(np.float32), size, interpolation=cv2.INTER_AREA)
    total = cv2.resize(np.where(known, every, 0.0), size, interpolation=cv2.INTER_AREA)
    mean = total / np.where(share > 0.5, share, np.nan)
    return np.asarray(mean, dtype=np.float32)


def _picture(file: DatasetReader) -> NDArray[np.uint8]:
    """(h, w, 3) of the first three bands, of one band by its palette, or in grey; white where there
    is nothing.
    """
    rows, columns = _shape(file, _MOST_PIXELS)
    if file.count >= 3:
        found = file.read([1, 2, 3], out_shape=(3, rows, columns), resampling=Resampling.average)
        pixels = found.transpose(1, 2, 0)
    elif file.colorinterp[0] is ColorInterp.palette:
        table = np.array([file.colormap(1).get(code, (0, 0, 0, 0)) for code in range(256)])
        pixels = table[file.read(1, out_shape=(rows, columns)), :3]
    else:
        grey = file.read(1, out_shape=(rows, columns), resampling=Resampling.average)
        pixels = np.repeat(grey[..., None], 3, axis=2)
    there = file.dataset_mask(out_shape=(rows, columns)) > 0
    return np.ascontiguousarray(np.where(there[..., None], pixels, 255), dtype=np.uint8)


def _shape(file: DatasetReader, most: int) -> tuple[int, int]:
    """Rows and columns to read, so that the longer side has no more."""
    times = max(1.0, max(file.height, file.width) / most)
    return max(1, round(file.height / times)), max(1, round(file.width / times))
