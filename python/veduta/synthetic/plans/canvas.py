"""A sheet of paper in metres of the house, drawn into with smooth edges."""

from __future__ import annotations

import math
from collections.abc import Sequence

import cv2
import numpy as np
from numpy.typing import ArrayLike, NDArray
from shapely.geometry import MultiPolygon, Polygon
from shapely.geometry.base import BaseGeometry

FINE = 2
SHIFT = 4
EDGE = 0.69
"""What OpenCV fills with soft edges reaches so many (fine) pixels farther than it is told."""
Colour = tuple[int, int, int]
Image = NDArray[np.uint8]
FontName = str
BLACK: Colour = (0, 0, 0)


class Canvas:
    """Draws in the plan frame (metres, y up) at `FINE` times the resolution that it gives back.

    Args:
        bounds_m: left, bottom, right and top of the sheet.
        metres_per_px: of the picture.
        paper: sRGB.
    """

    def __init__(
        self, bounds_m: tuple[float, float, float, float], metres_per_px: float, paper: Colour
    ) -> None:
        left, bottom, right, top = bounds_m
        self.left_m, self.top_m = left, top
        self.metres_per_px = metres_per_px
        self.width_px = math.ceil((right - left) / metres_per_px)
        self.height_px = math.ceil((top - bottom) / metres_per_px)
        self.pixels: Image = np.full(
            (self.height_px * FINE, self.width_px * FINE, 3), paper, np.uint8
        )

    @property
    def px_from_m(self) -> NDArray[np.float64]:
        """The affine (3, 3) from metres to pixels of the picture."""
        scale = 1.0 / self.metres_per_px
        return np.array(
            [[scale, 0.0, -self.left_m * scale], [0.0, -scale, self.top_m * scale], [0, 0, 1.0]]
        )

    def _fixed(self, points: ArrayLike) -> NDArray[np.int32]:
        """Points (n, 2) in metres as OpenCV's fixed-point pixels, whose centres are integers."""
        metres = np.atleast_2d(np.asarray(points, float))
        scale = FINE / self.metres_per_px
        px = np.column_stack([metres[:, 0] - self.left_m, self.top_m - metres[:, 1]]) * scale - 0.5
        return np.asarray(np.round(px * 2**SHIFT), np.int32)

    def _pen(self, width_px: float) -> int:
        return max(1, round(width_px * FINE))

    def line(
        self, points: ArrayLike, width_px: float = 1.0, colour: Colour = BLACK, closed: bool = False
    ) -> None:
        """A polyline of a pen so many pixels wide."""
        cv2.polylines(
            self.pixels,
            [self._fixed(points)],
            closed,
            colour,
            self._pen(width_px),
            cv2.LINE_AA,
            SHIFT,
        )

    def dashed(
        self, start: ArrayLike, end: ArrayLike, width_px: float = 1.0, colour: Colour = BLACK
    ) -> None:
        """A dashed straight line; dashes of 12 cm."""
        a, b = np.asarray(start, float), np.asarray(end, float)
        count = max(1, round(float(np.hypot(*(b - a))) / 0.24))
        for index in range(count):
            low, high = index / count, (index + 0.5) / count
            self.line([a + low * (b - a), a + high * (b - a)], width_px, colour)

    def fill(self, area: BaseGeometry, colour: Colour) -> None:
        """Polygons with holes, filled."""
        if not area.is_empty:
            cv2.fillPoly(self.pixels, self._inner(area), colour, cv2.LINE_AA, SHIFT)

    def outline(self, area: BaseGeometry, width_px: float, colour: Colour = BLACK) -> None:
        """The rings of polygons."""
        for ring in self._rings(area):
            cv2.polylines(
                self.pixels, [ring], True, colour, self._pen(width_px), cv2.LINE_AA, SHIFT
            )

    def hatch(
        self,
        area: BaseGeometry,
        gap_m: float,
        width_px: float,
        colour: Colour,
        crossed: bool = False,
    ) -> None:
        """Lines at 45 degrees within polygons."""
        mask = np.zeros(self.pixels.shape[:2], np.uint8)
        cv2.fillPoly(mask, self._inner(area), 255, cv2.LINE_AA, SHIFT)
        lines = self.pixels.copy()
        height, width = self.pixels.shape[:2]
        gap = gap_m * FINE / self.metres_per_px * math.sqrt(2.0)
        for offset in np.arange(-height, width + height, gap):
            low = round(float(offset))
            pen = self._pen(width_px)
            cv2.line(lines, (low, height), (low + height, 0), colour, pen, cv2.LINE_AA)
            if crossed:
                cv2.line(lines, (low - height, 0), (low, height), colour, pen, cv2.LINE_AA)
        inside = mask > 0
        share = mask[inside][:, None].astype(np.float32) / 255.0
        mixed = share * lines[inside] + (1 - share) * self.pixels[inside]
        self.pixels[inside] = np.round(mixed).astype(np.uint8)

    def _inner(self, area: BaseGeometry) -> list[NDArray[np.int32]]:
        """The rings between which polygons are filled, so that they cover as much as they are."""
        inner = area.buffer(-EDGE * self.metres_per_px / FINE, join_style="mitre")
        return self._rings(area if inner.is_empty else inner)

    def _rings(self, area: BaseGeometry) -> list[NDArray[np.int32]]:
        parts: Sequence[BaseGeometry] = (
            [area] if isinstance(area, Polygon) else list(getattr(area, "geoms", []))
        )
        rings = []
        for part in parts:
            if isinstance(part, MultiPolygon):
                rings += self._rings(part)
            if isinstance(part, Polygon):
                rings += [self._fixed(ring.coords) for ring in (part.exterior, *part.interiors)]
        return rings

    def text(
        self,
        text: str,
        centre_m: tuple[float, float],
        height_px: float,
        font: FontName = "sans",
        colour: Colour = BLACK,
        weight: int = 400,
        upright: bool = True,
    ) -> None:
        """A line of text about a point; turned to read from the right where not upright."""
        face = cv2.FontFace(font)
        size = round(height_px * FINE)
        wide, high = text_size_px(text, height_px, font, weight)
        pad = size
        patch = np.full(
            (round(high * FINE) + 2 * pad, round(wide * FINE) + 2 * pad, 3), 255, np.uint8
        )
        cv2.putText(patch, text, (pad, pad + round(size * 0.8)), (0, 0, 0), face, size, weight)
        if not upright:
            patch = np.rot90(patch).copy()
        x, y = (round(value / 2**SHIFT) for value in self._fixed([centre_m])[0].tolist())
        self._stamp(patch, x - patch.shape[1] // 2, y - patch.shape[0] // 2, colour)

    def _stamp(self, patch: Image, left: int, top: int, colour: Colour) -> None:
        """Ink of a black-on-white patch laid onto the sheet; what sticks out is cut."""
        height, width = self.pixels.shape[:2]
        x0, y0, x1, y1 = (
            max(left, 0),
            max(top, 0),
            min(left + patch.shape[1], width),
            min(top + patch.shape[0], height),
        )
        if x1 <= x0 or y1 <= y0:
            return
        ink = 1.0 - patch[y0 - top : y1 - top, x0 - left : x1 - left].astype(np.float32) / 255.0
        under = self.pixels[y0:y1, x0:x1]
        under[:] = np.round(ink * np.array(colour, np.float32) + (1 - ink) * under).astype(np.uint8)

    def picture(self) -> Image:
        """The sheet at its resolution, sRGB (height, width, 3)."""
        size = (self.width_px, self.height_px)
        return np.asarray(cv2.resize(self.pixels, size, interpolation=cv2.INTER_AREA), np.uint8)


def text_size_px(
    text: str, height_px: float, font: FontName = "sans", weight: int = 400
) -> tuple[float, float]:
    """How wide and high a line of text is."""
    size = max(1, round(height_px * FINE))
    box = cv2.getTextSize((0, 0), text, (0, 0), cv2.FontFace(font), size, weight)
    return float(box[2]) / FINE, float(size) / FINE
