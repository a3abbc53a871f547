"""A vector drawing laid out as a sheet at a known scale: walls solid, all else in thin lines."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray
from shapely.geometry import LineString, MultiPolygon, Polygon
from shapely.geometry.base import BaseGeometry

from veduta.plan.document import Text
from veduta.plan.drawn import Cleaned
from veduta.plan.vector.entities import Entities, Points, Stroke, Word
from veduta.plan.vector.faces import NEAR_M, Walls, bounds_of
from veduta.plan.vector.layers import OPENINGS

PX_PER_M = 110.0
SIDE_PX = (900, 2600)
"""Least and most of the longer side, as scans are read."""
MARGIN_M = 1.0
FINE = 4
LINE_PX = 2.0
_SHIFT = 4
"""Of OpenCV's fixed point numbers."""
_ALONE = ("wall", *OPENINGS, "stairs", "other")
"""What is drawn where layers tell the walls; things are drawn, too, where they do not."""


@dataclass(frozen=True)
class VectorSheet:
    """The picture; `px_from_units` (3, 3) takes drawing units to its pixels; texts are in them.

    `solid` (h, w) is where walls are.
    """

    cleaned: Cleaned
    texts: tuple[Text, ...]
    px_from_units: NDArray[np.float64]
    solid: NDArray[np.bool_]

    @property
    def px_per_unit(self) -> float:
        """Pixels of a drawing unit."""
        return float(self.px_from_units[0, 0])


def lay_out(found: Entities, walls: Walls, unit_m: float) -> VectorSheet:
    """Draw the sheet. Grey levels are those of anti-aliased lines, as a scan would have."""
    low, high = bounds_of(found)
    margin = MARGIN_M / unit_m
    low, high = low - margin, high + margin
    long_m = float((high - low).max()) * unit_m
    scale = float(np.clip(PX_PER_M, SIDE_PX[0] / long_m, SIDE_PX[1] / long_m)) * unit_m
    width, height = (int(one) for one in np.ceil((high - low) * scale))
    px_from_units = np.array([[scale, 0, -low[0] * scale], [0, -scale, high[1] * scale], [0, 0, 1]])
    canvas = _Canvas((height, width), px_from_units)
    canvas.fill(walls.solid)
    solid = canvas.ink() > np.float32(0.5)
    for role, rings in found.filled:
        if role in _ALONE and role != "wall":
            canvas.fill(Polygon(rings[0]).buffer(0.0))
    around = walls.solid.buffer(2.0 * NEAR_M / unit_m)
    for stroke in found.strokes:
        if _is_shown(stroke, walls):
            canvas.line(stroke, around if stroke.role == "wall" else None)
    ink = canvas.ink()
    grey = np.uint8(255) - np.round(255 * ink).astype(np.uint8)
    texts = tuple(_text(word, px_from_units) for word in found.words)
    cleaned = Cleaned(
        pixels=np.repeat(grey[..., None], 3, axis=2),
        ink=ink,
        clean_from_scan=px_from_units,
        mirrored=False,
        rotation_rad=0.0,
        line_px=LINE_PX,
    )
    return VectorSheet(cleaned, texts, px_from_units, solid)


def _is_shown(stroke: Stroke, walls: Walls) -> bool:
    return stroke.role in _ALONE or (stroke.role == "thing" and not walls.by_name)


def _text(word: Word, px_from_units: NDArray[np.float64]) -> Text:
    corners = word.box @ px_from_units[:2, :2].T + px_from_units[:2, 2]
    return Text(text=word.text, box_px=[(float(x), float(y)) for x, y in corners], score=1.0)


class _Canvas:
    """Ink at FINE times the resolution."""

    def __init__(self, size: tuple[int, int], px_from_units: NDArray[np.float64]) -> None:
        self.size, self.matrix = size, px_from_units
        self.grid = np.zeros((size[0] * FINE, size[1] * FINE), np.uint8)

    def _fixed(self, points: Points) -> NDArray[np.int32]:
        px = points @ self.matrix[:2, :2].T + self.matrix[:2, 2]
        # OpenCV puts the centre of the upper left pixel at (0, 0); far strays are cut by it.
        limit = 2**26 / (1 << _SHIFT)
        fine = np.clip(px * FINE - 0.5, -limit, limit)
        return np.round(fine * (1 << _SHIFT)).astype(np.int32)

    def fill(self, shape: BaseGeometry) -> None:
        parts = shape.geoms if isinstance(shape, MultiPolygon) else [shape]
        for part in parts:
            if isinstance(part, Polygon) and not part.is_empty:
                rings = [part.exterior, *part.interiors]
                fixed = [self._fixed(np.array(ring.coords)) for ring in rings]
                cv2.fillPoly(self.grid, fixed, 255, cv2.LINE_8, _SHIFT)

    def line(self, stroke: Stroke, hidden: BaseGeometry | None) -> None:
        shape: BaseGeometry = LineString(stroke.points)
        if hidden is not None:
            shape = shape.difference(hidden)
        wide = max(round(LINE_PX * FINE), round(stroke.width * self.matrix[0, 0] * FINE))
        for part in getattr(shape, "geoms", [shape]):
            if not part.is_empty:
                fixed = self._fixed(np.array(part.coords))
                cv2.polylines(self.grid, [fixed], False, 255, wide, cv2.LINE_8, _SHIFT)

    def ink(self) -> NDArray[np.float32]:
        height, width = self.size
        small = cv2.resize(self.grid, (width, height), interpolation=cv2.INTER_AREA)
        return np.asarray(small, dtype=np.float32) / np.float32(255)
