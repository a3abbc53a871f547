"""Finding the facade's plane in a photo, and deciding whether there is one at all."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.geometry import vanishing
from veduta.geometry.homography import Matrix
from veduta.geometry.vanishing import FacadeView
from veduta.imaging.plane_fit import PlaneFit, fit_plane, segment_weights
from veduta.imaging.read import Photo
from veduta.imaging.segments import Segments, detect_segments
from veduta.run.errors import NotFoundError

HELD_OUT_PART = 0.25
SEED = 20091

_NEAR_RAD = math.radians(2.0)
_MIN_SEGMENTS = 24
_MIN_NEAR_PART = 0.30
"""Of the length of the held-out segments. Facades have 0.49 to 0.93 (seen from any side, behind
trees), a portal 0.53; rocks, noise and random lines at most 0.10, a drawn meadow 0.17."""

_MIN_NEAR_PART_EACH = 0.06
"""Grass and trunks run upwards but not along anything: 0.02 in the drawn meadow."""

_REMEDY = (
    "Give the four corners of the facade with --corners, or another photo; "
    "--rectified where it is seen from straight in front already."
)


@dataclass(frozen=True)
class FacadePlane:
    """The fitted view, all segments of the photo, and which of them the fit did not use."""

    fit: PlaneFit
    segments: Segments
    held_out: NDArray[np.bool_]

    @property
    def view(self) -> FacadeView:
        """The camera and its rotation against the wall."""
        return self.fit.view

    def plane_from_image(self) -> Matrix:
        """Takes photo pixels to the wall, in units of the camera's distance."""
        return vanishing.plane_from_image(self.view)

    def angles(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """(n,) absolute angles (radians) of the segments to "along the wall" and "up the wall"."""
        points = self.view.camera() @ self.view.rotation()
        middle, direction = self.segments.midpoints(), self.segments.directions()
        along = vanishing.angles_to_vanishing_point(middle, direction, points[:, 0])
        up = vanishing.angles_to_vanishing_point(middle, direction, points[:, 1])
        return np.abs(along), np.abs(up)


def find_plane(photo: Photo, focal_px: float | None) -> FacadePlane:
    """The dominant vertical plane; NotFoundError with the measured reason when there is none."""
    segments = detect_segments(photo.pixels)
    if len(segments) < _MIN_SEGMENTS:
        raise _not_found(
            f"the photo has {len(segments)} straight edges, {_MIN_SEGMENTS} are needed"
        )
    rng = np.random.default_rng(SEED)
    held_out = np.zeros(len(segments), dtype=np.bool_)
    count = max(1, round(HELD_OUT_PART * len(segments)))
    held_out[rng.permutation(len(segments))[:count]] = True
    return plane_of_segments(segments, held_out, photo, focal_px)


def plane_of_segments(
    segments: Segments, held_out: NDArray[np.bool_], photo: Photo, focal_px: float | None
) -> FacadePlane:
    """The same with the segments and the held-out ones chosen by the caller."""
    height, width = photo.pixels.shape[:2]
    fit = fit_plane(segments.select(~held_out), (width, height), focal_px)
    if fit is None:
        raise _not_found("no two directions of straight edges")
    plane = FacadePlane(fit, segments, held_out)
    _require_evidence(plane, math.hypot(width, height))
    return plane


def _require_evidence(plane: FacadePlane, diagonal_px: float) -> None:
    """Held-out segments must run along or up the wall more often than chance makes them."""
    weights = segment_weights(plane.segments, diagonal_px)[plane.held_out]
    along, up = (angles[plane.held_out] < _NEAR_RAD for angles in plane.angles())
    total = float(weights.sum())
    part_along = float(weights[along].sum()) / total
    part_up = float(weights[up & ~along].sum()) / total
    if part_along + part_up < _MIN_NEAR_PART or min(part_along, part_up) < _MIN_NEAR_PART_EACH:
        raise _not_found(
            f"{part_along:.0%} of the straight edges run along one wall and {part_up:.0%} up it "
            f"(a facade has {_MIN_NEAR_PART:.0%} or more together, "
            f"{_MIN_NEAR_PART_EACH:.0%} or more each)"
        )


def _not_found(evidence: str) -> NotFoundError:
    return NotFoundError("a facade plane", evidence, _REMEDY)
