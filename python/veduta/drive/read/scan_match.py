"""One horizontal 2D scan onto another: correlative start, point-to-line ICP, covariance.

Olson 2009 (Real-time correlative scan matching) for a start that no local minimum traps; Censi 2008
(An ICP variant using a point-to-line metric) for the end. All candidates are looked up at once.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

Floats = NDArray[np.float64]
_FEWEST = 10
"""Points of a scan that can be matched."""


@dataclass(frozen=True)
class MatchParameters:
    """Thresholds of scan matching.

    reach_m, reach_rad: how far from the given start a scan is looked for. cell_m: of the grid on
    which candidates are judged. step_m, step_rad: between candidates. blur_m: a point this far from
    the reference counts e^-1/2. apart_m: points farther apart do not match in ICP, at first; at the
    end a third of it. huber_m: residuals above weigh less (a beam's noise is 1 to 3 cm).
    sigma_m: noise of a residual, for the covariance. line_m: neighbours on a line are this near.
    on_m: a point so near lies on the reference.
    """

    reach_m: float = 0.6
    reach_rad: float = 0.35
    cell_m: float = 0.05
    step_m: float = 0.1
    step_rad: float = 0.02
    blur_m: float = 0.12
    apart_m: float = 0.6
    huber_m: float = 0.05
    sigma_m: float = 0.02
    line_m: float = 0.5
    on_m: float = 0.2
    rounds: int = 30


@dataclass(frozen=True, eq=False)
class Match:
    """pose: (3,) x, y (m) and turn (rad), reference_from_scan. covariance: (3, 3).

    share: of the scan's points that lie on the reference.
    """

    pose: Floats
    covariance: Floats
    share: float


class Reference:
    """Points that scans are matched onto: (n, 2), with what is made of them once."""

    def __init__(self, points: Floats, line_m: float = 0.5) -> None:
        """line_m: neighbours on a line are this near."""
        self.points = points
        self.tree = cKDTree(points)
        self.normals, self.straight = _normals(points, line_m)
        self._fields: dict[tuple[float, float], tuple[Floats, NDArray[np.float32]]] = {}

    def likelihood(self, chosen: MatchParameters) -> tuple[Floats, NDArray[np.float32]]:
        """The lower corner of a grid, and how well a point fits in each cell of it, 0 to 1."""
        key = (chosen.cell_m, chosen.blur_m)
        if key not in self._fields:
            low = self.points.min(axis=0) - 1.0
            size = np.ceil((self.points.max(axis=0) + 1.0 - low) / chosen.cell_m).astype(int) + 1
            size = np.minimum(size, 4000)
            empty = np.ones(size, dtype=np.uint8)
            at = ((self.points - low) / chosen.cell_m).astype(int)
            inside = (at < size).all(axis=1)
            empty[at[inside, 0], at[inside, 1]] = 0
            distance = cv2.distanceTransform(empty, cv2.DIST_L2, 5) * chosen.cell_m
            fit = np.exp(-0.5 * (distance / chosen.blur_m) ** 2).astype(np.float32)
            self._fields[key] = low, fit
        return self._fields[key]


def match_scans(
    reference: Floats | Reference,
    scan: Floats,
    start: Floats,
    parameters: MatchParameters | None = None,
) -> Match:
    """reference: (n, 2); scan: (m, 2); start: (3,). A correlative search, then ICP."""
    chosen = parameters or MatchParameters()
    known = _reference(reference, chosen)
    if known is None or len(scan) < _FEWEST:
        return Match(start.copy(), np.diag([1.0, 1.0, 1.0]), 0.0)
    return _icp(known, scan, _correlated(known, scan, start, chosen), chosen)


def align_scans(
    reference: Floats | Reference,
    scan: Floats,
    start: Floats,
    parameters: MatchParameters | None = None,
) -> Match:
    """The same from a start that is trusted: point-to-line ICP only."""
    chosen = parameters or MatchParameters()
    known = _reference(reference, chosen)
    if known is None or len(scan) < _FEWEST:
        return Match(start.copy(), np.diag([1.0, 1.0, 1.0]), 0.0)
    return _icp(known, scan, start, chosen)


def _reference(given: Floats | Reference, chosen: MatchParameters) -> Reference | None:
    if isinstance(given, Reference):
        return given
    return Reference(given, chosen.line_m) if len(given) >= _FEWEST else None


def moved(pose: Floats, points: Floats) -> Floats:
    """(n, 2) points of a frame whose pose is given, in the frame of the pose."""
    c, s = np.cos(pose[2]), np.sin(pose[2])
    return np.asarray(points @ np.array([[c, s], [-s, c]]) + pose[:2], dtype=np.float64)


def between(first: Floats, second: Floats) -> Floats:
    """(3,) the second pose as seen from the first."""
    c, s = np.cos(first[2]), np.sin(first[2])
    step = np.array([[c, s], [-s, c]]) @ (second[:2] - first[:2])
    turn = (second[2] - first[2] + np.pi) % (2 * np.pi) - np.pi
    return np.array([step[0], step[1], turn])


def joined(first: Floats, step: Floats) -> Floats:
    """(3,) the pose after a step from the first."""
    flat = moved(first, step[None, :2])[0]
    return np.array([flat[0], flat[1], first[2] + step[2]])


def _correlated(
    reference: Reference, scan: Floats, start: Floats, chosen: MatchParameters
) -> Floats:
    """The candidate around the start under which the scan's points lie nearest to the reference."""
    low, field = reference.likelihood(chosen)
    size = np.array(field.shape)
    shifts = np.arange(-chosen.reach_m, chosen.reach_m + 1e-9, chosen.step_m)
    turns = np.arange(-chosen.reach_rad, chosen.reach_rad + 1e-9, chosen.step_rad)
    best, pose = -np.inf, start
    cells = np.rint(shifts / chosen.cell_m).astype(int)
    for turn in turns.tolist():
        turned = moved(np.array([start[0], start[1], start[2] + turn]), scan)
        at = ((turned - low) / chosen.cell_m).astype(int)
        x = at[:, 0][None] + cells[:, None]
        y = at[:, 1][None] + cells[:, None]
        x_in, y_in = (x >= 0) & (x < size[0]), (y >= 0) & (y < size[1])
        x, y = np.where(x_in, x, 0), np.where(y_in, y, 0)
        looked = field[x[:, None], y[None]] * (x_in[:, None] & y_in[None])
        # The start is a little better than all that is as good.
        score = looked.sum(axis=2) - 1e-3 * (np.abs(cells[:, None]) + np.abs(cells[None]))
        score -= 0.05 * abs(turn)
        row, column = np.unravel_index(int(np.argmax(score)), score.shape)
        if score[row, column] > best:
            best = float(score[row, column])
            pose = start + np.array([shifts[row], shifts[column], turn])
    return pose


def _icp(reference: Reference, scan: Floats, pose: Floats, chosen: MatchParameters) -> Match:
    normals, straight, tree = reference.normals, reference.straight, reference.tree
    pose = pose.copy()
    information = np.eye(3)
    for number in range(chosen.rounds):
        apart = chosen.apart_m * (1.0 if number < chosen.rounds // 2 else 1.0 / 3.0)
        points = moved(pose, scan)
        told = tree.query(points)
        distance, nearest = np.asarray(told[0]), np.asarray(told[1])
        kept = (distance < apart) & straight[nearest]
        if kept.sum() < 6:
            break
        normal, target = normals[nearest[kept]], reference.points[nearest[kept]]
        residual = ((points[kept] - target) * normal).sum(axis=1)
        weight = 1.0 / np.maximum(np.abs(residual) / chosen.huber_m, 1.0)
        arm = points[kept] - pose[:2]
        turn = arm[:, 0] * normal[:, 1] - arm[:, 1] * normal[:, 0]
        rows = np.stack([normal[:, 0], normal[:, 1], turn], axis=1)
        information = rows.T @ (rows * weight[:, None]) + 1e-6 * np.eye(3)
        step = -np.linalg.solve(information, rows.T @ (weight * residual))
        pose += step
        if np.abs(step).max() < 1e-5 and number >= chosen.rounds // 2:
            break
    distance = np.asarray(tree.query(moved(pose, scan))[0])
    share = float((distance < chosen.on_m).mean())
    pose[2] = (pose[2] + np.pi) % (2 * np.pi) - np.pi
    covariance = np.asarray(chosen.sigma_m**2 * np.linalg.inv(information), dtype=np.float64)
    return Match(pose, covariance, share)


def _normals(points: Floats, near_m: float) -> tuple[Floats, NDArray[np.bool_]]:
    """(n, 2) unit normals of the line through the four nearest neighbours, and where they are on
    one.
    """
    count = min(5, len(points))
    told = cKDTree(points).query(points, k=count)
    distance, around = np.asarray(told[0]), np.asarray(told[1])
    centred = points[around] - points[around].mean(axis=1, keepdims=True)
    spread = np.einsum("nki,nkj->nij", centred, centred)
    values, vectors = np.linalg.eigh(spread)
    straight = (values[:, 0] < 0.1 * values[:, 1]) & (distance[:, 1] < near_m)
    return vectors[:, :, 0], straight
