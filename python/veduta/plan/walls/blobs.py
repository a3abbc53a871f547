"""Solid areas that are far thicker than walls: chimney breasts, cars, beds, shaded things.

As strokes they would be slanted walls, and the walls beside them windows. A wall that such an area
hides goes on through it where it comes out at both ends.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.plan.walls.solid import Thickness


@dataclass(frozen=True)
class BlobRule:
    """What is no wall, for all its ink.

    thick: so many times as thick as the thickest common wall. long: and no longer than so many
    times its own thickness, which a thick wall may be. on: a wall beside it goes on through it if
    it is so many wall thicknesses long there.
    """

    thick: float = 2.3
    long: float = 6.0
    on: float = 1.0


BLOB = BlobRule()


def without_blobs(
    solid: NDArray[np.bool_], thickness: Thickness, rule: BlobRule = BLOB
) -> NDArray[np.bool_]:
    """A mask (h, w) of thick strokes without what is too thick; walls are carried through it."""
    size = max(3, round(rule.thick * thickness.most_px))
    grey: NDArray[np.uint8] = solid.astype(np.uint8)
    fat = cv2.morphologyEx(grey, cv2.MORPH_OPEN, np.ones((size, size), np.uint8))
    if not fat.any():
        return solid
    # The rounded rim of a blob belongs to it.
    rim = max(1, round(0.25 * thickness.most_px))
    wide = np.minimum(cv2.dilate(fat, np.ones((2 * rim + 1, 2 * rim + 1), np.uint8)), grey)
    count, labels, stats, _ = cv2.connectedComponentsWithStats(wide, connectivity=8)
    cleared = grey.copy()
    for label in range(1, count):
        left, top, across, down = (int(value) for value in stats[label, :4])
        if max(across, down) > rule.long * min(across, down):
            continue
        own = labels == label
        margin = round(rule.on * thickness.most_px) + 2
        window = (
            slice(max(0, top - margin), top + down + margin),
            slice(max(0, left - margin), left + across + margin),
        )
        rest = np.where(own, 0, grey).astype(np.uint8)[window]
        through = _through(rest, own[window], (across, down))
        cleared[window] = np.where(own[window], through, cleared[window])
    return cleared.astype(np.bool_)


def _through(
    rest: NDArray[np.uint8], own: NDArray[np.bool_], size_px: tuple[int, int]
) -> NDArray[np.uint8]:
    """What lies in an area between walls that end at both sides of it, in a row or a column."""
    across, down = size_px
    found = np.zeros(rest.shape, np.uint8)
    for shape in ((1, across + 3), (down + 3, 1)):
        wide = cv2.copyMakeBorder(
            rest, shape[0], shape[0], shape[1], shape[1], cv2.BORDER_CONSTANT, value=0
        )
        shut = cv2.morphologyEx(wide, cv2.MORPH_CLOSE, np.ones(shape, np.uint8))
        shut = shut[shape[0] : -shape[0], shape[1] : -shape[1]]
        found |= (shut > 0).astype(np.uint8) & own.astype(np.uint8)
    return found
