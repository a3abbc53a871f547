"""Sides and areas that are printed in rooms, each measured as well as the sheet allows.

A scale is known by about: it tells which side is which, how a text is to be read, and what is not
the room's at all.
"""

from __future__ import annotations

import itertools
import math
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from shapely.geometry import Polygon

from veduta.plan.document import Text
from veduta.plan.scale.clear_spans import Span, clear_sides, thin_wall
from veduta.plan.scale.free_runs import free_spans
from veduta.plan.scale.printed import laid_level, printed_in, room_polygon
from veduta.plan.scale.quantities import Quantity
from veduta.plan.scale.sharpen import Reading

_CLEAR_PX, _OUTLINE_PX = 0.4, 1.5  # errors of sides between bare faces, and of outlines
_FLOOR = 0.002  # no sheet is drawn more truly than this
_NEAR, _NEAR_PX = 0.04, 8.0  # a side is the printed one if it is so near, as a share or in pixels
_LEAST_TRUST = 0.3


@dataclass(frozen=True)
class _Measured:
    """A room in pixels: its area by its outline, its sides by that and between bare faces."""

    area: float
    sides: tuple[float, float]
    clear: tuple[float | None, float | None]


def side_readings(
    texts: Sequence[Text],
    rooms_px: Sequence[NDArray[np.float64]],
    walls_px: Sequence[float],
    masks: Sequence[NDArray[np.uint8]],
    ink: NDArray[np.float32],
    metres_per_px: float,
) -> list[Reading]:
    """What sizes and areas in rooms say, of what agrees with `metres_per_px` about.

    `rooms_px` are outlines (n, 2), `walls_px` thicknesses, `masks` (h, w) those of walls
    (`free_runs`), `ink` (h, w) is 0 to 1; texts are in its pixels. What does not fit the outline
    around it is measured by the free paper around it.
    """
    rooms = [room_polygon(outline) for outline in rooms_px]
    thin_px = thin_wall(walls_px)
    told = printed_in(texts, rooms)
    areas = Counter(one.room for one in told if one.areas)
    measured: dict[int, _Measured] = {}
    found: list[Reading] = []
    for one in told:
        best: list[Reading] = []
        if one.room is not None:
            if one.room not in measured:
                measured[one.room] = _measured(rooms[one.room], ink, thin_px)
            # Several areas in a room are those of its parts.
            fit = [said for said in one.quantities if said.kind != "area" or areas[one.room] == 1]
            best = _best(_readings(said, measured[one.room], metres_per_px) for said in fit)
        sizes = [said for said in one.quantities if said.kind == "size"]
        if sizes and len(best) < 2:
            spans = free_spans(masks, one.text)
            best = max(best, _of_free_paper(sizes, spans, ink, thin_px, metres_per_px), key=len)
        found += best
    return found


def _measured(room: Polygon, ink: NDArray[np.float32], thin_px: float) -> _Measured:
    turn, straight = laid_level(room)
    left, top, right, bottom = straight.bounds
    span = Span(turn, np.array([left, top]), np.array([right, bottom]))
    return replace(_between(span, ink, thin_px), area=float(room.area))


def _between(span: Span, ink: NDArray[np.float32], thin_px: float) -> _Measured:
    along, across = span.sides
    return _Measured(along * across, span.sides, clear_sides(ink, span, thin_px))


def _of_free_paper(
    sizes: Sequence[Quantity],
    spans: tuple[Sequence[tuple[float, float]], Sequence[tuple[float, float]]],
    ink: NDArray[np.float32],
    thin_px: float,
    metres_per_px: float,
) -> list[Reading]:
    """Of the rectangles of free paper around a text, what that which is most like its size says."""
    rectangles = [
        Span(0.0, np.array([x[0], y[0]]), np.array([x[1], y[1]]))
        for x, y in itertools.product(*spans)
    ]
    if not rectangles:
        return []
    ways = []
    for size in sizes:
        likest = min(rectangles, key=lambda one: _unlike(size, one.sides, metres_per_px))
        ways.append(_readings(size, _between(likest, ink, thin_px), metres_per_px))
    return _best(ways)


def _unlike(size: Quantity, sides: tuple[float, float], metres_per_px: float) -> float:
    """By how much both sides together are not those of a size; one that is not at all is enough."""
    ratios = np.log(_turned(size, sides, metres_per_px) / metres_per_px / sides)
    return float(np.minimum(np.abs(ratios), _NEAR).sum())


def _turned(
    size: Quantity, sides: tuple[float, float], metres_per_px: float
) -> NDArray[np.float64]:
    """The two sides of a size in the order of those in pixels."""
    metres = np.array(size.values)
    ways = (metres, metres[::-1])
    return min(ways, key=lambda way: float(np.abs(way / metres_per_px - sides).sum()))


def _best(ways: Iterable[Iterable[Reading]]) -> list[Reading]:
    """Of the ways to understand a text, that of which most fits."""
    return max(map(list, ways), key=lambda way: sum(one.trust for one in way), default=[])


def _readings(said: Quantity, room: _Measured, metres_per_px: float) -> Iterator[Reading]:
    """What a size or an area says, for as much of it as can be the room's."""
    if said.trust < _LEAST_TRUST or said.kind not in {"size", "area"}:
        return
    if said.kind == "area":
        found = [_of_area(said, room)]
    else:
        metres = _turned(said, room.sides, metres_per_px).tolist()
        found = [
            _reading(printed, bare or outline, _error(bare), said.step, said.trust)
            for printed, outline, bare in zip(metres, room.sides, room.clear, strict=True)
        ]
    for one in found:
        away = abs(math.exp(one.log_mpp) / metres_per_px - 1.0)
        if away <= max(_NEAR, _NEAR_PX * one.per_px):
            yield one


def _of_area(said: Quantity, room: _Measured) -> Reading:
    """An area as the side of a square."""
    metres, pixels = math.sqrt(said.values[0]), math.sqrt(room.area)
    along, across = room.clear
    if along is not None and across is not None:
        pixels *= math.sqrt(along * across / (room.sides[0] * room.sides[1]))
    # Each of both sides counts by half, and so does what an area is rounded to.
    error = math.hypot(_error(along), _error(across)) / 2.0
    return _reading(metres, pixels, error, said.step / (2.0 * metres), said.trust)


def _error(bare: float | None) -> float:
    return _OUTLINE_PX if bare is None else _CLEAR_PX


def _reading(metres: float, pixels: float, error_px: float, step_m: float, trust: float) -> Reading:
    # What is rounded to a step has a standard deviation of step / sqrt(12).
    sigma = math.hypot(error_px / pixels, step_m / metres / math.sqrt(12.0), _FLOOR)
    return Reading(math.log(metres / pixels), sigma, trust, 1.0 / pixels)
