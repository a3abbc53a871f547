"""Holes that what stands before a facade leaves in it, one object at a time (section 6.3).

An object hides ground and structure. The ground below the virtual boundary is the plane on which
most ground points around the hole lie (RANSAC); the structure above it is filled line by line from
side to side, then from above and below.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from veduta.drive.build.frame import ColumnFrame

Depths = NDArray[np.float32]
Mask = NDArray[np.bool_]
Labels = NDArray[np.int32]
_SEED = 1
"""Of the planes that are drawn."""


@dataclass(frozen=True)
class HoleParameters:
    """reach_px: scanners coarser than the depth image leave beams of an object empty: what is so
    near to it is of its hole. around_px: valid pixels so near to a hole are its boundary points.
    off_m: a point is on a plane within this (2 sigma of the paper's scanner). tries: planes that
    are drawn. fewest: boundary points, of which so many must lie on the plane. slope: of a plane at
    most, along the path and across it.
    """

    reach_px: int = 3
    around_px: int = 4
    off_m: float = 0.07
    tries: int = 60
    fewest: int = 8
    slope: float = 0.12


def holes_of(objects: Labels, parameters: HoleParameters | None = None) -> Labels:
    """(r, c) the object, from 1 on, before each pixel, and 0 before none: the objects projected
    onto the background, without the gaps between a coarse scanner's beams.
    """
    chosen = parameters or HoleParameters()
    if not objects.any():
        return objects
    away, nearest = ndimage.distance_transform_edt(objects == 0, return_indices=True)
    return np.where(away <= chosen.reach_px, objects[tuple(nearest)], 0).astype(np.int32)


def between(values: NDArray[np.floating], *, axis: int) -> tuple[Depths, NDArray[np.int64], Depths]:
    """Of each pixel without a value the linear interpolation between the nearest ones on both sides
    along an axis, NaN where there are not both; how far these are from each other (pixels), and by
    how much they differ.
    """
    own = np.moveaxis(np.asarray(values, dtype=np.float32), axis, -1)
    valid = np.isfinite(own)
    last = own.shape[-1] - 1
    place = np.broadcast_to(np.arange(last + 1), own.shape)
    before = np.maximum.accumulate(np.where(valid, place, -1), axis=-1)
    after = np.where(valid, place, last + 1)[..., ::-1]
    after = np.minimum.accumulate(after, axis=-1)[..., ::-1]
    both = ~valid & (before >= 0) & (after <= last)
    low = np.take_along_axis(own, np.maximum(before, 0), axis=-1)
    high = np.take_along_axis(own, np.minimum(after, last), axis=-1)
    gap = np.maximum(after - before, 1)
    found = np.where(both, low + (place - before) / gap * (high - low), np.nan)
    step = np.where(both, np.abs(high - low), np.nan)
    back = [np.moveaxis(one, -1, axis) for one in (found, gap, step)]
    return back[0].astype(np.float32), back[1], back[2].astype(np.float32)


def fill_structure(
    wall: Depths, holes: Labels, parameters: HoleParameters | None = None
) -> Depths:
    """Walls (r, c), NaN elsewhere, with the holes of objects filled from the structure around each:
    from side to side where it goes on to both, and then, with what was so filled, from above and
    below. Where it does not go on, behind a crown over a roof, nothing is filled.

    The paper interpolates depths; told from the main depth on, steps of fronts stay steps.
    """
    chosen = parameters or HoleParameters()
    filled = wall.copy()
    for rows, columns, hole, around in _each(holes, np.isfinite(wall), chosen):
        own = np.where(around, wall[rows, columns], np.nan)
        for axis in (1, 0):
            own = np.where(hole & np.isnan(own), between(own, axis=axis)[0], own)
        filled[rows, columns][hole] = own[hole]
    return filled


def _each(
    holes: Labels, known: Mask, chosen: HoleParameters
) -> Iterator[tuple[slice, slice, Mask, Mask]]:
    """Of each object rows and columns, in them its hole, and the boundary points around that: what
    is known near to it.
    """
    boxes = ndimage.find_objects(holes)
    margin = chosen.around_px + 1
    for number in np.unique(holes[holes > 0]).tolist():
        rows, columns = (
            slice(max(part.start - margin, 0), min(part.stop + margin, length))
            for part, length in zip(boxes[number - 1], holes.shape, strict=True)
        )
        there = known[rows, columns]
        hole = (holes[rows, columns] == number) & ~there
        if hole.any():
            near = ndimage.distance_transform_edt(~hole) <= chosen.around_px
            yield rows, columns, hole, near & there


def ground_planes(
    ground: Depths,
    holes: Labels,
    frame: ColumnFrame,
    parameters: HoleParameters | None = None,
) -> Depths:
    """(r, c) depths at which beams meet the ground plane of the object that hides it there; NaN
    where none does, or too few of the ground around an object lie on one plane.

    ground: (r, c) measured ground, NaN elsewhere.
    """
    chosen = parameters or HoleParameters()
    random = np.random.default_rng(_SEED)
    found = np.full(ground.shape, np.nan, dtype=np.float32)
    for rows, columns, hole, around in _each(holes, np.isfinite(ground), chosen):
        corner = [rows.start, columns.start]
        at = np.argwhere(around) + corner
        plane = _plane(_points(ground, at, frame), random, chosen)
        if plane is not None:
            there = np.argwhere(hole) + corner
            found[there[:, 0], there[:, 1]] = _meets(plane, there, frame)
    return found


def _points(ground: Depths, at: NDArray[np.int64], frame: ColumnFrame) -> NDArray[np.float64]:
    """(n, 3) along the path, depth, height of ground pixels (m)."""
    depth = ground[at[:, 0], at[:, 1]].astype(np.float64)
    height = frame.origins[at[:, 1], 2] + depth * np.tan(frame.angles_rad[at[:, 0]])
    return np.column_stack([at[:, 1] * frame.spacing_m, depth, height])


def _plane(
    points: NDArray[np.float64], random: np.random.Generator, chosen: HoleParameters
) -> NDArray[np.float64] | None:
    """(3,) a, b, c of height = a along + b depth + c with the most points on it, fitted to them."""
    if len(points) < chosen.fewest:
        return None
    basis = np.column_stack([points[:, :2], np.ones(len(points))])
    drawn = random.integers(0, len(points), (chosen.tries, 3))
    corners, heights = basis[drawn], points[drawn, 2]
    sound = np.abs(np.linalg.det(corners)) > 1e-3
    if not sound.any():
        return None
    planes = np.linalg.solve(corners[sound], heights[sound][..., None])[..., 0]
    planes = planes[(np.abs(planes[:, :2]) <= chosen.slope).all(axis=1)]
    if not len(planes):
        return None
    on = np.abs(planes @ basis.T - points[:, 2]) < chosen.off_m
    best = on[on.sum(axis=1).argmax()]
    if best.sum() < chosen.fewest:
        return None
    plane, *_ = np.linalg.lstsq(basis[best], points[best, 2], rcond=None)
    level = (np.abs(plane[:2]) <= chosen.slope).all()
    return np.asarray(plane) if level else None


def _meets(
    plane: NDArray[np.float64], at: NDArray[np.int64], frame: ColumnFrame
) -> NDArray[np.float64]:
    """(n,) depths at which the beams of pixels meet a plane; NaN where they do not, going down."""
    along, across, level = plane
    rise = np.tan(frame.angles_rad[at[:, 0]]) - across
    drop = along * at[:, 1] * frame.spacing_m + level - frame.origins[at[:, 1], 2]
    depth = drop / np.minimum(rise, -1e-6)
    return np.where((rise < -1e-3) & (depth > 0.0), depth, np.nan)
