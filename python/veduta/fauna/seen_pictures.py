"""The report's picture of what was seen: outlines and axes over the frames."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.fauna.motion.angles import Floats
from veduta.fauna.read.footage import Footage
from veduta.fauna.read.limbless import Seen

_PANELS = 6
_SIDE = 380
_OUTLINE, _AXIS = (214, 48, 40), (40, 190, 70)
_SURE = (90, 140, 200)


def second_picture(mask: NDArray[np.bool_]) -> NDArray[np.uint8]:
    """A silhouette of the second view, cut to the animal: white on grey, its outline red."""
    rows, columns = np.flatnonzero(mask.any(axis=1)), np.flatnonzero(mask.any(axis=0))
    cut = np.pad(mask[rows[0] : rows[-1] + 1, columns[0] : columns[-1] + 1], 8)
    scale = min(4.0, 3.0 * _SIDE / max(cut.shape))
    large = cv2.resize(cut.astype(np.uint8), None, fx=scale, fy=scale)
    panel = np.where(large[..., None] > 0, 255, 110).astype(np.uint8).repeat(3, axis=2)
    outlines, _ = cv2.findContours(large, cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_NONE)
    cv2.drawContours(panel, outlines, -1, _OUTLINE, 2, cv2.LINE_AA)
    return panel


def scores_picture(
    scores: list[tuple[int, float]], width: int = 900, height: int = 160
) -> NDArray[np.uint8]:
    """A bar for each frame that shows the animal, as high as its silhouette is sure; a gap is a
    frame that was left out.
    """
    pixels = np.full((height, width, 3), 255, dtype=np.uint8)
    first, last = scores[0][0], scores[-1][0]
    step = width / max(last - first + 1, 1)
    for frame, score in scores:
        left = int((frame - first) * step)
        right = max(left + 1, int((frame - first + 1) * step) - (1 if step > 3.0 else 0))
        pixels[height - round(score * (height - 1)) :, left:right] = _SURE
    return pixels


def silhouettes_picture(
    footage: Footage, seen: Seen, points: Floats, rows: NDArray[np.int64]
) -> NDArray[np.uint8]:
    """Six frames side by side in two lines, cut to where the animal goes.

    points: (t, n, 2) px, y down, of the frames `rows` of the footage.
    """
    place = {int(row): number for number, row in enumerate(seen.silhouettes.rows)}
    low = np.maximum(points.min(axis=(0, 1)) - 25.0, 0.0)
    high = np.minimum(points.max(axis=(0, 1)) + 25.0, [footage.size[1], footage.size[0]])
    (left, top), (right, bottom) = low.astype(int), high.astype(int)
    scale = _SIDE / max(bottom - top, 1)
    scale = min(scale, 1.4 * _SIDE / max(right - left, 1))
    panels = []
    for number in np.linspace(0, len(rows) - 1, _PANELS).round().astype(int):
        row = int(rows[number])
        cut = footage.frames[row][top:bottom, left:right]
        panel = cv2.resize(cut, None, fx=scale, fy=scale, interpolation=cv2.INTER_AREA)
        mask = seen.silhouettes.masks[place[row]][top:bottom, left:right].astype(np.uint8)
        large = cv2.resize(mask, panel.shape[1::-1], interpolation=cv2.INTER_NEAREST)
        outlines, _ = cv2.findContours(large, cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_NONE)
        cv2.drawContours(panel, outlines, -1, _OUTLINE, 1, cv2.LINE_AA)
        line = np.round((points[number] - [left, top]) * scale * 8).astype(np.int32)
        cv2.polylines(panel, [line], False, _AXIS, 2, cv2.LINE_AA, shift=3)
        head = (int(line[0, 0]), int(line[0, 1]))
        cv2.circle(panel, head, 4 * 8, _AXIS, -1, cv2.LINE_AA, shift=3)
        panels.append(cv2.copyMakeBorder(panel, 2, 2, 2, 2, cv2.BORDER_CONSTANT, value=(255,) * 3))
    half = _PANELS // 2
    rows_of = [np.hstack(panels[:half]), np.hstack(panels[half:])]
    return np.ascontiguousarray(np.vstack(rows_of), dtype=np.uint8)
