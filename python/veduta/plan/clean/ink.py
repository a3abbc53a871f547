"""Ink told from paper: uneven light, yellowed or coloured paper, white lines on black."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

LIGHT_SIDE_PX = 320
"""The light is estimated on a reduced sheet of this side: it changes slowly."""

LIGHT_REACH = 1 / 11
"""Paper is looked for within this share of the side: more than the widest solid wall."""

LEAST_CONTRAST = 0.2
"""Fainter than this share of the darkest ink is no line: shaded floors and JPEG's rings are not."""

COMMON = 0.1
"""Lines have at least this part of the runs of what is commonest: there may be more wall."""

NOISY = 0.03
"""Standard deviation of the noise, as a share of black, from which a sheet is smoothed first."""

DOT = 1.0
"""What is enclosed by ink and no larger than the square of a line's width by this is no room."""

BAND = 2.0
"""Dots lie in what is so many times as thick as lines."""

EDGE = 0.4
"""Its pale edge is as wide as this part of a line."""

PALE = 0.6
"""Paler ink may be a shade ..."""

STEEP, SHARP_SHARE = 0.5, 0.3
"""... where less than this share of its edge to the paper has that part of a stroke's slope ..."""

FREE_SHARE, SHADE_PX, GRAIN_PX = 0.5, 60, 3
"""... and more than this share of its edge is to the paper, which is a square of so many pixels at
least; what has fewer pixels is no matter."""

BLACK, WHITE = 80, 170
"""A sheet whose median is darker is black; one whose median is lighter is white."""

AROUND, FAINT = 0.2, 16
"""The paper is the median within so much of the side; so many grey levels about it are noise."""


def is_negative(pixels: NDArray[np.uint8]) -> bool:
    """Whether (h, w, 3) pixels are light lines on dark: blueprints, screens of CAD programs.

    On a sheet that is neither black nor white it is told by what stands out of the paper, which is
    the commonest around each place: more of it lighter, or more of it darker.
    """
    if np.median(pixels[::7, ::7].max(axis=2)) < BLACK:
        return True
    grey = cv2.cvtColor(pixels, cv2.COLOR_RGB2GRAY)
    if np.median(grey[::7, ::7]) > WHITE:
        return False
    shrink = min(1.0, 2.0 * LIGHT_SIDE_PX / max(grey.shape))
    small = cv2.resize(grey, None, fx=shrink, fy=shrink, interpolation=cv2.INTER_AREA)
    reach = 2 * round(max(small.shape) * AROUND / 2) + 1
    off = small.astype(np.int64) - cv2.medianBlur(small, min(reach, 255))
    return int(off[off > FAINT].sum()) > -int(off[off < -FAINT].sum())


def darkness(pixels: NDArray[np.uint8]) -> NDArray[np.float32]:
    """(h, w) of how much darker than the paper around it each pixel is, 0 to 1.

    The darkest channel counts, so that red and blue lines are as dark as black ones. The paper's
    brightness is the largest one around, per channel: yellowed paper and shades divide out.
    """
    paper = _paper(pixels)
    dark = np.zeros(pixels.shape[:2], dtype=np.float32)
    for channel in range(3):
        here = pixels[..., channel].astype(np.float32)
        np.maximum(dark, 1.0 - here / np.maximum(paper[..., channel], 1.0), out=dark)
    if _noise(dark) > NOISY:
        dark = np.asarray(cv2.medianBlur(dark, 3), dtype=np.float32)
    return dark


def ink_of(dark: NDArray[np.float32]) -> NDArray[np.float32]:
    """Darkness over that of the sheet's darkest lines: (h, w) float32 in 0 to 1."""
    seen = dark[dark > LEAST_CONTRAST]
    full = float(np.percentile(seen, 85)) if seen.size > 50 else 1.0
    return np.asarray(np.clip(dark / max(full, LEAST_CONTRAST), 0, 1), dtype=np.float32)


def marks(ink: NDArray[np.float32], line_px: float = 3.0) -> NDArray[np.bool_]:
    """The (h, w) mask of ink: above half of the darkest ink within some line widths.

    A local threshold (as that of Bernsen 1986), so that faint lines count where no dark one is
    near, and the blur around dark ones does not.
    """
    reach = 2 * max(2, round(line_px)) + 1
    disc = cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (reach, reach))
    darkest = cv2.blur(cv2.dilate(ink, disc), (reach, reach))
    return np.asarray(ink > np.maximum(0.5 * darkest, LEAST_CONTRAST), dtype=np.bool_)


def without_pinholes(ink: NDArray[np.float32], mask: NDArray[np.bool_]) -> NDArray[np.float32]:
    """The ink with what it encloses filled where that is no larger than a dot of a pen.

    `mask` (h, w) is of the ink's marks. Rows of white dots are the drawing of walls of concrete or
    of insulation, and single ones are noise.
    """
    line_px = line_width(mask)
    most = max(1.0, DOT * line_px**2)
    paper = (~mask).view(np.uint8)
    count, labels, stats, _ = cv2.connectedComponentsWithStats(paper, connectivity=4)
    small = stats[:, cv2.CC_STAT_AREA] <= most
    small[0] = False
    if count < 2 or not small.any():
        return ink
    holes = small[labels]
    # Not those of letters, nor between lines that meet: with them filled, it is thick there.
    side = max(2, round(BAND * line_px))
    full = cv2.morphologyEx(
        (mask | holes).view(np.uint8), cv2.MORPH_OPEN, np.ones((side, side), np.uint8)
    )
    holes &= full.view(np.bool_)
    if not holes.any():
        return ink
    # With their pale edges.
    reach = 2 * round(EDGE * line_px) + 1
    around = cv2.dilate(holes.view(np.uint8), np.ones((reach, reach), np.uint8)).view(np.bool_)
    return np.asarray(np.where(around & (mask | holes), np.float32(1), ink), dtype=np.float32)


def without_shades(ink: NDArray[np.float32], mask: NDArray[np.bool_]) -> NDArray[np.float32]:
    """The ink without creases, stains and shadows: what is pale and has no edge to the paper.

    `mask` (h, w) is of the ink's marks. Edges are steep or not as those of the darkest ink are, so
    that pale strokes stay on a sheet out of focus.
    """
    square = np.ones((3, 3), np.uint8)
    pale = (mask & (ink < PALE)).view(np.uint8)
    count, labels = cv2.connectedComponents(pale, connectivity=8)
    slope = cv2.dilate(ink, square) - cv2.erode(ink, square)
    dark = (ink >= PALE).view(np.uint8)
    edges = slope[cv2.morphologyEx(dark, cv2.MORPH_GRADIENT, square).view(np.bool_)]
    if count < 2 or not edges.size:
        return ink
    # Grains of light within a pale fill are no paper.
    paper = cv2.morphologyEx(
        (ink < LEAST_CONTRAST).view(np.uint8),
        cv2.MORPH_OPEN,
        np.ones((GRAIN_PX, GRAIN_PX), np.uint8),
    )
    rim = labels[(pale > 0) & (cv2.erode(pale, square) == 0)]
    border = (pale > 0) & (cv2.dilate(paper, square) > 0)
    area = np.maximum(np.bincount(labels.ravel(), minlength=count), 1)
    level = np.bincount(labels.ravel(), weights=ink.ravel(), minlength=count) / area
    at = labels[border]
    steep = slope[border] > STEEP * float(np.median(edges)) * level[at]
    sharp = np.bincount(at, weights=steep, minlength=count)
    length = np.bincount(at, minlength=count)
    shade = length > FREE_SHARE * np.bincount(rim, minlength=count)
    shade &= (sharp < SHARP_SHARE * length) & (area > SHADE_PX)
    shade[0] = False
    if not shade.any():
        return ink
    return np.asarray(np.where(shade[labels], np.float32(0), ink), dtype=np.float32)


def faint_marks(ink: NDArray[np.float32], line_px: float = 3.0) -> NDArray[np.bool_]:
    """The (h, w) mask of thin lines, also pale ones: what stands out from both of its sides.

    White top-hat above four times the noise; for the thin lines of door leaves and arcs, where
    a wall's blurred edge does not matter.
    """
    reach = 2 * round(1.5 * line_px) + 3
    stands_out = cv2.morphologyEx(ink, cv2.MORPH_TOPHAT, np.ones((reach, reach), np.uint8))
    # What half of the sheet stands out by, which is paper, is its grain.
    grain = 2 * float(np.median(stands_out[::3, ::3]))
    least = float(np.clip(max(4 * _noise(ink), grain), 0.05, LEAST_CONTRAST))
    return np.asarray(stands_out > least, dtype=np.bool_) | marks(ink, line_px)


def line_width(mask: NDArray[np.bool_]) -> float:
    """The usual width of thin lines: the commonest short run of ink, along rows and columns."""
    counts = np.zeros(40)
    for grid in (mask, mask.T):
        edges = np.diff(np.pad(grid.astype(np.int8), ((0, 0), (1, 1))), axis=1)
        starts, ends = np.nonzero(edges == 1)[1], np.nonzero(edges == -1)[1]
        counts += np.bincount(np.minimum(ends - starts, 39), minlength=40)[:40]
    counts[[0, 39]] = 0
    smooth = counts + 0.5 * (np.roll(counts, 1) + np.roll(counts, -1))
    smooth[[0, 39]] = 0
    # Walls may be as common as lines: the thinnest common width is that of lines.
    rising = (smooth >= np.roll(smooth, 1)) & (smooth >= np.roll(smooth, -1))
    best = int(np.argmax(rising & (smooth >= COMMON * smooth.max())))
    near = np.arange(max(1, best - 1), min(39, best + 2))
    total = counts[near].sum()
    return float((near * counts[near]).sum() / total) if total else 1.0


def _paper(pixels: NDArray[np.uint8]) -> NDArray[np.float32]:
    """(h, w, 3) brightness of the paper under the ink."""
    height, width = pixels.shape[:2]
    shrink = min(1.0, LIGHT_SIDE_PX / max(height, width))
    size = (max(2, round(width * shrink)), max(2, round(height * shrink)))
    small = cv2.resize(pixels, size, interpolation=cv2.INTER_AREA)
    reach = 2 * round(max(size) * LIGHT_REACH / 2) + 1
    disc = cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (reach, reach))
    closed = cv2.morphologyEx(small, cv2.MORPH_CLOSE, disc, borderType=cv2.BORDER_REPLICATE)
    smooth = cv2.GaussianBlur(closed, (0, 0), reach / 4, borderType=cv2.BORDER_REPLICATE)
    return np.asarray(
        cv2.resize(smooth, (width, height), interpolation=cv2.INTER_LINEAR), np.float32
    )


def _noise(dark: NDArray[np.float32]) -> float:
    """Standard deviation of the noise (Immerkaer 1996); by the median, as lines are no noise."""
    kernel = np.array([[1, -2, 1], [-2, 4, -2], [1, -2, 1]], dtype=np.float32)
    return float(np.median(np.abs(cv2.filter2D(dark, -1, kernel))) / (6 * 0.6745))
