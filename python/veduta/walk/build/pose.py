"""Relative pose of two key positions (section 3.3): a robust start, then the reprojection minimised."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from veduta.run.errors import NotFoundError
from veduta.walk.build.local_model import LocalModel
from veduta.walk.build.matches import Matches
from veduta.walk.rig import Rig

Matrix = NDArray[np.float64]


@dataclass(frozen=True)
class PoseSettings:
    """limit_px: of an inlier to the start. fewest: inliers with which a pose is believed. draws: of
    the robust start. huber_px: beyond it a residual counts linearly. disparity_px: how much less
    sure a disparity is than a place in a picture (a factor). farthest: points beyond so many
    baselines say nothing of the translation but turn with the camera.
    """

    limit_px: float = 3.0
    fewest: int = 20
    draws: int = 2000
    huber_px: float = 0.7
    disparity: float = 1.5
    rounds: int = 25
    share: float = 0.12


@dataclass(frozen=True, eq=False)
class Pose:
    """second_from_first: (3, 4) of the left cameras, metres. inliers: of the matches, (n,).

    residual_px: root mean square of the inliers' reprojection. matches: those that it comes from.
    """

    second_from_first: Matrix
    matches: Matches
    inliers: NDArray[np.bool_]
    residual_px: float

    @property
    def distance_m(self) -> float:
        """How far the second camera is from the first."""
        return float(np.linalg.norm(self.second_from_first[:, 3]))


def relative_pose(
    first: LocalModel, second: LocalModel, rig: Rig, matches: Matches,
    settings: PoseSettings = PoseSettings(),
) -> Pose:  # fmt: skip
    """PnP with draws, then both stereo pairs' reprojection of the points minimised.

    NotFoundError where too few matches agree on any pose.
    """
    depth = _depth_at(first, matches.first)
    known = np.asarray(np.isfinite(depth))
    if known.sum() < settings.fewest:
        raise _nothing(int(known.sum()), settings)
    usable = matches.only(known)
    points = first.screen.points(usable.first, depth[known])
    cv2.setRNGSeed(1)
    found, turn, move, inliers = cv2.solvePnPRansac(
        points, usable.second - 0.5, _corner_matrix(second), None, iterationsCount=settings.draws,
        reprojectionError=settings.limit_px, confidence=0.9999, flags=cv2.SOLVEPNP_AP3P,
    )  # fmt: skip
    count = 0 if not found or inliers is None else len(inliers)
    if count < max(settings.fewest, settings.share * len(usable)):
        raise _nothing(count, settings)
    start = np.column_stack([cv2.Rodrigues(turn)[0], np.asarray(move).ravel()])
    return refine_pose(start, first, second, rig, usable, settings)


def _nothing(count: int, settings: PoseSettings) -> NotFoundError:
    return NotFoundError(
        "the way from one key position to the next",
        f"{count} matches agree on it, and {settings.fewest} are wanted",
        "Take pictures that show more of the same.",
    )


def _corner_matrix(model: LocalModel) -> Matrix:
    matrix = model.screen.matrix
    matrix[:2, 2] -= 0.5
    return matrix


def _depth_at(model: LocalModel, pixels: Matrix) -> Matrix:
    """Depth at points of the picture, where stereo is sure and nearly flat around; else NaN."""
    depth = np.where(model.measured, model.depth_m, np.nan)
    samples = []
    for dx, dy in ((0, 0), (1, 0), (-1, 0), (0, 1), (0, -1)):
        columns = np.clip(np.floor(pixels[:, 0]).astype(int) + dx, 0, depth.shape[1] - 1)
        rows = np.clip(np.floor(pixels[:, 1]).astype(int) + dy, 0, depth.shape[0] - 1)
        samples.append(depth[rows, columns])
    around = np.array(samples)
    steep = around.max(axis=0) - around.min(axis=0) > 0.05 * around[0]
    return np.where(np.isfinite(around).all(axis=0) & ~steep, around[0], np.nan)


def refine_pose(
    start: Matrix, first: LocalModel, second: LocalModel, rig: Rig, matches: Matches,
    settings: PoseSettings = PoseSettings(),
) -> Pose:  # fmt: skip
    """Bundle adjustment of one pose and its points, the points eliminated (Schur complement).

    Of each point six numbers were seen: x, y and disparity in both pairs. Huber's weights.
    """
    seen = [_observed(model, rig, points) for model, points in ((first, matches.first), (second, matches.second))]
    known = np.asarray(np.isfinite(seen[0]).all(axis=1))
    weights_second = np.where(np.isfinite(seen[1][:, 2]), 1.0 / settings.disparity, 0.0)
    kept = matches.only(known)
    here, there = seen[0][known], np.nan_to_num(seen[1][known])
    sure = np.column_stack([np.ones((len(here), 2)), np.full(len(here), 1.0 / settings.disparity)])
    sure_there = np.column_stack([np.ones((len(here), 2)), weights_second[known]])
    turn, move = Rotation.from_matrix(start[:, :3]), start[:, 3].copy()
    stereo = rig.focal_px[0] * rig.baseline_m
    points = first.screen.points(here[:, :2], stereo / np.maximum(here[:, 2], 1e-3))
    weight = np.ones(len(points))
    for _ in range(settings.rounds):
        errors, at_points, at_pose = _linear(points, turn, move, first, second, here, there, stereo)
        scale = np.concatenate([sure, sure_there], axis=1)
        errors = errors * scale
        length = np.sqrt((errors**2).sum(axis=1))
        weight = np.where(length < settings.huber_px, 1.0, settings.huber_px / np.maximum(length, 1e-9))
        weight = np.where(length > 8.0 * settings.huber_px, 0.0, weight)
        scale = scale * np.sqrt(weight)[:, None]
        step, moved = _solve(errors * np.sqrt(weight)[:, None], at_points * scale[..., None], at_pose * scale[..., None])
        turn = Rotation.from_rotvec(step[:3]) * turn
        move = move + step[3:]
        points = points + moved
        points[:, 2] = np.maximum(points[:, 2], 0.1)
        if np.abs(step).max() < 1e-8:
            break
    inliers = weight > 0.3
    pose = np.column_stack([turn.as_matrix(), move])
    picture = errors[inliers][:, [0, 1, 3, 4]]
    residual = float(np.sqrt((picture**2).mean())) if inliers.any() else float("inf")
    if inliers.sum() < settings.fewest:
        raise _nothing(int(inliers.sum()), settings)
    return Pose(pose, kept, inliers, residual)


def _observed(model: LocalModel, rig: Rig, pixels: Matrix) -> Matrix:
    """(n, 3) x, y (px) and disparity (px) of points of the picture; disparity NaN where unsure."""
    disparity = rig.focal_px[0] * rig.baseline_m / _depth_at(model, pixels)
    return np.column_stack([pixels, disparity])


def _linear(
    points: Matrix, turn: Rotation, move: Matrix, first: LocalModel, second: LocalModel,
    here: Matrix, there: Matrix, stereo: float,
) -> tuple[Matrix, Matrix, Matrix]:  # fmt: skip
    """(n, 6) residuals, (n, 6, 3) their change with the points, (n, 6, 6) with turn and move."""
    matrix = turn.as_matrix()
    turned = points @ matrix.T
    moved = turned + move
    seen, change = _seen(points, first, stereo)
    seen_there, change_there = _seen(moved, second, stereo)
    errors = np.concatenate([seen - here, seen_there - there], axis=1)
    at_points = np.concatenate([change, change_there @ matrix], axis=1)
    cross = np.zeros((len(points), 3, 3))
    cross[:, 0, 1], cross[:, 0, 2] = turned[:, 2], -turned[:, 1]
    cross[:, 1, 0], cross[:, 1, 2] = -turned[:, 2], turned[:, 0]
    cross[:, 2, 0], cross[:, 2, 1] = turned[:, 1], -turned[:, 0]
    at_pose = np.zeros((len(points), 6, 6))
    at_pose[:, 3:, :3] = change_there @ cross
    at_pose[:, 3:, 3:] = change_there
    return errors, at_points, at_pose


def _seen(points: Matrix, model: LocalModel, stereo: float) -> tuple[Matrix, Matrix]:
    """(n, 3) x, y and disparity of points, and (n, 3, 3) their change with the point."""
    (fx, fy), (cx, cy) = model.screen.focal_px, model.screen.centre_px
    x, y, z = points[:, 0], points[:, 1], np.maximum(points[:, 2], 0.1)
    seen = np.column_stack([fx * x / z + cx, fy * y / z + cy, stereo / z])
    change = np.zeros((len(points), 3, 3))
    change[:, 0, 0], change[:, 0, 2] = fx / z, -fx * x / z**2
    change[:, 1, 1], change[:, 1, 2] = fy / z, -fy * y / z**2
    change[:, 2, 2] = -stereo / z**2
    return seen, change


def _solve(errors: Matrix, at_points: Matrix, at_pose: Matrix) -> tuple[Matrix, Matrix]:
    """The step of Gauss and Newton: of the pose (6), and of the points (n, 3)."""
    own = np.einsum("nij,nik->njk", at_points, at_points) + 1e-9 * np.eye(3)
    mixed = np.einsum("nij,nik->njk", at_pose, at_points)
    towards = -np.einsum("nij,ni->nj", at_points, errors)
    back = np.linalg.inv(own)
    left = np.einsum("nij,nik->jk", at_pose, at_pose) - np.einsum("nij,njk,nlk->il", mixed, back, mixed)
    right = -np.einsum("nij,ni->j", at_pose, errors) - np.einsum("nij,njk,nk->i", mixed, back, towards)
    step = np.linalg.solve(left + 1e-9 * np.eye(6), right)
    moved = np.einsum("njk,nk->nj", back, towards - np.einsum("nij,i->nj", mixed, step))
    return step, moved
