"""Shop fronts as wholes: what the pixels call shop, in one piece."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.facade.eyes.look import Seen


@dataclass(frozen=True)
class ShopParameters:
    """When pixels are a shop front.

    `chance`: a pixel's, at least. `closed`: gaps (piers, doors) up to this share of the picture's
    height are within a front. `least`: the share of the picture that a front takes.
    """

    chance: float = 0.3
    closed: float = 0.02
    least: float = 0.003


def shop_fronts(seen: Seen, parameters: ShopParameters) -> list[tuple[NDArray[np.float64], float]]:
    """Boxes (x0, y0, x1, y1 in pixels of the picture) of the fronts, and the chance in each."""
    chance = seen.chance("shop")
    height, width = chance.shape
    reach = max(3, round(parameters.closed * height))
    kernel = np.ones((reach, reach), np.uint8)
    mask = (chance > parameters.chance).astype(np.uint8)
    for way in (cv2.MORPH_CLOSE, cv2.MORPH_OPEN):
        mask = cv2.morphologyEx(mask, way, kernel).astype(np.uint8)
    count, parts, stats, _ = cv2.connectedComponentsWithStats(mask)
    to_picture = np.array([seen.width_px / width, seen.height_px / height])
    fronts = []
    for part in range(1, count):
        x, y, w, h, area = (int(v) for v in stats[part])
        if area >= parameters.least * height * width:
            box = np.array([x, y, x + w, y + h], np.float64) * np.tile(to_picture, 2)
            fronts.append((box, float(chance[parts == part].mean())))
    return fronts
