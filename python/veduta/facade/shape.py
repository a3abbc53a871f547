"""Shapes of elements that are no rectangles: their corners, and the cuts that make them.

A rule file cuts a rectangle by lines. What a shape leaves of its rectangle lies beyond such lines,
one along each of its edges that is not one of the rectangle's; so every convex shape can be cut.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import cos, degrees, hypot, radians, sin

import cv2
import numpy as np

from veduta.facade.document import Element
from veduta.facade.rectangles import Rectangle

Point = tuple[float, float]


@dataclass(frozen=True)
class ShapeParameters:
    """When an edge of a shape is a cut of its rectangle; lengths in metres.

    least_left_m, least_off_m: cuts that leave less of a shape, or take less off it, are none.
    on_side_m: edges so close to a side of the rectangle are on it. near_m, least_side_m: a shape
    closer to a side touches it, and then lies on it along this length at least. step_m, steps: by
    how much lines are moved out until that is so, and how often. head: share of the width, from the
    sides, in which an arch springs. All are a little more than the millimetre to which rules are
    rounded.
    """

    least_left_m: float = 0.05
    least_off_m: float = 0.002
    on_side_m: float = 0.005
    near_m: float = 0.004
    least_side_m: float = 0.02
    step_m: float = 0.006
    steps: int = 6
    head: float = 0.02


_OWN = ShapeParameters()


@dataclass(frozen=True)
class Cut:
    """What lies far out in a direction is cut off.

    turn_deg: the direction, counter-clockwise from that of the cut before (from x for the first).
    keep_m: what is kept, along that direction, from where the shape begins in it.
    """

    turn_deg: float
    keep_m: float


@dataclass(frozen=True)
class _HalfPlane:
    """Where cos(turn) x + sin(turn) z is at most `reach` (m)."""

    turn_deg: float
    reach: float


def corners_px(element: Element) -> list[Point]:
    """The corners of an element in order (rectified pixels); y points down."""
    if element.outline_px:
        return list(element.outline_px)
    left, top = element.x_px, element.y_px
    right, bottom = left + element.width_px, top + element.height_px
    return [(left, top), (right, top), (right, bottom), (left, bottom)]


def fitted_outline(element: Element) -> list[Point] | None:
    """The outline of an element as wide and high as its rectangle, which may have been edited.

    One that fits to a pixel stays as it is.
    """
    if not element.outline_px:
        return None
    corners = np.array(element.outline_px, dtype=np.float64)
    low, high = corners.min(axis=0), corners.max(axis=0)
    start = np.array([element.x_px, element.y_px])
    size = np.array([element.width_px, element.height_px])
    if np.abs(low - start).max() <= 1.0 and np.abs(high - start - size).max() <= 1.0:
        return element.outline_px
    moved = start + (corners - low) / np.maximum(high - low, 1e-9) * size
    return [(round(float(x), 2), round(float(y), 2)) for x, y in moved]


def head_rise_m(element: Element) -> float:
    """How far the middle of an element's head lies above its springers (m); 0 for a level head."""
    if not element.outline_px:
        return 0.0
    corners = np.array(element.outline_px, dtype=np.float64)
    near = _OWN.head * element.width_px
    sides = [corners[:, 0] < element.x_px + near]
    sides.append(corners[:, 0] > element.x_px + element.width_px - near)
    springers = [float(corners[side, 1].min()) for side in sides if side.any()]
    down = max(springers, default=element.y_px) - float(corners[:, 1].min())
    return float(max(0.0, down) * element.width_m / element.width_px)


def area_share(element: Element) -> float:
    """Which share of its rectangle an element fills."""
    if not element.outline_px:
        return 1.0
    corners = np.array(element.outline_px, dtype=np.float64)
    corners -= corners.mean(axis=0)
    x, y = corners.T
    area = 0.5 * abs(float(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1))))
    return min(1.0, area / max(element.width_px * element.height_px, 1e-9))


def cuts_of(element: Element, place: Rectangle) -> list[Cut]:
    """The cuts that make the shape of an element out of the place (m) that it has in the wall.

    A shape that is not convex is filled up to one that is. What the place has below the element
    stays whole: a door that is made to reach the ground keeps its head. A corner that would touch a
    side of the place is cut off there: walls that meet in a point do not close.
    """
    planes = _half_planes(element)
    for step in range(_OWN.steps):
        cuts, shape = _cuts(planes, place, step * _OWN.step_m)
        if _keeps_sides(shape, place):
            return cuts
    return []


def _cuts(
    planes: Sequence[_HalfPlane], place: Rectangle, further: float
) -> tuple[list[Cut], list[Point]]:
    """The cuts of these planes, each so much further out, and the shape that they leave."""
    shape: list[Point] = place.corners()
    found: list[Cut] = []
    before = 0.0
    for plane in planes:
        turn = radians(plane.turn_deg)
        along = [x * cos(turn) + z * sin(turn) for x, z in shape]
        keep = round(plane.reach + further - min(along), 3)
        if keep > max(along) - min(along) - _OWN.least_off_m or keep < _OWN.least_left_m:
            continue
        found.append(Cut(round(plane.turn_deg - before, 4), keep))
        before = round(before + found[-1].turn_deg, 4)
        shape = _clipped(shape, turn, min(along) + keep)
    return found, shape


def _keeps_sides(shape: Sequence[Point], place: Rectangle) -> bool:
    """Whether a shape has either nothing of each side of the place, or more than a touch."""
    for axis, at in ((0, place.x0), (0, place.x1), (1, place.z0), (1, place.z1)):
        on = [p[1 - axis] for p in shape if abs(p[axis] - at) < _OWN.near_m]
        if on and max(on) - min(on) < _OWN.least_side_m:
            return False
    return True


def _half_planes(element: Element) -> list[_HalfPlane]:
    """One for each edge of the convex outline that is on no side of the rectangle."""
    if not element.outline_px or len(element.outline_px) < 3:
        return []
    m = element.width_m / element.width_px
    corners = np.array(element.outline_px, dtype=np.float64)
    x = element.x_m + (corners[:, 0] - element.x_px) * m
    z = element.y_m + (element.y_px + element.height_px - corners[:, 1]) * m
    hull = cv2.convexHull(np.stack([x, z], axis=1).astype(np.float32)).reshape(-1, 2)
    points = [(float(a), float(b)) for a, b in hull]
    if _signed_area(points) < 0.0:
        points.reverse()
    sides = Rectangle(
        element.x_m,
        element.y_m,
        element.x_m + element.width_m,
        element.y_m + element.height_m,
    )
    found = []
    for (x0, z0), (x1, z1) in zip(points, points[1:] + points[:1], strict=True):
        length = hypot(x1 - x0, z1 - z0)
        if length < 1e-6 or _is_on_side((x0, z0), (x1, z1), sides):
            continue
        out_x, out_z = (z1 - z0) / length, -(x1 - x0) / length
        turn = degrees(float(np.arctan2(out_z, out_x)))
        found.append(_HalfPlane(round(turn, 4), out_x * x0 + out_z * z0))
    return found


def _is_on_side(a: Point, b: Point, sides: Rectangle) -> bool:
    near = _OWN.on_side_m
    upright = any(max(abs(a[0] - x), abs(b[0] - x)) < near for x in (sides.x0, sides.x1))
    return upright or any(max(abs(a[1] - z), abs(b[1] - z)) < near for z in (sides.z0, sides.z1))


def _signed_area(points: Sequence[Point]) -> float:
    pairs = zip(points, [*points[1:], points[0]], strict=True)
    return 0.5 * sum(x0 * z1 - x1 * z0 for (x0, z0), (x1, z1) in pairs)


def _clipped(shape: Sequence[Point], turn: float, reach: float) -> list[Point]:
    """What of a convex polygon lies within a half plane."""
    kept: list[Point] = []
    for one, other in zip(shape, [*shape[1:], shape[0]], strict=True):
        a, b = (x * cos(turn) + z * sin(turn) - reach for x, z in (one, other))
        if a <= 0.0:
            kept.append(one)
        if (a < 0.0 < b) or (b < 0.0 < a):
            t = a / (a - b)
            kept.append((one[0] + t * (other[0] - one[0]), one[1] + t * (other[1] - one[1])))
    return kept
