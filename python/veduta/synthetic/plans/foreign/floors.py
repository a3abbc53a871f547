"""What all six have in common: a floor, where there is room on it, rows of sizes, a seed's choices.

The floors are those of `layout.make_house`, on one storey.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from itertools import pairwise

import cv2
import numpy as np
from shapely.geometry import Polygon

from veduta.synthetic.plans.canvas import Canvas, Colour, Image, text_size_px
from veduta.synthetic.plans.house import Language, Opening, Room, Storey, Wall
from veduta.synthetic.plans.layout import LayoutFault, make_house
from veduta.synthetic.plans.places import Place

INCH_M = 0.0254
ATTEMPTS = 12


def floor_of(seed: int, family: str, language: Language) -> Storey:
    """The one storey of a seed in a family; a seed that has no sound layout takes the next."""
    base = sum(ord(letter) for letter in family) * 1_000_003 + seed * ATTEMPTS
    for attempt in range(ATTEMPTS):
        try:
            return make_house(base + attempt, language, 1).storeys[0]
        except LayoutFault:
            continue
    raise LayoutFault(f"no sound layout of {family} for seed {seed}")


def hinge_of(opening: Opening) -> tuple[float, float, float]:
    """Of a leaf that turns: where it hangs along the wall, which way it closes, its side."""
    side = 1.0 if opening.swing == "left" else -1.0
    return (0.0, 1.0, side) if opening.hinge == "start" else (opening.width_m, -1.0, side)


def leaves_of(opening: Opening) -> list[tuple[float, float, float]]:
    """Hinge, signed length and side of each leaf of a door that turns."""
    hinge, towards, side = hinge_of(opening)
    if opening.type in ("double", "french"):
        half = opening.width_m / 2.0
        return [(0.0, half, side), (opening.width_m, -half, side)]
    return [(hinge, towards * opening.width_m, side)]


def turned_leaf(
    canvas: Canvas, place: Place, leaf: tuple[float, float, float], pen: float, ink: Colour
) -> None:
    """A line at a right angle, and its quarter."""
    hinge, length, side = leaf
    base = side * place.half_m
    canvas.line([place.at(hinge, base), place.at(hinge, base + side * abs(length))], pen, ink)
    canvas.line(place.sweep((hinge, base), length, side, 24), 0.8 * pen, ink)


def outward(wall: Wall) -> float:
    """1 where outdoors is at the wall's left, else -1."""
    return 1.0 if wall.left is None else -1.0


def feet(metres: float) -> str:
    """Feet and inches as draughtsmen write them: 12'-4\"."""
    whole, rest = divmod(round(metres / INCH_M), 12)
    return f"{whole}'-{rest}\""


def crossings(storey: Storey, axis: int, level: float) -> list[float]:
    """Middles of the straight walls that a line along an axis cuts at a level of the other one."""
    found = set()
    for wall in storey.walls:
        (low, high) = sorted((wall.start_m[1 - axis], wall.end_m[1 - axis]))
        if wall.bulge == 0.0 and wall.start_m[axis] == wall.end_m[axis] and low < level < high:
            found.add(round(wall.start_m[axis], 3))
    return sorted(found)


def chain(
    canvas: Canvas, places: Sequence[float], level: float, along_x: bool, pen: float, ink: Colour,
    written: Callable[[float], str], height_px: float, ends: str = "tick", gap_m: float = 0.5,
) -> None:  # fmt: skip
    """A row of sizes between places; `ends` are ticks, dots or arrow heads."""

    def at(along: float, across: float) -> tuple[float, float]:
        return (along, across) if along_x else (across, along)

    canvas.line([at(places[0], level), at(places[-1], level)], pen, ink)
    for number, one in enumerate(places):
        canvas.line([at(one, level - 0.1), at(one, level + 0.1)], pen, ink)
        if ends == "tick":
            canvas.line([at(one - 0.07, level - 0.07), at(one + 0.07, level + 0.07)], 2 * pen, ink)
        elif ends == "dot":
            canvas.line([at(one - 0.01, level), at(one + 0.01, level)], 4.5 * pen, ink)
        else:
            for way in (-1.0, 1.0):
                if (number == 0 and way < 0) or (number == len(places) - 1 and way > 0):
                    continue
                head = [at(one + way * 0.14, level - 0.035), at(one, level),
                        at(one + way * 0.14, level + 0.035)]  # fmt: skip
                canvas.line(head, pen, ink)
    lift = 0.75 * height_px * canvas.metres_per_px + 0.02
    for low, high in pairwise(places):
        if high - low > gap_m:
            middle = at((low + high) / 2.0, level + (lift if along_x else -lift))
            canvas.text(written(high - low), middle, height_px, "sans", ink, 400, along_x)


def width_m(canvas: Canvas, text: str, height_px: float) -> float:
    """How wide a line of text is on the house's scale."""
    return text_size_px(text, height_px)[0] * canvas.metres_per_px


def largest(storey: Storey) -> Room:
    """The room with the largest area."""
    return max(storey.rooms, key=lambda room: room.area_m2)


def clear_size(room: Room) -> tuple[float, float] | None:
    """Its two sides where it is a rectangle."""
    area = Polygon(room.outline_m)
    left, bottom, right, top = area.bounds
    wide, high = right - left, top - bottom
    return (wide, high) if area.area > 0.97 * wide * high else None


def slanted(
    picture: Image, text: str, middle_px: tuple[float, float], height_px: int, turn_deg: float,
    colour: Colour, strength: float,
) -> Image:  # fmt: skip
    """Text across a finished picture at an angle, so strong (0 to 1) over what lies below."""
    wide = text_size_px(text, height_px, "sans", 800)[0]
    start = (round(middle_px[0] - wide / 2.0), round(middle_px[1] + 0.35 * height_px))
    ink = np.full(picture.shape, 255, np.uint8)
    cv2.putText(ink, text, start, (0, 0, 0), cv2.FontFace("sans"), height_px, 800)
    turn = cv2.getRotationMatrix2D(middle_px, turn_deg, 1.0)
    mask = cv2.warpAffine(255 - ink[:, :, 0], turn, (picture.shape[1], picture.shape[0]))
    share = strength * mask[:, :, None].astype(np.float64) / 255.0
    return np.asarray(share * np.array(colour) + (1.0 - share) * picture, np.uint8)


def star(canvas: Canvas, at: tuple[float, float], radius: float, turn: float, ink: Colour) -> None:
    """A compass of four long points, half of each filled, and its N."""
    for quarter in range(4):
        way = turn + quarter * math.pi / 2.0
        reach = radius * (1.3 if quarter == 0 else 1.0)
        tip = (at[0] + reach * math.sin(way), at[1] + reach * math.cos(way))
        waist = 0.25 * radius
        sides = [
            (at[0] + waist * math.sin(way + lean), at[1] + waist * math.cos(way + lean))
            for lean in (-math.pi / 4.0, math.pi / 4.0)
        ]
        canvas.fill(Polygon([at, sides[0], tip]), ink)
        canvas.line([at, sides[1], tip], 1.0, ink)
    letter = (at[0] + 1.75 * radius * math.sin(turn), at[1] + 1.75 * radius * math.cos(turn))
    canvas.text("N", letter, 0.5 * radius / canvas.metres_per_px, "sans", ink, 700)
