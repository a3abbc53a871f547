"""The footage as the coat of an animal with limbs: the median of frames at each place."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.fauna.document.coat import Panel, panel_of
from veduta.fauna.motion.figure import Figure, Floats, posed
from veduta.fauna.read.silhouettes import Masks
from veduta.place.material import Texture

_WIDTH = 640
_MOST_FRAMES = 24
_FOLLOW = 0.02
"""A place between two segments follows both, so many lengths wide."""
_INSIDE = 2
"""What is so near to the outline (px) has the background's light in it."""


def coat_of_plane(
    frames: NDArray[np.uint8], masks: Masks, figure: Figure, turns: Floats, joints_px: Floats,
    unit_px: float, faces: float, *, top: bool,
) -> Texture:  # fmt: skip
    """The two panels: what was seen, and under it the same again, of which all is invented.

    frames: (t, h, w, 3). masks: (t, h, w). figure: the animal's own. turns: (t, s) from how it
    stands. joints_px: (t, j, 2), y down. unit_px: pixels in a length. faces: 1 where it looks to
    the right of the picture, -1 to the left. top: whether it was seen from above.
    """
    panel = panel_of(figure)
    height = max(8, round(_WIDTH * panel.size[1] / panel.size[0]))
    places = _places(panel, height)
    near, inside = _segments_near(figure, places, top=top)
    chosen = np.unique(np.linspace(0, len(frames) - 1, _MOST_FRAMES).round().astype(int))
    samples = np.full((len(chosen), len(places), 3), np.nan, dtype=np.float32)
    kernel = np.ones((2 * _INSIDE + 1, 2 * _INSIDE + 1), np.uint8)
    for row, number in enumerate(chosen):
        at = _carried(figure, places, near, turns[number], joints_px[number], unit_px, faces)
        sure = cv2.erode(masks[number].astype(np.uint8), kernel)
        x, y = (at[:, k].astype(np.float32).reshape(height, _WIDTH) - 0.5 for k in (0, 1))
        seen = cv2.remap(frames[number], x, y, cv2.INTER_LINEAR).reshape(-1, 3)
        good = np.asarray(cv2.remap(sure, x, y, cv2.INTER_NEAREST)).reshape(-1) > 0
        samples[row, good] = seen[good]
    known = np.isfinite(samples).any(axis=(0, 2)) & inside
    pixels = np.zeros((len(places), 3), dtype=np.uint8)
    pixels[known] = np.nanmedian(samples[:, known], axis=0).astype(np.uint8)
    shown = known.reshape(height, _WIDTH)
    filled = _filled(pixels.reshape(height, _WIDTH, 3), shown)
    invented = np.concatenate([~shown, np.ones_like(shown)])
    return Texture(np.ascontiguousarray(np.concatenate([filled, filled])), invented)


def _places(panel: Panel, height: int) -> Floats:
    x = panel.low[0] + (np.arange(_WIDTH) + 0.5) / _WIDTH * panel.size[0]
    y = panel.low[1] + (1.0 - (np.arange(height) + 0.5) / height) * panel.size[1]
    return np.asarray(np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2))


def _segments_near(
    figure: Figure, places: Floats, *, top: bool
) -> tuple[Floats, NDArray[np.bool_]]:
    """(p, s) how much each place follows each segment, and whether it lies in the figure."""
    at = _standing(figure)
    first, along = at[figure.start], at[figure.end] - at[figure.start]
    apart = np.empty((len(places), len(first)))
    for number in range(len(first)):
        away = places - first[number]
        square = max(float(along[number] @ along[number]), 1e-9)
        share = np.clip(away @ along[number] / square, 0.0, 1.0)
        deep = figure.deep[figure.start[number]] * (1.0 - share)
        deep = deep + figure.deep[figure.end[number]] * share
        apart[:, number] = np.linalg.norm(away - share[:, None] * along[number], axis=1) - deep
    if not top:
        # Of the legs that hide each other the left ones are taken: both stand alike.
        far = [figure.limbs[limb].side == "right" for limb in figure.limb]
        apart[:, far] = np.inf
    weight = np.exp(-(apart - apart.min(axis=1, keepdims=True)) / _FOLLOW)
    return weight / weight.sum(axis=1, keepdims=True), apart.min(axis=1) < 0.0


def _standing(figure: Figure) -> Floats:
    start = np.array([figure.limbs[0].part.points[0]])
    standing = posed(figure, start, figure.rest[None], figure.length, figure.apart)
    return np.asarray(standing.joints[0])


def _carried(
    figure: Figure, places: Floats, near: Floats, turns: Floats, joints_px: Floats, unit_px: float,
    faces: float,
) -> Floats:  # fmt: skip
    """(p, 2) px where the places are in a frame: each goes with its segments."""
    at = _standing(figure)
    angle = turns @ figure.turns
    cos, sin = np.cos(angle), np.sin(angle)
    found = np.zeros_like(places)
    for number in range(len(figure.start)):
        away = places - at[figure.start[number]]
        turned = np.stack(
            [
                cos[number] * away[:, 0] - sin[number] * away[:, 1],
                sin[number] * away[:, 0] + cos[number] * away[:, 1],
            ],
            axis=1,
        )
        px = joints_px[figure.start[number]] + turned * unit_px * np.array([faces, -1.0])
        found += near[:, number, None] * px
    return found


def _filled(pixels: NDArray[np.uint8], known: NDArray[np.bool_]) -> NDArray[np.uint8]:
    """Each unknown pixel as the nearest known one."""
    if not known.any():
        return np.full_like(pixels, 128)
    _, labels = cv2.distanceTransformWithLabels(
        (~known).astype(np.uint8), cv2.DIST_L2, 5, labelType=cv2.DIST_LABEL_PIXEL
    )
    at = np.zeros(int(labels.max()) + 1, dtype=np.int64)
    at[labels[known]] = np.flatnonzero(known.ravel())
    return np.asarray(pixels.reshape(-1, 3)[at[labels]])
