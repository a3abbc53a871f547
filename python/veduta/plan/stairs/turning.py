"""Stairs that turn: fans and landings with the flights beside them, and which way they rise."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from shapely.geometry import LineString, Point, Polygon

from veduta.plan.document import Text
from veduta.plan.drawn import DrawnStairs
from veduta.plan.stairs.arrow import DOWN, UP, head_end
from veduta.plan.stairs.course import Course, course_of
from veduta.plan.stairs.fans import find_fans
from veduta.plan.stairs.landings import with_landings
from veduta.plan.stairs.probe import Probe

LEAST_TREADS = 6
MOST_TREADS = 30
INSIDE = 0.5
"""A straight flight that lies so far in stairs that turn is a part of them."""
_STRIP = 0.45
"""What is looked at on both sides of the walking line, of a flight's width."""
_NEAR = 1.2
"""A word belongs to an end of the walking line that is so near, in widths ..."""
_NEARER = 0.7
"""... and so much nearer than the other end."""


def find_turning(
    ink: NDArray[np.bool_], flights: Sequence[DrawnStairs], probe: Probe, texts: Sequence[Text]
) -> list[DrawnStairs]:
    """Stairs that turn, and those of the straight flights that are no parts of them."""
    fans = [one for fan in find_fans(ink, probe) if (one := course_of(fan, probe)) is not None]
    landed = [one for flight in flights if (one := with_landings(flight, probe)) is not None]
    kept: list[Course] = []
    for course in sorted([*fans, *landed], key=lambda one: -len(one.steps)):
        sized = LEAST_TREADS <= len(course.steps) <= MOST_TREADS and course.outline.is_valid
        if sized and not any(one.outline.intersects(course.outline.buffer(-2.0)) for one in kept):
            kept.append(course)
    rest = [flight for flight in flights if not any(_is_part(flight, one) for one in kept)]
    return [*(_drawn(course, ink, texts) for course in kept), *rest]


def _is_part(flight: DrawnStairs, course: Course) -> bool:
    shape = Polygon(flight.outline_px)
    return bool(shape.intersection(course.outline).area > INSIDE * shape.area)


def _drawn(course: Course, ink: NDArray[np.bool_], texts: Sequence[Text]) -> DrawnStairs:
    sign = _by_word(course, texts) or head_end(unrolled(course, ink), len(course.steps))
    course = course.turned() if sign < 0 else course
    way = (course.path[1] - course.path[0]) / np.hypot(*(course.path[1] - course.path[0]))
    return DrawnStairs(
        id="",
        outline_px=np.array(course.outline.exterior.coords)[:-1],
        treads=len(course.steps),
        up_px=(float(way[0]), float(way[1])) if sign else (0.0, 0.0),
        score=round(min(0.95, 0.5 + 0.03 * len(course.steps)) * course.score, 3),
        steps_px=tuple(np.array(step.exterior.coords)[:-1] for step in course.steps),
        path_px=course.path,
    )


def unrolled(course: Course, ink: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """(n, m) the ink along the walking line, a row a pixel, as if the stairs were straight."""
    line = LineString(course.path)
    along = np.arange(0.0, line.length, 1.0)
    middle = np.array([line.interpolate(at).coords[0] for at in along])
    ahead = np.gradient(middle, axis=0)
    ahead /= np.maximum(np.hypot(*ahead.T), 1e-9)[:, None]
    aside = np.arange(-_STRIP * course.width_px, _STRIP * course.width_px, 1.0)
    right = np.stack([-ahead[:, 1], ahead[:, 0]], axis=1)
    places = middle[:, None] + aside[None, :, None] * right[:, None]
    columns, rows = np.floor(places).astype(np.int64).transpose(2, 0, 1)
    height, width = ink.shape
    inside = (columns >= 0) & (rows >= 0) & (columns < width) & (rows < height)
    return np.asarray(inside & ink[np.clip(rows, 0, height - 1), np.clip(columns, 0, width - 1)])


def _by_word(course: Course, texts: Sequence[Text]) -> int:
    """1 where a word says that the walking line rises, -1 where it falls, 0 where there is none."""
    start, end = (Point(*course.path[number]) for number in (0, -1))
    for text in texts:
        at = Point(*np.mean(text.box_px, axis=0))
        near = min(at.distance(start), at.distance(end))
        far = max(at.distance(start), at.distance(end))
        if near > _NEAR * course.width_px or near > _NEARER * far:
            continue
        first = at.distance(start) < at.distance(end)
        if UP.match(text.text):
            return 1 if first else -1
        if DOWN.match(text.text):
            return -1 if first else 1
    return 0
