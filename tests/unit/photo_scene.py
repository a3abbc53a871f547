"""A corner of two walls and a floor with known cameras, photographed by casting rays at planes."""

from __future__ import annotations

import functools
from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray
from PIL import Image

WIDTH_PX, HEIGHT_PX, FOCAL_PX = 480, 360, 430.0
TEXELS_PER_M = 90


@dataclass(frozen=True)
class Pose:
    """Where a photo is taken (m), and what it looks at."""

    eye: tuple[float, float, float]
    target: tuple[float, float, float] = (0.6, 0.6, 1.4)

    @property
    def rotation(self) -> NDArray[np.float64]:
        """(3, 3) cam_from_world: x right, y down, z forward; the rows of the photo are level."""
        ahead = np.subtract(self.target, self.eye)
        ahead = ahead / np.linalg.norm(ahead)
        right = np.cross(ahead, (0.0, 0.0, 1.0))
        right = right / np.linalg.norm(right)
        return np.stack([right, np.cross(ahead, right), ahead])


ARC = tuple(
    Pose((6.2 * float(np.cos(turn)), 6.2 * float(np.sin(turn)), 1.7))
    for turn in np.deg2rad(np.linspace(22.0, 68.0, 6))
)


def take_photo(pose: Pose, seed: int = 5) -> NDArray[np.uint8]:
    """(h, w, 3) what a pinhole camera sees of the walls x = 0 and y = 0 and of the floor z = 0."""
    columns, rows = np.meshgrid(np.arange(WIDTH_PX) + 0.5, np.arange(HEIGHT_PX) + 0.5)
    rays = np.stack(
        [columns - WIDTH_PX / 2, rows - HEIGHT_PX / 2, np.full(columns.shape, FOCAL_PX)], axis=-1
    )
    rays = rays @ pose.rotation
    with np.errstate(divide="ignore"):
        ways = -np.array(pose.eye) / rays
    ways[ways <= 0] = np.inf
    nearest = ways.argmin(axis=-1)
    points = np.array(pose.eye) + ways.min(axis=-1)[..., None] * rays
    picture = np.zeros((HEIGHT_PX, WIDTH_PX, 3), dtype=np.uint8)
    for axis in range(3):
        across, up = (other for other in range(3) if other != axis)
        place = (points[..., [across, up]] * TEXELS_PER_M).astype(np.float32)
        texture = _texture(seed + axis)
        seen = cv2.remap(
            texture, place[..., 0], place[..., 1], cv2.INTER_LINEAR, borderMode=cv2.BORDER_REFLECT
        )
        picture[nearest == axis] = seen[nearest == axis]
    return picture


@functools.cache
def _texture(seed: int) -> NDArray[np.uint8]:
    """(1000, 1000, 3) spots of several sizes, different in each place."""
    rng = np.random.default_rng(seed)
    sum_ = np.zeros((1000, 1000, 3), dtype=np.float32)
    for size, weight in ((3, 0.5), (8, 1.0), (25, 1.0), (80, 0.8)):
        small = rng.standard_normal((1000 // size + 2, 1000 // size + 2, 3)).astype(np.float32)
        sum_ += weight * cv2.resize(small, (1000, 1000), interpolation=cv2.INTER_CUBIC)
    return np.clip(128 + 45 * sum_, 0, 255).astype(np.uint8)


def write_photos(folder: Path, poses: tuple[Pose, ...] = ARC, seed: int = 5) -> list[Path]:
    """Photos as PNG, `view0.png` and on."""
    folder.mkdir(parents=True, exist_ok=True)
    paths = []
    for number, pose in enumerate(poses):
        paths.append(folder / f"view{number}.png")
        Image.fromarray(take_photo(pose, seed)).save(paths[-1])
    return paths
