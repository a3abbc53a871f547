"""What stands above a hole carried down into it: jambs, panes and walls go on downwards.

As the third part of (6.8) of the thesis has it, whose step of N pixels is here a strip that is
mirrored at its ends, so that no edge is repeated.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.surfaces.filling.choosing import Spoilt
from veduta.surfaces.filling.options import RepeatParameters

Floats = NDArray[np.float32]
_NEVER = np.float32(1e9)


@dataclass(frozen=True, eq=False)
class Carried:
    """pixels (h, w, 3) in the holes, and cost (h, w): the mean square error to be expected."""

    pixels: Floats
    cost: Floats


def carried_down(spoilt: Spoilt, reach_px: float, parameters: RepeatParameters) -> Carried:
    """Each column's strip above its hole, mirrored down; not where nothing or less is known above.

    The error is how much the strip varies from row to row, and grows with the depth.
    """
    height, width = spoilt.holes.shape
    strip = max(2, round(parameters.strip * reach_px))
    rows = np.arange(height)[:, None]
    top = np.maximum.accumulate(np.where(spoilt.holes, -1, rows), axis=0)
    depth = rows - top - 1
    wave = np.mod(depth, 2 * strip)
    wave = np.where(wave >= strip, 2 * strip - 1 - wave, wave)
    source = top - wave
    usable = spoilt.holes & (source >= 0)
    source = np.maximum(source, 0)
    columns = np.broadcast_to(np.arange(width), source.shape)
    usable &= ~spoilt.holes[source, columns] & (spoilt.zones[source] == spoilt.zones[rows])
    varies = _varies(spoilt, strip)[np.maximum(top, 0), columns]
    cost = parameters.carried + varies + parameters.lower * (depth / strip) ** 2
    pixels = spoilt.pixels[source, columns].astype(np.float32)
    return Carried(pixels, np.where(usable, cost, _NEVER).astype(np.float32))


def _varies(spoilt: Spoilt, strip: int) -> Floats:
    """(h, w) variance from row to row of the strip that ends at each pixel, over a few columns."""
    known = (~spoilt.holes).astype(np.float32)
    grey = cv2.cvtColor(spoilt.pixels, cv2.COLOR_RGB2GRAY).astype(np.float32) * known
    count = np.maximum(_summed(known, strip), 1.0)
    mean = _summed(grey, strip) / count
    square = _summed(grey * grey, strip) / count
    varies = np.maximum(square - mean * mean, 0.0)
    side = 2 * max(1, strip // 4) + 1
    return np.asarray(cv2.boxFilter(varies, -1, (side, 1)), np.float32)


def _summed(values: Floats, strip: int) -> Floats:
    """(h, w) sum of the rows of a strip that ends at each pixel."""
    size, anchor, beyond = (1, strip), (0, strip - 1), cv2.BORDER_CONSTANT
    summed = cv2.boxFilter(values, -1, size, anchor=anchor, normalize=False, borderType=beyond)
    return np.asarray(summed, np.float32)
