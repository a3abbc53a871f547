"""A painted bowl, whose hollow no silhouette shows, photographed from rings of cameras."""

from __future__ import annotations

import numpy as np
import trimesh
from numpy.typing import NDArray

from veduta import _core
from veduta.cameras import Camera
from veduta.carve.views import View, camera_rows

OUTER, INNER = 0.5, 0.4
"""Radii of the two hemispheres, m."""
VOLUME = 2.0 / 3.0 * np.pi * (OUTER**3 - INNER**3)
HOLLOW = 2.0 / 3.0 * np.pi * INNER**3


def bowl_mesh(parts: int = 72) -> trimesh.Trimesh:
    """Open to above, its rim at z = 0."""
    down = np.linspace(-np.pi / 2.0, 0.0, parts)
    outer = OUTER * np.column_stack([np.cos(down), np.sin(down)])
    inner = INNER * np.column_stack([np.cos(down), np.sin(down)])[::-1]
    rim = np.column_stack([np.linspace(OUTER, INNER, 12)[1:-1], np.zeros(10)])
    profile = np.concatenate([outer, rim, inner])
    profile[[0, -1], 0] = 0.0
    return trimesh.creation.revolve(profile, sections=3 * parts)


def painted(places: NDArray[np.float64], grain: float, contrast: float = 90.0) -> NDArray[np.uint8]:
    """(n, 3) the colours of a block of stone, whose grains are so large (m), at (n, 3) places."""
    rng = np.random.default_rng(7)
    waves = rng.normal(0.0, 1.0, (3, 10, 3)) * np.pi / grain
    phases = rng.uniform(0.0, 2.0 * np.pi, (3, 10))
    each = [
        np.sin(places @ wave.T + phase).sum(axis=1)
        for wave, phase in zip(waves, phases, strict=True)
    ]
    values = np.tanh(np.column_stack(each) / 2.0)
    return (130.0 + contrast * values).clip(0, 255).astype(np.uint8)


def rings(size: int) -> list[Camera]:
    """Rings of cameras about the bowl, from level to high above, that look at its middle."""
    cameras: list[Camera] = []
    for count, height in ((16, 0.1), (16, 0.55), (16, 0.95), (10, 1.25), (8, -0.6)):
        for number in range(count):
            angle = 2.0 * np.pi * (number + 0.5 * (height > 0.5)) / count
            back = np.array(
                [np.cos(angle) * np.cos(height), np.sin(angle) * np.cos(height), np.sin(height)]
            )
            right = np.array([-np.sin(angle), np.cos(angle), 0.0])
            turn = np.array([right, np.cross(-back, right), -back])
            pose = np.column_stack([turn, -turn @ (2.6 * back + [0.0, 0.0, -0.2])])
            focal = (2.0 * size, 2.0 * size)
            half = (size / 2.0, size / 2.0)
            cameras.append(Camera(f"bowl{len(cameras):02d}", size, size, focal, half, pose))
    return cameras


def bowl_views(size: int = 240, grain: float = 0.12, noise: float = 2.0) -> list[View]:
    """Photos of it with silhouettes, noise (grey levels) in their colours."""
    mesh = bowl_mesh()
    cameras = rings(size)
    seen = _core.seen_triangles(
        camera_rows(cameras),
        [(size, size)] * len(cameras),
        np.asarray(mesh.vertices, dtype=np.float64),
        np.asarray(mesh.faces, dtype=np.uint32),
    )
    colours = painted(np.asarray(mesh.triangles_center), grain)
    rng = np.random.default_rng(11)
    views = []
    for camera, one in zip(cameras, seen, strict=True):
        mask = one >= 0
        clean = np.where(mask[..., None], colours[one.clip(0)], 20).astype(np.float64)
        photo = (clean + rng.normal(0.0, noise, clean.shape)).clip(0, 255)
        views.append(View(camera, photo.astype(np.uint8), mask, "mask"))
    return views
