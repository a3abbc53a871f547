"""Where to look on the way: ahead, into the room that one enters, around in it, at the house.

Yaw: radians from +x of the plan frame, counter-clockwise; pitch: up is positive.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray
from shapely.geometry import LineString, Point, Polygon

from veduta.plan.tour.smooth import lengths_along

AHEAD_M = 1.6
"""One looks to where one will be after so much of the way."""
INTO_M = 2.5
"""So far before the end of the way one begins to look to the middle of the room."""
NEAR_M = 0.5
"""A middle that is nearer than this has no direction."""
LEVEL_RAD = math.radians(-4.0)
"""Inside one looks down a little, to the floor and the furniture."""
HOUSE_RAD = math.radians(3.0)
TO_HOUSE = 0.75
"""Outside: how much one looks to the house, the rest ahead."""
LONG_WAY_RAD = math.radians(270.0)
"""One turns by no more than this to see the larger part of a room."""
ASIDE_RAD = math.radians(100.0)
"""Who goes straight on looks to the side by so much first."""
STRAIGHT_RAD = math.radians(60.0)
_RAYS = 48
_FAR_M = 30.0


def walking(points_m: NDArray[np.float64], middle_m: NDArray[np.float64] | None) -> (
    tuple[NDArray[np.float64], NDArray[np.float64]]
):  # fmt: skip
    """(n,) yaw and pitch along a way (n, 3) of the feet into a room with this middle (2,)."""
    along = lengths_along(points_m)
    target = np.stack(
        [np.interp(np.minimum(along + AHEAD_M, along[-1]), along, column) for column in points_m.T],
        axis=1,
    )
    course = _last_course(points_m, target - points_m)
    pitch = np.arctan2(course[:, 2], np.linalg.norm(course[:, :2], axis=1)) * 0.6 + LEVEL_RAD
    look = course[:, :2] / np.maximum(np.linalg.norm(course[:, :2], axis=1), 1e-9)[:, None]
    if middle_m is not None:
        to_middle = middle_m - points_m[:, :2]
        away = np.linalg.norm(to_middle, axis=1)
        share = _smooth_step(1.0 - (along[-1] - along) / INTO_M) * _smooth_step(away / NEAR_M - 1.0)
        look = look + share[:, None] * (to_middle / np.maximum(away, 1e-9)[:, None] - look)
    return np.unwrap(np.arctan2(look[:, 1], look[:, 0])), pitch


def around(
    ring_m: NDArray[np.float64], centre_m: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """(n,) yaw and pitch on the way (n, 3) around a house: to it, and ahead a little."""
    course = np.gradient(ring_m[:, :2], axis=0)
    course /= np.maximum(np.linalg.norm(course, axis=1), 1e-9)[:, None]
    inward = centre_m - ring_m[:, :2]
    inward /= np.maximum(np.linalg.norm(inward, axis=1), 1e-9)[:, None]
    look = TO_HOUSE * inward + (1.0 - TO_HOUSE) * course
    return np.unwrap(np.arctan2(look[:, 1], look[:, 0])), np.full(len(ring_m), HOUSE_RAD)


def turn(
    at_m: NDArray[np.float64], shape: Polygon, arrive_rad: float, leave_rad: float
) -> list[float]:
    """The yaws to turn through at a stop, from one to the next: over where most of the room is."""
    left = (leave_rad - arrive_rad) % (2.0 * math.pi)
    short = left if left <= math.pi else left - 2.0 * math.pi
    depths = depths_of(at_m, shape)
    on_left, on_right = (
        _depth(depths, arrive_rad, ASIDE_RAD),
        _depth(depths, arrive_rad, -ASIDE_RAD),
    )
    side = 1.0 if on_left >= on_right else -1.0
    if abs(short) < STRAIGHT_RAD:
        return [arrive_rad, arrive_rad + side * ASIDE_RAD, arrive_rad + short]
    wished = short if short * side > 0.0 else short + side * 2.0 * math.pi
    chosen = wished if abs(wished) <= LONG_WAY_RAD else short
    return [arrive_rad, arrive_rad + chosen]


def depths_of(at_m: NDArray[np.float64], shape: Polygon) -> NDArray[np.float64]:
    """(k,) how far one sees in a room, in k directions from +x on, counter-clockwise."""
    angles = 2.0 * math.pi * np.arange(_RAYS) / _RAYS
    ends = at_m + _FAR_M * np.stack([np.cos(angles), np.sin(angles)], axis=1)
    point = Point(at_m)
    found = []
    for end in ends:
        seen = shape.intersection(LineString([at_m, end]))
        parts = [part for part in getattr(seen, "geoms", [seen]) if part.distance(point) < 1e-6]
        found.append(sum(part.length for part in parts))
    return np.array(found)


def _depth(depths: NDArray[np.float64], start_rad: float, span_rad: float) -> float:
    """The mean area that is seen over a span of directions."""
    angles = start_rad + np.linspace(0.0, span_rad, 13)
    rows = np.round(angles / (2.0 * math.pi) * len(depths)).astype(int) % len(depths)
    return float((depths[rows] ** 2).mean())


def _last_course(points_m: NDArray[np.float64], course: NDArray[np.float64]) -> NDArray[np.float64]:
    """Directions with those at the end, where there is nothing ahead, as the one before them."""
    size = np.linalg.norm(course[:, :2], axis=1)
    known = np.flatnonzero(size > 0.3)
    if len(known) == 0:
        return np.broadcast_to(points_m[-1] - points_m[0], course.shape).copy()
    last = np.interp(np.arange(len(course)), known, np.arange(len(known))).astype(int)
    kept: NDArray[np.float64] = course[known[last]]
    return kept


def _smooth_step(share: NDArray[np.float64]) -> NDArray[np.float64]:
    bounded = np.clip(share, 0.0, 1.0)
    smooth: NDArray[np.float64] = bounded * bounded * (3.0 - 2.0 * bounded)
    return smooth
