"""A printed board of markers: what stands where on its sheet, and the sheet to print.

The markers run round the sheet's edge, so that an object has room in the middle. World frame of a
board: origin in the middle of the sheet, x right, y up on the page, z out of it, metres.
"""

from __future__ import annotations

import time
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Literal

import cv2
import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw

Floats = NDArray[np.float64]
SheetName = Literal["a4", "a3", "letter"]
SHEETS_MM: dict[SheetName, tuple[float, float]] = {
    "a4": (210.0, 297.0),
    "a3": (297.0, 420.0),
    "letter": (215.9, 279.4),
}
MARKERS = cv2.aruco.DICT_5X5_100
_PDF_DPI = 600
_CELLS = 7
"""Of a marker of 5 x 5, with its black border."""


@dataclass(frozen=True)
class Board:
    """A sheet of markers. stretch: by what it was printed larger than it is drawn."""

    sheet: SheetName
    stretch: float = 1.0

    @property
    def size_m(self) -> tuple[float, float]:
        """Width and height of the sheet."""
        width, height = SHEETS_MM[self.sheet]
        return width * self.stretch / 1000.0, height * self.stretch / 1000.0

    @property
    def marker_m(self) -> float:
        """The side of a marker."""
        return self.size_m[0] * 26.0 / 210.0

    @cached_property
    def corners_m(self) -> Floats:
        """(m, 4, 3) of each marker by its number: upper left and right, lower right and left."""
        width, height = self.size_m
        side = self.marker_m
        inset = 12.0 / 210.0 * width + side / 2.0
        across, down = width / 2.0 - inset, height / 2.0 - inset
        columns = max(2, int(2.0 * across / (1.2 * side)) + 1)
        rows = max(2, int(2.0 * down / (1.3 * side)) + 1)
        xs, ys = np.linspace(-across, across, columns), np.linspace(down, -down, rows)
        middles = [(x, y) for y in (ys[0], ys[-1]) for x in xs]
        middles += [(x, y) for x in (xs[0], xs[-1]) for y in ys[1:-1]]
        half = side / 2.0
        ring = np.array(
            [[-half, half, 0.0], [half, half, 0.0], [half, -half, 0.0], [-half, -half, 0]]
        )
        return np.array([np.array([x, y, 0.0]) + ring for x, y in middles])

    @property
    def free_m(self) -> tuple[float, float]:
        """Width and height of the free middle."""
        inner = 2.0 * (12.0 / 210.0 * self.size_m[0] + self.marker_m)
        return self.size_m[0] - inner, self.size_m[1] - inner

    def drawn(self, dots_per_m: float) -> NDArray[np.uint8]:
        """(h, w) uint8 the sheet from above, y down."""
        width, height = self.size_m
        page = np.full((round(height * dots_per_m), round(width * dots_per_m)), 255, np.uint8)
        dictionary = cv2.aruco.getPredefinedDictionary(MARKERS)
        for number, corners in enumerate(self.corners_m):
            left, top = self._dots(corners[0], dots_per_m)
            right, low = self._dots(corners[2], dots_per_m)
            cells = cv2.aruco.generateImageMarker(dictionary, number, _CELLS)
            page[top:low, left:right] = cv2.resize(
                cells, (right - left, low - top), interpolation=cv2.INTER_NEAREST
            )
        return page

    def _dots(self, point: Floats, dots_per_m: float) -> tuple[int, int]:
        width, height = self.size_m
        x, y = point[0] + width / 2.0, height / 2.0 - point[1]
        return round(float(x) * dots_per_m), round(float(y) * dots_per_m)


def print_board(board: Board, path: Path) -> None:
    """The sheet as a PDF at its true size, with a line of 100 mm to measure."""
    dots_per_m = _PDF_DPI / 0.0254
    page = Image.fromarray(board.drawn(dots_per_m))
    pen = ImageDraw.Draw(page)
    millimetre = dots_per_m / 1000.0
    middle, low = page.width / 2.0, page.height - 5.0 * millimetre
    ends = middle - 50.0 * millimetre, middle + 50.0 * millimetre
    pen.line([(ends[0], low), (ends[1], low)], fill=0, width=round(0.3 * millimetre))
    for end in ends:
        ticks = [(end, low - 2.0 * millimetre), (end, low + 2.0 * millimetre)]
        pen.line(ticks, fill=0, width=round(0.3 * millimetre))
    words = f"{board.sheet.upper()}. Print at 100 %; this line is 100 mm long"
    pen.text((ends[0], low - 4.5 * millimetre), words, fill=0, font_size=3.0 * millimetre)
    made = time.gmtime(0)
    page.convert("1").save(
        path, "PDF", resolution=float(_PDF_DPI), creationDate=made, modDate=made, title="Markers"
    )
