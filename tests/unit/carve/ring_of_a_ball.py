"""A ball on a plain background, photographed from a ring: a folder as people have it."""

from __future__ import annotations

from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.cameras import Camera

SIZE, FOCAL, AWAY, RADIUS = 96, 120.0, 3.0, 0.7


def ring_camera(number: int, count: int, height: float = 0.25) -> Camera:
    """A camera about z that looks at the origin."""
    angle = 2.0 * np.pi * number / count
    back = np.array(
        [np.cos(angle) * np.cos(height), np.sin(angle) * np.cos(height), np.sin(height)]
    )
    right = np.array([-np.sin(angle), np.cos(angle), 0.0])
    turn = np.array([right, np.cross(-back, right), -back])
    pose = np.column_stack([turn, -turn @ (AWAY * back)])
    return Camera(f"ball{number:02d}.png", SIZE, SIZE, (FOCAL, FOCAL), (SIZE / 2, SIZE / 2), pose)


def disc(radius: float = RADIUS, size: int = SIZE) -> NDArray[np.bool_]:
    """(size, size) where a ball about the origin is in each photo."""
    y, x = np.mgrid[0:size, 0:size] + 0.5 - size / 2
    return np.hypot(x, y) < FOCAL * radius / np.sqrt(AWAY**2 - radius**2)


def write_ring(
    folder: Path, count: int = 12, *, masks: bool = False, background: int = 30
) -> list[Camera]:
    """Photos, and a `ball_par.txt` with their cameras; masks where they are wanted."""
    folder.mkdir(parents=True, exist_ok=True)
    rng = np.random.default_rng(4)
    cameras = [ring_camera(number, count) for number in range(count)]
    lines = [str(count)]
    for camera in cameras:
        noise = rng.integers(-3, 4, size=(SIZE, SIZE, 3))
        pixels = np.where(disc()[..., None], (60, 120, 200), background) + noise
        cv2.imwrite(str(folder / camera.name), pixels.clip(0, 255).astype(np.uint8))
        numbers = [camera.matrix().ravel(), camera.cam_from_world[:, :3].ravel()]
        numbers += [camera.cam_from_world[:, 3]]
        lines.append(" ".join([camera.name, *map(repr, map(float, np.concatenate(numbers)))]))
        if masks:
            (folder / "masks").mkdir(exist_ok=True)
            cv2.imwrite(str(folder / "masks" / camera.name), disc().astype(np.uint8) * 255)
    (folder / "ball_par.txt").write_text("\n".join(lines) + "\n")
    return cameras
