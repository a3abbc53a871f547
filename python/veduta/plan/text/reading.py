"""From the picture of a sheet to the text on it."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.plan.document import Text
from veduta.plan.text.engine import LINE_PX, Line, read_line
from veduta.plan.text.options import TextOptions
from veduta.plan.text.regions import find_regions

_SURE = 0.9  # a line that is read so well stands the way in which it was read
_LONG = 1.5  # a region this much longer than wide runs along its long side


def read_texts(pixels: NDArray[np.uint8], options: TextOptions | None = None) -> list[Text]:
    """The text on a sheet.

    `pixels` is (h, w, 3) sRGB or (h, w) gray, upright and not mirrored (see `orientation`). Boxes
    are in its pixels; corners go clockwise in the direction of reading, from the upper left corner
    of the first letter. Regions that say nothing with `options.score` are left out.
    """
    options = options or TextOptions()
    pixels = in_colour(pixels)
    regions = find_regions(pixels, options)[: options.regions]
    read = (_read_region(pixels, quad, options.threads) for quad in regions)
    return [
        Text(text=line.text, box_px=[(float(x), float(y)) for x, y in quad], score=line.score)
        for quad, line in read
        if line.text and line.score >= options.score
    ]


def in_colour(pixels: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """(h, w, 3) of a picture that is (h, w) or (h, w, 3)."""
    return np.repeat(pixels[:, :, None], 3, axis=2) if pixels.ndim == 2 else pixels


def strip_of(pixels: NDArray[np.uint8], quad: NDArray[np.float64]) -> NDArray[np.uint8]:
    """The region inside `quad` (4, 2) as an upright line of text, LINE_PX high.

    The first side of `quad` becomes the top. Cubic interpolation: small text is enlarged by it.
    """
    across = float(np.linalg.norm(quad[1] - quad[0]) + np.linalg.norm(quad[2] - quad[3]))
    down = float(np.linalg.norm(quad[3] - quad[0]) + np.linalg.norm(quad[2] - quad[1]))
    width = int(np.clip(round(LINE_PX * across / max(down, 1e-9)), 8, 60 * LINE_PX))
    corners = np.array([(0, 0), (width, 0), (width, LINE_PX), (0, LINE_PX)], dtype=np.float32)
    matrix = cv2.getPerspectiveTransform(quad.astype(np.float32), corners)
    return np.asarray(
        cv2.warpPerspective(
            pixels,
            matrix,
            (width, LINE_PX),
            flags=cv2.INTER_CUBIC,
            borderMode=cv2.BORDER_REPLICATE,
        ),
        dtype=np.uint8,
    )


def _read_region(
    pixels: NDArray[np.uint8], quad: NDArray[np.float64], threads: int
) -> tuple[NDArray[np.float64], Line]:
    """The corners in the direction of reading, and what the region says."""
    best_quad, best = quad, Line("", 0.0)
    for turns in _ways_round(quad):
        turned = np.roll(quad, -turns, axis=0)
        line = read_line(strip_of(pixels, turned), threads)
        if line.score > best.score:
            best_quad, best = turned, line
        if best.score >= _SURE and turns in (0, 3):
            break
    return best_quad, best


def _ways_round(quad: NDArray[np.float64]) -> tuple[int, ...]:
    """Which sides of a region may be the top of its text, the likeliest first.

    0 is as it stands, 3 reads upwards, 1 downwards. Plans are read from below and from the right.
    """
    across = np.linalg.norm(quad[1] - quad[0])
    down = np.linalg.norm(quad[3] - quad[0])
    if across > _LONG * down:
        return (0,)
    if down > _LONG * across:
        return (3, 1)
    return (0, 3, 1)
