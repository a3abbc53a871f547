"""A room whose walls are noise, seen through any lens: rays meet the six sides of a box."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
HALF_M = np.array([4.0, 5.0, 2.5])
TEXELS = 700


def room(seed: int) -> NDArray[np.uint8]:
    """(6, t, t) a texture of each side."""
    rng = np.random.default_rng(seed)
    sides = []
    for _ in range(6):
        total = np.full((TEXELS, TEXELS), 128.0, np.float32)
        for cells, strength in ((12, 20.0), (45, 25.0), (140, 22.0)):
            coarse = rng.standard_normal((cells, cells)).astype(np.float32)
            total += strength * cv2.resize(coarse, (TEXELS, TEXELS), interpolation=cv2.INTER_CUBIC)
        sides.append(np.clip(total, 0, 255).astype(np.uint8))
    return np.array(sides)


def seen(textures: NDArray[np.uint8], place: Floats, rays: Floats) -> NDArray[np.uint8]:
    """(h, w, 3) what (h, w, 3) rays from a place inside meet."""
    with np.errstate(divide="ignore"):
        reach = (np.sign(rays) * HALF_M - place) / rays
    axis = reach.argmin(axis=2)
    hit = place + np.take_along_axis(reach, axis[..., None], axis=2) * rays
    share = np.clip((hit / HALF_M + 1.0) / 2.0, 0.0, 0.9999)
    first, second = np.array([1, 0, 0])[axis], np.array([2, 2, 1])[axis]
    u = np.take_along_axis(share, first[..., None], axis=2)[..., 0]
    v = np.take_along_axis(share, second[..., None], axis=2)[..., 0]
    positive = np.take_along_axis(rays, axis[..., None], axis=2)[..., 0] > 0
    side = 2 * axis + positive
    grey = np.zeros(side.shape, np.uint8)
    for number in range(6):
        own = side == number
        x, y = (u * TEXELS).astype(np.float32), (v * TEXELS).astype(np.float32)
        shown = cv2.remap(textures[number], x, y, cv2.INTER_LINEAR, borderMode=cv2.BORDER_REFLECT)
        grey[own] = shown[own]
    return np.repeat(grey[..., None], 3, axis=2)


def equirectangular_rays(width: int) -> Floats:
    """(w/2, w, 3) x east, y north in the middle, z up."""
    longitude = ((np.arange(width) + 0.5) / width - 0.5) * 2.0 * np.pi
    latitude = (0.5 - (np.arange(width // 2) + 0.5) / (width // 2)) * np.pi
    lon, lat = np.meshgrid(longitude, latitude)
    return np.stack([np.cos(lat) * np.sin(lon), np.cos(lat) * np.cos(lon), np.sin(lat)], axis=2)


def fisheye_rays(side: int, focal_px: float, heading: float) -> Floats:
    """(side, side, 3) of an equidistant fisheye that looks level; behind it, its rim goes on."""
    place = (np.arange(side) + 0.5 - side / 2.0) / focal_px
    x, y = np.meshgrid(place, place)
    angle = np.minimum(np.hypot(x, y), 0.499 * np.pi)
    around = np.maximum(np.hypot(x, y), 1e-12)
    own = np.stack([np.sin(angle) * x / around, np.sin(angle) * y / around, np.cos(angle)], axis=2)
    c, s = np.cos(heading), np.sin(heading)
    world_from_cam = np.array([[c, 0.0, s], [-s, 0.0, c], [0.0, -1.0, 0.0]])
    return own @ world_from_cam.T
