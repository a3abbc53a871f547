"""The footage as the animal's coat: colours across the body in all frames, and their median."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.fauna.motion.angles import Floats
from veduta.place.material import Texture

_ALONG, _ACROSS = 512, 128
_MOST_FRAMES = 60
_INSIDE = 0.92
"""What is so near to the outline has the background's light in it."""


def coat_from_above(frames: NDArray[np.uint8], points: Floats, half_width: Floats) -> Texture:
    """The texture of a body whose back was seen: u from head to tail, v around from the belly.

    frames: (t, h, w, 3). points: (t, n, 2) px, y down, head first. half_width: (n,) px. The back,
    v from 0.25 to 0.75, is what the frames show; the belly mirrors it and is marked invented.
    """
    chosen = np.linspace(0, len(frames) - 1, min(len(frames), _MOST_FRAMES)).round().astype(int)
    places = np.linspace(0.0, points.shape[1] - 1.0, _ALONG)
    # v = 0.25 is the left side, 0.75 the right one: across the body by the sine of the turn.
    turn = np.linspace(-0.5 * np.pi, 0.5 * np.pi, _ACROSS // 2)
    across = _INSIDE * np.sin(turn)
    half = np.interp(places, np.arange(len(half_width)), half_width)
    samples = np.empty((len(chosen), _ACROSS // 2, _ALONG, 3), dtype=np.uint8)
    for row, number in enumerate(chosen):
        line = points[number]
        ahead = -np.gradient(line, axis=0)
        ahead /= np.maximum(np.linalg.norm(ahead, axis=1, keepdims=True), 1e-9)
        right = np.stack([-ahead[:, 1], ahead[:, 0]], axis=1)
        at = np.stack([np.interp(places, np.arange(len(line)), line[:, k]) for k in (0, 1)], axis=1)
        side = np.stack([np.interp(places, np.arange(len(line)), right[:, k]) for k in (0, 1)], 1)
        probes = at[None] + across[:, None, None] * (half[:, None] * side)[None]
        samples[row] = cv2.remap(
            frames[number], (probes[..., 0] - 0.5).astype(np.float32),
            (probes[..., 1] - 0.5).astype(np.float32), cv2.INTER_LINEAR,
            borderMode=cv2.BORDER_REPLICATE,
        )  # fmt: skip
    back = np.median(samples, axis=0).astype(np.uint8)
    quarter = _ACROSS // 4
    belly = back[::-1]
    # v runs from the belly's middle over the left side, the back and the right side to it again.
    pixels = np.concatenate([belly[quarter:], back, belly[:quarter]])
    invented = np.ones(pixels.shape[:2], dtype=np.bool_)
    invented[quarter : quarter + len(back)] = False
    return Texture(np.ascontiguousarray(pixels), invented)
