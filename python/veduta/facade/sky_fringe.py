"""The sky in the texture of a roof: with its fringe, and what stands in its place."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.place.material import Colour

Pixels = NDArray[np.uint8]
Mask = NDArray[np.bool_]


@dataclass(frozen=True)
class FringeParameters:
    """What beside the sky is of it.

    mixed_px: pixels along the sky's border that are mixed of both. reach_px: how far from it what
    looks as the sky does is sky, too. alike: how far (OpenCV's Lab) a pixel may be from the sky's
    usual colour there. spread_px: over how many pixels the roof's colour goes on into the sky.
    """

    mixed_px: int = 2
    reach_px: int = 14
    alike: float = 26.0
    spread_px: float = 24.0


def sky_with_fringe(pixels: Pixels, sky: Mask, parameters: FringeParameters | None = None) -> Mask:
    """(h, w) the sky, with the mixed pixels around it and what looks like it close by."""
    p = parameters or FringeParameters()
    if not sky.any():
        return sky
    lab = cv2.cvtColor(pixels, cv2.COLOR_RGB2LAB).astype(np.float32)
    inner = cv2.erode(sky.astype(np.uint8), _disc(p.mixed_px)) > 0
    usual = np.median(lab[inner if inner.any() else sky], axis=0)
    alike = np.linalg.norm(lab - usual, axis=2) < p.alike
    near = cv2.dilate(sky.astype(np.uint8), _disc(p.reach_px)) > 0
    likely = (alike & near) | sky
    joined = cv2.dilate(likely.astype(np.uint8), _disc(p.mixed_px))
    _, pieces = cv2.connectedComponents(joined)
    touched = np.unique(pieces[sky])
    whole = likely & np.isin(pieces, touched[touched > 0])
    return np.asarray(cv2.dilate(whole.astype(np.uint8), _disc(p.mixed_px)) > 0, np.bool_)


def without_sky(
    pixels: Pixels, sky: Mask, roof: Colour, parameters: FringeParameters | None = None
) -> Pixels:
    """The picture with what is next to the sky going on into it, up to the roof's usual colour."""
    p = parameters or FringeParameters()
    made = pixels.copy()
    if not sky.any():
        return made
    usual = np.array(roof, dtype=np.float32) * 255.0
    known = (~sky).astype(np.float32)
    # The roof's own colour counts a little everywhere, so that far from it nothing else is left.
    weight = cv2.GaussianBlur(known, (0, 0), p.spread_px)
    apart = (pixels.astype(np.float32) - usual) * known[..., None]
    near = np.abs(apart).max(axis=2) < 60.0
    blurred = cv2.GaussianBlur(apart * near[..., None], (0, 0), p.spread_px)
    going_on = usual + blurred / (weight + 0.05)[..., None]
    made[sky] = np.clip(np.rint(going_on[sky]), 0, 255).astype(np.uint8)
    return made


def _disc(radius: int) -> NDArray[np.uint8]:
    side = 2 * radius + 1
    return np.asarray(cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (side, side)), np.uint8)
