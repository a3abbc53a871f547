"""Sun and sky: where light comes from, and what one sees (or glass mirrors) in a direction."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.synthetic.noise import fractal_noise
from veduta.synthetic.seeds import stream

Directions = NDArray[np.float32]
_ZENITH = np.array([0.16, 0.33, 0.68], np.float32)
_HORIZON = np.array([0.64, 0.77, 0.90], np.float32)
_WHITE = np.array([0.98, 0.97, 0.95], np.float32)
_GREY = np.array([0.80, 0.83, 0.87], np.float32)
_FAR_SIDE = np.array([0.16, 0.15, 0.135], np.float32)


@dataclass(frozen=True)
class Light:
    """Daylight. `sun_from` points from the scene to the sun (unit, world); colours are linear.

    `clouds` (n, n) is how much cloud there is, 0..1, on a level ceiling that repeats;
    `skyline_rad` (k,) is how high the far side of the street stands, by azimuth.
    """

    sun_from: tuple[float, float, float]
    sun: tuple[float, float, float]
    sky: tuple[float, float, float]
    bounce: tuple[float, float, float]
    clouds: NDArray[np.float32]
    overcast: bool
    skyline_rad: NDArray[np.float32]

    def ambient(self, normals: Directions) -> NDArray[np.float32]:
        """Unshadowed light from sky and ground on surfaces with these normals (n, 3)."""
        up = 0.5 + 0.5 * normals[:, 2:3]
        sky, bounce = np.asarray(self.sky, np.float32), np.asarray(self.bounce, np.float32)
        return up * sky + (1.0 - up) * bounce

    def seen(self, directions: Directions, skyline: bool) -> NDArray[np.float32]:
        """Radiance (n, 3) from unit directions; `skyline` puts the far side of the street in."""
        up = np.clip(directions[:, 2], 0.0, 1.0)
        cloud = self._cloud(directions, up)
        if self.overcast:
            radiance = _GREY * (0.80 + 0.22 * cloud + 0.10 * up)[:, None]
        else:
            blue = _HORIZON + (_ZENITH - _HORIZON) * (up**0.6)[:, None]
            cover = np.clip((cloud - 0.50) * 2.0, 0.0, 0.9)[:, None]
            radiance = blue * (1 - cover) + _WHITE * (0.80 + 0.22 * cloud)[:, None] * cover
        if skyline:
            radiance = self._with_skyline(directions, radiance)
        return radiance.astype(np.float32)

    def _cloud(self, directions: Directions, up: NDArray[np.float32]) -> NDArray[np.float32]:
        """The ceiling's cloud where each direction meets it."""
        size = self.clouds.shape[0]
        at = directions[:, :2] / (up[:, None] + 0.25) * (0.28 * size)
        whole = np.floor(at).astype(np.int64)
        part = (at - whole).astype(np.float32)
        (x, y), (u, v) = whole.T, part.T
        near = self.clouds[y % size, x % size] * (1 - u) + self.clouds[y % size, (x + 1) % size] * u
        y = y + 1
        far = self.clouds[y % size, x % size] * (1 - u) + self.clouds[y % size, (x + 1) % size] * u
        return np.asarray(near * (1 - v) + far * v, np.float32)

    def _with_skyline(
        self, directions: Directions, radiance: NDArray[np.float32]
    ) -> NDArray[np.float32]:
        steps = len(self.skyline_rad)
        azimuth = np.arctan2(directions[:, 1], directions[:, 0]) / (2 * np.pi) % 1.0
        top = self.skyline_rad[np.minimum((azimuth * steps).astype(np.int64), steps - 1)]
        elevation = np.arcsin(np.clip(directions[:, 2], -1.0, 1.0))
        bright = 0.6 + 0.5 * np.clip(elevation / top, 0.0, 1.0)
        return np.where((elevation < top)[:, None], _FAR_SIDE * bright[:, None], radiance)


def daylight(seed: int, sunny: bool, azimuth_rad: float, elevation_rad: float) -> Light:
    """A day. The azimuth is counted from x towards y of the world; the facade looks to -y."""
    c = float(np.cos(elevation_rad))
    towards = (
        c * float(np.cos(azimuth_rad)),
        c * float(np.sin(azimuth_rad)),
        float(np.sin(elevation_rad)),
    )
    rng = stream(seed, "sky")
    cloud = np.clip(0.5 + 0.9 * fractal_noise(rng, (512, 512), 110.0, 6), 0.0, 1.0)
    skyline = rng.uniform(0.20, 0.42, 32).astype(np.float32)
    if sunny:
        return Light(
            towards,
            (1.15, 1.05, 0.90),
            (0.42, 0.48, 0.58),
            (0.30, 0.28, 0.25),
            cloud,
            False,
            skyline,
        )
    return Light(
        towards, (0.0, 0.0, 0.0), (0.95, 0.98, 1.02), (0.38, 0.37, 0.35), cloud, True, skyline
    )
