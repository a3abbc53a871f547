"""Sun and sky: where light comes from, and what one sees (or glass mirrors) in a direction."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.synthetic.noise import fractal_noise
from veduta.synthetic.seeds import stream

Directions = NDArray[np.float32]
_MAP = (256, 1024)


@dataclass(frozen=True)
class Light:
    """Daylight. `sun_from` points from the scene to the sun (unit, world); colours are linear.

    `sky_map` (256, 1024, 3) is the sky by elevation (row 0 is the zenith, the last row the
    horizon) and azimuth; `skyline_rad` (1024,) is how high the far side of the street stands.
    """

    sun_from: tuple[float, float, float]
    sun: tuple[float, float, float]
    sky: tuple[float, float, float]
    bounce: tuple[float, float, float]
    sky_map: NDArray[np.float32]
    skyline_rad: NDArray[np.float32]

    def ambient(self, normals: Directions) -> NDArray[np.float32]:
        """Unshadowed light from sky and ground on surfaces with these normals (n, 3)."""
        up = 0.5 + 0.5 * normals[:, 2:3]
        sky, bounce = np.asarray(self.sky, np.float32), np.asarray(self.bounce, np.float32)
        return up * sky + (1.0 - up) * bounce

    def seen(self, directions: Directions, skyline: bool) -> NDArray[np.float32]:
        """Radiance (n, 3) from unit directions; `skyline` puts the far side of the street in."""
        rows, columns = _MAP
        azimuth = np.arctan2(directions[:, 1], directions[:, 0]) / (2 * np.pi) % 1.0
        elevation = np.arcsin(np.clip(directions[:, 2], -1.0, 1.0))
        column = np.minimum((azimuth * columns).astype(np.int32), columns - 1)
        row = ((1.0 - np.clip(elevation, 0, None) / (np.pi / 2)) * rows).astype(np.int32)
        radiance = self.sky_map[np.minimum(row, rows - 1), column]
        if skyline:
            below = elevation < self.skyline_rad[column]
            depth = np.clip(elevation / np.maximum(self.skyline_rad[column], 1e-3), 0, 1)
            wall = np.array([0.16, 0.15, 0.135], np.float32) * (0.6 + 0.5 * depth)[:, None]
            radiance = np.where(below[:, None], wall, radiance)
        return radiance.astype(np.float32)


def daylight(seed: int, sunny: bool, azimuth_rad: float, elevation_rad: float) -> Light:
    """A day. The azimuth is counted from x towards y of the world; the facade looks to -y."""
    c = float(np.cos(elevation_rad))
    towards = (c * float(np.cos(azimuth_rad)), c * float(np.sin(azimuth_rad)),
               float(np.sin(elevation_rad)))  # fmt: skip
    rng = stream(seed, "sky")
    rows, columns = _MAP
    height = 1.0 - (np.arange(rows, dtype=np.float32)[:, None, None] + 0.5) / rows
    zenith = np.array([0.20, 0.38, 0.72], np.float32)
    horizon = np.array([0.66, 0.78, 0.90], np.float32)
    blue = horizon + (zenith - horizon) * height**0.55
    cloud = 0.5 + 0.9 * fractal_noise(rng, (rows, columns), 90.0, 5)[..., None]
    if sunny:
        cover = np.clip((cloud - 0.48) * 1.7, 0.0, 0.9)
        white = np.array([0.98, 0.97, 0.95], np.float32) * (0.82 + 0.22 * cloud)
        sky, sun, dome, bounce = (
            blue * (1 - cover) + white * cover, (1.15, 1.05, 0.90), (0.42, 0.48, 0.58),
            (0.30, 0.28, 0.25),
        )  # fmt: skip
    else:
        sky = np.array([0.80, 0.83, 0.87], np.float32) * (0.80 + 0.22 * cloud + 0.1 * height)
        sun, dome, bounce = (0.0, 0.0, 0.0), (0.95, 0.98, 1.02), (0.38, 0.37, 0.35)
    steps = np.repeat(rng.uniform(0.20, 0.42, 32), columns // 32).astype(np.float32)
    return Light(towards, sun, dome, bounce, sky.astype(np.float32), steps)
