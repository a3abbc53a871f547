"""The fronto-parallel view of the facade: given, from four corners, or from vanishing points."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from veduta.facade.document import Rectification
from veduta.facade.find_plane import find_plane
from veduta.facade.options import RectifyOptions
from veduta.facade.plane_region import framed, plane_region
from veduta.geometry import homography, polygon
from veduta.geometry.homography import Matrix
from veduta.geometry.rectangle import aspect_of_rectangle
from veduta.geometry.vanishing import axis_angles
from veduta.imaging.exif import focal_px_from_mm35
from veduta.imaging.padding import inside_photo
from veduta.imaging.plane_fit import aspect_error
from veduta.imaging.read import Photo
from veduta.imaging.segments import Segments, detect_segments
from veduta.imaging.warp import warp
from veduta.run.errors import InputError

MIN_SIDE_PX = 64

JUDGED_LENGTH_PART = 0.02
"""Of the diagonal: an end is known to about half a pixel, 30 px are known to about a degree."""

_FEWEST_JUDGED = 10
"""A median of fewer segments says nothing."""

CORNERS_OFF_DEG = 1.5
"""Over this, corners that a person gave are doubtful. Of 180 facades that were rectified well, 2
have more (the median is 0.5 to 1.0). Where each corner is off by 2 % of the facade's side, 30 to
50 % have, at 3 % 50 to 80 %, at 5 % 80 to 95 %."""

MIN_VALID_PART = 0.3
"""Outer rows and columns with less of the photo in them are cut off."""

# Nine of ten views of known cameras are right within this where the focal length is not known
# (benchmarks/results/rectify-cameras.md).
_LEAST_ASPECT_ERROR = 0.05


@dataclass(frozen=True)
class Rectified:
    """The rectified photo: (h, w, 3) uint8 sRGB; `valid` (h, w) is False outside the photo."""

    pixels: NDArray[np.uint8]
    record: Rectification
    valid: NDArray[np.bool_]
    notes: tuple[str, ...] = ()


def rectify(photo: Photo, options: RectifyOptions) -> Rectified:
    """Rectify a photo; NotFoundError without a facade plane, InputError when it is too small."""
    height, width = photo.pixels.shape[:2]
    if min(height, width) < MIN_SIDE_PX:
        raise InputError(
            photo.path,
            f"is {width} x {height} px",
            f"A facade needs at least {MIN_SIDE_PX} px a side.",
        )
    if options.rectified and options.corners is not None:
        raise InputError("--corners", "is given together with --rectified", "Give one of the two.")
    if options.rectified:
        return _as_given(photo, options)
    if options.corners is not None:
        return _from_corners(photo, options)
    return _from_vanishing_points(photo, options)


def known_focal_px(photo: Photo, options: RectifyOptions) -> float | None:
    """The focal length that the user states, else that of EXIF."""
    if options.focal_mm35 is not None:
        height, width = photo.pixels.shape[:2]
        return focal_px_from_mm35(options.focal_mm35, width, height)
    return photo.focal_px


def _as_given(photo: Photo, options: RectifyOptions) -> Rectified:
    height, width = photo.pixels.shape[:2]
    shrink = min(1.0, options.max_side_px / max(height, width))
    width_px, height_px = max(1, round(width * shrink)), max(1, round(height * shrink))
    scale = homography.scaling(width_px / width, height_px / height)
    given = _render(photo, scale, (width_px, height_px), "rectified", "given", None, ())
    return replace(given, valid=given.valid & inside_photo(given.pixels))


def _from_corners(photo: Photo, options: RectifyOptions) -> Rectified:
    corners = checked_corners(photo, options)
    focal_px = known_focal_px(photo, options)
    height, width = photo.pixels.shape[:2]
    if focal_px is not None:
        aspect = aspect_of_rectangle(corners, focal_px, (width / 2, height / 2))
        notes: tuple[str, ...] = ()
    else:
        edges = np.linalg.norm(np.roll(corners, -1, axis=0) - corners, axis=1)
        aspect = float((edges[0] + edges[2]) / (edges[1] + edges[3]))
        notes = ("no focal length: the aspect is that of the mean edge lengths of the corners",)
    target_width, target_height = _size_of_same_area(polygon.signed_area(corners), aspect)
    shrink = min(1.0, options.max_side_px / max(target_width, target_height))
    width_px = max(1, round(target_width * shrink))
    height_px = max(1, round(target_height * shrink))
    matrix = homography.from_points(corners, polygon.rectangle(0.0, 0.0, width_px, height_px))
    basis: Literal["focal-length", "assumed"] = "assumed" if focal_px is None else "focal-length"
    size = (width_px, height_px)
    off = residual_deg(detect_segments(photo.pixels), corners, (width, height), matrix)
    if off is not None and off > CORNERS_OFF_DEG:
        notes += (
            f"the corners are doubtful: between them, edges are {off:.1f} degrees off level or"
            f" upright in the median ({CORNERS_OFF_DEG:g} at most where they fit)",
        )
    return _render(photo, matrix, size, "corners", basis, focal_px, notes, off)


def _size_of_same_area(area: float, aspect: float) -> tuple[float, float]:
    """Width and height of a rectangle with the area and the ratio width / height."""
    return float(np.sqrt(area * aspect)), float(np.sqrt(area / aspect))


def checked_corners(photo: Photo, options: RectifyOptions) -> NDArray[np.float64]:
    """The corners as (4, 2); InputError when they are not a facade in the stated order."""
    corners = np.array(options.corners, dtype=np.float64).reshape(4, 2)
    height, width = photo.pixels.shape[:2]
    order = "Give upper left, upper right, lower right, lower left, as x y in photo pixels."
    if not np.isfinite(corners).all():
        raise InputError("--corners", "has a value that is not a finite number", order)
    reach = np.array([width, height], dtype=np.float64)
    if (corners < -reach).any() or (corners > 2 * reach).any():
        raise InputError("--corners", f"lies far outside the {width} x {height} px photo", order)
    if not polygon.is_strictly_convex(corners, tolerance=1e-3):
        raise InputError("--corners", "is not a convex quadrilateral", order)
    if polygon.signed_area(corners) < 0:
        raise InputError("--corners", "goes round the wrong way (a mirrored facade)", order)
    top, bottom = corners[:2].mean(axis=0), corners[2:].mean(axis=0)
    left, right = corners[[0, 3]].mean(axis=0), corners[1:3].mean(axis=0)
    if top[1] >= bottom[1] or left[0] >= right[0]:
        raise InputError("--corners", "starts at another corner than the upper left", order)
    if polygon.signed_area(corners) < MIN_SIDE_PX**2:
        raise InputError("--corners", "encloses too few pixels", order)
    return corners


def _from_vanishing_points(photo: Photo, options: RectifyOptions) -> Rectified:
    height, width = photo.pixels.shape[:2]
    focal_px = known_focal_px(photo, options)
    plane = find_plane(photo, focal_px)
    region = plane_region(plane, (width, height))
    rectified_from_source, size_px = framed(plane, region, options.max_side_px)
    basis: Literal["focal-length", "assumed"] = "assumed" if focal_px is None else "focal-length"
    notes = region.notes
    if focal_px is None:
        error = max(_LEAST_ASPECT_ERROR, 2 * aspect_error(plane.fit, region.middle_px[0]))
        notes += (f"no focal length: width against height may be off by {error:.0%}",)
    rectified = _render(
        photo,
        rectified_from_source,
        size_px,
        "vanishing-points",
        basis,
        plane.view.focal_px,
        notes,
        residual_deg(
            plane.segments.select(plane.held_out),
            region.polygon_px,
            (width, height),
            plane.judged_plane_from_image(),
        ),
    )
    return trimmed(rectified)


def residual_deg(
    segments: Segments,
    polygon_px: NDArray[np.float64],
    size_px: tuple[int, int],
    rectified_from_source: Matrix,
) -> float | None:
    """Median angle (degrees) of the segments in the polygon to the nearest image axis.

    Of those long enough that their own direction is known better than what is measured; None
    where there are too few. The segments must be others than those that the view was fitted to.
    `size_px` is (width, height) of the photo.
    """
    long_enough = segments.lengths() >= JUDGED_LENGTH_PART * math.hypot(*size_px)
    inside = polygon.contains(polygon_px, segments.start)
    inside &= polygon.contains(polygon_px, segments.end)
    judged = segments.select(inside & long_enough).mapped(rectified_from_source)
    if len(judged) < _FEWEST_JUDGED:
        return None
    return float(np.rad2deg(np.median(axis_angles(judged.directions()))))


def are_corners_doubtful(record: Rectification) -> bool:
    """Whether corners that a person gave leave edges of the facade that are not upright."""
    off = record.residual_deg
    return record.method == "corners" and off is not None and off > CORNERS_OFF_DEG


def trimmed(rectified: Rectified) -> Rectified:
    """Without the outer rows and columns that lie mostly outside the photo."""
    rows = np.flatnonzero(rectified.valid.mean(axis=1) >= MIN_VALID_PART)
    columns = np.flatnonzero(rectified.valid.mean(axis=0) >= MIN_VALID_PART)
    if not len(rows) or not len(columns):
        return rectified
    top, bottom = int(rows[0]), int(rows[-1]) + 1
    left, right = int(columns[0]), int(columns[-1]) + 1
    moved = homography.translation(-left, -top) @ np.array(rectified.record.rectified_from_source)
    record = rectified.record.model_copy(
        update={
            "width_px": right - left,
            "height_px": bottom - top,
            "rectified_from_source": homography.normalised(moved).tolist(),
        }
    )
    return replace(
        rectified,
        pixels=np.ascontiguousarray(rectified.pixels[top:bottom, left:right]),
        valid=np.ascontiguousarray(rectified.valid[top:bottom, left:right]),
        record=record,
    )


def _render(
    photo: Photo,
    rectified_from_source: Matrix,
    size_px: tuple[int, int],
    method: Literal["rectified", "corners", "vanishing-points"],
    aspect: Literal["given", "focal-length", "assumed"],
    focal_px: float | None,
    notes: tuple[str, ...],
    residual_deg: float | None = None,
) -> Rectified:
    height, width = photo.pixels.shape[:2]
    width_px, height_px = size_px
    if size_px == (width, height) and np.array_equal(rectified_from_source, np.eye(3)):
        pixels, valid = photo.pixels, np.ones((height, width), dtype=np.bool_)
    else:
        pixels, valid = warp(photo.pixels, rectified_from_source, width_px, height_px)
    record = Rectification(
        method=method,
        width_px=width_px,
        height_px=height_px,
        rectified_from_source=homography.normalised(rectified_from_source).tolist(),
        aspect=aspect,
        focal_px=focal_px,
        residual_deg=residual_deg,
    )
    return Rectified(pixels=pixels, record=record, valid=valid, notes=notes)
