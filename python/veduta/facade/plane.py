"""The plane that was fitted to a photo, and whether it is a facade's at all."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.geometry import vanishing
from veduta.geometry.homography import Matrix
from veduta.geometry.vanishing import FacadeView
from veduta.imaging.plane_fit import PlaneFit, segment_weights
from veduta.imaging.segments import Segments
from veduta.run.errors import NotFoundError

_NEAR_RAD = math.radians(2.0)
_MIN_NEAR_PART = 0.30
"""Of the length of the held-out segments. Facades have 0.49 to 0.93 (seen from any side, behind
trees), a portal 0.53; rocks, noise and random lines at most 0.10, a drawn meadow 0.17."""

_MIN_NEAR_PART_EACH = 0.06
"""Grass and trunks run upwards but not along anything: 0.02 in the drawn meadow."""

_MIN_UP_OF_REST = 0.25
"""Of what does not run along the wall. Walls of many level courses have few uprights beside them:
0.03 to 0.06 of all on three of 240 pictures of CMP, and there 0.32 to 0.86 of the rest."""

_MIN_UP_PART = 0.025
"""Even so: blinds and furrows have one upright in a hundred."""

_REMEDY = (
    "Give the four corners of the facade with --corners, or another photo; "
    "--rectified where it is seen from straight in front already."
)


@dataclass(frozen=True)
class FacadePlane:
    """The fitted view, and all segments of the photo.

    `judged` is the same view measured without the held-out segments: what they say of it is what
    other edges would say. `fit` uses them too.
    """

    fit: PlaneFit
    judged: PlaneFit
    segments: Segments
    held_out: NDArray[np.bool_]

    @property
    def view(self) -> FacadeView:
        """The camera and its rotation against the wall."""
        return self.fit.view

    def plane_from_image(self) -> Matrix:
        """Takes photo pixels to the wall, in units of the camera's distance."""
        return vanishing.plane_from_image(self.view)

    def judged_plane_from_image(self) -> Matrix:
        """The same of the view that the held-out segments have no part in."""
        return vanishing.plane_from_image(self.judged.view)

    def angles(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """(n,) absolute angles (radians) of the segments to "along the wall" and "up the wall"."""
        points = self.view.camera() @ self.view.rotation()
        middle, direction = self.segments.midpoints(), self.segments.directions()
        along = vanishing.angles_to_vanishing_point(middle, direction, points[:, 0])
        up = vanishing.angles_to_vanishing_point(middle, direction, points[:, 1])
        return np.abs(along), np.abs(up)


def require_evidence(plane: FacadePlane, diagonal_px: float) -> None:
    """Held-out segments must run along or up the wall more often than chance makes them.

    NotFoundError where they do not. At least one segment must be held out.
    """
    weights = segment_weights(plane.segments, diagonal_px)[plane.held_out]
    along, up = (angles[plane.held_out] < _NEAR_RAD for angles in plane.angles())
    total = float(weights.sum())
    part_along = float(weights[along].sum()) / total
    part_up = float(weights[up & ~along].sum()) / total
    least_of_rest = max(_MIN_UP_PART, _MIN_UP_OF_REST * (1.0 - part_along))
    least_up = min(_MIN_NEAR_PART_EACH, least_of_rest)
    is_each = part_up >= least_up and part_along >= _MIN_NEAR_PART_EACH
    if part_along + part_up < _MIN_NEAR_PART or not is_each:
        raise not_found(
            "the photo cannot be turned to a view from straight ahead: too few lines of one wall "
            f"are seen in it: {part_along:.0%} of the straight edges are its level ones and "
            f"{part_up:.0%} its upright ones (a facade has {_MIN_NEAR_PART:.0%} or more together, "
            f"{_MIN_NEAR_PART_EACH:.0%} level and {least_up:.1%} upright at least)"
        )


def not_found(evidence: str) -> NotFoundError:
    """The error that says what of a facade is missing, and what to do."""
    return NotFoundError("a facade plane", evidence, _REMEDY)
