"""Where text stands on a sheet: an overview, and a closer look at small marks of large sheets.

The network finds text of some 10 to 100 px. A small sheet is enlarged before. A large one is
reduced; what becomes too small by that is looked for once more and larger, but only around marks of
the size of letters outside the text that is known: most of a large sheet is empty paper.
"""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from veduta.plan.text.engine import find_lines
from veduta.plan.text.mosaic import JOINED_PX, Box, boxes_of_marks, mosaics

OVERVIEW_PX = 1600
"""Long side at which the whole sheet is searched."""
TILE_PX = 1280
"""Side of the pictures of the closer look, which hold what is around small marks."""
MOST_TILES = 8
"""What is looked at closer has at most the area of so many; of more, what has most marks."""
_ENLARGE = 2.0  # a small sheet, at most
_OVERLAP = 0.15  # of a tile, where a block of text is larger: a line is whole in one of the two
_MARGIN_PX = 64  # around marks: letters that touch lines are no marks, but stand beside others
_FINER = 4.0  # the closer look over the overview
_LETTER_PX = (6, 60)  # height of letters, in pixels of the closer look
_IN_LINE = 0.4  # of a letter's size: so far off its line are the middles of those beside it
_DASH = 0.25  # what is so much narrower than long is a dash, or an l that stands beside an a
_CLEAR_PX = 12.0  # height of a region that the overview shows well
_TALLEST = 0.08  # a line of text over the long side of the sheet
_LETTERS = 4  # fewer marks than this are no text worth a second of work


def find_overview(pixels: NDArray[np.uint8]) -> NDArray[np.float64]:
    """Quadrangles (n, 4, 2) around the lines of text that are seen with the whole sheet in view.

    `pixels` is (h, w, 3) sRGB; quadrangles are in its pixels.
    """
    factor = overview_factor((pixels.shape[1], pixels.shape[0]))
    found = find_lines(_resized(pixels, factor)) / factor
    # What is taller is a drawing that looks like text from afar, and would hide the text in it.
    kept = _short_sides(found) < _TALLEST * max(pixels.shape)
    return np.asarray(found[kept], dtype=np.float64)


def find_regions(
    pixels: NDArray[np.uint8], overview: NDArray[np.float64] | None = None
) -> NDArray[np.float64]:
    """Quadrangles (n, 4, 2) around the lines of text of a sheet, in its pixels, each once.

    `pixels` is (h, w, 3) sRGB; `overview` is what `find_overview` gave, where it was called before.
    """
    found = find_overview(pixels) if overview is None else overview
    factor = overview_factor((pixels.shape[1], pixels.shape[0]))
    if factor < 1.0:
        scale = min(1.0, _FINER * factor)
        large = _resized(pixels, scale)
        clear = _short_sides(found) * factor >= _CLEAR_PX
        boxes = _closer_look(large, found[clear] * scale, found[~clear] * scale)
        paper = np.median(large[::16, ::16], axis=(0, 1)).astype(np.uint8)
        pictures = mosaics(large, boxes, TILE_PX, paper)
        closer = [one.in_sheet(find_lines(one.pixels)) / scale for one in pictures]
        seen = np.zeros(len(found), dtype=bool)
        for box in boxes:
            seen |= box.holds((found * scale).reshape(-1, 2)).reshape(-1, 4).all(axis=1)
        # What was small in the overview is as the closer look has it: lines run into one another.
        found = np.concatenate([found[clear | ~seen], *closer])
    return without_duplicates(found)


def _short_sides(quads: NDArray[np.float64]) -> NDArray[np.float64]:
    sides = np.linalg.norm(quads - np.roll(quads, -1, axis=1), axis=2)
    return np.asarray(sides.min(axis=1, initial=np.inf), dtype=np.float64)


def overview_factor(size_px: tuple[int, int]) -> float:
    """By how much a sheet of this width and height is enlarged (or reduced, below 1)."""
    return min(_ENLARGE, OVERVIEW_PX / max(size_px))


def without_duplicates(quads: NDArray[np.float64]) -> NDArray[np.float64]:
    """Quadrangles (n, 4, 2) without those that lie mostly in a larger one.

    Text is found twice where parts of the closer look overlap, and there after the overview.
    """
    kept: list[int] = []
    areas = [abs(cv2.contourArea(quad.astype(np.float32))) for quad in quads]
    for index in np.argsort(areas)[::-1]:
        quad = quads[index].astype(np.float32)
        shared = (
            cv2.intersectConvexConvex(quad, quads[other].astype(np.float32))[0] for other in kept
        )
        if areas[index] > 0 and all(area <= 0.5 * areas[index] for area in shared):
            kept.append(int(index))
    return quads[sorted(kept)]


def _resized(pixels: NDArray[np.uint8], factor: float) -> NDArray[np.uint8]:
    if factor == 1.0:
        return pixels
    how = cv2.INTER_AREA if factor < 1.0 else cv2.INTER_CUBIC
    size = tuple(max(32, round(side * factor)) for side in pixels.shape[1::-1])
    return np.asarray(cv2.resize(pixels, size, interpolation=how), dtype=np.uint8)


def _closer_look(
    pixels: NDArray[np.uint8], known: NDArray[np.float64], unclear: NDArray[np.float64]
) -> list[Box]:
    """The parts of a sheet (h, w, 3) with marks of the size of letters outside the known regions.

    `unclear` (n, 4, 2) are regions that are known, but too small to be read as they are.
    """
    size = (pixels.shape[1], pixels.shape[0])
    step = int(TILE_PX * (1.0 - _OVERLAP))
    points = np.concatenate([_letter_like(pixels, known), *map(_all_over, unclear)])
    boxes = boxes_of_marks(points, size, _MARGIN_PX, _LETTERS, TILE_PX, step)
    left = MOST_TILES * TILE_PX**2
    kept = []
    for box in boxes:
        if box.taken_px2 <= left:
            kept.append(box)
            left -= box.taken_px2
    return kept


def _all_over(quad: NDArray[np.float64]) -> NDArray[np.float64]:
    """Points (n, 2) all over a quadrangle, near to each other: those of a block with its extent."""
    low, high = quad.min(axis=0), quad.max(axis=0)
    count = np.maximum(3, np.ceil((high - low) / (JOINED_PX / 2)).astype(int) + 1)
    x, y = (np.linspace(low[axis], high[axis], count[axis]) for axis in (0, 1))
    return np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2)


def _letter_like(pixels: NDArray[np.uint8], known: NDArray[np.float64]) -> NDArray[np.float64]:
    """Centres (n, 2) of marks that have a letter's size and are not in a known region."""
    gray = cv2.cvtColor(pixels, cv2.COLOR_RGB2GRAY)
    _, ink = cv2.threshold(gray, 0, 1, cv2.THRESH_BINARY_INV + cv2.THRESH_OTSU)
    if ink.mean() > 0.5:
        ink = 1 - ink
    cv2.fillPoly(ink, [np.round(quad).astype(np.int32) for quad in known], 0)
    _, _, stats, centres = cv2.connectedComponentsWithStats(ink.astype(np.uint8))
    low, high = _LETTER_PX
    tall, wide = stats[1:, cv2.CC_STAT_HEIGHT], stats[1:, cv2.CC_STAT_WIDTH]
    fits = (np.maximum(tall, wide) >= low) & (np.maximum(tall, wide) <= high)
    fits &= np.minimum(tall, wide) >= 2
    sizes = np.maximum(tall, wide)[fits]
    broad = np.minimum(tall, wide)[fits] >= _DASH * sizes
    return _in_company(np.asarray(centres[1:][fits], dtype=np.float64), sizes, broad)


def _in_company(
    centres: NDArray[np.float64], sizes: NDArray[np.int32], broad: NDArray[np.bool_]
) -> NDArray[np.float64]:
    """The marks with two others of their size in one line with them: letters stand in words.

    One of the three is `broad`: a row of dashes is no word.
    """
    if len(centres) < 3:
        return np.zeros((0, 2))
    found = cKDTree(centres).query(centres, k=min(6, len(centres)))
    away, others = np.asarray(found[0]), np.asarray(found[1])
    near = away[:, 1:] < 2.0 * sizes[:, None]
    ratio = sizes[others[:, 1:]] / sizes[:, None]
    alike = near & (ratio > 0.6) & (ratio < 1.6)
    # (n, 5, 2): words stand level or upright, as sheets do, and may be a little askew.
    off = np.abs(centres[others[:, 1:]] - centres[:, None]) < _IN_LINE * sizes[:, None, None]
    in_line = (alike[..., None] & off).sum(axis=1).max(axis=1) >= 2
    lettered = broad | (alike & broad[others[:, 1:]]).any(axis=1)
    return np.asarray(centres[in_line & lettered], dtype=np.float64)
