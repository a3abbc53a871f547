"""Contour rectangles of a photo: areas that contours enclose and that have four corners.

AV3D, "Texture Extraction" (its figures 9 and 22): the Sobel operator, then rectangles. A strong
contour needs another threshold than a weak one; where the paper has one of them, here each area
may be closed by contours of its own strength.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

Pixels = NDArray[np.uint8]

LEVELS = (1.6, 2.5, 4.0, 7.0, 12.0, 20.0, 34.0)
"""Strengths of contours (CIELAB steps per pixel, of 8-bit channels) that are tried."""
SHORTEST_PX = 7.0
"""A side of a rectangle is no shorter."""
LARGEST = 0.2
"""A rectangle is at most this share of the photo."""
FILLED = 0.86
"""An area that is a rectangle fills its four corners at least this far."""
_EDGE_PX = 1.5
_WIDER = 1.6
_MOVED = 0.1
"""A rectangle within sharper contours is at most so much larger, and its middle stays."""
_CORNER = 0.035
"""How far a side may bend, as a share of the way round."""


@dataclass(frozen=True)
class Rectangles:
    """corners_px: (n, 4, 2), clockwise as seen, from the upper left. area_px: (n,)."""

    corners_px: NDArray[np.float64]
    area_px: NDArray[np.float64]

    def __len__(self) -> int:
        return len(self.corners_px)

    @property
    def middles_px(self) -> NDArray[np.float64]:
        """(n, 2) the means of their corners."""
        middles: NDArray[np.float64] = self.corners_px.mean(axis=1)
        return middles


def contour_strength(pixels: Pixels) -> NDArray[np.float32]:
    """(h, w) the strongest Sobel gradient of lightness and of the two colour channels."""
    lab = cv2.GaussianBlur(cv2.cvtColor(pixels, cv2.COLOR_RGB2LAB), (0, 0), 0.8)
    across = cv2.Sobel(lab, cv2.CV_32F, 1, 0, scale=0.125)
    down = cv2.Sobel(lab, cv2.CV_32F, 0, 1, scale=0.125)
    strength: NDArray[np.float32] = np.hypot(across, down).max(axis=2)
    return strength


def find_rectangles(pixels: Pixels) -> Rectangles:
    """All of them in (h, w, 3) sRGB, each once: of the strongest contours that still close it.

    Weak contours are wide, and what they enclose is smaller.
    """
    strength = contour_strength(pixels)
    found: list[NDArray[np.float64]] = []
    taken = np.zeros(strength.shape, dtype=np.int32)
    for level in LEVELS:
        for corners in _of_level(strength < level):
            number = _taken_by(taken, corners)
            if number is None:
                found.append(corners)
                cv2.fillConvexPoly(taken, corners.round().astype(np.int32), len(found))
            elif _is_same(found[number], corners):
                found[number] = corners
    quads = np.array([one for one in found if _is_whole(one, strength.shape)]).reshape(-1, 4, 2)
    return Rectangles(quads, np.array([abs(_area(corners)) for corners in quads]))


def _of_level(calm: NDArray[np.bool_]) -> list[NDArray[np.float64]]:
    """The rectangles among the areas in which there are no contours."""
    most = LARGEST * calm.size
    rings, nesting = cv2.findContours(
        calm.astype(np.uint8), cv2.RETR_CCOMP, cv2.CHAIN_APPROX_SIMPLE
    )
    outer = [] if nesting is None else np.flatnonzero(nesting[0, :, 3] < 0).tolist()
    found = []
    for number in outer:
        size = cv2.contourArea(rings[number])
        if SHORTEST_PX**2 < size < most:
            corners = _four_corners(np.asarray(rings[number], dtype=np.int32), size)
            found += [] if corners is None else [corners]
    return found


def _four_corners(ring: NDArray[np.int32], size_px: float) -> NDArray[np.float64] | None:
    """(4, 2) corners of an area that is about a rectangle, in pixels of the project."""
    hull = cv2.convexHull(ring)
    corners = cv2.approxPolyDP(hull, _CORNER * cv2.arcLength(hull, closed=True), closed=True)
    if len(corners) != 4 or not cv2.isContourConvex(corners):
        return None
    points = corners.reshape(4, 2).astype(np.float64)
    sides = np.linalg.norm(points - np.roll(points, -1, axis=0), axis=1)
    if sides.min() < SHORTEST_PX or size_px < FILLED * abs(_area(points)):
        return None
    return _ordered(_on_sides(hull.reshape(-1, 2).astype(np.float64), points)) + 0.5


def _on_sides(hull: NDArray[np.float64], corners: NDArray[np.float64]) -> NDArray[np.float64]:
    """The corners in which lines through the four sides of the hull meet: finer than its points."""
    lines = []
    for start, end in zip(corners, np.roll(corners, -1, axis=0), strict=True):
        way = end - start
        along = (hull - start) @ way / (way @ way)
        off = np.abs((hull - start) @ np.array([-way[1], way[0]])) / np.linalg.norm(way)
        near = hull[(along > 0.1) & (along < 0.9) & (off < 2.0)]
        if len(near) < 2:
            near = np.stack([start, end])
        dx, dy, x, y = cv2.fitLine(near.astype(np.float32), cv2.DIST_L2, 0, 0.01, 0.01).reshape(4)
        lines.append(np.array([-dy, dx, dy * x - dx * y]))
    met = np.cross(np.roll(lines, 1, axis=0), lines)
    if (np.abs(met[:, 2]) < 1e-6).any():
        return corners
    finer: NDArray[np.float64] = met[:, :2] / met[:, 2:]
    moved = np.linalg.norm(finer - corners, axis=1).max()
    return finer if moved < 0.5 * SHORTEST_PX else corners


def _ordered(corners: NDArray[np.float64]) -> NDArray[np.float64]:
    """Clockwise as seen (y down), beginning with the one that is most up and left."""
    ring = corners if _area(corners) > 0 else corners[::-1]
    return np.roll(ring, -int(ring.sum(axis=1).argmin()), axis=0)


def _area(ring: NDArray[np.float64] | Sequence[Sequence[float]]) -> float:
    """Signed: above zero if clockwise as seen."""
    points = np.asarray(ring)
    after = np.roll(points, -1, axis=0)
    return 0.5 * float((points[:, 0] * after[:, 1] - after[:, 0] * points[:, 1]).sum())


def _is_whole(corners: NDArray[np.float64], shape: tuple[int, ...]) -> bool:
    """Whether it is not cut off by the photo's edge."""
    size = np.array(shape)[::-1]
    return bool((corners > _EDGE_PX).all() and (corners < size - _EDGE_PX).all())


def _taken_by(taken: NDArray[np.int32], corners: NDArray[np.float64]) -> int | None:
    """The rectangle found before in which the middle lies."""
    x, y = corners.mean(axis=0).astype(int).clip(0, np.array(taken.shape)[::-1] - 1)
    return int(taken[y, x]) - 1 if taken[y, x] else None


def _is_same(before: NDArray[np.float64], after: NDArray[np.float64]) -> bool:
    """Whether it is that rectangle, seen within sharper contours; not one with its neighbour."""
    old, new = abs(_area(before)), abs(_area(after))
    moved = float(np.linalg.norm(after.mean(axis=0) - before.mean(axis=0)))
    return old <= new <= _WIDER * old and moved <= _MOVED * old**0.5
