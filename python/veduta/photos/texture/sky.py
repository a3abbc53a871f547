"""Where a photo shows sky although the model has a building there.

A model may be higher than what stands there, and a registration is off by decimetres over the
length of a street: then tops and sides of far walls are textured with sky, and every photo agrees.
Sky is known by itself: it goes on from beyond the model's outline in the same colour, with no edge
where the outline is. What does so is not of the wall; above the horizon alone, for the ground has
the colours of walls.
"""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.photos.texture.halves import Halves
from veduta.photos.texture.nearest import nearest_marked
from veduta.photos.texture.views import Nearness, View

REACH_M = 3.0
"""So far into a wall sky is looked for."""
ALIKE = 14
"""Largest difference of a channel (of 255) from the sky beside."""
_SMOOTH_SQUARES = 2.0


def sky_on_model(view: View, halves: Halves, nearness: Nearness) -> NDArray[np.bool_]:
    """(h, w) squares of `step_px` in which the view shows sky and the model has a face."""
    beyond = nearness.sky
    if not beyond.any():
        return np.zeros(beyond.shape, dtype=np.bool_)
    picture = _by_squares(halves, view.step_px, beyond.shape).astype(np.float32)
    weight = beyond.astype(np.float32)
    sums = cv2.GaussianBlur(picture * weight[..., None], (0, 0), _SMOOTH_SQUARES)
    weights = cv2.GaussianBlur(weight, (0, 0), _SMOOTH_SQUARES)
    own = sums[beyond] / np.maximum(weights[beyond], 1e-3)[:, None]
    nearest, distance = nearest_marked(beyond)
    alike = np.abs(picture - own[nearest]).max(axis=-1) <= ALIKE
    squares_per_m = max(view.camera.focal_px) / view.step_px * nearness.most
    alike &= ~beyond & (distance <= REACH_M * squares_per_m)
    count, component = cv2.connectedComponents((beyond | alike).astype(np.uint8), connectivity=4)
    of_sky = np.zeros(count, dtype=np.bool_)
    of_sky[component[beyond]] = True
    found = (alike & of_sky[component]).astype(np.uint8)
    # The squares beside are mixed with it.
    return (cv2.dilate(found, np.ones((3, 3), np.uint8)) > 0) & ~beyond


def _by_squares(halves: Halves, step_px: int, shape: tuple[int, ...]) -> NDArray[np.uint8]:
    """(h, w, 3) the picture at the middles of squares."""
    level, pixels = halves.at(int(np.log2(step_px)))
    step = step_px / 2**level
    move = np.array([[step, 0, 0.5 * step - 0.5], [0, step, 0.5 * step - 0.5]])
    flags = cv2.INTER_LINEAR | cv2.WARP_INVERSE_MAP
    size = (shape[1], shape[0])
    found = cv2.warpAffine(pixels, move, size, flags=flags, borderMode=cv2.BORDER_REPLICATE)
    return np.asarray(found, dtype=np.uint8)
