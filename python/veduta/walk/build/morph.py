"""The morphable model (section 3.4): region Psi, and the destinations of equation (3) and (6)."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.walk.build.flow import Flow, FlowSettings, FoundFlow, find_flow
from veduta.walk.build.local_model import LocalModel
from veduta.walk.build.poisson import extend_destinations
from veduta.walk.build.sampling import sampled

Matrix = NDArray[np.float64]
Mask = NDArray[np.bool_]


@dataclass(frozen=True)
class PsiLimits:
    """back_px: how far forward and back may miss (in the second picture, and times the scale).
    cost: largest 1 - correlation. depth: largest difference of the depths that the two models have,
    as a share. fade_px: over which the resolution fades across the border (figure 6c).
    piece_px: smaller pieces of Psi are chance. agree: by how much of its depth a point may move on
    its way to the other model, a soft limit (chosen on `laser/kitti00`).
    """

    back_px: float = 1.5
    cost: float = 0.75
    depth: float = 0.12
    fade_px: int = 9
    piece_px: int = 200
    agree: float = 0.05


@dataclass(frozen=True, eq=False)
class Morph:
    """What a local model becomes on the way to another. Everything in the first camera's picture.

    target: (h, w, 2) px in the second picture. psi: (h, w) 0..1, 1 inside the region. points and
    destinations: (h, w, 3) in the frame of the first and of the second camera: equation (1) is
    between `second_from_first` of the former and the latter. moving: (h, w) what is elsewhere in
    the second view; it has no part in Psi.
    """

    first: LocalModel
    second: LocalModel
    second_from_first: Matrix
    target: Flow
    psi: NDArray[np.float32]
    region: NDArray[np.bool_]
    moving: NDArray[np.bool_]
    flow: FoundFlow
    limits: PsiLimits


def find_morphs(
    first: LocalModel, second: LocalModel, second_from_first: Matrix,
    settings: FlowSettings = FlowSettings(), limits: PsiLimits = PsiLimits(),
    moving: tuple[Mask, Mask] | None = None,
) -> tuple[Morph, Morph]:  # fmt: skip
    """From the first to the second and back; each checks the other.

    moving: what moves in the first view and in the second; None: nothing does.
    """
    still = (np.zeros_like(first.sky), np.zeros_like(second.sky)) if moving is None else moving
    back_pose = inverse(second_from_first)
    forth = find_flow(first, second, second_from_first, settings)
    back = find_flow(second, first, back_pose, settings)
    return (
        _morph(first, second, second_from_first, forth, back, still[0], limits),
        _morph(second, first, back_pose, back, forth, still[1], limits),
    )


def inverse(pose: Matrix) -> Matrix:
    """(3, 4) the other way."""
    turn = pose[:, :3].T
    return np.column_stack([turn, -turn @ pose[:, 3]])


def _morph(
    first: LocalModel, second: LocalModel, pose: Matrix, forth: FoundFlow, back: FoundFlow,
    moving: Mask, limits: PsiLimits,
) -> Morph:  # fmt: skip
    region = _psi(first, second, forth, back, limits) & ~moving
    inner = cv2.erode(region.astype(np.uint8), np.ones((3, 3), np.uint8)).astype(np.float32)
    size = 2 * (limits.fade_px // 2) + 1
    psi = np.minimum(cv2.GaussianBlur(inner, (size, size), 0), region.astype(np.float32))
    return Morph(first, second, pose, forth.target, psi, region, moving, forth, limits)


def _psi(
    first: LocalModel, second: LocalModel, forth: FoundFlow, back: FoundFlow, limits: PsiLimits
) -> NDArray[np.bool_]:
    """Whose counterpart leads back, looks the same, and is where geometry says."""
    returned = sampled(back.target, forth.target)
    missed = np.linalg.norm(returned - first.screen.pixels, axis=-1)
    scale = np.maximum(1.0, first.depth_m / np.maximum(forth.depth_m, 0.1))
    depth = sampled(second.depth_m, forth.target, nearest=True)
    near = np.abs(depth - forth.depth_m) < limits.depth * np.minimum(depth, forth.depth_m)
    found = forth.inside & (missed * np.minimum(scale, 3.0) < 2.0 * limits.back_px) & (missed < limits.back_px)
    found &= near & (forth.cost < limits.cost)
    both_sky = first.sky & forth.inside & (sampled(second.sky, forth.target, nearest=True) > 0)
    found = np.where(first.sky, both_sky, found)
    count, numbers, stats, _ = cv2.connectedComponentsWithStats(found.astype(np.uint8), connectivity=4)
    large = stats[:, cv2.CC_STAT_AREA] >= limits.piece_px
    large[0] = False
    opened = large[numbers]
    holes = cv2.morphologyEx(opened.astype(np.uint8), cv2.MORPH_CLOSE, np.ones((5, 5), np.uint8)) > 0
    return np.asarray(opened | (holes & forth.inside & near), dtype=np.bool_)


def node_destinations(
    morph: Morph, rows: NDArray[np.int64], columns: NDArray[np.int64],
    right: NDArray[np.float64], down: NDArray[np.float64],
) -> NDArray[np.float64]:  # fmt: skip
    """(rows, columns, 3) in the second camera's frame: equation (3) in Psi, (6) elsewhere."""
    at = np.ix_(rows, columns)
    pose = morph.second_from_first
    points = morph.first.points[at] @ pose[:, :3].T + pose[:, 3]
    target = morph.target[at]
    second = morph.second
    depth = sampled(second.depth_m, target)
    wanted = morph.flow.depth_m[at]
    near = np.abs(depth - wanted) < morph.limits.depth * np.minimum(depth, wanted)
    known = morph.region[at] & near & ~morph.first.sky[at]
    destinations = second.screen.points(target, depth)
    sky = morph.first.sky[at]
    # The sky goes along with the camera: it only turns.
    turned = morph.first.points[at] @ pose[:, :3].T
    destinations = np.where(sky[..., None], turned, destinations)
    extended = extend_destinations(points, destinations, known | sky, right, down)
    return _believed(points, extended, morph.limits)


def _believed(
    points: NDArray[np.float64], destinations: NDArray[np.float64], limits: PsiLimits
) -> NDArray[np.float64]:
    """Where both models nearly agree, what the second says; where they contradict each other one of
    them is wrong, and the place stays as it is.
    """
    apart = np.linalg.norm(destinations - points, axis=-1, keepdims=True)
    share = apart / (limits.agree * np.linalg.norm(points, axis=-1, keepdims=True))
    weight = np.exp(-np.minimum(share**2, 60.0))
    return np.asarray(points + weight * (destinations - points))

