"""Heights of the ground from a GeoTIFF: what lots stand on.

Read with Pillow, for rasterio is no dependency: a picture of one band with upright axes
(ModelPixelScale and ModelTiepoint, OGC 19-008r4), in the CRS of the lots. Nothing is reprojected.
"""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from veduta.run.errors import InputError
from veduta.run.inputs import require_file
from veduta.run.limits import Limits, limited

MAX_BYTES = 2 * 2**30
MAX_CELLS = 250_000_000
MAX_LOT_CELLS = 4_000_000
CELL_M = (1e-6, 1e6)
"""Smallest and largest side of a cell, in the units of the CRS."""
MAX_METRES = 1e9
"""No CRS has places farther from its origin; NaN is none either."""
Ground = Literal["lowest", "mean"]
_SCALE, _TIE, _MATRIX, _KEYS, _NO_DATA = 33550, 33922, 34264, 34735, 42113
_RASTER_TYPE, _GEOGRAPHIC, _PROJECTED = 1025, 2048, 3072
_POINT = 2
_LIMITS = Limits(memory_mb=4000, seconds=120)
"""The largest terrain takes three quarters of this."""
_MODES = ("F", "I", "I;16", "I;16S", "I;16B", "I;16L", "L")


class NoGroundError(ValueError):
    """The terrain does not say how high a lot lies."""


@dataclass(frozen=True)
class Terrain:
    """A grid of heights.

    heights_m: (rows, columns) float32 from north to south, NaN where it has none. west, north: the
    centre of the upper left cell, in the CRS. cell: width and height of a cell.
    """

    heights_m: NDArray[np.float32]
    west: float
    north: float
    cell: tuple[float, float]

    def under(self, rings: Sequence[NDArray[np.float64]], ground: Ground) -> float:
        """The height (m) on which a lot stands: rings of (n, 2) in the CRS, the outline first.

        That of the lowest place, or the mean over the lot: of the cells whose centres lie in it,
        and of the places of its corners, between cells. NoGroundError where one of them has none.
        """
        corners = np.concatenate([ring[:, :2] for ring in rings])
        found = [self._at(corners), self._inside(rings)]
        heights = np.concatenate(found)
        if np.isnan(heights).any():
            raise NoGroundError("the terrain has no height in some place of it")
        if ground == "lowest":
            return float(heights.min())
        return float((found[1] if len(found[1]) else heights).mean())

    def _at(self, places: NDArray[np.float64]) -> NDArray[np.float64]:
        """(n,) heights between cells, linear along both axes; NaN outside."""
        rows, columns = self.heights_m.shape
        x = (places[:, 0] - self.west) / self.cell[0]
        y = (self.north - places[:, 1]) / self.cell[1]
        outside = (x < -0.5) | (y < -0.5) | (x > columns - 0.5) | (y > rows - 0.5)
        x, y = np.clip(x, 0, columns - 1), np.clip(y, 0, rows - 1)
        left, top = np.floor(x).astype(np.int64), np.floor(y).astype(np.int64)
        right, low = np.minimum(left + 1, columns - 1), np.minimum(top + 1, rows - 1)
        u, v = x - left, y - top
        upper = self.heights_m[top, left] * (1 - u) + self.heights_m[top, right] * u
        lower = self.heights_m[low, left] * (1 - u) + self.heights_m[low, right] * u
        return np.where(outside, np.nan, upper * (1 - v) + lower * v)

    def _inside(self, rings: Sequence[NDArray[np.float64]]) -> NDArray[np.float64]:
        """(n,) heights of the cells whose centres lie in the lot."""
        low, high = rings[0][:, :2].min(axis=0), rings[0][:, :2].max(axis=0)
        rows, columns = self.heights_m.shape
        left = max(0, int(np.ceil((low[0] - self.west) / self.cell[0])))
        right = min(columns - 1, int(np.floor((high[0] - self.west) / self.cell[0])))
        top = max(0, int(np.ceil((self.north - high[1]) / self.cell[1])))
        bottom = min(rows - 1, int(np.floor((self.north - low[1]) / self.cell[1])))
        wide, tall = right - left + 1, bottom - top + 1
        if wide <= 0 or tall <= 0:
            return np.empty(0)
        if wide * tall > MAX_LOT_CELLS:
            raise NoGroundError(f"covers more than {MAX_LOT_CELLS} cells of the terrain")
        y = self.north - self.cell[1] * np.arange(top, bottom + 1)[:, None]
        x = self.west + self.cell[0] * np.arange(left, right + 1)[None, :]
        is_in = np.zeros((tall, wide), dtype=np.bool_)
        for ring in rings:
            for (x0, y0), (x1, y1) in zip(
                ring[:, :2], np.roll(ring[:, :2], -1, axis=0), strict=True
            ):
                if y0 == y1:
                    continue
                spans = (y0 > y) != (y1 > y)
                is_in ^= spans & (x < x0 + (y - y0) * (x1 - x0) / (y1 - y0))
        part = self.heights_m[top : bottom + 1, left : right + 1]
        return part[is_in].astype(np.float64)


def read_terrain(path: Path, crs: str | None) -> Terrain:
    """The heights of a file; InputError where it cannot be used for lots in `crs`."""
    return limited(_terrain, (path, crs), path, "Cut out what is needed.", _LIMITS)


def _terrain(asked: tuple[Path, str | None]) -> Terrain:
    path, crs = asked
    try:
        require_file(path, MAX_BYTES)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", Image.DecompressionBombWarning)
            with Image.open(path, formats=("TIFF",)) as image:
                return _read(path, image, crs)
    except FileNotFoundError as error:
        raise InputError(path, "does not exist", "Check its name.") from error
    except Image.DecompressionBombError as error:
        raise _too_large(path) from error
    except (
        OSError, ValueError, SyntaxError, KeyError, IndexError, TypeError, OverflowError,
        MemoryError,
    ) as error:  # fmt: skip
        raise InputError(path, f"is no GeoTIFF that can be read ({error})", _HINT) from error


_HINT = "Save it as GeoTIFF of one band, with upright axes, in the CRS of the lots."


def _read(path: Path, image: Image.Image, crs: str | None) -> Terrain:
    tags: dict[int, Any] = dict(getattr(image, "tag_v2", {}))
    if image.width * image.height > MAX_CELLS:
        raise _too_large(path)
    if image.mode not in _MODES:
        raise InputError(path, f"has no single band of heights (mode {image.mode})", _HINT)
    if _MATRIX in tags or _SCALE not in tags or _TIE not in tags:
        raise InputError(path, "does not say where it lies, or is turned", _HINT)
    keys = _geo_keys(tags.get(_KEYS, ()))
    _require_crs(path, keys, crs)
    width, height = (float(part) for part in tags[_SCALE][:2])
    column, row, _, x, y = (float(part) for part in tags[_TIE][:5])
    least, most = CELL_M
    sound = least <= width <= most and least <= height <= most
    if not (sound and np.abs([column, row, x, y]).max() <= MAX_METRES):
        raise InputError(path, "does not say where it lies, or is turned", _HINT)
    half = 0.0 if keys.get(_RASTER_TYPE) == _POINT else 0.5
    heights = np.asarray(image, dtype=np.float32).copy()
    heights[~np.isfinite(heights)] = np.nan
    if (text := str(tags.get(_NO_DATA, "")).strip("\0 ")) != "":
        heights[heights == np.float32(float(text))] = np.nan
    west, north = x + (half - column) * width, y - (half - row) * height
    return Terrain(heights, west, north, (width, height))


def _geo_keys(words: Sequence[int]) -> dict[int, int]:
    """The keys of the directory whose values stand in it."""
    rows = [words[at : at + 4] for at in range(4, len(words) - 3, 4)]
    return {int(key): int(value) for key, location, _, value in rows if location == 0}


def _require_crs(path: Path, keys: dict[int, int], crs: str | None) -> None:
    code = keys.get(_PROJECTED)
    if code is None and _GEOGRAPHIC in keys:
        raise InputError(
            path, "is in degrees, and lots are in metres", f"Reproject it to {crs or 'theirs'}."
        )
    named = None if code in (None, 32767) else f"EPSG:{code}"
    if crs is not None and named is not None and named != crs:
        raise InputError(
            path, f"is in {named}, but the lots are in {crs}", f"Reproject it to {crs}."
        )


def _too_large(path: Path) -> InputError:
    return InputError(path, f"has more than {MAX_CELLS:,} cells", "Cut out what is needed.")
