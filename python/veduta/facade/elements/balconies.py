"""Iron balconies by colour and texture (6.4.2): dark pixels (6.5), energy in all directions (6.6).

Colours are clustered into two Gaussians by expectation maximisation, of which the one that is
nearer to the colour of balconies is theirs. The responses of four Gabor filters are multiplied, and
the product with the chance of the colour is the soft mask S (6.7), whose connected parts are the
balconies.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.facade.elements.two_colours import two_colours
from veduta.facade.elements.working_size import at_working_size

Float = NDArray[np.float64]
Boxes = NDArray[np.float64]
"""(n, 4): left, top, right, bottom in pixels."""


@dataclass(frozen=True)
class BalconyParameters:
    """The thesis's balcony detector; lengths in pixels at `long_px`.

    long_px: the longer side that pictures are brought to. colour: sRGB of balconies, which the
    thesis's user gives: dark. samples: pixels that the Gaussians are estimated from. least_chance,
    least_energy: below which a chance of the colour and an energy are 0 (the thesis's 0.02).
    least_mask: the same of the mask, where the thesis's 0.02 joins all floors of a front: this one,
    `kernel`, `covered` and `most_high` were chosen on pictures of CMP's training fold. wave_px: of
    the filters, as far apart as bars are. full: the share of pixels whose product of energies
    counts as less than 1: the single highest one says nothing. kernel: side of the closing, of the
    longer side (the thesis's 21 px at 100 px / m are 0.0105 of a front of 20 m). least_wide,
    least_high, most_high: sizes of balconies, of the longer side. upright: the least width by
    height. covered: share of a part's box that the closed mask covers. top, bottom: shares of the
    picture above and below which there are none.
    """

    long_px: int = 600
    colour: tuple[float, float, float] = (40.0, 40.0, 45.0)
    samples: int = 20000
    least_chance: float = 0.02
    least_energy: float = 0.02
    least_mask: float = 0.35
    wave_px: float = 4.0
    full: float = 0.98
    kernel: float = 0.02
    least_wide: float = 0.035
    least_high: float = 0.015
    most_high: float = 0.12
    upright: float = 0.8
    covered: float = 0.3
    top: float = 0.05
    bottom: float = 0.92


def find_balconies(pixels: NDArray[np.uint8], parameters: BalconyParameters | None = None) -> Boxes:
    """Boxes (n, 4) of the balconies in (h, w, 3) uint8 sRGB pixels of a rectified front."""
    own = parameters or BalconyParameters()
    small = at_working_size(pixels, own.long_px)
    mask = soft_mask(small.pixels, own)
    side = max(3, round(own.kernel * own.long_px)) | 1
    closed = cv2.morphologyEx(mask, cv2.MORPH_CLOSE, np.ones((side, side), np.uint8))
    parts = (closed > own.least_mask).astype(np.uint8)
    _, _, stats, _ = cv2.connectedComponentsWithStats(parts)
    return small.in_picture(_sound(stats[1:], small.size, own))


def soft_mask(pixels: NDArray[np.uint8], own: BalconyParameters) -> Float:
    """S of (6.7), (h, w) from 0 to 1."""
    return _scaled(colour_chance(pixels, own) * texture_energy(pixels, own), 1.0)


def colour_chance(pixels: NDArray[np.uint8], own: BalconyParameters) -> Float:
    """P(B | i) of (6.5), (h, w), of the darkest pixel within a bar's distance.

    A bar is as thin as a pixel here, and mixed with the wall behind it; at the thesis's 100 px / m
    it is not.
    """
    bars = max(1, round(own.wave_px)) | 1
    darkest = cv2.erode(pixels, np.ones((bars, bars), np.uint8))
    flat = darkest.reshape(-1, 3).astype(np.float64)
    clusters = two_colours(flat[:: max(1, len(flat) // own.samples)])
    nearest = int(np.linalg.norm(clusters.means - np.array(own.colour), axis=1).argmin())
    found = clusters.chance(flat, nearest).reshape(pixels.shape[:2])
    return np.where(found < own.least_chance, 0.0, found)


def texture_energy(pixels: NDArray[np.uint8], own: BalconyParameters) -> Float:
    """E_Tex of (6.6), (h, w) from 0 to 1: the product of the energies of four directions."""
    grey = cv2.cvtColor(pixels, cv2.COLOR_RGB2GRAY).astype(np.float64)
    product = np.ones(grey.shape)
    for angle in (0.0, 0.25 * np.pi, 0.5 * np.pi, 0.75 * np.pi):
        parts = [
            cv2.filter2D(grey, -1, _gabor(own.wave_px, angle, phase), borderType=cv2.BORDER_REFLECT)
            for phase in (0.0, -0.5 * np.pi)
        ]
        energy = np.hypot(parts[0], parts[1])
        product *= cv2.GaussianBlur(energy, (0, 0), own.wave_px)
    found = _scaled(product, own.full)
    return np.where(found < own.least_energy, 0.0, found)


def _gabor(wave_px: float, angle: float, phase: float) -> Float:
    """A filter without a response to flat colours."""
    sigma = 0.56 * wave_px  # a bandwidth of one octave
    side = int(6.0 * sigma) | 1
    kernel = cv2.getGaborKernel((side, side), sigma, angle, wave_px, 0.5, phase, cv2.CV_64F)
    return np.asarray(kernel - kernel.mean(), np.float64)


def _scaled(values: Float, full: float) -> Float:
    """To 0..1, by the value that this share of the pixels does not exceed."""
    most = float(np.quantile(values, full))
    return np.asarray(np.clip(values / max(most, 1e-12), 0.0, 1.0), np.float64)


def _sound(stats: NDArray[np.generic], size: tuple[int, ...], own: BalconyParameters) -> Boxes:
    """The parts that have sizes and places of balconies, as boxes."""
    x, y, w, h, area = stats.astype(np.float64).T
    side = max(size)
    fits = (w >= own.least_wide * side) & (h >= own.least_high * side)
    fits &= (h <= own.most_high * side) & (w >= own.upright * h)
    fits &= (
        (area >= own.covered * w * h) & (y >= own.top * size[1]) & (y + h <= own.bottom * size[1])
    )
    return np.asarray(np.column_stack([x, y, x + w, y + h])[fits], np.float64)
