"""Light and shadow evened: what is darker or brighter than the wall is elsewhere, and is wall."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

Pixels = NDArray[np.uint8]
Mask = NDArray[np.bool_]


@dataclass(frozen=True)
class LightParameters:
    """How far light is evened.

    reach: over how many storeys a pixel of the wall tells of the light around it. strength: which
    share of the difference goes. most: the largest factor up or down.
    """

    reach: float = 0.7
    strength: float = 0.7
    most: float = 1.35


def even_light(
    pixels: Pixels,
    wall: Mask,
    rows: slice,
    storey_px: float,
    parameters: LightParameters | None = None,
) -> tuple[Pixels, float]:
    """The picture (h, w, 3) sRGB with the light on some rows evened, and the largest change.

    The change is a share. wall: (h, w) what is plain wall. Nothing changes where there is too
    little of it.
    """
    p = parameters or LightParameters()
    height, width = wall.shape
    inside = np.zeros_like(wall)
    inside[rows] = wall[rows]
    if inside.mean() < 0.02 or storey_px < 4:
        return pixels, 0.0
    scale = min(1.0, 256.0 / max(height, width))
    size = max(1, round(width * scale)), max(1, round(height * scale))
    light = np.log(cv2.cvtColor(pixels, cv2.COLOR_RGB2GRAY).astype(np.float32) + 8.0)
    weight = cv2.resize(inside.astype(np.float32), size, interpolation=cv2.INTER_AREA)
    summed = cv2.resize(
        np.where(inside, light, 0).astype(np.float32), size, interpolation=cv2.INTER_AREA
    )
    sigma = max(1.0, p.reach * storey_px * scale)
    far = cv2.GaussianBlur(weight, (0, 0), sigma)
    around = cv2.GaussianBlur(summed, (0, 0), sigma) / np.maximum(far, 1e-4)
    usual = float(np.median(light[inside]))
    sure = np.clip(far / 0.05, 0.0, 1.0)
    change = np.clip(p.strength * (usual - around) * sure, -np.log(p.most), np.log(p.most))
    whole = cv2.resize(change.astype(np.float32), (width, height), interpolation=cv2.INTER_LINEAR)
    fade = np.zeros((height, 1), dtype=np.float32)
    fade[rows] = 1.0
    side = 2 * max(1, round(0.1 * storey_px)) + 1
    whole *= cv2.blur(fade, (1, side)).reshape(height, 1)
    made = np.clip(np.rint(pixels * np.exp(whole)[..., None]), 0, 255).astype(np.uint8)
    return made, float(np.exp(np.abs(whole[rows]).max(initial=0.0)) - 1.0)
