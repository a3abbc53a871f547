"""A rig of two cameras carried past the painted corner of `photo_scene`."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from photo_scene import Pose, take_photo
from PIL import Image

BASE_M = 0.5
TURNED_DEG = 25.0
"""How far the right camera looks to the right of the left one."""


def rig_poses(frames: int = 7) -> dict[str, list[Pose]]:
    """Level cameras, half a metre apart: the left one is the body, which looks at the corner."""
    found: dict[str, list[Pose]] = {"left": [], "right": []}
    for turn in np.deg2rad(np.linspace(22.0, 62.0, frames)):
        eye = np.array([6.2 * np.cos(turn), 6.2 * np.sin(turn), 1.7])
        ahead = np.array([0.9, 0.9, 1.7]) - eye
        ahead /= np.linalg.norm(ahead)
        right = np.cross(ahead, (0.0, 0.0, 1.0))
        beside = eye + BASE_M * right
        turned = np.deg2rad(TURNED_DEG)
        aside = np.cos(turned) * ahead + np.sin(turned) * right
        found["left"].append(Pose(_triple(eye), _triple(eye + ahead)))
        found["right"].append(Pose(_triple(beside), _triple(beside + aside)))
    return found


def _triple(place: np.ndarray) -> tuple[float, float, float]:
    x, y, z = (float(value) for value in place)
    return x, y, z


def write_rig(folder: Path, frames: int = 7) -> dict[str, list[Pose]]:
    """The photos, `left/00.png` and on, and the true poses."""
    poses = rig_poses(frames)
    for camera, own in poses.items():
        (folder / camera).mkdir(parents=True)
        for number, pose in enumerate(own):
            Image.fromarray(take_photo(pose)).save(folder / camera / f"{number:02d}.png")
    return poses
