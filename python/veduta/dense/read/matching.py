"""Planes for each pixel by PatchMatch, coarse to fine, then held against the neighbours' depths."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta import _core
from veduta.dense.document.views import Views, scaled_row, scaled_size
from veduta.dense.read.neighbours import Comparison
from veduta.run.card import Engine

Planes = NDArray[np.float32]
Depths = list[NDArray[np.float32] | None]


@dataclass(frozen=True)
class MatchParameters:
    """Of `veduta_stereo::search` (Rust).

    step_px: between the 5 x 5 samples of a window. gamma_grey, gamma_px: (3.2)'s constants (of
    255; px). noise_grey: a window that varies less says nothing. consistency, most_px: cost
    per pixel by which a neighbour's depth leads back elsewhere, up to so many (Xu and Tao 2019).
    coarse: (share of the size, sweeps, variation of the depth, of the normal) of each level without
    the neighbours' depths; fine: of the last, with them.
    """

    step_px: float = 2.0
    gamma_grey: float = 20.0
    gamma_px: float = 8.0
    noise_grey: float = 2.0
    consistency: float = 0.1
    most_px: float = 3.0
    coarse: tuple[tuple[float, int, float, float], ...] = (
        (0.25, 4, 0.05, 0.7),
        (0.5, 2, 0.01, 0.3),
    )
    fine: tuple[float, int, float, float] = (1.0, 2, 0.004, 0.2)

    @property
    def window_px(self) -> float:
        """Side of the window at full size (px)."""
        return 4.0 * self.step_px + 1.0


def match_coarse(
    views: Views, comparison: Comparison, seed: int, parameters: MatchParameters, engine: Engine
) -> Planes:
    """(pixels, 4) at the last coarse level: inverse depth (1/m), its slopes (1/m/px), the cost."""
    planes, shape = None, (1, 1)
    for level in parameters.coarse:
        nothing: Depths = [None for _ in comparison.neighbours]
        planes = _match(
            views, comparison, level, (planes, shape), nothing, seed, parameters, engine
        )
        shape = _shape(views, comparison.view, level[0])
    if planes is None:
        raise ValueError("no coarse level")
    return planes


def match_fine(
    views: Views,
    comparison: Comparison,
    planes: Mapping[int, Planes],
    seed: int,
    parameters: MatchParameters,
    engine: Engine,
) -> Planes:
    """(pixels, 4) at the working size. planes: the coarse ones of the view and its neighbours."""
    scale = parameters.coarse[-1][0]
    start = np.asarray(planes[comparison.view])
    depths: Depths = []
    for other in comparison.neighbours:
        if other not in planes:
            depths.append(None)
            continue
        coarse = depths_of(planes[other], _shape(views, other, scale))
        size = scaled_size(views.cameras[other], parameters.fine[0])
        larger = cv2.resize(coarse, size, interpolation=cv2.INTER_NEAREST)
        depths.append(np.asarray(larger, dtype=np.float32))
    begun = (start, _shape(views, comparison.view, scale))
    return _match(views, comparison, parameters.fine, begun, depths, seed, parameters, engine)


def _shape(views: Views, view: int, scale: float) -> tuple[int, int]:
    width, height = scaled_size(views.cameras[view], scale)
    return height, width


def _match(
    views: Views,
    comparison: Comparison,
    level: tuple[float, int, float, float],
    start: tuple[Planes | None, tuple[int, int]],
    depths: Depths,
    seed: int,
    parameters: MatchParameters,
    engine: Engine,
) -> Planes:
    scale, sweeps, vary_depth, vary_normal = level
    near = comparison.neighbours
    given = (
        views.grey(comparison.view, scale),
        scaled_row(views.cameras[comparison.view], scale),
        [views.grey(other, scale) for other in near],
        np.stack([scaled_row(views.cameras[other], scale) for other in near]),
        depths,
        start[0],
        start[1],
    )
    rule = _core.SearchRule(
        near=comparison.near_m,
        far=comparison.far_m,
        sweeps=sweeps,
        views=max(1, (len(near) + 1) // 2),
        step_px=parameters.step_px,
        gamma_grey=parameters.gamma_grey,
        gamma_px=parameters.gamma_px,
        noise_grey=parameters.noise_grey,
        consistency=parameters.consistency,
        most_px=parameters.most_px,
        vary_depth=vary_depth,
        vary_normal=vary_normal,
        seed=seed,
    )
    return engine.run(
        lambda card: card.match_planes(*given, rule),
        lambda: _core.match_planes(*given, rule),
    )


def depths_of(planes: Planes, shape: tuple[int, int]) -> NDArray[np.float32]:
    """(h, w) depths (m) of planes."""
    return np.asarray(1.0 / planes[:, 0].reshape(shape), dtype=np.float32)


def normals_of(planes: Planes, row: NDArray[np.float64], shape: tuple[int, int]) -> Planes:
    """(pixels, 3) unit normals, towards the camera, in its frame. row: of the camera."""
    height, width = shape
    x, y = np.meshgrid(np.arange(width) + 0.5 - row[2], np.arange(height) + 0.5 - row[3])
    inverse, right, down = (planes[:, k].astype(np.float64) for k in range(3))
    normal = np.stack(
        [row[0] * right, row[1] * down, inverse - right * x.ravel() - down * y.ravel()], axis=1
    )
    length = np.linalg.norm(normal, axis=1, keepdims=True)
    return np.asarray(-normal / np.maximum(length, 1e-12), dtype=np.float32)
