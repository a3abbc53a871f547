"""Optical flow between the left pictures of two key positions (section 3.4.1).

Where a point of one picture lies in the other is predicted from its depth and the pose; labels
(dx, dy, scale) about the prediction are chosen by a Potts energy on a grid of nodes, and the flow
that they give is refined between the pixels.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta._core import walk_label_costs, walk_potts
from veduta.walk.build.local_model import LocalModel
from veduta.walk.build.sampling import sampled

Matrix = NDArray[np.float64]
Flow = NDArray[np.float32]


@dataclass(frozen=True)
class FlowSettings:
    """step_px: between nodes. reach_px: how far from the prediction a label lies along the epipolar
    line, band_px: across it. scales: S, 1 = s0 < s1 < ... ; scale_steps: how many of them about the
    predicted one are tried. radius: of the patches. noise: contrast (0..255) of noise. smooth: the
    Potts constant. edge: share of it that is left across a break in depth. rounds: of the solver.
    """

    step_px: int = 4
    reach_px: int = 4
    band_px: float = 2.5
    scales: tuple[float, ...] = (1.0, 1.11, 1.25, 1.43, 1.67, 2.0, 2.5, 3.33)
    scale_steps: int = 1
    radius: int = 3
    noise: float = 3.0
    smooth: float = 0.25
    edge: float = 0.1
    rounds: int = 8
    solver: str = "trws"
    variational: int = 5


@dataclass(frozen=True, eq=False)
class Labelling:
    """energy: of the labels; energy_icm: what ICM comes to; bound: no labelling is below it."""

    energy: float
    energy_icm: float
    bound: float


@dataclass(frozen=True, eq=False)
class FoundFlow:
    """target: (h, w, 2) float32 where each pixel of the first picture lies in the second (px).

    predicted: the same by geometry alone. cost: (h, w) float32, 1 - correlation of the chosen label.
    inside: (h, w) whether the target lies in the second picture, ahead of its camera.
    depth_m: (h, w) the depth of the first model's points in the second camera.
    """

    target: Flow
    predicted: Flow
    depth_m: NDArray[np.float32]
    cost: NDArray[np.float32]
    inside: NDArray[np.bool_]
    labelling: Labelling


@dataclass(frozen=True, eq=False)
class Shrunk:
    """A grey picture at each of the scales."""

    grey: NDArray[np.float32]
    scales: tuple[float, ...]

    @cached_property
    def levels(self) -> list[NDArray[np.float32]]:
        """The picture shrunk by each scale."""
        height, width = self.grey.shape
        levels = []
        for scale in self.scales:
            size = (max(8, round(width / scale)), max(8, round(height / scale)))
            shrunk = self.grey if scale == 1.0 else cv2.resize(self.grey, size, interpolation=cv2.INTER_AREA)
            levels.append(np.ascontiguousarray(shrunk, dtype=np.float32))
        return levels


def find_flow(
    first: LocalModel, second: LocalModel, second_from_first: Matrix,
    settings: FlowSettings = FlowSettings(),
) -> FoundFlow:  # fmt: skip
    """The flow from the first picture to the second."""
    points = first.points @ second_from_first[:, :3].T + second_from_first[:, 3]
    there, depth = second.screen.project(points)
    inside = _inside(there, second)
    predicted = np.where(inside[..., None], there, -1e4).astype(np.float32)
    looming = first.depth_m / np.maximum(depth, 0.1)
    residual, cost, labelling = _labels(first, second, predicted, looming, second_from_first, settings)
    target = predicted + residual
    target = _refined(first, second, target, inside, settings)
    inside &= _inside(target, second)
    return FoundFlow(target, predicted, depth.astype(np.float32), cost, inside, labelling)


def _inside(pixels: NDArray[np.floating], model: LocalModel) -> NDArray[np.bool_]:
    x, y = pixels[..., 0], pixels[..., 1]
    with np.errstate(invalid="ignore"):
        return (x >= 1) & (y >= 1) & (x <= model.screen.width_px - 1) & (y <= model.screen.height_px - 1)


def _labels(
    first: LocalModel, second: LocalModel, predicted: Flow, looming: Matrix, pose: Matrix,
    settings: FlowSettings,
) -> tuple[Flow, NDArray[np.float32], Labelling]:  # fmt: skip
    """(h, w, 2) what the labels add to the prediction, their costs, and the energies."""
    step = settings.step_px
    rows, columns = (np.arange(step // 2, size, step) for size in first.depth_m.shape)
    at = np.ix_(rows, columns)
    there = predicted[at]
    valid = (there[..., 0] > -1e3) & ~first.sky[at]
    number = np.full((len(rows), len(columns)), -1, dtype=np.int32)
    number[valid] = np.arange(valid.sum(), dtype=np.int32)
    own = first.screen.pixels[at][valid]
    offsets, steps = _label_set(settings)
    costs = walk_label_costs(
        Shrunk(first.grey, settings.scales).levels, Shrunk(second.grey, settings.scales).levels,
        list(settings.scales), own, there[valid], _scale_index(looming[at][valid], settings.scales),
        _epipolar(own, there[valid], first, second, pose, first.depth_m[at][valid]), offsets, steps,
        radius=settings.radius, band_px=settings.band_px, noise=settings.noise,
    )  # fmt: skip
    right, down = _weights(first.depth_m[at], settings)
    chosen, energy, bound = walk_potts(costs, number, right, down, settings.solver, rounds=settings.rounds)
    energy_icm = walk_potts(costs, number, right, down, "icm", rounds=settings.rounds)[1]
    sparse = np.zeros((*valid.shape, 2), dtype=np.float32)
    sparse[valid] = offsets[chosen]
    sparse_cost = np.full(valid.shape, 1.0, dtype=np.float32)
    sparse_cost[valid] = costs[np.arange(len(chosen)), chosen]
    return (
        _spread(sparse, first.depth_m.shape, step), _spread(sparse_cost, first.depth_m.shape, step),
        Labelling(energy, energy_icm, bound),
    )  # fmt: skip


def _spread(nodes: NDArray[np.float32], shape: tuple[int, int], step: int) -> NDArray[np.float32]:
    """From nodes to pixels, linear in between."""
    x, y = np.meshgrid(np.arange(shape[1]), np.arange(shape[0]))
    return sampled(nodes, np.stack([x - step // 2, y - step // 2], axis=-1) / step + 0.5)


def _label_set(settings: FlowSettings) -> tuple[NDArray[np.float32], NDArray[np.int32]]:
    """Offsets (l, 2) and scale steps (l): the nearest to the prediction come first."""
    reach = np.arange(-settings.reach_px, settings.reach_px + 1)
    most = min(settings.scale_steps, len(settings.scales) - 1)
    scales, ys, xs = np.meshgrid(np.arange(-most, most + 1), reach, reach, indexing="ij")
    offsets = np.stack([xs.ravel(), ys.ravel()], axis=1).astype(np.float32)
    order = np.lexsort((np.abs(scales.ravel()), np.linalg.norm(offsets, axis=1)))
    return offsets[order], scales.ravel()[order].astype(np.int32)


def _scale_index(looming: Matrix, scales: tuple[float, ...]) -> NDArray[np.int32]:
    """The scale nearest to how much larger a point is in the second picture; negative: smaller."""
    logs = np.log(np.array(scales))
    wanted = np.log(np.clip(looming, 0.05, 20.0))
    index = np.abs(np.abs(wanted)[:, None] - logs).argmin(axis=1)
    return np.asarray(np.sign(wanted) * index, dtype=np.int32)


def _epipolar(
    own: NDArray[np.float32], there: NDArray[np.float32], first: LocalModel, second: LocalModel,
    pose: Matrix, depth: NDArray[np.float32],
) -> NDArray[np.float32]:
    """(n, 3) lines through the prediction and the epipole; 0 where the two are one."""
    rays = first.screen.points(own, depth) @ pose[:, :3].T
    infinite, _ = second.screen.project(1e6 * rays)
    along = there - infinite
    certain = np.isfinite(along).all(axis=1) & (np.linalg.norm(along, axis=1) > 3.0)
    if second.screen.round:  # the line is a curve there: its tangent
        along = second.screen.project(1.02 * rays + pose[:, 3])[0] - there
    with np.errstate(invalid="ignore", divide="ignore"):
        length = np.linalg.norm(along, axis=1)
        certain &= np.isfinite(length) & (length > 1e-6)
        normal = np.stack([-along[:, 1], along[:, 0]], axis=1) / length[:, None]
    lines = np.concatenate([normal, -(normal * there).sum(axis=1, keepdims=True)], axis=1)
    return np.where(certain[:, None], lines, 0.0).astype(np.float32)


def _weights(
    depth: NDArray[np.float32], settings: FlowSettings
) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
    """The Potts constant towards the node on the right and below: little across breaks in depth."""
    near = np.log(depth)
    weights = []
    for axis in (1, 0):
        apart = np.abs(np.diff(near, axis=axis, append=np.take(near, [-1], axis=axis)))
        share = settings.edge + (1.0 - settings.edge) * np.exp(-((apart / 0.08) ** 2))
        weights.append((settings.smooth * share).astype(np.float32))
    return weights[0], weights[1]


def _refined(
    first: LocalModel, second: LocalModel, target: Flow, inside: NDArray[np.bool_], settings: FlowSettings
) -> Flow:
    """Between the pixels: variational, after the second picture was laid upon the first."""
    if settings.variational <= 0:
        return target
    seen = np.where(inside, sampled(second.grey, target), first.grey).astype(np.float32)
    levelled = _levelled(seen, first.grey)
    refinement = cv2.VariationalRefinement.create()
    refinement.setFixedPointIterations(settings.variational)
    nothing = np.zeros_like(target)
    pictures = [np.clip(one, 0, 255).astype(np.uint8) for one in (first.grey, levelled)]
    residual = np.clip(refinement.calc(pictures[0], pictures[1], nothing), -3.0, 3.0)
    return sampled(target, first.screen.pixels + residual)


def _levelled(picture: NDArray[np.float32], like: NDArray[np.float32]) -> NDArray[np.float32]:
    """With the local mean and spread of another: exposure and haze are no motion."""
    size = (31, 31)
    means = [cv2.blur(one, size) for one in (picture, like)]
    spreads = [
        np.sqrt(np.maximum(cv2.blur(one * one, size) - mean * mean, 4.0))
        for one, mean in zip((picture, like), means, strict=True)
    ]
    return (picture - means[0]) * np.clip(spreads[1] / spreads[0], 0.5, 2.0) + means[1]
