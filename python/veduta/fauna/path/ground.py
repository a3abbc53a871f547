"""What an animal goes over: a place, a mesh, or a grid of heights (GeoTIFF) without any place."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import cv2
import numpy as np
import rasterio
from numpy.typing import NDArray
from rasterio.errors import RasterioError, RasterioIOError

from veduta.fauna.motion.angles import Floats
from veduta.fauna.path.terrain import MOST_CELLS, Terrain, terrain_of, terrain_of_heights
from veduta.formats.geotiff_grid import require_grid
from veduta.place.material import Material
from veduta.place.mesh import Mesh
from veduta.place.place import Place, Standing
from veduta.place.semantics import Provenance, SemanticClass
from veduta.run.errors import InputError
from veduta.run.inputs import require_file
from veduta.run.limits import Limits, limited

LEVEL = "level-ground"
AROUND_M = 12.0
"""A level ground goes on so far around what stands on it."""
GRIDS = (".tif", ".tiff")
_MOST_BYTES = 4_000_000_000
_MOST_READ = 100_000_000
"""Cells of a file; what has more than a million is planned on larger ones."""
_REMEDY = "Give a GeoTIFF of one band, heights in metres, in a CRS in metres."
_LIMITS = Limits(memory_mb=5000, seconds=120)
"""The largest one that is read takes two thirds of this."""
_METRES = ("m", "metre", "metres", "meter", "meters")
_LOWEST_M, _HIGHEST_M = -500.0, 9000.0
"""Of dry ground on Earth, with some room."""
_SHOWN = 400
"""Vertices along a side of the mesh that is shown: feet stand on that."""


def ground_of(path: Path, length_m: float) -> tuple[Place, Terrain]:
    """The place and its terrain for an animal of this length.

    path: a folder that Veduta wrote, a mesh that is all ground, or heights in metres. InputError
    where it is none of them.
    """
    if path.suffix.lower() in GRIDS:
        return _of_heights(path)
    place = Place.load(path)
    if path.is_file() and not any(placed.standing.ground for placed in place.parts.values()):
        for placed in place.parts.values():
            placed.standing = replace(placed.standing, ground=True)
    if not any(placed.standing.ground for placed in place.parts.values()):
        _add_level_ground(place)
    return place, terrain_of(place, length_m)


def _add_level_ground(place: Place) -> None:
    """A level ground under things that stand together and have none: it is invented."""
    alive = {animal.part for animal in place.animals}
    solid = [
        placed
        for placed in place.parts.values()
        if placed.id not in alive and not placed.standing.backdrop
    ]
    if len(solid) < 2:
        return
    points = [placed.triangles()[0] for placed in solid]
    low = np.min([one.min(axis=0) for one in points], axis=0)[:2] - AROUND_M
    high = np.max([one.max(axis=0) for one in points], axis=0)[:2] + AROUND_M
    level = float(np.median([one[:, 2].min() for one in points]))
    corners = [(low[0], low[1]), (high[0], low[1]), (high[0], high[1]), (low[0], high[1])]
    mesh = Mesh.simple(
        LEVEL, np.array([(x, y, level) for x, y in corners]), np.array([[0, 1, 2], [0, 2, 3]]),
        SemanticClass.GROUND, Provenance.INVENTED, name="ground",
        material=Material("ground", (0.52, 0.51, 0.48)),
    )  # fmt: skip
    place.add(mesh, Standing(name="level ground", ground=True, arrangement="invented"))


def around_others(terrain: Terrain, place: Place, own: str, length_m: float) -> Terrain:
    """The terrain on which the ways of the place's other animals are in the way, too."""
    canvas = terrain.blocked.astype(np.uint8)
    for animal in place.animals:
        if animal.id == own:
            continue
        cells = terrain.cell_of(np.array(animal.path))[:, ::-1]
        wide = 0.5 * (animal.length + length_m) / terrain.cell_m
        line = np.clip(np.round(cells * 16), -(2**30), 2**30).astype(np.int32)
        cv2.polylines(canvas, [line], animal.closed, 1, max(1, round(wide)), cv2.LINE_8, 4)
    return replace(terrain, blocked=canvas > 0)


def local_points(points_m: Floats, place: Place, terrain: Terrain) -> Floats:
    """Points of a path in the place's own metres: those of its CRS are shifted by its origin."""
    rows, columns = terrain.heights_m.shape

    def inside(points: Floats) -> bool:
        cells = terrain.cell_of(points)
        limit = np.array([rows, columns])
        return bool(((cells > -1.0) & (cells < limit)).all())

    shifted: Floats = points_m - np.array(place.origin_m[:2])
    return shifted if not inside(points_m) and inside(shifted) else points_m


def _of_heights(path: Path) -> tuple[Place, Terrain]:
    heights, low, cell_m, crs = limited(_read, path, path, _REMEDY, _LIMITS)
    by = max(1, int(np.ceil(np.sqrt(heights.size / MOST_CELLS))))
    heights = _coarser(heights, by)
    known = np.isfinite(heights)
    if known.sum() < 4:
        raise InputError(path, "has no heights", "Give a grid of heights in metres.")
    base = float(np.floor(heights[known].min()))
    terrain = terrain_of_heights(heights - base, cell_m * by, (0.5 * cell_m * by,) * 2)
    place = Place(title=path.stem, crs=crs, origin_m=(low[0], low[1], base))
    shown = max(1, int(np.ceil(max(heights.shape) / _SHOWN)))
    seen = _coarser(terrain.heights_m, shown)
    corner = terrain.origin_m[0] + 0.5 * (shown - 1) * terrain.cell_m
    surface = terrain_of_heights(seen, terrain.cell_m * shown, (corner, corner))
    place.add(_mesh(path.stem, surface), Standing(name=path.stem, ground=True))
    return place, replace(terrain, exact=surface.height_at)


def _read(path: Path) -> tuple[Floats, tuple[float, float], float, str | None]:
    """Heights (rows from the south, columns), the lower left corner, the side of a cell, the
    CRS.
    """
    try:
        require_file(path, _MOST_BYTES)
        with rasterio.open(path, driver="GTiff") as file:
            place, size = file.transform, file.width * file.height
            if size > _MOST_READ or file.count != 1:
                fault = f"has {size:,} cells and {file.count} bands"
                raise InputError(path, fault, f"{_REMEDY} At most {_MOST_READ:,} cells.")
            system = file.crs
            unit = _unit(file)
            data = file.read(1, masked=True)
    except FileNotFoundError as error:
        raise InputError(path, "there is no such file", _REMEDY) from error
    except (RasterioError, RasterioIOError) as error:
        raise InputError(path, "is no GeoTIFF that can be read", "Copy it again.") from error
    require_grid(path, place, system)
    if unit is not None:
        fault = f"has lengths in {unit}, not in metres"
        raise InputError(path, fault, "Warp it to a CRS in metres, and its heights to metres.")
    if min(data.shape) < 2:
        fault = f"has {data.shape[0]} rows and {data.shape[1]} columns"
        raise InputError(path, fault, "Give a grid of two of each at least.")
    values = np.ma.filled(data.astype(np.float64), np.nan)[::-1]
    odd = (values < _LOWEST_M) | (values > _HIGHEST_M)
    if odd.any():
        fault = f"has {odd.sum():,} heights such as {values[odd][0]:g} m"
        raise InputError(path, fault, "Say what stands for no height (gdal_edit.py -a_nodata).")
    low = (float(place.c), float(place.f + place.e * values.shape[0]))
    return values, low, float(place.a), None if system is None else system.to_string()


def _unit(file: rasterio.DatasetReader) -> str | None:
    """The unit of the file's CRS, or of its heights, where that is told and is no metre."""
    crs = file.crs
    if crs is not None and crs.is_projected:
        name, factor = crs.linear_units_factor
        if abs(factor - 1.0) > 1e-9:
            return str(name)
    told = (file.units[0] or "").strip()
    return told if told and told.lower() not in _METRES else None


def _coarser(heights: Floats, by: int) -> Floats:
    """Means of so many cells along a side; what is left over at the north and east is cut."""
    if by == 1:
        return heights
    rows, columns = (side // by for side in heights.shape)
    cut = heights[: rows * by, : columns * by].reshape(rows, by, columns, by)
    return np.asarray(cut.mean(axis=(1, 3)), dtype=np.float64)


def _mesh(name: str, surface: Terrain) -> Mesh:
    """The triangles between the cells' middles; those without a height are left out."""
    heights = surface.heights_m
    rows, columns = heights.shape
    row, column = np.indices((rows, columns))
    flat = surface.point_of(np.stack([row.reshape(-1), column.reshape(-1)], axis=1))
    points = np.column_stack([flat, heights.reshape(-1)])
    number: NDArray[np.int64] = np.arange(rows * columns).reshape(rows, columns)
    a, b, c, d = number[:-1, :-1], number[:-1, 1:], number[1:, :-1], number[1:, 1:]
    faces = np.concatenate(
        [np.stack([a, b, d], axis=-1).reshape(-1, 3), np.stack([a, d, c], axis=-1).reshape(-1, 3)]
    )
    faces = faces[np.isfinite(points[:, 2])[faces].all(axis=1)]
    used, triangles = np.unique(faces, return_inverse=True)
    slope = np.nan_to_num(np.hypot(*np.gradient(heights, surface.cell_m)).reshape(-1))
    share = np.clip(slope, 0.0, 1.0)[:, None]
    even, steep = np.array([116.0, 128.0, 84.0]), np.array([138.0, 122.0, 102.0])
    colours = even * (1.0 - share) + steep * share
    return Mesh.simple(
        f"{name}-ground", points[used], triangles.reshape(-1, 3), SemanticClass.GROUND,
        Provenance.MEASURED, name="ground", colours=colours[used].astype(np.uint8),
    )  # fmt: skip
