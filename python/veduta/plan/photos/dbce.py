"""The colour that a photo has most of, by density (DBCE): the fullest ball of the RGB cube.

AV3D, "Colour Extraction". The text asks for the densest sphere of radius 3. Its pseudo-code sums a
cube, and its loops leave out what is nearer than 3 to a face: white walls are never found. Here it
is a ball, and its middle may be any colour: beyond the faces there are no pixels.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

RADIUS = 3
LEVELS = 256

_AT_ONCE = 4_000_000
"""Pixels that are counted at once: it bounds the memory for large photos."""

Rgb8 = tuple[int, int, int]


@dataclass(frozen=True)
class Densest:
    """srgb: the middle of the ball. share: of all pixels that lie in the ball (0 to 1)."""

    srgb: Rgb8
    share: float


def densest_colour(colours: NDArray[np.uint8]) -> Densest:
    """The colour whose ball of radius 3 has the most pixels. colours: (n, 3) sRGB, at least one.

    Where several have as many, that with the most pixels of its very own colour, then the first by
    red, green and blue. Counts are whole numbers: the result is exact.
    """
    if not len(colours):
        raise ValueError("no pixels, so no colour")
    cube, first = _cube(colours)
    inside = ball_sums(cube)
    best = np.flatnonzero(inside == inside.max())
    best = best[int(cube.reshape(-1)[best].argmax())]
    red, green, blue = (np.array(np.unravel_index(best, cube.shape)) + first).tolist()
    return Densest((red, green, blue), float(inside.reshape(-1)[best]) / len(colours))


def in_ball(pixels: NDArray[np.uint8], middle: Rgb8) -> NDArray[np.bool_]:
    """(h, w) which of (h, w, 3) sRGB pixels lie in the ball around a colour."""
    apart = pixels.astype(np.int32) - np.array(middle, dtype=np.int32)
    near: NDArray[np.bool_] = (apart**2).sum(axis=-1) <= RADIUS**2
    return near


def ball_sums(cube: NDArray[np.float64]) -> NDArray[np.float64]:
    """Of each cell of (r, g, b) counts, how many lie within 3 of it; zero beyond the faces.

    A convolution with the ball, as that of each plane of red with the ball's discs. OpenCV adds
    directly under kernels of this size: sums of whole numbers are exact below 2**53.
    """
    total = np.zeros_like(cube)
    length = len(cube)
    for step in range(RADIUS + 1):
        disc = _disc(RADIUS**2 - step**2)
        for red in range(length):
            sums = cv2.filter2D(cube[red], cv2.CV_64F, disc, borderType=cv2.BORDER_CONSTANT)
            for at in {red - step, red + step}:
                if 0 <= at < length:
                    total[at] += sums
    return total


def _disc(square: int) -> NDArray[np.float64]:
    """(7, 7) ones where two whole numbers have at most this sum of squares."""
    along = np.arange(-RADIUS, RADIUS + 1) ** 2
    return (along[:, None] + along <= square).astype(np.float64)


def _cube(colours: NDArray[np.uint8]) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """How many pixels each colour has, of the cube's part that is used, and its first colour.

    Middles of balls may lie up to a radius beside the colours that are there.
    """
    low = np.maximum(colours.min(axis=0).astype(np.int64) - RADIUS, 0)
    high = np.minimum(colours.max(axis=0).astype(np.int64) + RADIUS, LEVELS - 1)
    shape = tuple((high - low + 1).tolist())
    count = np.zeros(int(np.prod(shape)))
    for start in range(0, len(colours), _AT_ONCE):
        some = colours[start : start + _AT_ONCE].astype(np.int64) - low
        count += np.bincount(np.ravel_multi_index(tuple(some.T), shape), minlength=len(count))
    return count.reshape(shape), low
