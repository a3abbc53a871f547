"""Laying a component to where GPS says that its photos were taken.

Up is better known from how the photos were held than from GPS: photos along a street leave the roll
about it open, and GPS heights are poor. So the fit is level: scale, turn and shift in the plane by
pairs (RANSAC) and an M-estimator; the height alone, by the median.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.photos.structure import Structure
from veduta.photos.world.columns import Complex, Placements, complex_of, plane_fit
from veduta.photos.world.gauss_newton import UP_SD_RAD
from veduta.photos.world.georeference import Fit, Georeference, Residual, Similarity
from veduta.photos.world.gps_positions import GpsPositions
from veduta.photos.world.prior import PlacementPrior

FEWEST = 4
LEAST_SD_M = 1.0
"""GPS of a hand-held device is no better than this, whatever the residuals say."""
DRIFT_SD_M, HEIGHT_DRIFT_SD_M = 3.0, 10.0
"""What the positions of one walk err together: no residual shows it."""
HUBER = 1.345
DRAWS = 500
INLIER_M = 10.0
LEAST_INLIERS = 0.5
MOST_SCALE_SD, MOST_TURN_SD_RAD = 0.1, np.deg2rad(6.0)
ITERATIONS = 20


@dataclass(frozen=True)
class _Level:
    """placement: of one. left_m: (k,). sd_m: of one position each way. weight: (k,)."""

    placement: Placements
    left_m: NDArray[np.float64]
    sd_m: float
    weight: NDArray[np.float64]
    turn_sd: float


def gps_georeference(
    structure: Structure, positions: GpsPositions, seed: int
) -> tuple[Georeference, PlacementPrior | None]:
    """The fit with its uncertainty, and what it says beforehand to a search among walls."""
    # Views of a panorama, and photos of one frame of a rig, are of one place.
    taken = len(np.unique(structure.by_frame()[positions.rows]))
    if taken < FEWEST:
        what = "placed photos" if taken == len(positions.rows) else "panoramas or frames of the rig"
        why = f"only {taken} {what} have GPS, of {FEWEST} that it takes"
        return _refused(positions, why), None
    centres = structure.centres()
    own = complex_of(centres[positions.rows, :2])
    there = complex_of(positions.east_north)
    if float(np.abs(there - there.mean()).max()) < 1e-6 or np.abs(own - own.mean()).max() < 1e-9:
        return _refused(positions, "all photos have one and the same position"), None
    level = _level(own, there, seed)
    middle = centres.mean(axis=0)
    fit = _fit(structure, positions, level, middle)
    flat = complex(middle[0], middle[1])
    turn = complex(level.placement.turn[0])
    prior = PlacementPrior(
        turn=turn,
        there=turn * flat + complex(level.placement.shift[0]),
        turn_sd_rad=level.turn_sd,
        scale_sd=level.turn_sd,
        there_sd_m=float(np.hypot(fit.shift_sd_m[0], fit.shift_sd_m[1])),
    )
    inliers = float((level.left_m < max(INLIER_M, 3.0 * LEAST_SD_M)).mean())
    accepted, why = _believed(level, inliers, len(own))
    found = Georeference("gps", accepted, why, positions.crs, positions.origin_m, fit)
    return found, prior if inliers >= LEAST_INLIERS else None


def _refused(positions: GpsPositions, why: str) -> Georeference:
    return Georeference("gps", False, why, positions.crs, positions.origin_m, None)


def _level(own: Complex, there: Complex, seed: int) -> _Level:
    """RANSAC over pairs of photos, then weights by Huber with the deviation of the residuals."""
    rng = np.random.default_rng(seed)
    pairs = rng.integers(0, len(own), (DRAWS, 2))
    pairs = pairs[np.abs(own[pairs[:, 0]] - own[pairs[:, 1]]) > 1e-9]
    drawn = plane_fit(own[pairs], there[pairs])
    left = np.abs(drawn.moved(own) - there)
    cost = np.minimum(left / INLIER_M, 1.0) ** 2
    best = int(cost.sum(axis=1).argmin()) if len(cost) else 0
    weight = (left[best] < INLIER_M).astype(float) if len(cost) else np.ones(len(own))
    if weight.sum() < 2:
        weight = np.ones(len(own))
    placement, sd = _weighted(own, there, weight), LEAST_SD_M
    for _ in range(ITERATIONS):
        left_now = np.abs(placement.moved(own)[0] - there)
        # The middle of the lengths of normal pairs is 1.1774 deviations each way.
        spare = np.sqrt(len(own) / max(1.0, len(own) - 2.0))
        sd = max(LEAST_SD_M, float(np.median(left_now[left_now < 5 * INLIER_M])) / 1.1774 * spare)
        weight = np.minimum(1.0, HUBER * sd / np.maximum(left_now, 1e-9))
        weight[left_now > 5.0 * sd] = 0.0
        placement = _weighted(own, there, weight)
    left_m = np.abs(placement.moved(own)[0] - there)
    about = own - (weight * own).sum() / weight.sum()
    size = np.abs(placement.turn[0]) * np.sqrt((weight * np.abs(about) ** 2).sum())
    return _Level(placement, left_m, sd, weight, sd / max(float(size), 1e-9))


def _weighted(own: Complex, there: Complex, weight: NDArray[np.float64]) -> Placements:
    """The weighted absolute orientation in the plane."""
    total = weight.sum()
    mean, target = (weight * own).sum() / total, (weight * there).sum() / total
    about, to = own - mean, there - target
    turn = (weight * np.conj(about) * to).sum() / max(
        float((weight * np.abs(about) ** 2).sum()), 1e-300
    )
    return Placements(np.array([turn]), np.array([target - turn * mean]))


def _fit(
    structure: Structure, positions: GpsPositions, level: _Level, middle: NDArray[np.float64]
) -> Fit:
    turn = complex(level.placement.turn[0])
    scale, angle = abs(turn), float(np.angle(turn))
    c, s = np.cos(angle), np.sin(angle)
    centres = structure.centres()[positions.rows]
    told = np.isfinite(positions.height)
    lift, lift_sd = _lift(structure, positions.height[told] - scale * centres[told, 2], scale)
    shift = complex(level.placement.shift[0])
    world_from_model = Similarity(
        scale,
        np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]]),
        np.array([shift.real, shift.imag, lift]),
    )
    sd = float(np.hypot(level.sd_m / np.sqrt(max(level.weight.sum(), 1.0)), DRIFT_SD_M))
    names = [structure.names[row] for row in positions.rows.tolist()]
    counted = level.weight > 0.0
    return Fit(
        world_from_model,
        scale_sd=level.turn_sd,
        rotation_sd_rad=np.array([UP_SD_RAD, UP_SD_RAD, level.turn_sd]),
        shift_sd_m=np.array([sd, sd, lift_sd]),
        rms_m=float(np.sqrt(np.mean(level.left_m[counted] ** 2))),
        score=float(counted.mean()),
        residuals=tuple(
            Residual(name, float(left)) for name, left in zip(names, level.left_m, strict=True)
        ),
    )


def _lift(structure: Structure, lifts: NDArray[np.float64], scale: float) -> tuple[float, float]:
    """The height of the structure's zero and its deviation; the lowest points lie at zero where no
    height is told.
    """
    if len(lifts) == 0:
        return -scale * float(np.quantile(structure.points[:, 2], 0.01)), 100.0
    middle = float(np.median(lifts))
    spread = 1.4826 * float(np.median(np.abs(lifts - middle))) / np.sqrt(len(lifts))
    return middle, float(np.hypot(max(spread, LEAST_SD_M), HEIGHT_DRIFT_SD_M))


def _believed(level: _Level, inliers: float, count: int) -> tuple[bool, str]:
    if inliers < LEAST_INLIERS:
        return False, (
            f"GPS contradicts the photos: {100 * (1 - inliers):.0f} % of its positions lie more"
            f" than {INLIER_M:.0f} m off the best fit"
        )
    if level.turn_sd > min(MOST_SCALE_SD, MOST_TURN_SD_RAD):
        return False, (
            f"the photos were taken too near to each other for an error of {level.sd_m:.1f} m:"
            f" direction and scale stay open by {np.rad2deg(level.turn_sd):.0f} degrees and"
            f" {100 * level.turn_sd:.0f} %"
        )
    return True, (
        f"{count} positions, {level.sd_m:.1f} m off each way; direction and scale are known to"
        f" {np.rad2deg(level.turn_sd):.1f} degrees and {100 * level.turn_sd:.1f} %"
    )
