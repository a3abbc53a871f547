"""Shadows that balconies throw on the wall below them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

Mask = NDArray[np.bool_]


@dataclass(frozen=True)
class ShadowParameters:
    """What is a shadow below a balcony.

    reach: how far below it one is looked for, in storeys. darker: the share of the wall's usual
    lightness below which a pixel is in the shadow. tint: how far its colour (OpenCV's a and b) may
    be from the wall's; more is another thing. least: a shadow covers at least this share of the
    wall that is looked at.
    """

    reach: float = 0.3
    darker: float = 0.82
    tint: float = 12.0
    least: float = 0.08


def shadows_below(
    pixels: NDArray[np.uint8],
    wall: Mask,
    balconies: Sequence[tuple[slice, slice]],
    storey_px: float,
    parameters: ShadowParameters | None = None,
) -> Mask:
    """(h, w) where the wall lies in the shadow of a balcony.

    pixels: (h, w, 3) sRGB; wall: (h, w) what is plain wall; balconies: rows and columns of each.
    """
    p = parameters or ShadowParameters()
    found = np.zeros_like(wall)
    if not balconies or not wall.any():
        return found
    lab = cv2.cvtColor(pixels, cv2.COLOR_RGB2LAB).astype(np.float32)
    usual = np.median(lab[wall], axis=0)
    dark = wall & (lab[..., 0] < p.darker * usual[0])
    dark &= np.hypot(lab[..., 1] - usual[1], lab[..., 2] - usual[2]) < p.tint
    for rows, columns in balconies:
        below = slice(rows.stop, min(len(wall), rows.stop + round(p.reach * storey_px)))
        seen, shade = wall[below, columns], dark[below, columns]
        if seen.any() and shade.sum() >= p.least * seen.sum():
            found[below, columns] |= _from_above(shade, seen)
    return found


def _from_above(shade: Mask, wall: Mask) -> Mask:
    """The part of a shadow that begins at the upper edge: below its end in a column is none."""
    lit = wall & ~shade
    # One lit pixel is noise; two in a column end the shadow.
    ended = np.logical_or.accumulate(lit[:-1] & lit[1:], axis=0)
    kept = shade.copy()
    kept[2:] &= ~ended[:-1]
    return kept
