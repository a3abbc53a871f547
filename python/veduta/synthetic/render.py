"""Renders any place through any camera: radiance, and per pixel the feature and the depth.

Ray casting over bands of rows. One ray per sample finds the surface; one shadow ray goes to the
sun and one into the hemisphere above the surface (ambient occlusion); glass mirrors the sky, and
what stands behind surfaces that are not opaque is seen through them.
"""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.synthetic.camera import Camera
from veduta.synthetic.light import Light
from veduta.synthetic.scene import Hits, RayScene

Floats = NDArray[np.float32]
_BAND_ROWS = 96
_OFFSET_M = 2e-3
_AMBIENT_REACH_M = 2.5
_SUN_RADIUS_RAD = 0.0047
_GLASS_FACING = 0.13
_MOST_PANES = 4
"""That a ray goes through."""


@dataclass(frozen=True)
class Measured:
    """What a range camera with class knowledge would see through each pixel's centre.

    `feature` (h, w) int32, -1 where nothing is hit; `depth_m` (h, w) float32 along the optical
    axis, NaN where nothing is hit.
    """

    feature: NDArray[np.int32]
    depth_m: Floats


def measure(scene: RayScene, camera: Camera, threads: int = 2) -> Measured:
    """Feature and depth through the pixel centres."""
    feature = np.full((camera.height_px, camera.width_px), -1, np.int32)
    depth = np.full((camera.height_px, camera.width_px), np.nan, np.float32)

    def band(rows: range) -> None:
        origins, rays = _primary(camera, rows, (0.5, 0.5))
        hits = scene.cast(origins, rays)
        feature[rows.start : rows.stop].reshape(-1)[hits.ray] = scene.feature[hits.triangle]
        depth[rows.start : rows.stop].reshape(-1)[hits.ray] = hits.distance

    _in_bands(camera.height_px, band, threads)
    return Measured(feature, depth)


def render(
    scene: RayScene, camera: Camera, light: Light, samples: int = 2, seed: int = 0, threads: int = 2
) -> Floats:
    """Linear radiance (h, w, 3) with `samples` x `samples` rays per pixel."""
    shape = (camera.height_px, camera.width_px)
    direct = np.zeros((*shape, 3), np.float32)
    ambient = np.zeros((*shape, 3), np.float32)
    open_ = np.zeros(shape, np.float32)
    key = np.full(shape, -1, np.int64)
    steps = [(i + 0.5) / samples for i in range(samples)]
    offsets = [(x, y) for x in steps for y in steps]

    def band(rows: range) -> None:
        rng = np.random.default_rng([seed, rows.start])
        part = slice(rows.start, rows.stop)
        for offset in offsets:
            origins, rays = _primary(camera, rows, offset)
            lit, dim, free, polygon = _shade(scene, light, origins, rays, rng)
            direct[part] += lit.reshape(direct[part].shape)
            ambient[part] += dim.reshape(ambient[part].shape)
            open_[part] += free.reshape(open_[part].shape)
            key[part] = polygon.reshape(key[part].shape)

    _in_bands(camera.height_px, band, threads)
    count = np.float32(len(offsets))
    occlusion = _smooth_within(open_ / count, key)
    return direct / count + ambient / count * occlusion[..., None]


def _in_bands(height: int, band: Callable[[range], None], threads: int) -> None:
    bands = [range(top, min(top + _BAND_ROWS, height)) for top in range(0, height, _BAND_ROWS)]
    with ThreadPoolExecutor(threads) as pool:
        list(pool.map(band, bands))


def _primary(camera: Camera, rows: range, offset: tuple[float, float]) -> tuple[Floats, Floats]:
    """Origins and directions (n, 3) of a band; a direction's length makes distance a depth."""
    y, x = np.meshgrid(
        np.arange(rows.start, rows.stop) + offset[1],
        np.arange(camera.width_px) + offset[0],
        indexing="ij",
    )
    rays = camera.rays(np.stack([x.ravel(), y.ravel()], axis=1)).astype(np.float32)
    origins = np.broadcast_to(camera.position_m.astype(np.float32), rays.shape)
    return np.ascontiguousarray(origins), rays


def _shade(
    scene: RayScene,
    light: Light,
    origins: Floats,
    rays: Floats,
    rng: np.random.Generator,
    panes: int = 0,
) -> tuple[Floats, Floats, Floats, NDArray[np.int64]]:
    """Per ray: direct radiance, ambient radiance without occlusion, openness, polygon."""
    hits = scene.cast(origins, rays)
    unit = rays / np.linalg.norm(rays, axis=1, keepdims=True)
    direct, ambient = np.zeros_like(unit), np.zeros_like(unit)
    missed = np.ones(len(rays), np.bool_)
    missed[hits.ray] = False
    direct[missed] = light.seen(unit[missed], skyline=False)
    free = np.ones(len(rays), np.float32)
    polygon = np.full(len(rays), -1, np.int64)
    if len(hits.ray) == 0:
        return direct, ambient, free, polygon
    view = unit[hits.ray]
    normal = scene.normal[hits.triangle]
    facing = np.sum(normal * view, axis=1, keepdims=True)
    normal = np.where(facing > 0, -normal, normal)
    points = origins[hits.ray] + rays[hits.ray] * hits.distance[:, None] + normal * _OFFSET_M
    albedo, mirror = scene.surface(hits)
    shine = _glass(scene, light, hits, view, normal, mirror)
    sun = _sunlight(scene, light, points, normal, rng)
    direct[hits.ray] = albedo * sun + shine
    ambient[hits.ray] = albedo * light.ambient(normal)
    free[hits.ray] = 1.0 - scene.blocked(points, _hemisphere(normal, rng), _AMBIENT_REACH_M)
    polygon[hits.ray] = scene.polygon[hits.triangle]
    opacity = scene.opacity[scene.material[hits.triangle]]
    clear = np.flatnonzero(opacity < 1.0)
    if len(clear) and panes < _MOST_PANES:
        own, through = hits.ray[clear], 1.0 - opacity[clear][:, None]
        beyond = points[clear] + view[clear] * (2.0 * _OFFSET_M) - normal[clear] * _OFFSET_M
        seen = _shade(scene, light, beyond, np.ascontiguousarray(view[clear]), rng, panes + 1)
        direct[own] = (direct[own] - shine[clear]) * (1.0 - through) + shine[clear]
        direct[own] += through * seen[0]
        ambient[own] = (1.0 - through) * ambient[own] + through * seen[1]
        free[own], polygon[own] = seen[2], seen[3]
    return direct, ambient, free, polygon


def _sunlight(
    scene: RayScene, light: Light, points: Floats, normal: Floats, rng: np.random.Generator
) -> Floats:
    """Irradiance from the sun (n, 3), zero in shadow; the sun is a disc, so shadows are soft."""
    irradiance = np.zeros((len(points), 3), np.float32)
    sun_from = np.asarray(light.sun_from, np.float32)
    cosine = normal @ sun_from
    if max(light.sun) <= 0.0:
        return irradiance
    lit = np.flatnonzero(cosine > 1e-3)
    towards = sun_from + _SUN_RADIUS_RAD * rng.standard_normal((len(lit), 3), dtype=np.float32)
    clear = ~scene.blocked(np.ascontiguousarray(points[lit]), towards, 1e3)
    irradiance[lit] = (cosine[lit] * clear)[:, None] * np.asarray(light.sun, np.float32)
    return irradiance


def _glass(
    scene: RayScene, light: Light, hits: Hits, view: Floats, normal: Floats, mirror: Floats
) -> Floats:
    """What mirroring surfaces add: the sky and the far side of the street, by Schlick's law.

    Each pane hangs a little askew (under half a degree), so that neighbours mirror differently.
    """
    shine = np.zeros_like(view)
    glassy = np.flatnonzero(mirror > 0.02)
    if len(glassy) == 0:
        return shine
    pane = scene.polygon[hits.triangle[glassy]].astype(np.uint64)
    twist = (pane[:, None] * np.array([2654435761, 40503, 97], np.uint64)) % np.uint64(1009)
    askew = normal[glassy] + (twist.astype(np.float32) / 1009.0 - 0.5) * 0.05
    askew /= np.linalg.norm(askew, axis=1, keepdims=True)
    incoming = view[glassy]
    cosine = np.clip(-np.sum(askew * incoming, axis=1, keepdims=True), 0.0, 1.0)
    outgoing = incoming + 2.0 * cosine * askew
    share = _GLASS_FACING + (1.0 - _GLASS_FACING) * (1.0 - cosine) ** 5
    shine[glassy] = light.seen(outgoing, skyline=True) * share * mirror[glassy, None]
    return shine


def _hemisphere(normal: Floats, rng: np.random.Generator) -> Floats:
    """Directions (n, 3) above surfaces, denser towards the normal (cosine law)."""
    sphere = rng.standard_normal(normal.shape, dtype=np.float32)
    sphere /= np.maximum(np.linalg.norm(sphere, axis=1, keepdims=True), 1e-6)
    towards = normal + sphere * np.float32(0.999)
    return np.asarray(towards / np.linalg.norm(towards, axis=1, keepdims=True), np.float32)


def _smooth_within(value: Floats, key: NDArray[np.int64], radius: int = 3) -> Floats:
    """The mean over a square window of those pixels that show the same polygon."""
    total, count = value.copy(), np.ones_like(value)
    height, width = value.shape
    for dy in range(-radius, radius + 1):
        for dx in range(-radius, radius + 1):
            if dx == dy == 0:
                continue
            to = (slice(max(0, -dy), height - max(0, dy)), slice(max(0, -dx), width - max(0, dx)))
            of = (slice(max(0, dy), height - max(0, -dy)), slice(max(0, dx), width - max(0, -dx)))
            same = key[to] == key[of]
            total[to] += np.where(same, value[of], 0.0)
            count[to] += same
    return total / count
