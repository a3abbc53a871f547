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
    # v = 0.25 is the left side, 0.75 the right one: across the body by the sine of the turn.
    turn = np.linspace(-0.5 * np.pi, 0.5 * np.pi, _ACROSS // 2)
    back = _sampled(frames, points, half_width, _INSIDE * np.sin(turn))
    quarter = _ACROSS // 4
    belly = back[::-1]
    # v runs from the belly's middle over the left side, the back and the right side to it again.
    pixels = np.concatenate([belly[quarter:], back, belly[:quarter]])
    invented = np.ones(pixels.shape[:2], dtype=np.bool_)
    invented[quarter : quarter + len(back)] = False
    return Texture(np.ascontiguousarray(pixels), invented)


def coat_from_side(
    frames: NDArray[np.uint8],
    points: Floats,
    half_height: Floats,
    looks_right: NDArray[np.bool_],
) -> Texture:
    """The texture of a body whose flank was seen, as above; looks_right: (t,) in each frame.

    Frames in which it looks to the right show its right flank, v from 0.5 to 1, the others its
    left one. A flank that no frame shows mirrors the other and is marked invented.
    """
    turn = np.linspace(0.0, np.pi, _ACROSS // 2)
    down = _INSIDE * np.cos(turn)  # from the belly up to the back
    flanks: list[NDArray[np.uint8] | None] = []
    for chosen, way in ((~looks_right, -1.0), (looks_right, 1.0)):
        # Across the body is to its right, as on a map: that is downwards where it looks right.
        shown = chosen.any()
        flanks.append(
            _sampled(frames[chosen], points[chosen], half_height, way * down) if shown else None
        )
    left, right = flanks
    seen = left if left is not None else right
    if seen is None:
        raise ValueError("no frame shows the animal")
    pixels = np.concatenate(
        [seen if left is None else left, (seen if right is None else right)[::-1]]
    )
    invented = np.zeros(pixels.shape[:2], dtype=np.bool_)
    invented[: len(seen)] = left is None
    invented[len(seen) :] = right is None
    return Texture(np.ascontiguousarray(pixels), invented)


def _sampled(
    frames: NDArray[np.uint8], points: Floats, half: Floats, across: Floats
) -> NDArray[np.uint8]:
    """(m, u, 3) the median of all frames at places across the body (m,), in half thicknesses."""
    chosen = np.linspace(0, len(frames) - 1, min(len(frames), _MOST_FRAMES)).round().astype(int)
    places = np.linspace(0.0, points.shape[1] - 1.0, _ALONG)
    thick = np.interp(places, np.arange(len(half)), half)
    samples = np.empty((len(chosen), len(across), _ALONG, 3), dtype=np.uint8)
    for row, number in enumerate(chosen):
        line = points[number]
        ahead = -np.gradient(line, axis=0)
        ahead /= np.maximum(np.linalg.norm(ahead, axis=1, keepdims=True), 1e-9)
        right = np.stack([-ahead[:, 1], ahead[:, 0]], axis=1)
        at = np.stack([np.interp(places, np.arange(len(line)), line[:, k]) for k in (0, 1)], axis=1)
        side = np.stack([np.interp(places, np.arange(len(line)), right[:, k]) for k in (0, 1)], 1)
        probes = at[None] + across[:, None, None] * (thick[:, None] * side)[None]
        samples[row] = cv2.remap(
            frames[number], (probes[..., 0] - 0.5).astype(np.float32),
            (probes[..., 1] - 0.5).astype(np.float32), cv2.INTER_LINEAR,
            borderMode=cv2.BORDER_REPLICATE,
        )  # fmt: skip
    return np.asarray(np.median(samples, axis=0), dtype=np.uint8)
