"""Ink along lines of any direction: what the finders of treads ask of a sheet. Pixels, y down."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

Spot = NDArray[np.float64]
INKED = 0.6
"""A line of treads has this share of its length inked, at least: an arrow or a word hides some."""
_ENDS = 0.08
CROSSED = 1.5
"""What is no longer than so many line widths is a line that is met and does not go on."""
BEYOND = 1.5
"""Nor does what is no longer than so many times the gap before it: a closet behind the wall."""


@dataclass(frozen=True)
class Probe:
    """A sheet's ink. near: (h, w) float32, 1 within a pixel of ink. solid: (h, w) filled walls.

    line_px: width of thin lines. extent_px: the longer side of all that is drawn.
    """

    near: NDArray[np.float32]
    solid: NDArray[np.float32]
    line_px: float
    extent_px: float

    def at(self, places: NDArray[np.float64]) -> NDArray[np.float32]:
        """(...,) whether there is ink at (..., 2) places."""
        return _sampled(self.near, places)

    def is_wall(self, places: NDArray[np.float64]) -> NDArray[np.float32]:
        """(...,) whether (..., 2) places lie in a filled wall."""
        return _sampled(self.solid, places)

    def inked(self, first: Spot, last: Spot) -> NDArray[np.float64]:
        """(n,) the inked share of lines between (n, 2) ends, but for a little at the ends."""
        length = float(np.hypot(*(last - first).T).max())
        share = np.linspace(_ENDS, 1.0 - _ENDS, max(4, int(length)))
        places = first[:, None] + share[None, :, None] * (last - first)[:, None]
        return np.asarray(self.at(places).mean(axis=1), np.float64)

    def reach(self, start: Spot, way: Spot, most_px: float, gap_px: float) -> float:
        """How far a line goes on from a place, over gaps for an arrow, until it ends at a wall.

        Of a wall that is drawn as two lines, the second one does not belong to it.
        """
        at = np.arange(0.0, most_px, 1.0)
        places = start + at[:, None] * way
        inked = np.flatnonzero(self.at(places) > 0)
        walled = np.flatnonzero(self.is_wall(places) > 0)
        if len(walled):
            inked = inked[inked < walled[0]]
        if not len(inked):
            return 0.0
        broken = np.flatnonzero(np.diff(inked) > gap_px)
        inked = inked[: broken[0] + 1] if len(broken) else inked
        runs = np.split(inked, np.flatnonzero(np.diff(inked) > 1) + 1)
        crossed = CROSSED * self.line_px + 3.0
        while len(runs) > 1:
            gap = float(runs[-1][0] - runs[-2][-1])
            if len(runs[-1]) > max(crossed, BEYOND * gap):
                break
            runs.pop()
        return float(runs[-1][-1])

    def lines_beside(
        self, ends: tuple[Spot, Spot], way: Spot, tread_px: tuple[float, float], most: int
    ) -> list[float]:
        """How far away lines lie that follow one between two ends, evenly, on one side of it.

        tread_px: the least and the most of the first distance; further ones are as the first.
        """
        least, greatest = tread_px
        at = np.arange(0.0, greatest * (most + 1), 1.0)
        first, last = (end + at[:, None] * way for end in ends)
        peaks = _peaks(self.inked(first, last) >= INKED, 2.0 * self.line_px + 5.0)
        found: list[float] = []
        while len(found) < most:
            here = found[-1] if found else 0.0
            usual = found[-1] / len(found) if found else 0.0
            low, high = (0.8 * usual - 1.0, 1.2 * usual + 1.0) if found else (least, greatest)
            near = [peak for peak in peaks if low <= peak - here <= high]
            if not near:
                break
            found.append(near[0])
        return found


def probe_of(ink: NDArray[np.bool_], line_px: float, extent_px: float) -> Probe:
    """Of an (h, w) mask of ink."""
    mask = ink.astype(np.uint8)
    thick = 2 * round(0.5 * (2.2 * line_px + 3.0)) + 1
    solid = cv2.morphologyEx(mask, cv2.MORPH_OPEN, np.ones((thick, thick), np.uint8))
    near = cv2.dilate(mask, np.ones((3, 3), np.uint8))
    return Probe(near.astype(np.float32), solid.astype(np.float32), line_px, extent_px)


def _peaks(values: NDArray[np.bool_], widest: float) -> list[float]:
    """The middles of runs that are not too wide."""
    edges = np.diff(np.pad(values.astype(np.int8), 1))
    starts, ends = np.flatnonzero(edges == 1), np.flatnonzero(edges == -1)
    return [
        float(start + end - 1) / 2.0
        for start, end in zip(starts, ends, strict=True)
        if end - start <= widest
    ]


def _sampled(image: NDArray[np.float32], places: NDArray[np.float64]) -> NDArray[np.float32]:
    """The pixels that places lie in; 0 outside."""
    columns = np.floor(places[..., 0]).astype(np.int64)
    rows = np.floor(places[..., 1]).astype(np.int64)
    height, width = image.shape
    inside = (columns >= 0) & (rows >= 0) & (columns < width) & (rows < height)
    found = image[np.clip(rows, 0, height - 1), np.clip(columns, 0, width - 1)]
    return np.asarray(np.where(inside, found, 0.0), np.float32)
