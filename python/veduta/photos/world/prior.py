"""What is known of a placement beforehand, and how many placements it leaves to choose from."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.photos.city.facades import Facades
from veduta.photos.world.columns import Placements

CELL_M, CELL_TURN_RAD, CELL_SCALE = 0.5, np.deg2rad(1.0), 0.03
"""Placements that differ by less are told apart by no wall."""
FREE_SCALES = 2.0
"""Logarithm of the range of scales that are thinkable where nothing is known of it."""
LEAST_TURN_RAD, LEAST_SCALE = np.deg2rad(12.0), 0.2
"""What is let pass at least beside a prior's turn and logarithm of scale."""
DEVIATIONS = 4.0
POSE_MOST_SD = 0.1
"""Of turn (radians) and of the logarithm of scale: as much as GPS is believed with."""
MOST_DRIFT_M = 15.0
"""GPS may be off together by as much among buildings."""


@dataclass(frozen=True)
class PlacementPrior:
    """A placement from GPS: turn is complex, its length the scale; there: of the photos' middle.

    turn_sd_rad, scale_sd (relative), there_sd_m: one deviation each.
    """

    turn: complex
    there: complex
    turn_sd_rad: float
    scale_sd: float
    there_sd_m: float

    @property
    def is_pose(self) -> bool:
        """Whether it says so much that what lies about it can be looked through."""
        return max(self.turn_sd_rad, self.scale_sd) <= POSE_MOST_SD

    @property
    def reach_m(self) -> float:
        """How far off the middle may be."""
        return MOST_DRIFT_M + DEVIATIONS * self.there_sd_m

    @property
    def turn_reach_rad(self) -> float:
        """How far off the turn may be."""
        return max(float(LEAST_TURN_RAD), DEVIATIONS * self.turn_sd_rad)

    @property
    def scale_reach(self) -> float:
        """How far off the logarithm of the scale may be."""
        return max(LEAST_SCALE, DEVIATIONS * self.scale_sd)

    def allows(self, placements: Placements, middle: complex) -> NDArray[np.bool_]:
        """(h,) which placements of a structure with this middle are near enough."""
        there = placements.turn * middle + placements.shift
        found: NDArray[np.bool_] = (
            (np.abs(there - self.there) <= self.reach_m)
            & (np.abs(np.angle(placements.turn / self.turn)) <= self.turn_reach_rad)
            & (np.abs(np.log(np.abs(placements.turn) / abs(self.turn))) <= self.scale_reach)
        )
        return found


def log_cells(facades: Facades, prior: PlacementPrior | None) -> float:
    """Logarithm of the number of placements that walls could tell apart: what chance has to draw
    from.
    """
    if prior is None:
        size = np.ptp(np.concatenate([facades.start, facades.end]), axis=0) + 20.0
        area, turns, scales = float(size.prod()), 2.0 * np.pi, FREE_SCALES
    else:
        area = float(np.pi * prior.reach_m**2)
        turns = min(2.0 * np.pi, 2.0 * prior.turn_reach_rad)
        scales = min(FREE_SCALES, 2.0 * prior.scale_reach)
    cells = area / CELL_M**2 * (turns / CELL_TURN_RAD) * (scales / CELL_SCALE)
    return float(np.log(max(cells, 1.0)))


POSE_DEVIATIONS = 2.0
POSE_SHIFT_M, POSE_TURN_RAD, POSE_SCALE = 1.0, np.deg2rad(2.0), 0.04
"""Steps between the placements that a pose stands for: refinement bridges half of each."""
MOST_STEPS = 8
"""On each side of the middle, of turns and of scales."""


def pose_placements(prior: PlacementPrior, middle: complex) -> Placements:
    """The placements about the pose itself, within two deviations, on a grid."""
    radius = POSE_DEVIATIONS * prior.there_sd_m / np.sqrt(2.0)
    count = int(radius / POSE_SHIFT_M)
    steps = np.arange(-count, count + 1)
    east, north = np.meshgrid(POSE_SHIFT_M * steps, POSE_SHIFT_M * steps)
    shift = (east + 1j * north).ravel()
    shift = shift[np.abs(shift) <= radius]
    turns = _about_zero(POSE_DEVIATIONS * prior.turn_sd_rad, float(POSE_TURN_RAD))
    scales = _about_zero(POSE_DEVIATIONS * prior.scale_sd, POSE_SCALE)
    factor = prior.turn * np.exp(scales[:, None] + 1j * turns[None]).ravel()
    turn = np.repeat(factor, len(shift))
    there = np.tile(prior.there + shift, len(factor))
    return Placements(turn, there - turn * middle)


def _about_zero(reach: float, step: float) -> NDArray[np.float64]:
    count = min(MOST_STEPS, int(np.ceil(reach / step - 0.5)))
    found: NDArray[np.float64] = step * np.arange(-count, count + 1, dtype=np.float64)
    return found
