"""Which part of the photo belongs to the plane, and at which scale it is worth resampling."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.facade.plane import FacadePlane
from veduta.geometry import homography, polygon, vanishing
from veduta.geometry.homography import Matrix, Points
from veduta.imaging.plane_fit import segment_weights
from veduta.imaging.vanishing import horizontal_candidates

MAX_STRETCH = 5.0
"""Largest linear magnification against the middle of the facade: beyond it the wall is a smear."""

_NEAR_RAD = math.radians(2.0)
_OTHER_WALL_PART = 0.35
"""A second wall counts when its segments weigh this much of the first's."""

_MIN_KEPT_PART = 0.25


@dataclass(frozen=True)
class PlaneRegion:
    """A convex polygon of photo pixels, and plane units to pixels at 1:1 in its middle."""

    polygon_px: Points
    px_per_plane_unit: float
    middle_px: Points
    notes: tuple[str, ...]


def plane_region(plane: FacadePlane, size_px: tuple[int, int]) -> PlaneRegion:
    """Clip the photo to the dominant wall and to a bounded stretch."""
    width, height = size_px
    notes: list[str] = []
    plane_from_image = _positive_at(plane.plane_from_image(), width / 2, height / 2)
    region = polygon.rectangle(0.0, 0.0, width, height)
    along = plane.angles()[0] < _NEAR_RAD
    weights = segment_weights(plane.segments, math.hypot(width, height))
    wall = _wall_interval(plane, plane_from_image, along, weights, size_px)
    if wall is not None:
        x_low, x_high = wall
        left = plane_from_image[0] - x_low * plane_from_image[2]
        right = x_high * plane_from_image[2] - plane_from_image[0]
        region = polygon.clip_half_plane(polygon.clip_half_plane(region, left), right)
        along &= polygon.contains(region, plane.segments.midpoints())
        notes.append("two walls are seen: the larger one is used, the other is cut off")
    middle = _weighted_median(plane.segments.midpoints()[along], weights[along])
    w_middle = homography.homogeneous(plane_from_image, middle)[0, 2]
    # The area grows as 1 / w^3, so a bound on the length is a half plane of the photo.
    w_least = w_middle * MAX_STRETCH ** (-2.0 / 3.0)
    clipped = polygon.clip_half_plane(region, plane_from_image[2] - (0.0, 0.0, w_least))
    if len(clipped) < 3:
        clipped = region
    elif abs(polygon.signed_area(clipped)) < 0.999 * abs(polygon.signed_area(region)):
        notes.append(f"the far end of the wall is cut off where it is stretched {MAX_STRETCH:g}x")
    area = abs(float(homography.area_scale(plane_from_image, middle)[0]))
    return PlaneRegion(clipped, 1.0 / math.sqrt(area), middle, tuple(notes))


def framed(
    plane: FacadePlane, region: PlaneRegion, max_side_px: int
) -> tuple[Matrix, tuple[int, int]]:
    """rectified_from_source and (width, height): the region's bounding box, 1:1 in its middle."""
    plane_from_source = plane.plane_from_image()
    corners = homography.apply(plane_from_source, region.polygon_px)
    low, high = corners.min(axis=0), corners.max(axis=0)
    extent = (high - low) * region.px_per_plane_unit
    scale = region.px_per_plane_unit * min(1.0, max_side_px / float(extent.max()))
    width_px, height_px = (max(1, min(max_side_px, round(v))) for v in (high - low) * scale)
    frame = homography.scaling(scale, scale) @ homography.translation(-low[0], -low[1])
    return frame @ plane_from_source, (width_px, height_px)


def _positive_at(matrix: Matrix, x: float, y: float) -> Matrix:
    w = float(homography.homogeneous(matrix, np.array([[x, y]]))[0, 2])
    return matrix if w > 0 else -matrix


def _wall_interval(
    plane: FacadePlane,
    plane_from_image: Matrix,
    along: NDArray[np.bool_],
    weights: NDArray[np.float64],
    size_px: tuple[int, int],
) -> tuple[float, float] | None:
    """The range of x on the wall where it outweighs a second wall; None for one wall alone."""
    other = _other_wall(plane, along, weights, size_px)
    if other is None:
        return None
    mapped = homography.homogeneous(plane_from_image, plane.segments.midpoints())
    ours, theirs = along & ~other, other & ~along
    in_front = mapped[:, 2] > 0
    used = (ours | theirs) & in_front
    x = mapped[used, 0] / mapped[used, 2]
    gain = np.where(ours[used], weights[used], -weights[used])
    order = np.argsort(x, kind="stable")
    first, last = _best_run(gain[order])
    x_sorted = x[order]
    kept = np.zeros(len(x), dtype=np.bool_)
    kept[order[first : last + 1]] = True
    lost = float(-gain[~kept & (gain < 0)].sum())
    # The second family must lie beside the wall, not on it (reveals and gutters do that).
    if lost < 0.6 * float(weights[theirs & in_front].sum()):
        return None
    if float(gain[kept & (gain > 0)].sum()) < _MIN_KEPT_PART * float(weights[ours].sum()):
        return None
    low = -math.inf if first == 0 else (x_sorted[first - 1] + x_sorted[first]) / 2
    high = math.inf if last == len(x) - 1 else (x_sorted[last] + x_sorted[last + 1]) / 2
    reach = float(np.abs(x_sorted).max()) * 1e3 + 1.0
    return max(low, -reach), min(high, reach)


def _other_wall(
    plane: FacadePlane,
    along: NDArray[np.bool_],
    weights: NDArray[np.float64],
    size_px: tuple[int, int],
) -> NDArray[np.bool_] | None:
    """Segments that run along the strongest second horizontal direction, if it is a strong one."""
    up = plane.angles()[1] < _NEAR_RAD
    rest = ~along & ~up
    if int(rest.sum()) < 8:
        return None
    centred = plane.segments.centred(size_px)
    found = horizontal_candidates(centred.select(rest), weights[rest], 1, np.random.default_rng(0))
    if not len(found.points) or found.support[0] < _OTHER_WALL_PART * weights[along & ~up].sum():
        return None
    angles = vanishing.angles_to_vanishing_point(
        centred.midpoints(), centred.directions(), found.points[0]
    )
    return np.asarray((np.abs(angles) < _NEAR_RAD) & ~up)


def _best_run(gain: NDArray[np.float64]) -> tuple[int, int]:
    """First and last index of the contiguous run with the largest sum (Kadane)."""
    total = np.concatenate([[0.0], np.cumsum(gain)])
    lowest = np.minimum.accumulate(total)
    last = int(np.argmax(total[1:] - lowest[:-1]))
    first = int(np.argmin(total[: last + 1]))
    return first, last


def _weighted_median(points: Points, weights: NDArray[np.float64]) -> Points:
    """(1, 2) medians of x and of y."""
    middle = []
    for values in points.T:
        order = np.argsort(values, kind="stable")
        total = np.cumsum(weights[order])
        middle.append(values[order[int(np.searchsorted(total, total[-1] / 2))]])
    return np.array([middle], dtype=np.float64)
