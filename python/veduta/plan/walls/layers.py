"""The walls' own lines on a sheet that is drawn in many colours, a colour to each kind of thing.

CAD programs draw a layer in a colour: walls, furniture, tiles, axes. Axes that run inside of walls
and tiles that end at them make a muddle of all ink together; the lines of one colour are a plan of
walls alone. Which colour that is, is told by what hollow walls are: two lines side by side, of the
one or two breadths that are commonest, far along the sheet.
"""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.plan.walls.cells import NARROW, common_values, longer_side, tolerance
from veduta.plan.walls.runs import run_lengths, run_lengths_down

COLOURED = 90
"""Ink has a hue from this saturation (0 to 255): greys of scanned ink are below."""

DARK = 60
"""And from this darkness: pale tints are filled areas and noise."""

PEAK_SHARE = 0.03
"""A colour of lines has at least this part of all ink."""

HUE_STEP = 6
"""OpenCV's hues (0 to 179) are counted in steps of so many, and those next to a peak are its."""

LEAST_LAYERS = 4
"""So many colours, grey among them, are layers; fewer are a pen, a fill and a note."""

LEAST_LINES = 1.2
"""Lines side by side are the faces of a wall from so many line widths on."""

LAYERS_AT_ONCE = 2
"""OpenCV and numpy let other threads go on while they look at a layer."""

LONG = 4.0
"""The space between the faces of a wall is so many times as long as broad."""

OTHER_BREADTH = 4.0
"""Outer and inner walls differ by this factor at most: what is broader is a corridor."""

SECOND = 0.1
"""A second breadth is that of walls, too, if they are so long together, of those of the first."""

SIDE_BY_SIDE = 2.5
"""What is filled over so many breadths each way is no wall."""

LEAST_LENGTH = 1.5
"""Hollow walls of one colour are together so many times as long as the sheet's drawing."""

TURNS = 4.0
"""Walls that meet others reach so many times their breadth both ways."""

MOSTLY = 0.4
"""So much of all walls does: chains of dimensions are straight lines side by side, too."""

STROKE = 8.0
"""What goes on under another colour's line is so many line widths long, at least, on both sides."""

COVERED = 0.08
"""Another colour covers at most so much of a wall's face at once, of the drawing's longer side."""


@dataclass(frozen=True)
class Hollow:
    """Hollow walls of one colour: the (h, w) mask of them, how long and how broad they are."""

    mask: NDArray[np.bool_]
    length_px: float
    breadth_px: float


def walls_of_a_colour(
    pixels: NDArray[np.uint8], ink: NDArray[np.bool_], line_px: float
) -> NDArray[np.bool_] | None:
    """The (h, w) mask of hollow walls with their faces, by the colour of these; None without one.

    `pixels` (h, w, 3) are sRGB, dark on light paper; `ink` (h, w) is the mask of all ink.
    """
    layers = colour_layers(pixels, ink)
    if len(layers) < LEAST_LAYERS:
        return None
    extent = longer_side(ink)

    def walls_of(layer: NDArray[np.bool_]) -> Hollow:
        whole = _uncovered(layer, ink, line_px, COVERED * extent)
        return hollow_walls(whole, line_px, NARROW * extent)

    with ThreadPoolExecutor(LAYERS_AT_ONCE) as threads:
        walls = [*threads.map(walls_of, layers)]
    walls = [one for one in walls if one.length_px >= LEAST_LENGTH * extent and _meet(one)]
    return max(walls, key=lambda one: one.length_px).mask if walls else None


def _meet(walls: Hollow) -> bool:
    """Whether most of them go around corners or meet others."""
    _, _, stats, _ = cv2.connectedComponentsWithStats(walls.mask.astype(np.uint8), connectivity=8)
    both = np.minimum(stats[1:, cv2.CC_STAT_WIDTH], stats[1:, cv2.CC_STAT_HEIGHT])
    area = stats[1:, cv2.CC_STAT_AREA]
    turning = area[both >= TURNS * walls.breadth_px].sum()
    return bool(turning >= MOSTLY * max(1, int(area.sum())))


def colour_layers(pixels: NDArray[np.uint8], ink: NDArray[np.bool_]) -> list[NDArray[np.bool_]]:
    """Masks of the ink of each common hue, and one of the ink without a hue, if that is common."""
    dark = np.asarray(cv2.cvtColor(255 - pixels, cv2.COLOR_RGB2HSV), np.uint8)
    hued = ink & (dark[..., 1] >= COLOURED) & (dark[..., 2] >= DARK)
    bins = 180 // HUE_STEP
    step = dark[..., 0] // HUE_STEP
    counts = np.bincount(step[hued], minlength=bins).astype(float)
    around = counts + np.roll(counts, 1) + np.roll(counts, -1)
    least = PEAK_SHARE * max(1, int(ink.sum()))
    top = (counts > np.roll(counts, 1)) & (counts >= np.roll(counts, -1)) & (around >= least)
    found = []
    for peak in np.flatnonzero(top):
        off = (step.astype(np.int64) - int(peak) + bins // 2) % bins - bins // 2
        found.append(hued & (np.abs(off) <= 1))
    grey = ink & ~hued
    return [*found, grey] if grey.sum() >= least else found


def hollow_walls(lines: NDArray[np.bool_], line_px: float, most_px: float) -> Hollow:
    """What lies between two lines side by side, of the one or two commonest breadths, with these.

    Spaces are at least some line widths and at most `most_px` broad, and much longer than broad.
    The ends of walls need not be drawn.
    """
    paper = ~lines
    across, down = run_lengths(paper), run_lengths_down(paper)
    thin, long = np.minimum(across, down), np.maximum(across, down)
    between = paper & (thin >= LEAST_LINES * line_px) & (thin <= most_px) & (long >= LONG * thin)
    breadths = _breadths(thin[between])
    if not breadths:
        return Hollow(np.zeros_like(lines), 0.0, 0.0)
    fits = np.zeros(int(thin.max()) + 1, np.bool_)
    for one in breadths:
        fits |= np.abs(np.arange(len(fits)) - one) <= float(tolerance(np.array(one)))
    inside = between & fits[thin]
    # Where walls meet their spaces are as long as both. Even sides would move all by a pixel.
    corner = np.ones((_odd(max(breadths) + 2),) * 2, np.uint8)
    closed = cv2.morphologyEx((lines | inside).astype(np.uint8), cv2.MORPH_CLOSE, corner)
    # Treads, boards and hatching are spaces side by side; a line alone is no wall.
    field = np.ones((_odd(SIDE_BY_SIDE * max(breadths) + 2),) * 2, np.uint8)
    walls = (closed > 0) & (cv2.morphologyEx(closed, cv2.MORPH_OPEN, field) == 0)
    broad = np.ones((_odd(min(breadths)),) * 2, np.uint8)
    mask = cv2.morphologyEx(walls.astype(np.uint8), cv2.MORPH_OPEN, broad) > 0
    length = float((1.0 / thin[inside & mask]).sum())
    return Hollow(mask, length, max(breadths))


def _odd(least: float) -> int:
    return 2 * (round(least) // 2) + 1


def _breadths(thin: NDArray[np.int32]) -> list[float]:
    """The one or two commonest breadths of spaces; none of none.

    `thin` (n,) is the breadth at each pixel of them: b pixels are broad by b where they are long.
    """
    values, counts = np.unique(thin, return_counts=True)
    along = np.repeat(values.astype(np.float64), np.round(counts / values).astype(np.int64))
    if len(along) == 0:
        return []
    first = common_values(along, 1)[0][0]
    off = np.abs(along - first) > tolerance(np.array(first))
    near = off & (along <= OTHER_BREADTH * first) & (along >= first / OTHER_BREADTH)
    if not near.any():
        return [first]
    second, share = common_values(along[near], 1)
    enough = share * float(near.sum()) >= SECOND * float((~off).sum())
    return [first, second[0]] if enough else [first]


def _uncovered(
    layer: NDArray[np.bool_], ink: NDArray[np.bool_], line_px: float, most_px: float
) -> NDArray[np.bool_]:
    """A layer with the parts of its upright lines that lines of other colours cover."""
    grey = layer.astype(np.uint8)
    stroke, reach = (2 * round(size / 2) for size in (STROKE * line_px, most_px))
    done = layer.copy()
    for across in ((1, 0), (0, 1)):
        least, most = (
            np.ones((1 + n * across[0], 1 + n * across[1]), np.uint8) for n in (stroke, reach)
        )
        strokes = cv2.morphologyEx(grey, cv2.MORPH_OPEN, least)
        joined = cv2.morphologyEx(strokes, cv2.MORPH_CLOSE, most)
        done |= (joined > 0) & ink
    return np.asarray(done, dtype=np.bool_)
