"""OpenCV's own way from calibrated photos to points: StereoSGBM over neighbouring pairs."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.synthetic.camera import Camera

Floats = NDArray[np.float64]


def sgbm_points(
    cameras: list[Camera],
    photos: list[NDArray[np.uint8]],
    reach_m: tuple[float, float],
    alpha: float,
) -> Floats:
    """(n, 3) points of all pairs of neighbours, each way back within a pixel. reach_m: depths.

    alpha: `stereoRectify`'s: 0 enlarges until no border shows, -1 leaves the size.
    """
    two = zip(cameras[:-1], cameras[1:], photos[:-1], photos[1:], strict=True)
    return np.concatenate([_pair(*one, reach_m, alpha) for one in two])


def _pair(
    left: Camera,
    right: Camera,
    one: NDArray[np.uint8],
    other: NDArray[np.uint8],
    reach_m: tuple[float, float],
    alpha: float,
) -> Floats:
    relative = right.cam_from_world @ np.linalg.inv(left.cam_from_world)
    size = (left.width_px, left.height_px)
    half = np.array([[0.0, 0.0, 0.5], [0.0, 0.0, 0.5], [0.0, 0.0, 0.0]])
    none = np.zeros(5)
    inner = [camera.intrinsics - half for camera in (left, right)]
    turns = cv2.stereoRectify(
        inner[0],
        none,
        inner[1],
        none,
        size,
        relative[:3, :3],
        relative[:3, 3:],
        flags=cv2.CALIB_ZERO_DISPARITY,
        alpha=alpha,
    )
    r1, r2, p1, p2, q = turns[:5]
    flat = []
    for matrix, turn, projection, photo in ((inner[0], r1, p1, one), (inner[1], r2, p2, other)):
        maps = cv2.initUndistortRectifyMap(matrix, none, turn, projection, size, cv2.CV_32FC1)
        flat.append(cv2.remap(photo, maps[0], maps[1], cv2.INTER_LINEAR))
    ends = [abs(p2[0, 3]) / away for away in (reach_m[1], reach_m[0])]
    low = int(ends[0]) - 1
    count = int(np.ceil((ends[1] - low + 1) / 16)) * 16
    matcher = cv2.StereoSGBM.create(
        low, count, 5, 8 * 3 * 25, 32 * 3 * 25, 1, 0, 10, 100, 2, cv2.STEREO_SGBM_MODE_HH
    )
    disparity = matcher.compute(flat[0], flat[1]).astype(np.float32) / 16.0
    points = cv2.reprojectImageTo3D(disparity, q)[disparity >= low].astype(np.float64)
    points = points[np.isfinite(points).all(axis=1)] @ r1
    pose = left.cam_from_world
    return np.asarray((points - pose[:3, 3]) @ pose[:3, :3])
