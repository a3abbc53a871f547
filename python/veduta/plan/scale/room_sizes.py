"""Sizes and areas of rooms that are printed in them (FPSE of the paper).

A room that is printed as 4.94 x 3.06 is measured along its walls: by the sides of the rectangle
around it, and by the free lines through the text, which are right where rooms run into each other
or have bays. Which side is which is not said, and need not be: the mean of the logarithms of both
ratios is the same either way, and how far the two ratios differ says how well the room fits.
"""

from __future__ import annotations

import itertools
import math
import re
from collections.abc import Iterator, Sequence
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
from veduta.plan.scale.free_runs import free_runs
from veduta.plan.scale.printed import Printed, laid_level, printed_in, room_polygon
from veduta.plan.scale.quantities import Quantity, read_quantities

_UNLIKE = 0.25  # sides whose ratios differ by more (in logarithms) are not the two sides
_ONE_SIDE_TRUST = 0.25  # one side alone, where the other is open to the next room
_RUN_TRUST = 0.8
_SAME_SIZE = 0.03  # metres and feet of one side differ by less
_LABEL = 2.5  # heights of text between the lines of one label
_AREA_OF_RUNS = 0.06  # the free runs of a room span a rectangle that is not quite its area
_AREA_STATED = 0.02  # built-in cupboards and chimneys are counted, or not
_TOTAL_STATED = 0.05  # inner walls are counted, or not
_TOTAL_TRUST, _HOUSE_TRUST = 0.5, 0.25  # of an area that may be of all rooms, or of all storeys
_STOREY_OF_TOTAL = 0.2  # a storey has at least so much of what is written as the house's total
_OF_HOUSE = re.compile(r"\b(?:total|gross|gesamt\w*|totale?|overall|whole|area)\b", re.IGNORECASE)


@dataclass(frozen=True)
class Measured:
    """Sides of a room in pixels: along its longest wall's direction, and across."""

    along: float
    across: float
    trust: float


def room_voters(
    texts: list[Text],
    rooms_px: list[NDArray[np.float64]],
    blur_px: float,
    walls: Sequence[NDArray[np.uint8]] = (),
) -> list[Voter]:
    """Evidence from sizes and areas in texts; `rooms_px` are outlines (n, 2), as `texts` in pixels.

    A size is that of the room it stands in. An area is too; where several stand in one room, they
    are its parts; the largest on the sheet may be that of all rooms. `walls` are masks (h, w) of
    walls (`free_runs`): by them, rooms whose outline is not known are measured as well.
    """
    rooms = [room_polygon(outline) for outline in rooms_px]
    printed = printed_in(texts, rooms)
    total = sum(room.area for room in rooms)
    totals = _totals(printed) if total > 0 else {}
    voters: list[Voter] = []
    places: list[tuple[NDArray[np.float64], str]] = []
    for one in printed:
        found = list(_of_room(one, printed, rooms, walls, blur_px))
        found += [
            Hypothesis(_area_log(quantity.values[0], total), _TOTAL_STATED, trust * quantity.trust)
            for quantity in one.quantities
            if quantity.kind == "area" and (trust := totals.get(id(one), 0.0)) > 0.0
        ]
        if found:
            sized = any(quantity.kind != "area" for quantity in one.quantities)
            kind: EvidenceKind = "dimension" if sized else "area"
            place = _place(one.text, one.at, places)
            voters.append(Voter(kind, one.text.text, place, tuple(found), mass=one.text.score))
    return voters


def of_house(text: str) -> bool:
    """Whether a text says an area of the whole house: `Gross Internal Area 821 sq. ft`."""
    area = any(one.kind == "area" for one in read_quantities(text))
    return area and _OF_HOUSE.search(text) is not None


def _totals(printed: list[Printed]) -> dict[int, float]:
    """How far each text is trusted to state the area of all rooms of the sheet, by its `id`.

    The largest may; so may what stands beside the plan and is not much smaller, as a house's total
    below the one of its storey. What says that it is of the house is trusted less where another
    text may be the storey's.
    """
    largest = max((area for one in printed for area in one.areas), default=0.0)
    may: dict[int, float] = {}
    for one in printed:
        area = max(one.areas, default=0.0)
        beside = one.room is None and area >= _STOREY_OF_TOTAL * largest
        if area > 0.0 and (area >= 0.99 * largest or beside):
            may[id(one)] = _TOTAL_TRUST
    if len({round(max(one.areas)) for one in printed if id(one) in may}) > 1:
        whole = [one for one in printed if id(one) in may and of_house(one.text.text)]
        may |= {id(one): _HOUSE_TRUST for one in whole}
    return may


def _of_room(
    one: Printed,
    printed: list[Printed],
    rooms: list[Polygon],
    walls: Sequence[NDArray[np.uint8]],
    blur_px: float,
) -> Iterator[Hypothesis]:
    """What a text says of the room around it."""
    runs = _between_walls(walls, one.text)
    room = None if one.room is None else rooms[one.room]
    sides = [] if room is None else measured_sides(room, Point(one.at), 1.0 / _crowd(one, printed))
    parts = [other.areas[0] for other in printed if other.room == one.room and other.areas]
    for quantity in one.quantities:
        if quantity.kind != "area":
            for measured in (*sides, *runs):
                yield from _of_sides(quantity, measured, blur_px)
        elif room is not None:
            alone = len(parts) < 2
            yield _of_area(
                quantity, quantity.values[0], room.area, quantity.trust if alone else 0.3
            )
            if not alone:
                yield _of_area(quantity, sum(parts), room.area, 0.5 * quantity.trust)
        if quantity.kind == "area" and (room is None or len(parts) > 1):
            for run in runs:
                log = _area_log(quantity.values[0], run.along * run.across)
                yield Hypothesis(log, _AREA_OF_RUNS, quantity.trust * run.trust)


def _crowd(one: Printed, printed: list[Printed]) -> int:
    """How many sizes are printed in a room, of which it has one; in metres and in feet are one.

    Where walls between rooms were missed, each size in them would be measured by the same outline,
    and they would agree with each other.
    """
    others = [other for other in printed if other.room == one.room and other.sizes]
    return 1 + sum(not _alike(one.sizes, other.sizes) for other in others)


def _alike(first: list[tuple[float, ...]], second: list[tuple[float, ...]]) -> bool:
    """Whether two texts may say the same size, read in one way or another."""
    return any(
        np.allclose(one, other, rtol=_SAME_SIZE) or np.allclose(one, other[::-1], rtol=_SAME_SIZE)
        for one, other in itertools.product(first, second)
    )


def _between_walls(walls: Sequence[NDArray[np.uint8]], text: Text) -> list[Measured]:
    widths, heights = free_runs(walls, text)
    return [
        Measured(width, height, _RUN_TRUST) for width, height in itertools.product(widths, heights)
    ]


def _place(
    text: Text, at: NDArray[np.float64], places: list[tuple[NDArray[np.float64], str]]
) -> str:
    """A name for where a text stands: that of the label it belongs to, as in metres and in feet."""
    reach = _LABEL * float(np.linalg.norm(np.subtract(text.box_px[3], text.box_px[0])))
    for other, name in places:
        if np.linalg.norm(at - other) <= reach:
            return name
    places.append((at, f"around ({at[0]:.0f}, {at[1]:.0f})"))
    return places[-1][1]


def measured_sides(room: Polygon, at: Point, trust: float = 1.0) -> list[Measured]:
    """What the two printed sides of a room may be: of its rectangle, or through its text."""
    angle, straight = laid_level(room)
    label = shapely.affinity.rotate(at, -angle, origin=(0, 0), use_radians=True)
    left, top, right, bottom = straight.bounds
    free_along = _free(straight, label, LineString([(left - 1, label.y), (right + 1, label.y)]))
    free_across = _free(straight, label, LineString([(label.x, top - 1), (label.x, bottom + 1)]))
    alongs = [(right - left, 1.0)] + ([(free_along, 0.9)] if free_along else [])
    acrosses = [(bottom - top, 1.0)] + ([(free_across, 0.9)] if free_across else [])
    return [
        Measured(along, across, trust * one * other)
        for (along, one), (across, other) in itertools.product(alongs, acrosses)
    ]


def _of_area(quantity: Quantity, metres2: float, pixels2: float, trust: float) -> Hypothesis:
    rounding = quantity.step / quantity.values[0] / math.sqrt(48.0)
    return Hypothesis(_area_log(metres2, pixels2), math.hypot(_AREA_STATED, rounding), trust)


def _of_sides(quantity: Quantity, sides: Measured, blur_px: float) -> Iterator[Hypothesis]:
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


def _area_log(metres2: float, pixels2: float) -> float:
    return 0.5 * math.log(metres2 / pixels2)


def _free(room: Polygon, label: Point, line: LineString) -> float:
    """Length of the piece of a line inside the room that the label is on; 0 if there is none."""
    for piece in shapely.get_parts(room.intersection(line)):
        if piece.distance(label) < 1e-6:
            return float(piece.length)
    return 0.0
