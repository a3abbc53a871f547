"""Depth of a single camera's frame from those before and after it, whose cameras are known.

A camera that goes ahead has no rows that two frames share, so nothing is rectified: planes are
matched (PatchMatch, as in `veduta-stereo`) between the frames as they are.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta import _core
from veduta.cameras import Camera
from veduta.walk.rig import Image

Planes = NDArray[np.float32]
Depth = NDArray[np.float32]


@dataclass(frozen=True)
class PhotoDepthSettings:
    """coarse: (share of the size, sweeps, variation of depth and normal) of each level; step_px,
    gamma_grey, gamma_px, noise_grey: of the windows. consistency, most_px: of a neighbour's depth
    that leads back elsewhere. agree_px, agree_share: by which depths of two frames may differ.
    most_cost: 1 - correlation of what is kept. seed: of the draws.
    """

    coarse: tuple[tuple[float, int, float, float], ...] = (
        (0.25, 4, 0.05, 0.7),
        (0.5, 2, 0.01, 0.3),
        (1.0, 2, 0.004, 0.2),
    )
    step_px: float = 2.0
    gamma_grey: float = 20.0
    gamma_px: float = 8.0
    noise_grey: float = 2.0
    consistency: float = 0.1
    most_px: float = 3.0
    agree_px: float = 1.5
    agree_share: float = 0.03
    most_cost: float = 1.2
    seed: int = 3


@dataclass(eq=False)
class FramePlanes:
    """Planes of frames, made when they are asked for; those of a few frames are kept.

    cameras: without distortion, of one size. picture: of a frame. near, far: depths looked for, in
    the cameras' unit, of a frame. reach: how many frames before and after one are compared; or
    around: the frames that each is compared with. kept: how many frames' planes are, at most.
    """

    cameras: list[Camera]
    picture: Callable[[int], Image]
    span: Callable[[int], tuple[float, float]]
    reach: int = 1
    around: tuple[tuple[int, ...], ...] | None = None
    kept: int = 4
    settings: PhotoDepthSettings = PhotoDepthSettings()
    _planes: dict[int, Planes] = field(default_factory=dict)

    def neighbours(self, number: int) -> list[int]:
        """The frames that are compared with one."""
        if self.around is not None:
            return list(self.around[number])
        around = range(number - self.reach, number + self.reach + 1)
        return [n for n in around if n != number and 0 <= n < len(self.cameras)]

    def depth(self, number: int) -> tuple[Depth, NDArray[np.bool_]]:
        """(h, w) depths without gaps, and where a neighbour's agree."""
        shape = (self.cameras[number].height_px, self.cameras[number].width_px)
        shown = [number, *self.neighbours(number)]
        depths = [_depth_of(self._of(one), shape) for one in shown]
        rows = np.stack([_row(self.cameras[one], 1.0) for one in shown])
        agree = _core.agreeing_views(
            depths, rows, most_px=self.settings.agree_px, most_share=self.settings.agree_share
        )
        cost = self._of(number)[:, 3]
        sure = ((agree >= 1) & (cost < self.settings.most_cost)).reshape(shape)
        for old in list(self._planes)[: -self.kept]:
            del self._planes[old]
        return depths[0], sure

    def _of(self, number: int) -> Planes:
        if number not in self._planes:
            self._planes[number] = self._match(number)
        return self._planes[number]

    def _match(self, number: int) -> Planes:
        settings = self.settings
        near, far = self.span(number)
        others = self.neighbours(number)
        best = 1 if self.around is not None else max(1, (len(others) + 1) // 2)
        planes: Planes | None = None
        shape = (1, 1)
        for scale, sweeps, vary_depth, vary_normal in settings.coarse:
            pictures = [self._grey(one, scale) for one in (number, *others)]
            rule = _core.SearchRule(
                near=near, far=far, sweeps=sweeps, views=best,
                step_px=settings.step_px, gamma_grey=settings.gamma_grey,
                gamma_px=settings.gamma_px, noise_grey=settings.noise_grey,
                consistency=settings.consistency, most_px=settings.most_px,
                vary_depth=vary_depth, vary_normal=vary_normal, seed=settings.seed + number,
            )  # fmt: skip
            planes = _core.match_planes(
                pictures[0], _row(self.cameras[number], scale), pictures[1:],
                np.stack([_row(self.cameras[one], scale) for one in others]),
                [None for _ in others], planes, shape, rule,
            )  # fmt: skip
            shape = (pictures[0].shape[0], pictures[0].shape[1])
        if planes is None:
            raise ValueError("no level")
        return planes

    def _grey(self, number: int, scale: float) -> NDArray[np.uint8]:
        grey = cv2.cvtColor(self.picture(number), cv2.COLOR_RGB2GRAY)
        if scale != 1.0:
            grey = cv2.resize(grey, _size(self.cameras[number], scale), interpolation=cv2.INTER_AREA)
        return np.ascontiguousarray(grey, dtype=np.uint8)


def _size(camera: Camera, scale: float) -> tuple[int, int]:
    return max(2, round(camera.width_px * scale)), max(2, round(camera.height_px * scale))


def _row(camera: Camera, scale: float) -> NDArray[np.float64]:
    """(16,) focal lengths, principal point, rotation by rows and shift, for the core."""
    turn, shift = camera.cam_from_world[:, :3], camera.cam_from_world[:, 3]
    row = np.concatenate([camera.focal_px, camera.centre_px, turn.ravel(), shift])
    width, height = _size(camera, scale)
    row[[0, 2]] *= width / camera.width_px
    row[[1, 3]] *= height / camera.height_px
    return row


def _depth_of(planes: Planes, shape: tuple[int, int]) -> Depth:
    return np.asarray(1.0 / np.maximum(planes[:, 0], 1e-9), dtype=np.float32).reshape(shape)
