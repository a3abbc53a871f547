"""By which offsets a facade repeats itself: its periods, and the sums of them.

The mean square difference between the known pixels and themselves, moved by any offset, is a sum of
correlations, which the Fourier transform gives for all offsets at once. A facade's windows repeat:
its offsets of least difference lie on a lattice (as He and Sun 2012 found for whole photographs).
"""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.surfaces.filling.options import FillParameters

Floats = NDArray[np.float32]
Mask = NDArray[np.bool_]


def repeats(
    pixels: Floats, known: Mask, hole: Mask, parameters: FillParameters
) -> tuple[NDArray[np.int64], Floats]:
    """(k, 2) offsets (x, y) that lead holes to known pixels, and (k,) the mean square difference.

    The best first: those that repeat better than all around them, then others. At least one, where
    any pixel is known and not all are.
    """
    from scipy import fft  # here, as few calls need it

    height, width = known.shape
    shape = (fft.next_fast_len(2 * height), fft.next_fast_len(2 * width))
    mask = known.astype(np.float64)
    values = np.where(known[..., None], pixels, 0.0).astype(np.float64)
    there = fft.rfft2(mask, shape)
    overlap = _correlation(there, there, shape)
    difference = np.zeros(shape)
    for channel in range(values.shape[2]):
        own = fft.rfft2(values[..., channel], shape)
        square = fft.rfft2(values[..., channel] ** 2, shape)
        difference += _correlation(square, there, shape) + _correlation(there, square, shape)
        difference -= 2.0 * _correlation(own, own, shape)
    difference /= values.shape[2] * np.maximum(overlap, 1.0)
    helped = _correlation(fft.rfft2(hole.astype(np.float64), shape), there, shape)
    y = np.arange(-height + 1, height)
    x = np.arange(-width + 1, width)
    at = np.ix_(y % shape[0], x % shape[1])
    difference, overlap, helped = difference[at], overlap[at], helped[at]
    nearest = max(2.0, parameters.shortest * max(height, width))
    far = np.maximum(np.abs(y)[:, None], np.abs(x)[None]) >= nearest
    usable = far & (helped >= parameters.help * hole.sum())
    usable &= overlap >= parameters.overlap * mask.sum()
    if not usable.any():
        usable = helped >= 1.0
    ranked = np.where(usable, np.maximum(difference, 0.0), np.inf).astype(np.float32)
    lowest = cv2.erode(np.where(np.isfinite(ranked), ranked, 1e12), np.ones((3, 3), np.uint8))
    # What is no minimum comes after all that are.
    order = np.argsort(np.where(ranked <= lowest, ranked, ranked + 1e6), axis=None, kind="stable")
    order = order[: parameters.tried]
    order = order[np.isfinite(ranked.ravel()[order])]
    rows, columns = np.unravel_index(order, ranked.shape)
    return np.stack([x[columns], y[rows]], axis=1), ranked.ravel()[order]


def _correlation(
    one: NDArray[np.complex128], other: NDArray[np.complex128], shape: tuple[int, int]
) -> NDArray[np.float64]:
    """The sum over x of one(x) other(x + s), for all s."""
    from scipy import fft

    return np.asarray(fft.irfft2(np.conj(one) * other, shape))


def refined(
    offsets: NDArray[np.int64], pixels: Floats, known: Mask, near: tuple[slice, slice]
) -> tuple[NDArray[np.int64], Floats]:
    """The offsets at twice the size, each moved by a pixel at most, and their differences.

    near: the part of the picture in which they must fit.
    """
    best = np.zeros_like(offsets)
    least = np.full(len(offsets), np.inf, dtype=np.float32)
    for dy in (-1, 0, 1):
        for dx in (-1, 0, 1):
            for number, offset in enumerate(offsets * 2 + (dx, dy)):
                source, there = moved(pixels, near, offset), moved(known, near, offset)
                both = there & known[near]
                if not both.any():
                    continue
                square = (source - pixels[near]) ** 2
                difference = float(square[both].mean())
                if difference < least[number]:
                    least[number], best[number] = difference, offset
    found = np.isfinite(least)
    unique, first = np.unique(best[found], axis=0, return_index=True)
    return unique, least[found][first]


def moved(values: NDArray, part: tuple[slice, slice], offset: NDArray[np.int64]) -> NDArray:  # type: ignore[type-arg]
    """What lies at an offset (x, y) from each pixel of a part; zero beyond the picture."""
    rows, columns = part
    top, bottom = rows.start + int(offset[1]), rows.stop + int(offset[1])
    left, right = columns.start + int(offset[0]), columns.stop + int(offset[0])
    height, width = values.shape[:2]
    found = np.zeros((bottom - top, right - left, *values.shape[2:]), dtype=values.dtype)
    y0, y1, x0, x1 = max(top, 0), min(bottom, height), max(left, 0), min(right, width)
    if y0 < y1 and x0 < x1:
        found[y0 - top : y1 - top, x0 - left : x1 - left] = values[y0:y1, x0:x1]
    return found
