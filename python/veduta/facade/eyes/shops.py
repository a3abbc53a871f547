"""Shop fronts as wholes: what the pixels call shop, in one piece."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.facade.eyes.look import Seen


@dataclass(frozen=True)
class ShopParameters:
    """When pixels are a shop front.

    `chance`: a pixel's, at least. `closed`: gaps (piers, doors) up to this share of the picture's
    height are within a front. `least`: the share of the picture that a front takes. `parted`: the
    chance of shop between the single shops of a front, up to which these are shops of their own:
    on 80 pictures of CMP, whose shops are single panes, the F1 of shops rises from 0.30 to 0.36
    with this; on 60 of ECP, whose shops are whole ground floors, it stays 0.76 (to close gaps of
    0.01 alone gives more on both, but loses pixels of shops).
    """

    chance: float = 0.3
    closed: float = 0.02
    least: float = 0.003
    parted: float = 0.25


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


def between_shops(seen: Seen, boxes: NDArray[np.float64]) -> float:
    """The median of the chances of shop between neighbours of (n, 4) boxes, of which two at least.

    Left, top, right, bottom in pixels of the picture.
    """
    chance = seen.chance("shop")
    to_grid = np.array([chance.shape[1] / seen.width_px, chance.shape[0] / seen.height_px])
    ordered = boxes[np.argsort(boxes[:, 0], kind="stable")] * np.tile(to_grid, 2)
    found = []
    for one, other in pairwise(ordered):
        low, high = sorted((int(one[2]), int(other[0])))
        top, bottom = int(min(one[1], other[1])), int(max(one[3], other[3]))
        part = chance[top : max(bottom, top + 1), low : max(high, low + 1)]
        found.append(float(part.mean()) if part.size else 1.0)
    return float(np.median(found))
