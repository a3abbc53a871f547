"""The background without holes (sections 6.3 and 6.4), and the walls above what was scanned."""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from veduta.drive.build.frame import ColumnFrame
from veduta.drive.build.layers import Layers
from veduta.drive.build.object_holes import between, fill_structure, ground_planes, holes_of


class Source(IntEnum):
    """Where a pixel of the background comes from."""

    NOTHING = 0
    MEASURED = 1
    FILLED = 2
    INFERRED = 3


@dataclass(frozen=True)
class FillParameters:
    """Thresholds of filling.

    gap_m: a gap in the main depth up to this is bridged where both ends agree within `agree_m`.
    widest_m: a hole that no object left in a wall is filled from side to side up to this. step_m:
    ends of it that differ more are of two houses. beams_px: so few rows apart are two beams of the
    scanner with nothing between. from_main: depths behind objects are interpolated from the main
    depth on; else as they are, as the paper does. road_m: the ground is filled so far out where nothing stands.
    alone: measured pixels with fewer measured ones around (7 x 7) are removed.
    smooth_m: how much the surface may move where it is smoothed (3 sigma of the scanner, 3.5 cm).
    """

    gap_m: float = 6.0
    agree_m: float = 0.6
    widest_m: float = 10.0
    step_m: float = 1.0
    beams_px: int = 4
    from_main: bool = True
    road_m: float = 12.0
    alone: int = 5
    smooth_m: float = 0.1


@dataclass(frozen=True, eq=False)
class Background:
    """depth: (r, c) float32 m. source: (r, c) uint8 `Source`. wall: (r, c) else it is ground.

    main: (c,) the main depth with its gaps bridged (m), NaN where no wall is. foot: (c,) the first
    row of the wall: below is ground (the paper's virtual boundary).
    """

    depth: NDArray[np.float32]
    source: NDArray[np.uint8]
    wall: NDArray[np.bool_]
    main: NDArray[np.float64]
    foot: NDArray[np.int64]


def fill_background(
    layers: Layers,
    objects: NDArray[np.int32],
    frame: ColumnFrame,
    parameters: FillParameters | None = None,
) -> Background:
    """What objects hide, one at a time: ground below the virtual boundary, structure above it; then
    what glass left open, by rows and by columns. objects: (r, c) of `find_objects`.
    """
    chosen = parameters or FillParameters()
    main = _bridged(layers.depths.main, frame.spacing_m, chosen)
    lowest = layers.behind.floor(main)
    foot = _virtual_boundary(layers, frame, lowest)
    rows = np.arange(frame.shape[0])[:, None]
    upper = rows >= foot
    measured = layers.background.copy()
    # Nothing of the wall lies below its foot, and no ground above.
    measured[layers.wall & ~upper & ~layers.depths.across] = np.nan
    measured[~layers.wall & upper] = np.nan
    measured[_alone(np.isfinite(measured), chosen.alone)] = np.nan
    source = np.where(np.isfinite(measured), Source.MEASURED, Source.NOTHING).astype(np.uint8)
    wall = np.where(upper, measured, np.nan)
    # From the main depth on, which steps where fronts do: a step is not filled as a slope.
    behind = layers.behind.depth(np.where(layers.wall, layers.background, np.nan))
    base = np.where(np.isfinite(behind), behind, np.nan_to_num(main)).astype(np.float32)
    holes = holes_of(objects)
    wall = _between_beams(wall - base, upper, chosen)
    plain = np.float32(0.0) if chosen.from_main else base
    wall = fill_structure(wall + plain, np.where(upper, holes, 0)) - plain + base
    inside = upper & (rows <= _top_rows(np.isfinite(wall))) & np.isfinite(main)
    filled = _across(wall - base, frame.spacing_m, chosen, axis=1) + base
    filled = _across(filled, float("nan"), chosen, axis=0)
    filled = np.where(inside & np.isnan(filled), base, filled)
    filled = np.where(inside, filled, wall)
    depth = np.where(upper, filled, _ground_depth(layers, frame, lowest, measured, holes, foot, chosen))
    depth = _smoothed(depth.astype(np.float32), upper, chosen.smooth_m)
    # Where a beam grazes the ground its depth is noise: there the height is smoothed.
    down = np.tan(np.minimum(frame.angles_rad, -1e-3))[:, None].astype(np.float32)
    depth = np.where(upper, depth, _smoothed(depth * down, ~upper, chosen.smooth_m) / down)
    source[(source == Source.NOTHING) & np.isfinite(depth)] = Source.FILLED
    return Background(depth, source, upper & np.isfinite(depth), main, foot)


def raise_walls(background: Background, frame: ColumnFrame, tops_m: NDArray[np.float64]) -> Background:
    """Walls go on in their plane, inferred, up to heights over the road (c,); NaN leaves one."""
    rows = np.arange(frame.shape[0])[:, None]
    wall = background.wall
    highest = np.where(wall.any(axis=0), wall.shape[0] - 1 - np.argmax(wall[::-1], axis=0), -1)
    upper = np.where(wall, background.depth, np.nan)
    near = (rows > highest - 12) & wall
    plane = np.full(len(tops_m), np.nan)
    some = np.flatnonzero(near.any(axis=0))
    if len(some):
        told = np.nanmedian(np.where(near, upper, np.nan)[:, some], axis=0)
        plane[some] = ndimage.median_filter(told, 9, mode="nearest")
    over_scanner = frame.road_m + tops_m - frame.origins[:, 2]
    limit = np.arctan2(over_scanner, plane)
    with np.errstate(invalid="ignore"):
        goes_on = (rows > highest) & (highest >= 0) & (frame.angles_rad[:, None] <= limit)
    depth = np.where(goes_on, plane[None].astype(np.float32), background.depth)
    source = np.where(goes_on, np.uint8(Source.INFERRED), background.source)
    return Background(depth, source, wall | goes_on, background.main, background.foot)


def _bridged(
    main: NDArray[np.float64], spacing_m: float, chosen: FillParameters
) -> NDArray[np.float64]:
    """Short gaps between two pieces of one front are of that front."""
    known = np.flatnonzero(np.isfinite(main))
    if len(known) < 2:
        return main
    bridged = np.interp(np.arange(len(main)), known, main[known])
    result = main.copy()
    for before, after in zip(known[:-1], known[1:], strict=True):
        short = (after - before) * spacing_m <= chosen.gap_m
        if after - before > 1 and short and abs(main[after] - main[before]) < chosen.agree_m:
            result[before:after] = bridged[before:after]
    return result


def _virtual_boundary(
    layers: Layers, frame: ColumnFrame, main: NDArray[np.float64]
) -> NDArray[np.int64]:
    """(c,) the row in which the line through the main depth meets the ground (section 6.3)."""
    columns = np.arange(len(main))
    depth = np.where(np.isfinite(main), main, 1.0)
    foot = frame.road_m + layers.ground.under(columns, depth) - frame.origins[:, 2]
    row = np.searchsorted(frame.angles_rad, np.arctan2(foot, depth))
    return np.where(np.isfinite(main), row, frame.shape[0]).astype(np.int64)


def _top_rows(wall: NDArray[np.bool_]) -> NDArray[np.int64]:
    """(c,) the highest row of the wall in each column: nothing is filled above."""
    return np.where(wall.any(axis=0), wall.shape[0] - 1 - np.argmax(wall[::-1], axis=0), -1)


def _between_beams(
    wall: NDArray[np.float32], upper: NDArray[np.bool_], chosen: FillParameters
) -> NDArray[np.float32]:
    """Rows of the depth image that lie between two beams of a coarser scanner."""
    found, gap, step = between(wall, axis=0)
    with np.errstate(invalid="ignore"):
        near = upper & np.isnan(wall) & (gap <= chosen.beams_px) & (step < chosen.step_m)
    return np.where(near, found, wall)


def _alone(filled: NDArray[np.bool_], fewest: int) -> NDArray[np.bool_]:
    around = ndimage.uniform_filter(filled.astype(np.float32), 7, mode="constant") * 49.0
    return np.asarray(filled & (around < fewest + 0.5))


def _across(
    depth: NDArray[np.floating], spacing_m: float, chosen: FillParameters, *, axis: int
) -> NDArray[np.float32]:
    """Linear between the nearest valid pixels on both sides along an axis, where they agree."""
    found, gap, step = between(depth, axis=axis)
    with np.errstate(invalid="ignore"):
        alike = step < chosen.step_m
    if np.isfinite(spacing_m):
        alike &= gap * spacing_m <= chosen.widest_m
    return np.where(alike, found, depth).astype(np.float32)


def _ground_depth(
    layers: Layers,
    frame: ColumnFrame,
    main: NDArray[np.float64],
    measured: NDArray[np.float32],
    holes: NDArray[np.int32],
    foot: NDArray[np.int64],
    chosen: FillParameters,
) -> NDArray[np.float32]:
    """(r, c) depths at which the beams below the wall meet the ground, measured ones kept.

    Behind an object that is the plane around it, elsewhere the ground's height nearby. The road
    below the vehicle is of it, too: scanners do not see it, images taken before do.
    """
    upper = np.arange(frame.shape[0])[:, None] >= foot
    down = np.tan(np.minimum(frame.angles_rad, -1e-3))[:, None]
    columns = np.broadcast_to(np.arange(frame.shape[1]), frame.shape)
    height = frame.road_m - frame.origins[:, 2]
    depth = np.broadcast_to(height / down, frame.shape)
    limit = np.where(np.isfinite(main), main + 0.5, chosen.road_m)
    for _ in range(3):
        near = np.clip(depth, 0.0, limit)
        depth = (height + layers.ground.under(columns, near)) / down
    lower = (frame.angles_rad[:, None] < 0.0) & ~upper
    planes = ground_planes(np.where(upper, np.nan, measured), np.where(lower, holes, 0), frame)
    with np.errstate(invalid="ignore"):
        depth = np.where(planes <= limit, planes, depth)
    ground = lower & (depth <= limit) & (depth > 0.0)
    return np.where(np.isfinite(measured), measured, np.where(ground, depth, np.nan)).astype(
        np.float32
    )


def _smoothed(
    depth: NDArray[np.float32], part: NDArray[np.bool_], most_m: float
) -> NDArray[np.float32]:
    """A median over 7 x 7 pixels of a part, where it moves the surface only by its noise."""
    nearest = ndimage.distance_transform_edt(
        np.isnan(depth) | ~part, return_distances=False, return_indices=True
    )
    filled = depth[tuple(nearest)] if part.any() else depth
    middle = ndimage.median_filter(filled, size=(7, 7), mode="nearest")
    with np.errstate(invalid="ignore"):
        near = part & (np.abs(middle - depth) < most_m)
    return np.where(near, middle, depth).astype(np.float32)
