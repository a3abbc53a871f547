"""A wall with a block before it, of known depths in closed form, seen by cameras in a row."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image

WIDTH, HEIGHT, FOCAL = 160, 120, 150.0
WALL_M, BLOCK_M = 6.0, 4.6
TURN = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])
"""Camera from world, z up, looking along +y."""
Floats = NDArray[np.float64]


def eyes(count: int, spacing_m: float = 0.45) -> Floats:
    """Where the cameras stand."""
    x = (np.arange(count) - (count - 1) / 2.0) * spacing_m
    return np.stack([x, np.zeros(count), 0.6 + 0.05 * np.cos(3.0 * np.arange(count))], axis=1)


def depths(eye: Floats) -> tuple[Floats, Floats]:
    """(h, w) depths along y, and (h, w, 3) points of the world."""
    u, v = np.meshgrid(np.arange(WIDTH) + 0.5, np.arange(HEIGHT) + 0.5)
    rays = np.stack([(u - WIDTH / 2) / FOCAL, np.ones_like(u), -(v - HEIGHT / 2) / FOCAL], axis=-1)
    on_block = eye + rays * (BLOCK_M - eye[1])
    hit = (np.abs(on_block[..., 0]) < 0.6) & (np.abs(on_block[..., 2] - 0.6) < 0.5)
    found = np.where(hit, BLOCK_M - eye[1], WALL_M - eye[1])
    return found, eye + rays * found[..., None]


def picture(eye: Floats) -> NDArray[np.uint8]:
    """(h, w, 3) a pattern that lies on the surfaces, without repetition."""
    _, points = depths(eye)
    x, y, z = points[..., 0], points[..., 1], points[..., 2]
    waves = (
        np.sin(7.1 * x + y) * np.cos(6.3 * z + 1.0)
        + np.sin(13.7 * x + 4.0 * z)
        + np.cos(11.0 * z - 3.3 * x)
        + 0.8 * np.sin(23.0 * x + 17.0 * z)
        + 0.6 * np.cos(31.0 * x - 27.0 * z)
    )
    grey = np.clip(128.0 + 26.0 * waves, 0.0, 255.0)
    return np.stack([grey, 0.8 * grey, 0.6 * grey], axis=-1).round().astype(np.uint8)


def write_set(folder: Path, count: int = 4, *, mirrored: bool = False) -> Path:
    """`.camera` files and photos, in the folder."""
    (folder / "cameras").mkdir(parents=True)
    (folder / "images").mkdir()
    matrix = np.array(
        [[FOCAL, 0.0, WIDTH / 2 - 0.5], [0.0, FOCAL, HEIGHT / 2 - 0.5], [0.0, 0.0, 1.0]]
    )
    for number, eye in enumerate(eyes(count)):
        pixels = picture(eye)
        Image.fromarray(pixels[:, ::-1] if mirrored else pixels).save(
            folder / "images" / f"view{number}.png"
        )
        rows = [matrix, np.zeros((1, 3)), TURN.T, eye[None], np.array([[WIDTH, HEIGHT]])]
        text = "\n".join(" ".join(map(repr, row)) for block in rows for row in block.tolist())
        (folder / "cameras" / f"view{number}.camera").write_text(text)
    return folder
