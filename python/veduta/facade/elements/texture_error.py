"""How badly a texture model explains each pixel: high where materials meet (6.1), and its blobs.

A pixel is a linear combination of its neighbours, whose factors are estimated over a window, so
that the model is overdetermined. With sums over windows as box filters, the factors of all pixels
follow at once from normal equations of one size.

Neighbours on all sides explain the straight border between two materials without any error, as
what is beside a pixel along the border is like it. So there are two models, one of the neighbours
on the row and one of those on the column, and the errors of both count.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

Float = NDArray[np.float64]


@dataclass(frozen=True)
class TextureParameters:
    """The auto-regressive model (6.1; the thesis gives no numbers).

    reach_px: side of the window over which the factors of a pixel are estimated: seven, so that
    there are 49 equations for two factors and the mean. steps_px: how far the neighbours are; those
    on both sides share a factor. ridge: what is added to the normal equations' diagonal, in grey
    levels squared, as flat walls have no texture to estimate from.
    """

    reach_px: int = 7
    steps_px: tuple[int, ...] = (1, 2)
    ridge: float = 4.0


def texture_error(grey: NDArray[np.uint8], parameters: TextureParameters | None = None) -> Float:
    """(h, w) the model's root mean square error around each pixel, in grey levels (6.1).

    grey: (h, w) uint8.
    """
    own = parameters or TextureParameters()
    values = grey.astype(np.float64)
    centred = values - _blurred(values, own)
    squared = sum(_unexplained(centred, axis, own) ** 2 for axis in (0, 1))
    return np.asarray(np.sqrt(np.maximum(_blurred(np.asarray(squared), own), 0.0)), np.float64)


def _unexplained(centred: Float, axis: int, own: TextureParameters) -> Float:
    """What the neighbours of each pixel along an axis do not explain of it."""
    neighbours = [_pair(centred, step, axis) for step in own.steps_px]
    count = len(neighbours)
    moments = np.empty((*centred.shape, count, count))
    against = np.empty((*centred.shape, count))
    for i, one in enumerate(neighbours):
        against[..., i] = _blurred(one * centred, own)
        for j, other in enumerate(neighbours[: i + 1]):
            moments[..., i, j] = moments[..., j, i] = _blurred(one * other, own)
    moments += own.ridge * np.eye(count)
    factors = np.linalg.solve(moments, against[..., None])[..., 0]
    told = sum(factors[..., i] * one for i, one in enumerate(neighbours))
    return np.asarray(centred - told, np.float64)


def _blurred(values: Float, own: TextureParameters) -> Float:
    """The mean over the window around each pixel."""
    size = (own.reach_px, own.reach_px)
    return np.asarray(cv2.blur(values, size, borderType=cv2.BORDER_REFLECT), np.float64)


def blobs(strength: Float) -> Float:
    """(h, w) the product of the mean of each row and the mean of each column (6.2, 6.3), 0 to 1."""
    product = strength.mean(axis=1)[:, None] * strength.mean(axis=0)[None]
    return _scaled(product)


def _scaled(values: Float) -> Float:
    low, high = float(values.min()), float(values.max())
    return np.asarray((values - low) / max(high - low, 1e-12), np.float64)


def _pair(centred: Float, step: int, axis: int) -> Float:
    """The sum of the two neighbours of each pixel along an axis."""
    before, after = np.roll(centred, step, axis), np.roll(centred, -step, axis)
    return np.asarray(before + after, np.float64)
