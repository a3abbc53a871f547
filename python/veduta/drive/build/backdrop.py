"""Where the background without holes is in an image: the surface that is to be textured (7.1)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from veduta.drive.build.fill import Background, Source, raise_walls
from veduta.drive.build.frame import ColumnFrame
from veduta.drive.record import Shot


@dataclass(frozen=True)
class BackdropParameters:
    """nearest_m, farthest_m: what is drawn. finer: so many points are drawn between two of the
    depth image, in both directions. gap_px: pixels between drawn points up to this far are of the
    same surface. noise_px: odd side of the median that takes out single points.
    """

    nearest_m: float = 1.0
    farthest_m: float = 60.0
    finer: int = 3
    gap_px: float = 4.0
    noise_px: int = 5


@dataclass(frozen=True, eq=False)
class Backdrop:
    """A segment's background with its walls as high as they may be. points: (r, c, 3) float32 (m,
    about `middle` (3,)), NaN where nothing is. inferred: (r, c) bool, above what the scanner saw.
    """

    points: NDArray[np.float32]
    middle: NDArray[np.float64]
    inferred: NDArray[np.bool_]


@dataclass(frozen=True, eq=False)
class Drawn:
    """depth: (h, w) float32 of the nearest backdrop in an image (m), NaN where none is.

    inferred: (h, w) bool, it is above what the scanner saw.
    """

    depth: NDArray[np.float32]
    inferred: NDArray[np.bool_]


def backdrop_of(background: Background, frame: ColumnFrame, highest_m: float) -> Backdrop:
    """highest_m: up to this height over the road walls may go on above what the scanner saw."""
    raised = raise_walls(background, frame, np.full(frame.shape[1], highest_m))
    points = frame.vertices(raised.depth)
    middle = frame.origins[len(frame.origins) // 2].astype(np.float64)
    return Backdrop(
        (points - middle).astype(np.float32), middle, raised.source == Source.INFERRED
    )


def draw_backdrops(
    shot: Shot, backdrops: Sequence[Backdrop], parameters: BackdropParameters | None = None
) -> Drawn:
    """Points between those of the depth images, the nearest in each pixel, gaps closed."""
    chosen = parameters or BackdropParameters()
    shape = (shot.height_px, shot.width_px)
    depth = np.full(shape[0] * shape[1], np.inf, dtype=np.float32)
    inferred = np.zeros(len(depth), dtype=bool)
    for one in backdrops:
        points, above = _finer(one, shot, chosen)
        pixels, away = shot.project(points)
        at = np.floor(pixels)
        inside = (away > chosen.nearest_m) & (away < chosen.farthest_m) & (at >= 0).all(axis=1)
        inside &= (at[:, 0] < shape[1]) & (at[:, 1] < shape[0])
        cell = (at[inside, 1] * shape[1] + at[inside, 0]).astype(np.int64)
        order = np.argsort(-away[inside], kind="stable")  # the nearest is written last
        cell, near = cell[order], away[inside][order].astype(np.float32)
        layer = np.full(len(depth), np.inf, dtype=np.float32)
        layer[cell] = near
        flags = np.zeros(len(depth), dtype=bool)
        flags[cell] = above[inside][order]
        inferred = np.where(layer < depth, flags, inferred)
        depth = np.minimum(depth, layer)
    return _closed(depth.reshape(shape), inferred.reshape(shape), chosen)


def _finer(
    one: Backdrop, shot: Shot, chosen: BackdropParameters
) -> tuple[NDArray[np.float64], NDArray[np.bool_]]:
    """(n, 3) points of a backdrop (m, world) near an image, and (n,) which are inferred."""
    eye = shot.world_from_cam[:3, 3] - one.middle
    with np.errstate(invalid="ignore"):
        away = np.nanmin(
            np.linalg.norm(one.points[..., :2] - eye[:2], axis=2), axis=0, initial=np.inf
        )
    columns = np.flatnonzero(away < chosen.farthest_m)
    if len(columns) < 2 or len(one.points) < 2:
        return np.zeros((0, 3)), np.zeros(0, dtype=bool)
    cut = slice(int(columns[0]), int(columns[-1]) + 1)
    grid, flags = one.points[:, cut], one.inferred[:, cut]
    share = np.arange(chosen.finer, dtype=np.float32) / chosen.finer
    down, right = share[:, None, None, None, None], share[None, :, None, None, None]
    upper = grid[:-1, :-1] * (1 - right) + grid[:-1, 1:] * right
    lower = grid[1:, :-1] * (1 - right) + grid[1:, 1:] * right
    points = (upper * (1 - down) + lower * down).reshape(-1, 3)
    above = np.broadcast_to(
        flags[:-1, :-1], (chosen.finer, chosen.finer, *flags[:-1, :-1].shape)
    ).reshape(-1)
    known = np.isfinite(points[:, 0])
    return points[known].astype(np.float64) + one.middle, above[known]


def _closed(
    depth: NDArray[np.float32], inferred: NDArray[np.bool_], chosen: BackdropParameters
) -> Drawn:
    if not np.isfinite(depth).any():
        return Drawn(np.full(depth.shape, np.nan, dtype=np.float32), inferred)
    distance, nearest = ndimage.distance_transform_edt(np.isinf(depth), return_indices=True)
    at = (nearest[0], nearest[1])
    smooth = cv2.medianBlur(np.ascontiguousarray(depth[at]), chosen.noise_px)
    known = distance <= chosen.gap_px
    return Drawn(np.where(known, smooth, np.nan).astype(np.float32), inferred[at] & known)
