"""One picture of all directions, made of a panorama or of four pictures.

Its columns are bearings: north in the middle, south at both ends. Its rows are elevations, from the
zenith down to `LOWEST_DEG`. Where the given pictures show nothing, their edge goes on and fades to
its mean; those pixels are invented, and marked.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.plan.surroundings.panorama import Pictures, Pixels

Floats = NDArray[np.float64]
Mask = NDArray[np.bool_]
LOWEST_DEG = -20.0
SPHERICAL_ASPECT = (1.94, 2.06)
"""Width by height of a picture whose rows are even steps of elevation; others are cylindrical."""
_WIDEST_PX, _LEAST_PX = 8192, 512
_QUARTER_DEG = 90.0
_MIX_DEG = 3.0
"""Two pictures of the four are mixed so far to both sides of where they meet."""
_FADE_DEG = 35.0
_EDGE_PX = 3
_BLUR_SHARE = 0.02
_BLURRED_BY = 0.1
"""Of the way of the fade: from there on the edge that goes on is blurred."""


@dataclass(frozen=True, eq=False)
class SkyPicture:
    """pixels: (h, w, 3). invented: (h, w)."""

    pixels: Pixels
    invented: Mask

    def uv(self, bearing_deg: Floats, elevation_deg: Floats) -> Floats:
        """(n, 2) where directions are seen, from the upper left, in shares of the picture.

        bearing_deg: from -180 to 180.
        """
        u = bearing_deg / 360.0 + 0.5
        return np.stack([u, (90.0 - elevation_deg) / (90.0 - LOWEST_DEG)], axis=1)


def sky_picture(pictures: Pictures) -> SkyPicture:
    """The picture of all directions."""
    if pictures.kind == "round":
        width_px = pictures.pixels[0].shape[1]
    else:
        width_px = 4 * min(one.shape[1] for one in pictures.pixels)
    width_px = max(_LEAST_PX, min(_WIDEST_PX, width_px))
    step = 360.0 / width_px
    rows = round((90.0 - LOWEST_DEG) / step)
    bearing = (np.arange(width_px) + 0.5) * step - 180.0
    elevation = 90.0 - (np.arange(rows) + 0.5) * (90.0 - LOWEST_DEG) / rows
    if pictures.kind == "round":
        seen, known = _around(pictures.pixels[0], bearing, elevation)
    else:
        seen, known = _four(pictures.pixels, bearing, elevation)
    return SkyPicture(_completed(seen, known, step), ~known)


def _around(picture: Pixels, bearing: Floats, elevation: Floats) -> tuple[Pixels, Mask]:
    """A panorama that is spherical (its rows are elevations) or on a cylinder (their tangents)."""
    height, width = picture.shape[:2]
    x = (bearing / 360.0 + 0.5) * width - 0.5
    if SPHERICAL_ASPECT[0] < width / height < SPHERICAL_ASPECT[1]:
        y = (90.0 - elevation) / 180.0 * height - 0.5
    else:
        y = height / 2.0 - np.tan(np.radians(elevation)) * width / (2.0 * math.pi) - 0.5
    seen = _sampled(np.hstack([picture, picture[:, :2]]), *np.meshgrid(x % width, y))
    return seen, np.broadcast_to(_within(y, height)[:, None], seen.shape[:2]).copy()


def _four(pictures: tuple[Pixels, ...], bearing: Floats, elevation: Floats) -> tuple[Pixels, Mask]:
    """Four sides of a box, each with 90 degrees of view."""
    size = (len(elevation), len(bearing))
    light = np.zeros((*size, 3), dtype=np.float32)
    known = np.zeros(size, dtype=np.bool_)
    for number, picture in enumerate(pictures):
        aside = (bearing - number * _QUARTER_DEG + 180.0) % 360.0 - 180.0
        half = _QUARTER_DEG / 2.0
        share = np.clip((half + _MIX_DEG - np.abs(aside)) / (2.0 * _MIX_DEG), 0.0, 1.0)
        columns = np.flatnonzero(share)
        angle = np.radians(np.clip(aside[columns], -half, half))
        height, width = picture.shape[:2]
        x = np.broadcast_to(width / 2.0 * (1.0 + np.tan(angle)) - 0.5, (size[0], len(columns)))
        rise = np.tan(np.radians(elevation))[:, None] / np.cos(angle)
        y = height / 2.0 - width / 2.0 * rise - 0.5
        seen = _sampled(picture, x, y)
        light[:, columns] += seen * share[columns].astype(np.float32)[:, None]
        known[:, columns] |= _within(y, height) & (share[columns] >= 0.5)
    return light.round().clip(0, 255).astype(np.uint8), known


def _within(y: Floats, height: int) -> Mask:
    return (y >= -0.5) & (y <= height - 0.5)


def _sampled(picture: Pixels, x: Floats, y: Floats) -> Pixels:
    """The colours at pixels; beyond the upper and the lower edge those of the edge."""
    found = cv2.remap(
        picture,
        np.asarray(x, dtype=np.float32),
        np.clip(y, 0.0, picture.shape[0] - 1.0).astype(np.float32),
        cv2.INTER_LINEAR,
        borderMode=cv2.BORDER_REPLICATE,
    )
    return np.asarray(found, dtype=np.uint8)


def _completed(seen: Pixels, known: Mask, step_deg: float) -> Pixels:
    """What is not known is the edge above or below it; further off, its mean."""
    first = known.argmax(axis=0)
    last = len(known) - 1 - known[::-1].argmax(axis=0)
    done = seen.copy()
    _fade(done, first, step_deg)
    _fade(done[::-1], len(known) - 1 - last, step_deg)
    return done


def _fade(picture: Pixels, first: NDArray[np.int64], step_deg: float) -> None:
    """Fill the rows above the first known one of each column, in place."""
    rows = int(first.max())
    if rows == 0:
        return
    width = picture.shape[1]
    rows_down = np.minimum(first + np.arange(_EDGE_PX)[:, None], len(picture) - 1)
    edge = picture[rows_down, np.arange(width)].mean(axis=0, dtype=np.float32)
    margin = max(1, round(3.0 * _BLUR_SHARE * width))
    around = np.concatenate([edge[-margin:], edge, edge[:margin]])[None]
    soft = cv2.GaussianBlur(around, (0, 0), _BLUR_SHARE * width, sigmaY=1e-3)[0][margin:-margin]
    mean = edge.mean(axis=0)
    for row in range(rows):  # a row at a time: a whole picture of floats is large
        way = np.clip((first - row) * step_deg / _FADE_DEG, 0.0, 1.0).astype(np.float32)[:, None]
        blurred = edge + np.minimum(1.0, way / _BLURRED_BY) * (soft - edge)
        colour = blurred + way * way * (3.0 - 2.0 * way) * (mean - blurred)
        missing = first > row
        picture[row, missing] = colour[missing].round().clip(0, 255).astype(np.uint8)
