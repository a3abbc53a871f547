"""Inner walls in a paler tone than the outer ones: sellers fill these black and those grey.

Paler strokes are panes as a rule. What goes around corners and is as long as walls are is none.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.plan.walls.solid import Thickness, half_perimeter, stroke_length


@dataclass(frozen=True)
class PaleRule:
    """What tells pale walls from shaded panes.

    turns: a piece of them reaches so many times its walls' thickness both ways.
    long: all pieces are together so long, as a part of the drawing's half perimeter.
    alike: short stubs that hang on one dark wall, as those beside doors, are at most so many times
    as thick as these.
    """

    turns: float = 3.0
    long: float = 0.35
    alike: float = 1.35


RULE = PaleRule()
FILLED = 0.5
TOUCH_PX = 4


def pale_walls(
    strokes: NDArray[np.bool_],
    solid: NDArray[np.bool_],
    thickness: Thickness,
    rule: PaleRule = RULE,
) -> NDArray[np.bool_]:
    """What of thick strokes (h, w) is pale wall beside dark walls `solid`; empty without such."""
    # The pale edge of dark walls is none.
    near = cv2.dilate(solid.astype(np.uint8), np.ones((3, 3), np.uint8)) > 0
    least = max(2, round(0.7 * thickness.least_px))
    rest = cv2.morphologyEx(
        (strokes & ~near).astype(np.uint8), cv2.MORPH_OPEN, np.ones((least, least), np.uint8)
    )
    count, marked, stats, _ = cv2.connectedComponentsWithStats(rest, connectivity=8)
    labels = np.asarray(marked, np.int32)
    wide, high = stats[:, cv2.CC_STAT_WIDTH], stats[:, cv2.CC_STAT_HEIGHT]
    # Beds and cars fill the box around them, walls do not.
    boxed = stats[:, cv2.CC_STAT_AREA] > FILLED * wide.astype(np.int64) * high
    turning = (np.minimum(wide, high) >= rule.turns * thickness.least_px) & ~boxed
    turning[0] = False
    found: NDArray[np.bool_] = turning[labels]
    if stroke_length(found, 0.7 * thickness.least_px) < rule.long * half_perimeter(solid):
        return np.zeros_like(solid)
    depth = cv2.distanceTransform(found.astype(np.uint8), cv2.DIST_L2, 3)
    usual = 2.0 * float(np.percentile(depth[found], 90))
    stubs = [
        label
        for label in range(1, count)
        if boxed[label]
        and min(wide[label], high[label]) <= rule.alike * usual
        and _contacts(labels, np.asarray(stats[label], np.int32), label, solid) == 1
    ]
    found = found | np.isin(labels, stubs)
    # With the edge that parted them from dark walls.
    grown = cv2.dilate(found.astype(np.uint8), np.ones((5, 5), np.uint8)) > 0
    return np.asarray(strokes & grown, np.bool_)


def _contacts(
    labels: NDArray[np.int32], stats: NDArray[np.int32], label: int, solid: NDArray[np.bool_]
) -> int:
    """With how many pieces of dark wall a pale one is in touch: panes have one at each end."""
    left, top, wide, high = (int(value) for value in stats[:4])
    window = (
        slice(max(0, top - TOUCH_PX), top + high + TOUCH_PX),
        slice(max(0, left - TOUCH_PX), left + wide + TOUCH_PX),
    )
    square = np.ones((2 * TOUCH_PX + 1, 2 * TOUCH_PX + 1), np.uint8)
    around = cv2.dilate((labels[window] == label).astype(np.uint8), square)
    count, _ = cv2.connectedComponents(around & solid[window].astype(np.uint8))
    return int(count) - 1
