"""Single letters that stand alone: `K`, `E` and `S` are rooms on Finnish plans.

The network that finds lines of text passes most of them by. A mark is taken for such a letter if it
has the height of the letters on the sheet, has free paper around it, and reads as one of these.
"""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.plan.document import Text
from veduta.plan.names.vocabulary import meanings
from veduta.plan.text.engine import read_line, side_by_side
from veduta.plan.text.strips import strip_of

_ALIKE = (0.8, 1.25)  # height over that of the sheet's letters
_SHAPE = (0.3, 1.3)  # width over height
_FREE = 0.7  # heights of free paper on each side
_SURE = 0.9
_MOST = 12


def find_letters(pixels: NDArray[np.uint8], texts: list[Text]) -> list[Text]:
    """Letters that name rooms and are not in `texts`; `pixels` is (h, w, 3) sRGB."""
    ink = _ink(pixels)
    height = _letter_height(ink, texts)
    if height is None:
        return []
    quads = _alone(ink, texts, height)[:_MOST]
    lines = side_by_side(lambda quad: read_line(strip_of(pixels, quad)), quads)
    found = []
    for quad, line in zip(quads, lines, strict=True):
        if line.score >= _SURE and len(line.text) == 1 and meanings(line.text):
            corners = [(float(x), float(y)) for x, y in quad]
            found.append(Text(text=line.text, box_px=corners, score=line.score))
    return found


def _ink(pixels: NDArray[np.uint8]) -> NDArray[np.uint8]:
    gray = cv2.cvtColor(pixels, cv2.COLOR_RGB2GRAY)
    _, ink = cv2.threshold(gray, 0, 1, cv2.THRESH_BINARY_INV + cv2.THRESH_OTSU)
    return np.asarray(1 - ink if ink.mean() > 0.5 else ink, dtype=np.uint8)


def _letter_height(ink: NDArray[np.uint8], texts: list[Text]) -> float | None:
    """Median height of letters in texts that name rooms and lie level; None without such."""
    heights = []
    for text in texts:
        box = np.asarray(text.box_px)
        if not meanings(text.text) or abs(box[1, 1] - box[0, 1]) > 0.2 * abs(box[1, 0] - box[0, 0]):
            continue
        low, high = np.maximum(box.min(axis=0), 0).astype(int), box.max(axis=0).astype(int)
        rows = np.flatnonzero(ink[low[1] : high[1], low[0] : high[0]].any(axis=1))
        if len(rows):
            heights.append(float(np.ptp(rows) + 1))
    return float(np.median(heights)) if heights else None


def _alone(ink: NDArray[np.uint8], texts: list[Text], height: float) -> list[NDArray[np.float64]]:
    """Rectangles (4, 2) around marks of a letter's size with free paper around them."""
    outside = ink.copy()
    cv2.fillPoly(outside, [np.round(text.box_px).astype(np.int32) for text in texts], 0)
    _, _, stats, _ = cv2.connectedComponentsWithStats(outside)
    free = round(_FREE * height)
    found = []
    for x, y, wide, tall, _ in stats[1:]:
        fits = _ALIKE[0] * height <= tall <= _ALIKE[1] * height
        if not fits or not _SHAPE[0] * tall <= wide <= _SHAPE[1] * tall:
            continue
        around = ink[max(0, y - free) : y + tall + free, max(0, x - free) : x + wide + free]
        if around.sum() == ink[y : y + tall, x : x + wide].sum():
            edge = 0.25 * height
            left, top, right, bottom = x - edge, y - edge, x + wide + edge, y + tall + edge
            found.append(np.array([(left, top), (right, top), (right, bottom), (left, bottom)]))
    return found
