"""Where text stands on a sheet: an overview, and tiles of large sheets where small marks are.

The network finds text of some 10 to 100 px. A small sheet is enlarged before. A large one is
reduced; what becomes too small by that is looked for in tiles, but only in those that hold marks of
the size of letters outside the text that is known: most of a large sheet is empty paper.
"""

from __future__ import annotations

from collections.abc import Iterator

import cv2
import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from veduta.plan.text.engine import find_lines

OVERVIEW_PX = 1600
"""Long side at which the whole sheet is searched."""
TILE_PX = 1280
MOST_TILES = 8
_ENLARGE = 2.0  # a small sheet, at most
_OVERLAP = 0.15  # of a tile: a line of text on a border is whole in one of the two
_FINER = 4.0  # a tile over the overview
_LETTER_PX = (6, 60)  # height of letters, in pixels of the tile
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
        tile = TILE_PX
        scale = min(1.0, _FINER * factor)
        large = _resized(pixels, scale)
        clear = _short_sides(found) * factor >= _CLEAR_PX
        boxes, seen = [], np.zeros(len(found), dtype=bool)
        for x, y in _tiles_with_letters(large, found[clear] * scale, tile, MOST_TILES):
            inside = find_lines(large[y : y + tile, x : x + tile])
            boxes.append((inside + np.array([x, y])) / scale)
            centres = found.mean(axis=1) * scale
            seen |= np.all((centres >= (x, y)) & (centres < (x + tile, y + tile)), axis=1)
        # What was small in the overview is as the tile has it: lines there run into one another.
        found = np.concatenate([found[clear | ~seen], *boxes])
    return without_duplicates(found)


def _short_sides(quads: NDArray[np.float64]) -> NDArray[np.float64]:
    sides = np.linalg.norm(quads - np.roll(quads, -1, axis=1), axis=2)
    return np.asarray(sides.min(axis=1, initial=np.inf), dtype=np.float64)


def overview_factor(size_px: tuple[int, int]) -> float:
    """By how much a sheet of this width and height is enlarged (or reduced, below 1)."""
    return min(_ENLARGE, OVERVIEW_PX / max(size_px))


def without_duplicates(quads: NDArray[np.float64]) -> NDArray[np.float64]:
    """Quadrangles (n, 4, 2) without those that lie mostly in a larger one.

    Text is found twice in the overlap of tiles, and in a tile after the overview.
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


def _tiles_with_letters(
    pixels: NDArray[np.uint8], known: NDArray[np.float64], tile: int, most: int
) -> Iterator[tuple[int, int]]:
    """Upper left corners of the tiles with most marks of the size of letters, at most `most`."""
    centres = _letter_like(pixels, known)
    height, width = pixels.shape[:2]
    step = int(tile * (1.0 - _OVERLAP))
    corners = [
        (x, y)
        for y in range(0, max(1, height - int(tile * _OVERLAP)), step)
        for x in range(0, max(1, width - int(tile * _OVERLAP)), step)
    ]
    counts = [
        int(np.all((centres >= corner) & (centres < np.add(corner, tile)), axis=1).sum())
        for corner in corners
    ]
    order = sorted(range(len(corners)), key=lambda index: -counts[index])
    return (corners[index] for index in order[:most] if counts[index] >= _LETTERS)


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
    return _in_company(np.asarray(centres[1:][fits], dtype=np.float64), sizes)


def _in_company(centres: NDArray[np.float64], sizes: NDArray[np.int32]) -> NDArray[np.float64]:
    """The marks that have two others of their size beside them: letters stand in words."""
    if len(centres) < 3:
        return np.zeros((0, 2))
    found = cKDTree(centres).query(centres, k=min(6, len(centres)))
    away, others = np.asarray(found[0]), np.asarray(found[1])
    near = away[:, 1:] < 2.0 * sizes[:, None]
    ratio = sizes[others[:, 1:]] / sizes[:, None]
    alike = near & (ratio > 0.6) & (ratio < 1.6)
    return np.asarray(centres[alike.sum(axis=1) >= 2], dtype=np.float64)
