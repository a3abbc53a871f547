"""How high walls go on above what the scanner saw: to where the sky begins in the images."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from veduta.drive.build.fill import Background
from veduta.drive.build.frame import ColumnFrame
from veduta.drive.build.pictures_of import Seen


@dataclass(frozen=True)
class RoofLineParameters:
    """step_m: heights that are looked at. lowest_m: sky below is none. smooth_m: over which roof
    lines are level. fewest: images that must show where the sky begins. seen_px: margin.
    quantile: trees stand before the sky and make a wall look higher, never lower.
    """

    step_m: float = 0.1
    lowest_m: float = 2.5
    smooth_m: float = 12.0
    fewest: int = 1
    quantile: float = 0.2


def find_roof_line(
    background: Background,
    frame: ColumnFrame,
    seen: Sequence[Seen],
    highest_m: float,
    parameters: RoofLineParameters | None = None,
) -> tuple[NDArray[np.float64], NDArray[np.bool_]]:
    """(c,) heights over the road up to which walls go on (m, NaN: not at all), and (c,) whether
    sky was seen over them; elsewhere the line of the neighbours goes on.
    """
    chosen = parameters or RoofLineParameters()
    walls = np.flatnonzero(background.wall.any(axis=0))
    tops = np.full(frame.shape[1], np.nan)
    known = np.zeros(frame.shape[1], dtype=bool)
    if not len(walls) or not seen or highest_m <= chosen.lowest_m:
        return tops, known
    depth = np.nanmedian(np.where(background.wall, background.depth, np.nan)[:, walls], axis=0)
    heights = np.arange(chosen.lowest_m, highest_m + chosen.step_m / 2, chosen.step_m)
    flat = frame.origins[walls, :2] + depth[:, None] * frame.outward[walls]
    line = np.empty((len(walls), len(heights), 3))
    line[..., :2] = flat[:, None]
    line[..., 2] = frame.road_m[walls][:, None] + heights
    both = [_sky_begins(one, line, heights) for one in seen]
    found, shown = np.stack([one[0] for one in both]), np.stack([one[1] for one in both])
    enough = np.isfinite(found).sum(axis=0) >= chosen.fewest
    told = np.where(shown.max(axis=0) > 0.0, shown.max(axis=0), np.nan)
    if enough.any():
        told[enough] = np.nanquantile(found[:, enough], chosen.quantile, axis=0)
    known[walls] = enough
    tops[walls] = _level(told, int(round(chosen.smooth_m / frame.spacing_m)) | 1)
    return tops, known


def _sky_begins(
    seen: Seen, line: NDArray[np.float64], heights: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """(w,) the lowest height of each vertical line with sky from there on, NaN where none is; and
    (w,) the greatest height that is inside the image, 0 where none is.
    """
    pixels, depth = seen.shot.project(line.reshape(-1, 3))
    at = np.floor(pixels).astype(np.int64)
    height, width = seen.sky.shape
    inside = (depth > 1.0) & (at >= 0).all(axis=1) & (at[:, 0] < width) & (at[:, 1] < height)
    at = np.where(inside[:, None], at, 0)
    sky = seen.sky[at[:, 1], at[:, 0]] & inside
    sky, inside = sky.reshape(line.shape[:2]), inside.reshape(line.shape[:2])
    # From the top of what the image shows downwards, sky without a break.
    open_ = np.minimum.accumulate((sky | ~inside)[:, ::-1], axis=1)[:, ::-1] & inside
    first = np.argmax(open_, axis=1)
    last = inside.shape[1] - 1 - np.argmax(inside[:, ::-1], axis=1)
    shown = np.where(inside.any(axis=1), heights[last], 0.0)
    return np.where(open_.any(axis=1) & (first > 0), heights[first], np.nan), shown


def _level(tops: NDArray[np.float64], wide: int) -> NDArray[np.float64]:
    """A low quantile along the street over the columns that know, and for their neighbours."""
    known = np.flatnonzero(np.isfinite(tops))
    if not len(known):
        return tops
    filled = np.interp(np.arange(len(tops)), known, tops[known])
    low = ndimage.percentile_filter(filled, 25, wide, mode="nearest")
    distance = np.abs(np.arange(len(tops))[:, None] - known).min(axis=1)
    return np.where(distance <= wide, low, np.nan)
