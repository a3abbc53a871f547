"""The surface model as a picture: heights lit from the north-west, or the photo itself."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from veduta.drive.read.surface_model import read_bands
from veduta.drive.record import Overview

_LIGHT = np.array([-0.5, 0.5, 0.7])
_LOW_TONE, _HIGH_TONE = (66, 74, 84), (206, 192, 168)
_UNKNOWN = (40, 40, 46)


def draw_surface(
    path: Path,
    origin_m: tuple[float, float, float],
    low: tuple[float, float],
    high: tuple[float, float],
    longest_px: int | None = None,
) -> Overview:
    """What of it lies between two corners (m, about the origin). InputError as its reader's.

    longest_px: the longer side is thinned to so many cells, about, before it is lit.
    """
    bands, corner, cell_m, _ = read_bands(path)
    begin = np.array(corner) - np.array(origin_m[:2])
    first = np.floor((np.array(low) - begin) / cell_m).astype(int)
    last = np.ceil((np.array(high) - begin) / cell_m).astype(int)
    first = np.clip(first, 0, [bands.shape[2], bands.shape[1]])
    last = np.clip(last, first, [bands.shape[2], bands.shape[1]])
    cut = bands[:, first[1] : last[1], first[0] : last[0]]
    where = begin + first * cell_m
    if longest_px is not None:
        every = max(1, -(-max(cut.shape[1:]) // longest_px))
        cut, cell_m = cut[:, ::every, ::every], cell_m * every
    pixels = _lit(cut[0], cell_m) if len(bands) == 1 else _photo(cut[:3])
    return Overview(pixels, (float(where[0]), float(where[1])), cell_m)


def _photo(bands: NDArray[np.float32]) -> NDArray[np.uint8]:
    return np.ascontiguousarray(np.moveaxis(np.nan_to_num(bands), 0, 2).astype(np.uint8))


def _lit(heights: NDArray[np.float32], cell_m: float) -> NDArray[np.uint8]:
    known = np.isfinite(heights)
    if min(heights.shape) < 2 or not known.any():
        return np.full((*heights.shape, 3), _UNKNOWN, dtype=np.uint8)
    low, high = np.quantile(heights[known], [0.02, 0.98])
    filled = np.where(known, heights, low)
    share = np.clip((filled - low) / max(float(high - low), 1.0), 0.0, 1.0)[..., None]
    tone = np.array(_LOW_TONE) + share * (np.array(_HIGH_TONE) - np.array(_LOW_TONE))
    north, east = np.gradient(filled, cell_m)
    normal = np.stack([-east, -north, np.ones_like(east)], axis=2)
    normal /= np.linalg.norm(normal, axis=2, keepdims=True)
    light = np.clip(normal @ (_LIGHT / np.linalg.norm(_LIGHT)), 0.0, 1.0)[..., None]
    shown = np.clip(tone * (0.45 + 0.75 * light), 0, 255)
    return np.where(known[..., None], shown, np.array(_UNKNOWN)).astype(np.uint8)
