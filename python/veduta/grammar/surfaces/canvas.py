"""What textures are painted on: a rectangle of a known size whose borders meet.

Fields are (h, w) float32; row 0 is the upper edge. Everything here wraps: what leaves at one border
comes in at the other, so that a texture goes on without a seam wherever it repeats.
"""

from __future__ import annotations

from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

Field = NDArray[np.float32]
Image = NDArray[np.uint8]
MOST_PX = 512
LIGHT = (-0.5, 0.62, 0.6)
"""To the sun, before a wall: from the upper left."""
DARKEST = 0.5
"""Of what looks away from the light: the sky lights it."""


class Canvas:
    """A rectangle of `size_m` (width, height) metres with a random stream of its own."""

    def __init__(self, size_m: tuple[float, float], seed: int) -> None:
        self.size_m = size_m
        per_m = MOST_PX / max(size_m)
        self.shape = (round(size_m[1] * per_m), round(size_m[0] * per_m))
        self.rng = np.random.default_rng(seed)

    @property
    def px_m(self) -> float:
        """Metres of a pixel."""
        return self.size_m[1] / self.shape[0]

    @cached_property
    def x_m(self) -> Field:
        """(w,) metres to the right of the left edge, of pixel centres."""
        width = self.shape[1]
        return ((np.arange(width) + 0.5) * (self.size_m[0] / width)).astype(np.float32)

    @cached_property
    def y_m(self) -> Field:
        """(h,) metres above the lower edge, of pixel centres."""
        height = self.shape[0]
        return ((height - np.arange(height) - 0.5) * self.px_m).astype(np.float32)

    @cached_property
    def _waves(self) -> tuple[Field, Field]:
        """Waves per metre to the right and up, of each coefficient of a Fourier transform."""
        rows, columns = self.shape
        right = np.fft.rfftfreq(columns, self.size_m[0] / columns)
        up = np.fft.fftfreq(rows, self.px_m)
        return right[None, :].astype(np.float32), up[:, None].astype(np.float32)

    def noise(
        self,
        largest_m: float,
        smallest_m: float = 0.0,
        fall: float = 1.0,
        stretch: tuple[float, float] = (1.0, 1.0),
    ) -> Field:
        """A random field of mean 0 and deviation 1 whose features have these sizes (m).

        Its amplitude goes with the feature's size to the power of `fall`. `stretch` multiplies
        their sizes to the right and up. Keep `largest_m` well below the canvas:
        larger ones would be seen to repeat.
        """
        right, up = self._waves
        wave = np.hypot(right * stretch[0], up * stretch[1])
        low, high = 1.0 / largest_m, 1.0 / max(smallest_m, 1e-6)
        with np.errstate(divide="ignore"):
            gain = np.where(wave >= low, wave ** (-fall - 1.0), 0.0)
        gain *= np.exp(-((wave / high) ** 2))
        white = self.rng.standard_normal(self.shape, dtype=np.float32)
        field = np.fft.irfft2(np.fft.rfft2(white) * gain, s=self.shape)
        field -= field.mean()
        return np.asarray(field / max(float(field.std()), 1e-9), np.float32)

    def grain(self) -> Field:
        """Values of deviation 1, each pixel by itself."""
        return self.rng.standard_normal(self.shape, dtype=np.float32)

    def blurred(self, field: Field, sigma_m: float) -> Field:
        """The field under a Gaussian of this width (m)."""
        right, up = self._waves
        gain = np.exp(-2.0 * (np.pi * sigma_m) ** 2 * (right**2 + up**2))
        return np.asarray(np.fft.irfft2(np.fft.rfft2(field) * gain, s=self.shape), np.float32)

    def lit(self, height_m: Field, strength: float = 1.0) -> Field:
        """How bright a relief is in slanting light, beside 1 for what lies flat."""
        across = (np.roll(height_m, -1, axis=1) - np.roll(height_m, 1, axis=1)) / (2 * self.px_m)
        upward = (np.roll(height_m, 1, axis=0) - np.roll(height_m, -1, axis=0)) / (2 * self.px_m)
        across, upward = strength * across, strength * upward
        x, y, z = LIGHT
        facing = (z - x * across - y * upward) / np.sqrt(1.0 + across**2 + upward**2)
        return np.asarray(np.clip(facing / z, DARKEST, 1.45), np.float32)

    def hollow(self, height_m: Field, reach_m: float, strength: float) -> Field:
        """How much darker it is where the relief lies below its surroundings; 1 elsewhere."""
        below = np.maximum(self.blurred(height_m, reach_m) - height_m, 0.0)
        return np.asarray(1.0 / (1.0 + strength * below / reach_m), np.float32)

    def image(self, shade: Field, tint: ArrayLike, mean: float) -> Image:
        """The (h, w, 3) picture of a brightness times a tint, with this mean value (0..1, sRGB)."""
        picture = shade[..., None] * np.asarray(tint, np.float32)
        for _ in range(4):  # what is brighter than white is cut off, which changes the mean
            picture *= mean / float(np.clip(picture, 0.0, 1.0).mean())
        return np.asarray(np.rint(np.clip(picture, 0.0, 1.0) * 255.0), np.uint8)


def eased(field: ArrayLike, low: float, high: float) -> Field:
    """0 below `low`, 1 above `high`, smooth between."""
    share = np.clip((np.asarray(field, np.float32) - low) / (high - low), 0.0, 1.0)
    return np.asarray(share * share * (3.0 - 2.0 * share), np.float32)


def mixed(a: ArrayLike, b: ArrayLike, share: Field) -> Field:
    """From colour `a` to `b`: (h, w, 3)."""
    weight = share[..., None]
    return np.asarray(np.asarray(a) * (1.0 - weight) + np.asarray(b) * weight, np.float32)
