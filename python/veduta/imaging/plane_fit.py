"""The view of the dominant vertical plane of a photo, from its line segments.

Maximum a posteriori over six numbers: yaw, pitch, roll, log focal length and the principal
point. Each segment runs along the wall or up the wall (the nearer one), with a robust
(Geman and McClure) penalty on its angle to that vanishing point; clutter is what is far from
both. The priors say what a photo is like when the segments do not: a phone's lens, a principal
point at the centre, a camera about level. They are weak, so "do nothing" wins only where the
evidence is weak. A focal length from EXIF is a narrow prior.

Twice: first to find the view, with weights that grow with the length, because clutter is short.
Then from there to measure it, with a scale for each segment: what its ends allow, and the scatter
of the wall's own edges as it is on the wall. A degree there is a fraction of one in the photo where
the edge runs away from the camera, and several where it lies across.

Rejected: two free vanishing points and the focal length from their orthogonality afterwards.
Near-frontal photos, the common case, then have an arbitrary or imaginary focal length.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from veduta.geometry import homography, vanishing
from veduta.geometry.vanishing import FacadeView
from veduta.imaging.segments import DETECTION_SIDE_PX, Segments
from veduta.imaging.vanishing import horizontal_candidates, vertical_candidates

_VERTICALS, _HORIZONTALS = 6, 5
_REFINED = 5
_TILTS_RAD = tuple(math.radians(v) for v in range(-30, 31, 4))
_DISTINCT_RAD = math.radians(4.0)
_MAX_YAW_RAD, _MAX_PITCH_RAD = math.radians(75.0), math.radians(50.0)
_ANNEALING_RAD = tuple(math.radians(v) for v in (3.0, 2.0, 1.2, 0.8))
_SCALE_RAD = math.radians(0.8)
_MAX_STEPS = 30
_END_NOISE_PX = 0.7

# Of 240 views of 60 facades of ECP and CMP under known cameras, none of them judged in
# `benchmarks photos/rectify`: the median error of a segment's direction is that of ends off by 0.35
# to 0.55 px at every length from 8 to 50 px. The scatter on the wall lies in a range of 0.9 to 1.2
# degrees that comes to the same (docs/facade-method.md).
_MEASURED_END_NOISE_PX = 0.5
_WALL_SCATTER_RAD = math.radians(1.0)
_MOST_FORESHORTENED = 4.0
"""At most so much more or less turns an edge in the photo than on the wall: the view that tells it
is not exact yet."""

_EVIDENCE = 0.25
"""Segments of one cornice are not independent: each counts for a quarter."""

_YAW_SIGMA, _PITCH_SIGMA, _ROLL_SIGMA = (math.radians(v) for v in (40.0, 15.0, 6.0))
_USUAL_FOCAL = 0.74
"""32 mm equivalent, as a part of the diagonal: between a phone and a standard lens."""

_USUAL_FOCAL_SIGMA = 0.35
_USUAL_CENTRE_SIGMA = 0.03
_KNOWN_FOCAL_SIGMA = 0.02
_KNOWN_CENTRE_SIGMA = 0.01

Vector = NDArray[np.float64]


@dataclass(frozen=True)
class PlaneFit:
    """The view, the (6, 6) covariance of (yaw, pitch, roll, log f, cx/d, cy/d), and its cost."""

    view: FacadeView
    covariance: NDArray[np.float64]
    cost: float
    size_px: tuple[int, int]


@dataclass(frozen=True)
class _Problem:
    """Segments in centred pixels / diagonal, and Gaussian priors on the six numbers."""

    middle: NDArray[np.float64]
    direction: NDArray[np.float64]
    weight: Vector
    noise_rad: Vector
    prior_mean: Vector
    prior_sigma: Vector


def fit_plane(
    segments: Segments,
    size_px: tuple[int, int],
    focal_px: float | None,
    seed: int = 0,
) -> PlaneFit | None:
    """Fit the view of the dominant plane; None when no two segments meet in each direction.

    `size_px` is (width, height) of the photo. Same arguments, same answer.
    """
    centred = segments.centred(size_px)
    problem = _problem(centred, math.hypot(*size_px), focal_px)
    starts = _starts(centred, problem, np.random.default_rng(seed))
    if not starts:
        return None
    annealed = [_annealed(problem, start) for start in starts]
    annealed.sort(key=lambda params: _cost(problem, params, _SCALE_RAD))
    ends = [_converged(problem, params, _SCALE_RAD) for params in annealed[:2]]
    found = min(ends, key=lambda params: _cost(problem, params, _SCALE_RAD))
    return _measured(problem, centred, size_px, found, 1)


def measure_plane(
    start: PlaneFit, segments: Segments, focal_px: float | None, times: int
) -> PlaneFit:
    """The view measured from `start` with other segments, in pixels of the photo.

    `times`: how often an edge is among them; what they say together counts for so much less.
    `focal_px` as for `fit_plane`.
    """
    centred = segments.centred(start.size_px)
    problem = _problem(centred, math.hypot(*start.size_px), focal_px)
    return _measured(problem, centred, start.size_px, _parameters(start), times)


def _measured(
    problem: _Problem, centred: Segments, size_px: tuple[int, int], start: Vector, times: int
) -> PlaneFit:
    measuring = _measuring(problem, centred, size_px, start, times)
    # The scatter is in the noise of each segment: nothing is added to it.
    best = _converged(measuring, start, 0.0)
    normal = _normal_equations(measuring, best, 0.0)[0]
    covariance = np.asarray(np.linalg.inv(normal), dtype=np.float64)
    return PlaneFit(_view(best, size_px), covariance, _cost(measuring, best, 0.0), size_px)


def _view(params: Vector, size_px: tuple[int, int]) -> FacadeView:
    width, height = size_px
    diagonal = math.hypot(width, height)
    yaw, pitch, roll, log_focal, cx, cy = (float(v) for v in params)
    return FacadeView(
        yaw=yaw,
        pitch=pitch,
        roll=roll,
        focal_px=math.exp(log_focal) * diagonal,
        centre_x_px=width / 2 + cx * diagonal,
        centre_y_px=height / 2 + cy * diagonal,
    )


def _parameters(fit: PlaneFit) -> Vector:
    """The six numbers of a fit: the inverse of `_view`."""
    view, (width, height) = fit.view, fit.size_px
    diagonal = math.hypot(width, height)
    centre_x = (view.centre_x_px - width / 2) / diagonal
    centre_y = (view.centre_y_px - height / 2) / diagonal
    log_focal = math.log(view.focal_px / diagonal)
    return np.array([view.yaw, view.pitch, view.roll, log_focal, centre_x, centre_y])


def aspect_error(fit: PlaneFit, at_px: NDArray[np.float64]) -> float:
    """Standard deviation of log(width / height) of a small piece of wall seen at a pixel (2,)."""
    mean = _parameters(fit)
    gradient = np.empty(6)
    for i in range(6):
        step = np.zeros(6)
        step[i] = 1e-4
        ahead = _log_aspect(_view(mean + step, fit.size_px), at_px)
        gradient[i] = (ahead - _log_aspect(_view(mean - step, fit.size_px), at_px)) / 2e-4
    return math.sqrt(float(gradient @ fit.covariance @ gradient))


def _log_aspect(view: FacadeView, at_px: NDArray[np.float64]) -> float:
    """log of metres on the wall per pixel across over metres per pixel up, at a pixel."""
    plane_from_image = vanishing.plane_from_image(view)
    steps = np.array([[0.0, 0.0], [0.5, 0.0], [0.0, 0.5]]) + at_px
    origin, across, up = homography.apply(plane_from_image, steps)
    return math.log(float(np.linalg.norm(across - origin)) / float(np.linalg.norm(up - origin)))


def segment_weights(segments: Segments, diagonal: float) -> Vector:
    """Length as a part of the diagonal, capped: one gutter is not the whole wall."""
    return np.asarray(np.minimum(segments.lengths() / diagonal, 0.1))


def _problem(centred: Segments, diagonal: float, focal_px: float | None) -> _Problem:
    known = focal_px is not None
    log_focal = math.log(focal_px / diagonal if focal_px is not None else _USUAL_FOCAL)
    focal_sigma = _KNOWN_FOCAL_SIGMA if known else _USUAL_FOCAL_SIGMA
    centre_sigma = _KNOWN_CENTRE_SIGMA if known else _USUAL_CENTRE_SIGMA
    lengths = centred.lengths()
    return _Problem(
        middle=centred.midpoints(),
        direction=centred.directions(),
        weight=_EVIDENCE * segment_weights(centred, 1.0) / 0.03,
        noise_rad=np.asarray(_END_NOISE_PX / np.maximum(lengths * diagonal, 1.0)),
        prior_mean=np.array([0.0, 0.0, 0.0, log_focal, 0.0, 0.0]),
        prior_sigma=np.array(
            [_YAW_SIGMA, _PITCH_SIGMA, _ROLL_SIGMA, focal_sigma, centre_sigma, centre_sigma]
        ),
    )


def _measuring(
    problem: _Problem, centred: Segments, size_px: tuple[int, int], start: Vector, times: int
) -> _Problem:
    """The same problem with each segment as certain as its ends and the wall make it."""
    detected_side_px = min(DETECTION_SIDE_PX, max(size_px))
    detected_diagonal_px = math.hypot(*size_px) * detected_side_px / max(size_px)
    lengths_px = np.maximum(centred.lengths() * detected_diagonal_px, 1.0)
    scatter = _WALL_SCATTER_RAD * _degrees_per_degree_of_wall(problem, start)
    weight = np.sqrt(lengths_px)
    return replace(
        problem,
        weight=np.asarray(_EVIDENCE / times * weight / weight.mean()),
        noise_rad=np.hypot(scatter, _MEASURED_END_NOISE_PX / lengths_px),
    )


def _degrees_per_degree_of_wall(problem: _Problem, params: Vector) -> Vector:
    """(n,) how far each segment turns in the photo when its edge turns on the wall, bounded."""
    step = 1e-4
    camera = vanishing.camera_matrix(math.exp(params[3]), params[4], params[5])
    points = camera @ vanishing.rotation_from_angles(params[0], params[1], params[2])
    turned = points[:, :2] @ np.array([[1.0, -step], [step, 1.0]])
    at = problem.middle, problem.direction
    along, up = _angles(problem, params)
    turn_along = vanishing.angles_to_vanishing_point(*at, turned[:, 0]) - along
    turn_up = vanishing.angles_to_vanishing_point(*at, turned[:, 1]) - up
    turn = np.abs(np.where(np.abs(up) < np.abs(along), turn_up, turn_along)) / step
    return np.asarray(np.clip(turn, 1.0 / _MOST_FORESHORTENED, _MOST_FORESHORTENED))


def _starts(centred: Segments, problem: _Problem, rng: np.random.Generator) -> list[Vector]:
    """The cheapest distinct guesses, each as the six numbers.

    Every horizontal candidate goes with every vertical one, and with a sweep of tilts about it:
    where a wall has few verticals of its own, something else's win the vertical RANSAC.
    """
    verticals = vertical_candidates(centred, problem.weight, _VERTICALS, rng)
    horizontals = horizontal_candidates(centred, problem.weight, _HORIZONTALS, rng)
    if not len(verticals.points) or not len(horizontals.points):
        return []
    starts = [problem.prior_mean.copy()]
    for horizontal in horizontals.points:
        for vertical in verticals.points:
            starts += _start(problem, horizontal, vertical)
        for tilt in _TILTS_RAD:
            up = np.array([0.0, math.cos(tilt), math.sin(tilt) / math.exp(problem.prior_mean[3])])
            starts += _start(problem, horizontal, up)
    starts.sort(key=lambda params: _cost(problem, params, _ANNEALING_RAD[0]))
    kept: list[Vector] = []
    for start in starts:
        if all(float(np.abs(start - other)[:3].max()) > _DISTINCT_RAD for other in kept):
            kept.append(start)
    return kept[:_REFINED]


def _start(
    problem: _Problem, horizontal: NDArray[np.float64], vertical: NDArray[np.float64]
) -> list[Vector]:
    """Angles under the focal length that makes the pair orthogonal where it is a likely one."""
    usual = problem.prior_mean[3]
    focal = vanishing.focal_from_orthogonal(vertical, horizontal, (0.0, 0.0))
    log_focal = usual
    if focal is not None and abs(math.log(focal) - usual) < 2.0 * problem.prior_sigma[3]:
        log_focal = math.log(focal)
    camera = vanishing.camera_matrix(math.exp(log_focal), 0.0, 0.0)
    rotation = vanishing.rotation_from_vanishing_points(camera, horizontal, vertical)
    if rotation is None:
        return []
    yaw, pitch, roll = vanishing.angles_from_rotation(rotation)
    if abs(yaw) > _MAX_YAW_RAD or abs(pitch) > _MAX_PITCH_RAD:
        return []
    return [np.array([yaw, pitch, roll, log_focal, 0.0, 0.0])]


def _annealed(problem: _Problem, start: Vector) -> Vector:
    """A few steps from a wide to a narrow scale: enough to tell good starts from bad ones."""
    params = start
    for scale in _ANNEALING_RAD:
        params = _step(problem, params, scale)
    return params


def _converged(problem: _Problem, start: Vector, scale_rad: float) -> Vector:
    """Steps at one scale until nothing moves."""
    params = start
    for _ in range(_MAX_STEPS):
        before = params
        params = _step(problem, params, scale_rad)
        if float(np.abs(params - before).max()) < 1e-5:
            break
    return params


def _step(problem: _Problem, params: Vector, scale_rad: float) -> Vector:
    """One step, halved until the cost falls; the same numbers where it does not."""
    normal, gradient = _normal_equations(problem, params, scale_rad)
    step = np.linalg.solve(normal, gradient)
    cost = _cost(problem, params, scale_rad)
    for _ in range(5):
        trial = np.asarray(params - step, dtype=np.float64)
        if _cost(problem, trial, scale_rad) < cost:
            return trial
        step = step / 2.0
    return params


def _angles(problem: _Problem, params: Vector) -> tuple[Vector, Vector]:
    """(n,) signed angles of each segment to the horizontal and the vertical vanishing point."""
    rotation = vanishing.rotation_from_angles(params[0], params[1], params[2])
    camera = vanishing.camera_matrix(math.exp(params[3]), params[4], params[5])
    points = camera @ rotation
    along = vanishing.angles_to_vanishing_point(problem.middle, problem.direction, points[:, 0])
    up = vanishing.angles_to_vanishing_point(problem.middle, problem.direction, points[:, 1])
    return along, up


def _cost(problem: _Problem, params: Vector, scale_rad: float) -> float:
    along, up = _angles(problem, params)
    angle = np.minimum(np.abs(along), np.abs(up))
    ratio = angle**2 / (scale_rad**2 + problem.noise_rad**2)
    prior = (params - problem.prior_mean) / problem.prior_sigma
    return float((problem.weight * ratio / (1.0 + ratio)).sum() + (prior**2).sum())


def _normal_equations(
    problem: _Problem, params: Vector, scale_rad: float
) -> tuple[NDArray[np.float64], Vector]:
    """J^T W J and J^T W r of segments and priors; Jacobian by central differences."""
    along, up = _angles(problem, params)
    is_up = np.abs(up) < np.abs(along)
    residual = np.where(is_up, up, along)
    jacobian = np.empty((len(residual), 6))
    for i in range(6):
        step = np.zeros(6)
        step[i] = 1e-5
        ahead, behind = _angles(problem, params + step), _angles(problem, params - step)
        difference = np.where(is_up, ahead[1] - behind[1], ahead[0] - behind[0])
        jacobian[:, i] = difference / 2e-5
    variance = scale_rad**2 + problem.noise_rad**2
    weight = problem.weight / variance / (1.0 + residual**2 / variance) ** 2
    precision = np.diag(1.0 / problem.prior_sigma**2)
    normal = jacobian.T @ (weight[:, None] * jacobian) + precision
    gradient = jacobian.T @ (weight * residual) + precision @ (params - problem.prior_mean)
    return normal, gradient
