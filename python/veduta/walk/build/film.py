"""The walk as a film: what the player draws, frame by frame, at walking speed."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation, Slerp

from veduta.run.errors import InputError
from veduta.walk.build.render import Transition, draw_between
from veduta.walk.build.sampling import sampled
from veduta.walk.build.screen import Screen
from veduta.walk.build.way import Way
from veduta.walk.rig import Image

FRAMES_S = 25
_CODES = ("vp09", "mp4v")
"""Of films, the first that is there: browsers play VP9 in MP4, and not MPEG-4 Part 2. OpenCV's own
packages bring no H.264."""
Shown = tuple[Image, Screen]
_SHORTEST_M = 0.5


def write_film(path: Path, frames: Iterator[Image], screen: Screen) -> int:
    """Write frames as MP4; how many there were. InputError where no encoder does it."""
    size = (screen.width_px // 2 * 2, screen.height_px // 2 * 2)
    writer = cv2.VideoWriter()
    if not any(
        writer.open(str(path), cv2.VideoWriter.fourcc(*code), FRAMES_S, size) for code in _CODES
    ):
        raise InputError(path, "cannot be written as MP4 here", "Leave --video away.")
    count = 0
    try:
        for frame in frames:
            writer.write(np.ascontiguousarray(frame[: size[1], : size[0], ::-1]))
            count += 1
    finally:
        writer.release()
    return count


def frames_of(
    way: Way, first: Shown, second: Shown, screen: Screen, speed_m_s: float
) -> Iterator[Image]:
    """The frames of a transition, its end not among them. first, second: pictures of the two ends
    and what they are on; screen: that of the film, a plane.
    """
    length_m = max(way.distance_m if way.forth is not None else 0.0, _SHORTEST_M)
    count = max(1, round(length_m / speed_m_s * FRAMES_S))
    for number in range(count):
        yield frame_at(way, first, second, screen, number / count)


def flat_picture(image: Image, own: Screen, screen: Screen) -> Image:
    """A picture as another screen in the same camera's frame shows it."""
    if own == screen:
        return image
    rays = screen.points(screen.pixels, np.ones(screen.pixels.shape[:2]))
    pixels = np.nan_to_num(own.project(rays)[0], nan=-1e4)
    return np.clip(np.round(sampled(image, pixels)), 0, 255).astype(np.uint8)


def frame_at(way: Way, start: Shown, end: Shown, screen: Screen, m: float) -> Image:
    """What is seen at m (0..1) of a transition of any kind."""
    if way.kind == "morph" and way.forth is not None and way.back is not None:
        transition = Transition(way.forth, way.back, way.second_from_first, start[0], end[0])
        return draw_between(transition, m, pose_at(way.second_from_first, m), screen)[0]
    first, second = (flat_picture(*shown, screen) for shown in (start, end))
    if way.kind == "cut":
        return first if m < 0.5 else second
    mixed = (1.0 - m) * first.astype(np.float32) + m * second.astype(np.float32)
    return np.round(mixed).astype(np.uint8)


def pose_at(second_from_first: NDArray[np.float64], m: float) -> NDArray[np.float64]:
    """(3, 4) cam_from_first on the straight way between both cameras, turning evenly."""
    turns = Rotation.from_matrix(np.stack([np.eye(3), second_from_first[:, :3]]))
    turn = Slerp([0.0, 1.0], turns)(m).as_matrix()
    centre = -m * second_from_first[:, :3].T @ second_from_first[:, 3]
    return np.column_stack([turn, -turn @ centre])
