"""Stereo pictures of a gorge by casting rays, with the depth of each pixel."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from embreex.mesh_construction import TriangleMesh
from embreex.rtcore_scene import EmbreeScene
from numpy.typing import NDArray

from veduta.synthetic.walks.gorge import BARK, LEAF, MOVER, WATER, Gorge

Floats = NDArray[np.float64]
_SUN = np.array([0.45, -0.35, 0.82]) / np.linalg.norm([0.45, -0.35, 0.82])
_TINTS = {
    0: (0.62, 0.55, 0.46), LEAF: (0.30, 0.42, 0.17), BARK: (0.34, 0.26, 0.19),
    WATER: (0.16, 0.22, 0.20), MOVER: (0.66, 0.36, 0.28),
}  # fmt: skip
_SKY = (0.62, 0.74, 0.90)
_CELLS = ((1.7, 0.25), (0.45, 0.3), (0.12, 0.27), (0.04, 0.18))
"""The grain of the texture: how large (m), and how strong."""
_MIRRORED, _RIPPLE = 0.75, 0.004
"""Share of the light that water mirrors, and how far ripples turn what is mirrored."""


@dataclass(frozen=True)
class WalkCamera:
    """An ideal camera. Camera frame: x right, y down, z forward; pixel centres at (0.5, 0.5)."""

    width_px: int
    height_px: int
    focal_px: float
    world_from_camera: Floats


@dataclass(frozen=True, eq=False)
class WalkShot:
    """image: (h, w, 3) uint8. depth_m: (h, w) along the axis, NaN in the sky.

    kind: (h, w) what is seen, as `Gorge.kind`; -1 in the sky.
    """

    image: NDArray[np.uint8]
    depth_m: Floats
    kind: NDArray[np.int32]


class GorgeScene:
    """A gorge that rays can be cast into."""

    def __init__(self, gorge: Gorge) -> None:
        self._gorge = gorge
        self._scene = EmbreeScene()
        corners = gorge.vertices[gorge.triangles].astype(np.float32)
        TriangleMesh(self._scene, corners)
        across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        length = np.maximum(np.linalg.norm(across, axis=1, keepdims=True), 1e-9)
        self._normals = across.astype(np.float64) / length

    def shoot(self, camera: WalkCamera, exposure: float = 1.0, samples: int = 2) -> WalkShot:
        """A picture, of samples x samples rays a pixel; depth is through the pixel centres."""
        light = np.zeros((camera.height_px, camera.width_px, 3))
        for row in range(samples):
            for column in range(samples):
                offset = (np.array([column, row]) + 0.5) / samples
                light += self._seen(camera, offset)[0] / samples**2
        _, depth, kind = self._seen(camera, np.array([0.5, 0.5]))
        display = np.clip(light * exposure, 0.0, 1.0) ** (1.0 / 2.2)
        return WalkShot(np.round(255.0 * display).astype(np.uint8), depth, kind)

    def _seen(self, camera: WalkCamera, offset: Floats) -> tuple[Floats, Floats, NDArray[np.int32]]:
        shape = (camera.height_px, camera.width_px)
        x, y = np.meshgrid(np.arange(shape[1]) + offset[0], np.arange(shape[0]) + offset[1])
        middle = np.array([shape[1] / 2.0, shape[0] / 2.0])
        plane = np.stack([(x - middle[0]) / camera.focal_px, (y - middle[1]) / camera.focal_px], -1)
        local = np.concatenate([plane, np.ones((*shape, 1))], axis=-1).reshape(-1, 3)
        length = np.linalg.norm(local, axis=1)
        rays = local @ camera.world_from_camera[:3, :3].T / length[:, None]
        origins = np.broadcast_to(camera.world_from_camera[:3, 3], rays.shape)
        which, distance = self._hits(origins, rays)
        colour = self._light(origins, rays, which, distance)
        mirrored = (which >= 0) & (self._gorge.kind[which] == WATER)
        if mirrored.any():
            points = origins[mirrored] + rays[mirrored] * distance[mirrored, None]
            colour[mirrored] = self._water(points, rays[mirrored], colour[mirrored])
        depth = np.where(which >= 0, distance / length, np.nan)
        kind = np.where(which >= 0, self._gorge.kind[which], -1).astype(np.int32)
        return colour.reshape(*shape, 3), depth.reshape(shape), kind.reshape(shape)

    def _hits(self, origins: Floats, rays: Floats) -> tuple[NDArray[np.integer], Floats]:
        """(n,) the triangle that each ray meets, -1 for none, and how far away it is."""
        found = self._scene.run(
            np.ascontiguousarray(origins, dtype=np.float32), rays.astype(np.float32), output=True
        )
        return found["primID"], found["tfar"].astype(np.float64)

    def _light(
        self, origins: Floats, rays: Floats, which: NDArray[np.integer], distance: Floats
    ) -> Floats:
        """(n, 3) what comes along each ray."""
        colour = np.tile(np.array(_SKY), (len(rays), 1))
        hit = which >= 0
        points = origins[hit] + rays[hit] * distance[hit, None]
        colour[hit] = self._colour(points, which[hit], rays[hit])
        return colour

    def _water(self, points: Floats, rays: Floats, own: Floats) -> Floats:
        """What level water mirrors, a little turned by ripples, over its own colour."""
        turned = rays * np.array([1.0, 1.0, -1.0])
        for axis, seed in ((0, 20), (1, 21)):
            turned[:, axis] += _RIPPLE * (_noise_3d(points / 0.25, seed) - 0.5)
        turned /= np.linalg.norm(turned, axis=1, keepdims=True)
        above = points + np.array([0.0, 0.0, 1e-3])
        which, distance = self._hits(above, turned)
        seen = self._light(above, turned, which, distance)
        return np.asarray(_MIRRORED * seen + (1.0 - _MIRRORED) * own)

    def _colour(self, points: Floats, which: NDArray[np.integer], rays: Floats) -> Floats:
        """Rock and leaves by noise in space, lit by the sun and the sky."""
        normals = self._normals[which]
        normals = normals * np.where((normals * rays).sum(axis=1) > 0.0, -1.0, 1.0)[:, None]
        light = 0.35 + 0.65 * np.maximum(normals @ _SUN, 0.0)
        kinds = self._gorge.kind[which]
        if self._gorge.mover_m is not None:
            points = points - np.where((kinds == MOVER)[:, None], self._gorge.mover_m, 0.0)
        pattern = np.zeros(len(points))
        for number, (cell, strength) in enumerate(_CELLS):
            pattern += strength * _noise_3d(points / cell, number)
        tints = np.array([_TINTS[kind] for kind in sorted(_TINTS)])
        contrast = np.clip(0.8 + 3.2 * (pattern - 0.5), 0.08, 2.2)
        linear = (tints[kinds] ** 2.2) * contrast[:, None]
        return np.asarray(linear * light[:, None] * 1.5)


def _noise_3d(points: Floats, seed: int) -> Floats:
    """Value noise in space, 0..1: hashed values at whole numbers, smooth in between."""
    whole = np.floor(points).astype(np.int64)
    share = points - whole
    share = share * share * (3.0 - 2.0 * share)
    total = np.zeros(len(points))
    for corner in range(8):
        bits = np.array([corner & 1, corner >> 1 & 1, corner >> 2 & 1])
        weight = np.where(bits == 1, share, 1.0 - share).prod(axis=1)
        total += weight * _hashed(whole + bits, seed)
    return total


def _hashed(cells: NDArray[np.int64], seed: int) -> Floats:
    """A number 0..1 for each row of whole numbers, the same wherever it is asked for."""
    mixed = cells.astype(np.uint64) * np.array(
        [0x9E3779B1, 0x85EBCA77, 0xC2B2AE3D], dtype=np.uint64
    )
    word = mixed[:, 0] ^ mixed[:, 1] ^ mixed[:, 2] ^ np.uint64(seed * 0x27D4EB2F)
    word = (word ^ (word >> np.uint64(15))) * np.uint64(0x2C1B3C6D)
    word = (word ^ (word >> np.uint64(12))) * np.uint64(0x297A2D39)
    word = word ^ (word >> np.uint64(15))
    return (word & np.uint64(0xFFFFFF)).astype(np.float64) / float(0xFFFFFF)
