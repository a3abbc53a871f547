"""Rendered fronts with the boxes of their modillions and consoles, in pixels."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from style_fronts import TrueFront, true_front

STYLES = ("haussmann", "louis-xiii", "victorian", "gothic-revival")
"""Those that have modillions."""
KINDS = ("modillion", "console")
LONG_PX = 1200
_BEFORE_WALL_M = 0.05
Boxes = NDArray[np.float64]


@dataclass(frozen=True)
class ElementFront:
    """pixels: (h, w, 3) uint8 sRGB, fronto-parallel. boxes: (n, 4) of each kind."""

    name: str
    pixels: NDArray[np.uint8]
    boxes: dict[str, Boxes]


def element_front(style: str, seed: int) -> ElementFront:
    """A front of a style by chance, as `style_fronts` renders it but larger."""
    front = true_front(style, seed, LONG_PX)
    return ElementFront(
        f"{style}-{seed}", front.pixels, {kind: _boxes(front, kind) for kind in KINDS}
    )


def _boxes(front: TrueFront, kind: str) -> Boxes:
    low, high = front.placed.get(kind, (np.zeros((0, 3)), np.zeros((0, 3))))
    height, scale = front.pixels.shape[0], front.px_per_m
    outside = low[:, 1] < _BEFORE_WALL_M
    boxes = np.column_stack(
        [low[:, 0], height / scale - high[:, 2], high[:, 0], height / scale - low[:, 2]]
    )
    return np.asarray(scale * boxes[outside], np.float64)
