"""Finding the plane of a facade in a photo: fitted to its edges, then measured as it faces us.

Where a wall is seen at an angle, its far end has few pixels and short segments, and the edges that
are found change with the view. So the photo is turned to face the fitted wall, its edges are found
there once more, and the view is measured from both.
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from veduta.facade.plane import FacadePlane, not_found, require_evidence
from veduta.facade.plane_region import framed, plane_region
from veduta.geometry import homography, polygon
from veduta.geometry.homography import Matrix, Points
from veduta.imaging.plane_fit import PlaneFit, fit_plane, measure_plane
from veduta.imaging.read import Photo
from veduta.imaging.segments import DETECTION_SIDE_PX, Segments, detect_segments, joined
from veduta.imaging.warp import warp

HELD_OUT_PART = 0.25
SEED = 20091

_MIN_SEGMENTS = 24
_FRONTAL_SIDE_PX = 2000
"""Longest side of the frontal view: a wall that is strongly turned is longer there than the photo,
where its middle keeps its size."""

_MARGIN_PX = 5.0
"""In pixels of the frontal view. Nearer to where the plane's region ends (the end of the photo, or
of what is used of it), an edge may be that end."""

_MOST_MOVED_RAD = math.radians(5.0)
"""The second measurement moves the view by 0.9 degrees at most on twenty street photos."""

_AT_ONCE = 256
"""Segments that are compared with all others at once: it bounds the memory."""

_SAME_EDGE_PX = 3.0
"""In pixels of the detection: segments of one edge, found twice, lie nearer to each other."""


def find_plane(photo: Photo, focal_px: float | None) -> FacadePlane:
    """The dominant vertical plane; NotFoundError with the measured reason when there is none."""
    segments = detect_segments(photo.pixels)
    if len(segments) < _MIN_SEGMENTS:
        raise not_found(f"the photo has {len(segments)} straight edges, {_MIN_SEGMENTS} are needed")
    rng = np.random.default_rng(SEED)
    held_out = np.zeros(len(segments), dtype=np.bool_)
    count = max(1, round(HELD_OUT_PART * len(segments)))
    held_out[rng.permutation(len(segments))[:count]] = True
    return plane_of_segments(segments, held_out, photo, focal_px)


def plane_of_segments(
    segments: Segments, held_out: NDArray[np.bool_], photo: Photo, focal_px: float | None
) -> FacadePlane:
    """The same with the segments and the held-out ones (one at least) chosen by the caller.

    NotFoundError where they, or the held-out ones, show no facade.
    """
    height, width = photo.pixels.shape[:2]
    fit = fit_plane(segments.select(~held_out), (width, height), focal_px)
    if fit is None:
        raise not_found(
            "the straight edges of the photo have no two directions, level and upright, as a wall"
            " has"
        )
    plane = FacadePlane(fit, fit, segments, held_out)
    require_evidence(plane, math.hypot(width, height))
    return _measured_facing(plane, photo, focal_px)


def _measured_facing(plane: FacadePlane, photo: Photo, focal_px: float | None) -> FacadePlane:
    """The plane with the edges of the view that faces the wall."""
    height, width = photo.pixels.shape[:2]
    shrink = min(1.0, DETECTION_SIDE_PX / max(height, width))
    facing = _facing_segments(plane, photo, shrink)
    held_out = plane.segments.select(plane.held_out)
    others = facing.select(~_is_seen_in(facing, held_out, _SAME_EDGE_PX / shrink))
    others = joined(plane.segments.select(~plane.held_out), others)
    everything = joined(plane.segments, facing)
    fit, judged = (measure_plane(plane.fit, one, focal_px, times=2) for one in (everything, others))
    if any(_moved_rad(plane.fit, one) > _MOST_MOVED_RAD for one in (fit, judged)):
        return plane
    return replace(plane, fit=fit, judged=judged)


def _moved_rad(before: PlaneFit, after: PlaneFit) -> float:
    """The largest change of an angle of the view."""
    a, b = before.view, after.view
    return max(abs(a.yaw - b.yaw), abs(a.pitch - b.pitch), abs(a.roll - b.roll))


def _facing_segments(plane: FacadePlane, photo: Photo, shrink: float) -> Segments:
    """Segments found in the frontal view of the plane's region, in pixels of the photo."""
    height, width = photo.pixels.shape[:2]
    region = plane_region(plane, (width, height))
    frame, size = framed(plane, region, round(_FRONTAL_SIDE_PX / shrink))
    width_px, height_px = (max(1, round(side * shrink)) for side in size)
    facing_from_photo: Matrix = homography.scaling(shrink, shrink) @ frame
    pixels, _ = warp(photo.pixels, facing_from_photo, width_px, height_px)
    found = detect_segments(pixels, longest_side_px=_FRONTAL_SIDE_PX)
    border = homography.apply(facing_from_photo, region.polygon_px)
    inside = polygon.contains(border, found.start, _MARGIN_PX)
    inside &= polygon.contains(border, found.end, _MARGIN_PX)
    return found.select(inside).mapped(homography.inverse(facing_from_photo))


def _is_seen_in(segments: Segments, others: Segments, near_px: float) -> NDArray[np.bool_]:
    """(n,) whether a segment and one of the others lie side by side, if only in part.

    Where two overlap, an end of one lies within the other.
    """
    seen = np.zeros(len(segments), dtype=np.bool_)
    for first in range(0, len(segments), _AT_ONCE):
        some = slice(first, first + _AT_ONCE)
        few = Segments(segments.start[some], segments.end[some])
        for end, other_end in ((few.start, others.start), (few.end, others.end)):
            seen[some] |= _near(end, others, near_px).any(axis=1)
            seen[some] |= _near(other_end, few, near_px).any(axis=0)
    return seen


def _near(points: Points, segments: Segments, near_px: float) -> NDArray[np.bool_]:
    """(points, segments): within `near_px` of the segment, between its ends."""
    offset = points[:, None] - segments.midpoints()[None]
    direction = segments.directions()[None]
    along = np.abs((offset * direction).sum(axis=2))
    across = np.abs(offset[..., 0] * direction[..., 1] - offset[..., 1] * direction[..., 0])
    return np.asarray((along <= segments.lengths()[None] / 2) & (across <= near_px))
