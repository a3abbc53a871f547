"""Spots on a drawn animal's coat, which move with the bones that they lie on."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

import cv2
import numpy as np
from numpy.typing import NDArray

_SIDE_PX = 256
_SPOT_PX = 2.5
_CONTRAST = 0.3
_BESIDE_PX = 40
"""So far from a bone a place may lie that is still painted."""


@dataclass(frozen=True, eq=False)
class Coat:
    """(n, n) how light the coat is for its mean: along a chain of bones, and across it (px)."""

    light: NDArray[np.float32]

    @classmethod
    def drawn(cls, random: np.random.Generator) -> Self:
        """One with spots of a few pixels, whose pattern comes again after `_SIDE_PX`."""
        rough = random.normal(size=(_SIDE_PX, _SIDE_PX)).astype(np.float32)
        rim = int(4 * _SPOT_PX)
        soft = cv2.GaussianBlur(np.pad(rough, rim, mode="wrap"), (0, 0), _SPOT_PX)
        soft = soft[rim:-rim, rim:-rim]
        return cls(np.clip(1.0 + _CONTRAST * soft / soft.std(), 0.2, 2.0).astype(np.float32))

    def on(
        self, joints: NDArray[np.float64], row: int, size: tuple[int, int]
    ) -> NDArray[np.float32]:
        """(h, w) how light each pixel near the chain is in a frame; 1 elsewhere.

        joints: (t, n, 2) px of the chain in all frames, so that a spot keeps its bone.
        """
        found = np.ones(size, np.float32)
        here = joints[row]
        low = np.clip(np.floor(here.min(axis=0)).astype(int) - _BESIDE_PX, 0, size[::-1])
        high = np.clip(np.ceil(here.max(axis=0)).astype(int) + _BESIDE_PX, 0, size[::-1])
        if (high <= low).any():
            return found
        x, y = np.meshgrid(np.arange(low[0], high[0]) + 0.5, np.arange(low[1], high[1]) + 0.5)
        usual = np.linalg.norm(np.diff(joints, axis=1), axis=2).mean(axis=0)
        nearest = np.full(x.shape, np.inf)
        along, across = np.zeros(x.shape), np.zeros(x.shape)
        for bone in range(len(here) - 1):
            way = here[bone + 1] - here[bone]
            square = max(float(way @ way), 1e-9)
            own = ((x - here[bone, 0]) * way[0] + (y - here[bone, 1]) * way[1]) / square
            share = np.clip(own, 0.0, 1.0)
            off_x, off_y = (
                x - here[bone, 0] - share * way[0], y - here[bone, 1] - share * way[1]
            )  # fmt: skip
            away = np.hypot(off_x, off_y)
            nearer = away < nearest
            nearest = np.where(nearer, away, nearest)
            along = np.where(nearer, usual[:bone].sum() + share * usual[bone], along)
            sided = away * np.sign(off_y * way[0] - off_x * way[1])
            across = np.where(nearer, sided, across)
        painted = cv2.remap(
            self.light, across.astype(np.float32) % _SIDE_PX, along.astype(np.float32) % _SIDE_PX,
            cv2.INTER_LINEAR, borderMode=cv2.BORDER_WRAP,
        )  # fmt: skip
        found[low[1] : high[1], low[0] : high[0]] = np.asarray(painted, dtype=np.float32)
        return found
