"""Points in space from consecutive images: corners are followed from image to image and intersected.

The paper had such vertices for some segments (sections 5 and 8.1) and sorted them into the layers.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.drive.build.misfit import Frame
from veduta.drive.record import Shot

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class StereoParameters:
    """corners: most of an image. quality, apart_px: of corners (Shi and Tomasi 1994). window_px: of
    following (Lucas and Kanade 1981). there_px: a corner that is followed there and back ends so
    near to where it began. off_px: a point is drawn so near to its corners in three images.
    angle_deg: its rays meet at no less. nearest_m, farthest_m: from the camera.
    moved_m: consecutive images are taken so far apart.
    """

    corners: int = 2500
    quality: float = 0.004
    apart_px: float = 5.0
    window_px: int = 21
    levels: int = 4
    there_px: float = 0.5
    off_px: float = 1.0
    angle_deg: float = 2.0
    nearest_m: float = 2.0
    farthest_m: float = 35.0
    moved_m: tuple[float, float] = (0.2, 5.0)


def stereo_points(
    frames: Sequence[Frame], parameters: StereoParameters | None = None
) -> Floats:
    """(n, 3) points (m, world) that three images in a row agree about; frames in their order."""
    chosen = parameters or StereoParameters()
    found = [np.zeros((0, 3))]
    grey = [np.asarray(cv2.cvtColor(one.pixels, cv2.COLOR_RGB2GRAY), dtype=np.uint8) for one in frames]
    for row in range(len(frames) - 2):
        shots = [one.shot for one in frames[row : row + 3]]
        steps = [np.linalg.norm(b.world_from_cam[:3, 3] - a.world_from_cam[:3, 3])
                 for a, b in zip(shots[:-1], shots[1:], strict=True)]  # fmt: skip
        if all(chosen.moved_m[0] <= step <= chosen.moved_m[1] for step in steps):
            found.append(_of_three(shots, grey[row : row + 3], chosen))
    return np.concatenate(found)


def _of_three(
    shots: Sequence[Shot], grey: Sequence[NDArray[np.uint8]], chosen: StereoParameters
) -> Floats:
    """The middle image's corners are followed to the one before and the one after it."""
    corners = cv2.goodFeaturesToTrack(grey[1], chosen.corners, chosen.quality, chosen.apart_px)
    if corners is None or not len(corners):
        return np.zeros((0, 3))
    start = np.asarray(corners, dtype=np.float32).reshape(-1, 1, 2)
    before, kept = _followed(grey[1], grey[0], start, chosen)
    after, also = _followed(grey[1], grey[2], start, chosen)
    # OpenCV counts from the middle of a pixel, shots from its corner.
    pixels = [one.reshape(-1, 2).astype(np.float64) + 0.5 for one in (before, start, after)]
    rays = [_rays(shot, at) for shot, at in zip(shots, pixels, strict=True)]
    points = _nearest_to(rays, [shot.world_from_cam[:3, 3] for shot in shots])
    kept &= also & np.isfinite(points).all(axis=1)
    cosine = np.clip((rays[0] * rays[2]).sum(axis=1), -1.0, 1.0)
    kept &= np.arccos(cosine) >= np.deg2rad(chosen.angle_deg)
    points = np.where(kept[:, None], points, 0.0)
    for shot, at in zip(shots, pixels, strict=True):
        drawn, depth = shot.project(points)
        kept &= (np.linalg.norm(drawn - at, axis=1) < chosen.off_px) & (depth > chosen.nearest_m)
        kept &= depth < chosen.farthest_m
    return points[kept]


def _followed(
    one: NDArray[np.uint8], other: NDArray[np.uint8], start: NDArray[np.float32], chosen: StereoParameters
) -> tuple[NDArray[np.float32], NDArray[np.bool_]]:
    """Where corners (n, 1, 2) are in another image, and whether they come back (n,)."""
    size = (chosen.window_px, chosen.window_px)
    there, met, _ = cv2.calcOpticalFlowPyrLK(one, other, start, start.copy(), None, None, size, chosen.levels)
    back, came, _ = cv2.calcOpticalFlowPyrLK(other, one, there, there.copy(), None, None, size, chosen.levels)
    near = np.linalg.norm((back - start).reshape(-1, 2), axis=1) < chosen.there_px
    return np.asarray(there, dtype=np.float32), near & (met.ravel() > 0) & (came.ravel() > 0)


def _rays(shot: Shot, pixels: Floats) -> Floats:
    """(n, 3) unit directions in the world."""
    flat = (pixels - np.array(shot.centre_px)) / np.array(shot.focal_px)
    local = np.concatenate([flat, np.ones((len(flat), 1))], axis=1)
    world = local @ shot.world_from_cam[:3, :3].T
    return np.asarray(world / np.linalg.norm(world, axis=1, keepdims=True), dtype=np.float64)


def _nearest_to(rays: Sequence[Floats], eyes: Sequence[Floats]) -> Floats:
    """(n, 3) the points nearest to three rays each (least squares); NaN where they are parallel."""
    matrix, right = np.zeros((len(rays[0]), 3, 3)), np.zeros((len(rays[0]), 3))
    for ray, eye in zip(rays, eyes, strict=True):
        across = np.eye(3) - ray[:, :, None] * ray[:, None, :]
        matrix += across
        right += across @ eye
    sure = np.linalg.det(matrix) > 1e-9
    points = np.full(right.shape, np.nan)
    points[sure] = np.linalg.solve(matrix[sure], right[sure][..., None])[..., 0]
    return points
