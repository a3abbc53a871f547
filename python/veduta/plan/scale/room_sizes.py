"""Sizes and areas of rooms that are printed in them (FPSE of the paper).

A room that is printed as 4.94 x 3.06 is measured along its walls: by the sides of the rectangle
around it, and by the free lines through the text, which are right where rooms run into each other
or have bays. Which side is which is not said, and need not be: the mean of the logarithms of both
ratios is the same either way, and how far the two ratios differ says how well the room fits.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import shapely
import shapely.affinity
from numpy.typing import NDArray
from shapely.geometry import LineString, Point, Polygon

from veduta.plan.document import Text
from veduta.plan.scale.evidence import (
    EvidenceKind,
    Hypothesis,
    Voter,
    side_hypothesis,
    side_sigma,
)
from veduta.plan.scale.quantities import Quantity, read_quantities

_UNLIKE = 0.25  # sides whose ratios differ by more (in logarithms) are not the two sides
_ONE_SIDE_TRUST = 0.25  # one side alone, where the other is open to the next room
_AREA_STATED = 0.02  # built-in cupboards and chimneys are counted, or not
_TOTAL_STATED = 0.05  # inner walls are counted, or not


@dataclass(frozen=True)
class Measured:
    """Sides of a room in pixels: along its longest wall's direction, and across."""

    along: float
    across: float
    trust: float


def room_voters(
    texts: list[Text], rooms_px: list[NDArray[np.float64]], blur_px: float
) -> list[Voter]:
    """Evidence from sizes and areas in texts; `rooms_px` are outlines (n, 2), as `texts` in pixels.

    An area is that of the room it stands in, or of all rooms; a size is that of the room.
    """
    rooms = [_polygon(outline) for outline in rooms_px]
    total = sum(room.area for room in rooms)
    voters = []
    for text in texts:
        quantities = [one for one in read_quantities(text.text) if one.kind != "ratio"]
        at = Point(np.mean(text.box_px, axis=0))
        inside = next((index for index, room in enumerate(rooms) if room.contains(at)), None)
        room = None if inside is None else rooms[inside]
        found = [one for quantity in quantities for one in _readings(quantity, room, at, blur_px)]
        found += [
            Hypothesis(_area_log(one, total), _TOTAL_STATED, 0.5 * one.trust)
            for one in quantities
            if one.kind == "area" and total > 0
        ]
        if found:
            sized = any(one.kind != "area" for one in quantities)
            kind: EvidenceKind = "dimension" if sized else "area"
            place = f"room {inside}" if inside is not None else "all rooms"
            voters.append(Voter(kind, text.text, place, tuple(found), mass=text.score))
    return voters


def measured_sides(room: Polygon, at: Point) -> list[Measured]:
    """What the two printed sides of a room may be: of its rectangle, or through its text."""
    angle = _direction(room)
    straight = shapely.affinity.rotate(room, -angle, origin=(0, 0), use_radians=True)
    label = shapely.affinity.rotate(at, -angle, origin=(0, 0), use_radians=True)
    left, top, right, bottom = straight.bounds
    free_along = _free(straight, label, LineString([(left - 1, label.y), (right + 1, label.y)]))
    free_across = _free(straight, label, LineString([(label.x, top - 1), (label.x, bottom + 1)]))
    alongs = [(right - left, 1.0)] + ([(free_along, 0.9)] if free_along else [])
    acrosses = [(bottom - top, 1.0)] + ([(free_across, 0.9)] if free_across else [])
    return [
        Measured(along, across, trust * other)
        for (along, trust), (across, other) in itertools.product(alongs, acrosses)
    ]


def _readings(
    quantity: Quantity, room: Polygon | None, at: Point, blur_px: float
) -> Iterator[Hypothesis]:
    if room is None:
        return
    if quantity.kind == "area":
        yield Hypothesis(
            _area_log(quantity, room.area),
            math.hypot(_AREA_STATED, quantity.step / quantity.values[0] / math.sqrt(48.0)),
            quantity.trust,
        )
        return
    for sides in measured_sides(room, at):
        if quantity.kind == "size":
            yield from _of_size(quantity, sides, blur_px)
        else:
            yield from _of_one_side(quantity, quantity.values[0], sides, blur_px)


def _of_size(quantity: Quantity, sides: Measured, blur_px: float) -> Iterator[Hypothesis]:
    a, b = quantity.values
    pairs = min(
        (((a, sides.along), (b, sides.across)), ((b, sides.along), (a, sides.across))),
        key=lambda pair: abs(_unlike(pair)),
    )
    unlike = _unlike(pairs)
    if abs(unlike) <= _UNLIKE:
        sigmas = [side_sigma(metres, pixels, quantity.step, blur_px) for metres, pixels in pairs]
        yield Hypothesis(
            sum(math.log(metres / pixels) for metres, pixels in pairs) / 2.0,
            math.hypot(*sigmas, unlike / 2.0) / math.sqrt(2.0),
            quantity.trust * sides.trust * math.exp(-0.5 * (unlike / 0.08) ** 2),
        )
    for metres in (a, b):
        yield from _of_one_side(quantity, metres, sides, blur_px)


def _of_one_side(
    quantity: Quantity, metres: float, sides: Measured, blur_px: float
) -> Iterator[Hypothesis]:
    """The paper's lounge: `5.0m` and 235 px between its walls give 47 px/m."""
    trust = _ONE_SIDE_TRUST * quantity.trust * sides.trust
    for pixels in (sides.along, sides.across):
        yield side_hypothesis(metres, pixels, quantity.step, blur_px, trust)


def _unlike(pairs: tuple[tuple[float, float], tuple[float, float]]) -> float:
    (a, along), (b, across) = pairs
    return math.log(a / along) - math.log(b / across)


def _area_log(quantity: Quantity, area_px2: float) -> float:
    return 0.5 * math.log(quantity.values[0] / area_px2)


def _polygon(outline: NDArray[np.float64]) -> Polygon:
    polygon = Polygon(outline)
    if polygon.is_valid:
        return polygon
    parts = shapely.get_parts(shapely.make_valid(polygon))
    areas = [part for part in parts if isinstance(part, Polygon)]
    return max(areas, key=lambda part: part.area, default=Polygon())


def _direction(room: Polygon) -> float:
    """Direction of the walls, modulo a right angle: that along which most of the outline runs."""
    steps = np.diff(np.asarray(room.exterior.coords), axis=0)
    lengths = np.hypot(steps[:, 0], steps[:, 1])
    angles = np.arctan2(steps[:, 1], steps[:, 0])
    # Four times the angle is the same for all four directions of a rectangle.
    mean = np.sum(lengths**2 * np.exp(4j * angles))
    return float(np.angle(mean) / 4.0)


def _free(room: Polygon, label: Point, line: LineString) -> float:
    """Length of the piece of a line inside the room that the label is on; 0 if there is none."""
    for piece in shapely.get_parts(room.intersection(line)):
        if piece.distance(label) < 1e-6:
            return float(piece.length)
    return 0.0
