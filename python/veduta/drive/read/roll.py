"""How far the vehicle leans to the side, from upright edges in its images (section 2).

Scans that look level and a surface model tell where a vehicle is, its heading and pitch; edges of
houses, doors and poles are upright, and say the rest.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray
from scipy import ndimage
from scipy.spatial.transform import Rotation

from veduta.drive.record import Shot
from veduta.imaging.read import read_image

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class RollParameters:
    """wide_px: edges are found at this width. shortest: of an edge, share of the image's height.
    most_rad: no street makes a vehicle lean more. step_rad: between leanings that are compared.
    sigma_rad: how far upright edges are off. edges_rad: edges that lean more are not upright.
    fewest: edges that agree. apart_m: images nearer to the last one that was used are left out.
    together: images in a row of which the median is taken.
    """

    wide_px: int = 960
    shortest: float = 0.06
    most_rad: float = 0.12
    step_rad: float = 0.001
    sigma_rad: float = 0.006
    edges_rad: float = 0.25
    fewest: int = 8
    apart_m: float = 1.5
    together: int = 5


@dataclass(frozen=True, eq=False)
class Roll:
    """times_s: (k,) of the images that told it. roll_rad: (k,) about the way ahead, to the right
    where positive. looked: images that were asked.
    """

    times_s: Floats
    roll_rad: Floats
    looked: int

    def onto(self, times_s: Floats, poses: Floats) -> Floats:
        """(p, 3, 4) world_from_vehicle that lean as the images say. times_s: (p,) theirs."""
        lean = np.interp(times_s, self.times_s, self.roll_rad)
        turned = poses.copy()
        ahead = poses[:, :3, 0]
        turn = Rotation.from_rotvec(ahead * lean[:, None]).as_matrix()
        turned[:, :3, :3] = turn @ poses[:, :3, :3]
        return turned


def find_roll(
    shots: Sequence[Shot], ahead: Floats, parameters: RollParameters | None = None
) -> Roll | None:
    """ahead: (n, 3) unit, the vehicle's x axis at each image (world). None where too few images
    show upright edges.
    """
    chosen = parameters or RollParameters()
    times, found, looked = [], [], 0
    last: Floats | None = None
    for shot, axis in zip(shots, ahead, strict=True):
        place = shot.world_from_cam[:3, 3]
        if last is not None and np.linalg.norm(place - last) < chosen.apart_m:
            continue
        last, looked = place, looked + 1
        lean = roll_in(read_image(shot.path).pixels, shot, axis, chosen)
        if lean is not None:
            times.append(shot.time_s)
            found.append(lean)
    if len(found) < chosen.together:
        return None
    order = np.argsort(times, kind="stable")
    steady = ndimage.median_filter(np.array(found)[order], chosen.together, mode="nearest")
    return Roll(np.array(times)[order], np.asarray(steady, dtype=np.float64), looked)


def roll_in(
    pixels: NDArray[np.uint8], shot: Shot, ahead: Floats, parameters: RollParameters | None = None
) -> float | None:
    """What an image tells (rad); None where too few of its edges agree."""
    chosen = parameters or RollParameters()
    planes, length = _edges(pixels, shot, chosen)
    if not len(planes):
        return None
    leans = np.arange(-chosen.most_rad, chosen.most_rad + 1e-9, chosen.step_rad)
    turns = Rotation.from_rotvec(-np.outer(leans, ahead)).as_matrix()
    up = turns @ np.array([0.0, 0.0, 1.0]) @ shot.world_from_cam[:3, :3]  # (k, 3), in the camera
    level = np.abs(planes @ up[len(up) // 2])
    upright = level < np.sin(chosen.edges_rad)
    if upright.sum() < chosen.fewest:
        return None
    off = planes[upright] @ up.T
    near = np.exp(-0.5 * (off / chosen.sigma_rad) ** 2)
    score = length[upright] @ near
    best = int(np.argmax(score))
    agree = (np.abs(off[:, best]) < 2.0 * chosen.sigma_rad).sum()
    if best in (0, len(leans) - 1) or agree < chosen.fewest:
        return None
    around = score[best - 1 : best + 2]
    bend = around[0] - 2.0 * around[1] + around[2]
    shift = 0.5 * (around[0] - around[2]) / bend if bend < 0.0 else 0.0
    return float(leans[best] + shift * chosen.step_rad)


def _edges(pixels: NDArray[np.uint8], shot: Shot, chosen: RollParameters) -> tuple[Floats, Floats]:
    """(n, 3) unit normals, in the camera, of the planes through it and each straight edge; and
    (n,) how long the edges are (px).
    """
    share = min(1.0, chosen.wide_px / shot.width_px)
    grey = cv2.cvtColor(pixels, cv2.COLOR_RGB2GRAY)
    small = cv2.resize(grey, None, fx=share, fy=share, interpolation=cv2.INTER_AREA)
    lines = cv2.createLineSegmentDetector().detect(small)[0]
    ends = np.asarray([] if lines is None else lines, dtype=np.float64).reshape(-1, 2, 2)
    length = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
    long = length > chosen.shortest * small.shape[0]
    at = (ends[long] + 0.5) / share
    rays = np.ones((len(at), 2, 3))
    rays[..., :2] = (at - np.array(shot.centre_px)) / np.array(shot.focal_px)
    planes = np.cross(rays[:, 0], rays[:, 1])
    return planes / np.linalg.norm(planes, axis=1, keepdims=True), length[long]
