"""A letting agent's page: both storeys of a terraced house with fittings, areas and small print.

Grey walls with a dark rim, pale floors by use, bold capitals with sizes in metres and feet under
them, hearths before chimney breasts, a compass, a total. The storeys stand side by side or one
above the other. What is drawn besides walls, openings and words is there to be told from them.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import cv2
import numpy as np
from shapely import unary_union
from shapely.geometry import Polygon, box
from shapely.geometry.base import BaseGeometry

from veduta.synthetic.plans.bodies import solid_walls, whole_walls
from veduta.synthetic.plans.canvas import Canvas, Colour, Image
from veduta.synthetic.plans.house import Fitting, Opening, Room, Stairs, Storey, Use, Wall
from veduta.synthetic.plans.places import place_of
from veduta.synthetic.plans.sanitary import basin, bath, bed, closet, counter
from veduta.synthetic.plans.terraced import Terrace, terraced_house
from veduta.synthetic.plans.truth_file import SheetTruth
from veduta.synthetic.seeds import stream

INK: Colour = (38, 38, 42)
WALL: Colour = (104, 106, 112)
FLOORS: Mapping[Use, Colour] = {
    "living": (244, 238, 226), "dining": (244, 238, 226), "kitchen": (226, 236, 240),
    "bathroom": (222, 234, 242), "bedroom": (240, 240, 232), "hall": (236, 232, 228),
    "corridor": (236, 232, 228),
}  # fmt: skip
NAMES: Mapping[Use, tuple[str, ...]] = {
    "living": ("LOUNGE", "SITTING ROOM", "RECEPTION ROOM"), "dining": ("DINING ROOM",),
    "kitchen": ("KITCHEN",), "bathroom": ("BATHROOM",), "hall": ("HALL",),
    "corridor": ("LANDING",), "bedroom": ("BEDROOM",),
}  # fmt: skip
TITLES = ("GROUND FLOOR", "FIRST FLOOR")
FOOT_M = 0.3048
BREAST_M = (1.25, 0.38)
SMALL_PRINT = (
    "This drawing shows the layout only. Sizes are the largest of each room",
    "and were not taken for building.",
)


@dataclass(frozen=True)
class Page:
    """How a page is drawn: its scale, its pen, and whether storeys stand one above the other."""

    metres_per_px: float
    pen_px: float
    above: bool
    coloured: bool
    feet: bool


def brochure_page(seed: int) -> tuple[Image, list[SheetTruth]]:
    """The page (h, w, 3) of a seed and the truth of its two storeys, the lower first."""
    rng = stream(seed, "brochure")
    page = Page(
        1.0 / float(rng.uniform(52.0, 84.0)), float(rng.uniform(1.0, 1.7)),
        bool(rng.random() < 0.4), bool(rng.random() < 0.6), bool(rng.random() < 0.7),
    )  # fmt: skip
    house, size = terraced_house(seed)
    names = stream(seed, "brochure names")
    made = [_storey(one, size, page, names) for one in house.storeys]
    drawn = [canvas for canvas, _ in made]
    sheet, corners = _laid_out(drawn, page, rng)
    truths = []
    for storey, (canvas, fittings), corner in zip(house.storeys, made, corners, strict=True):
        move = np.eye(3)
        move[:2, 2] = corner
        truths.append(
            SheetTruth(
                file=f"brochure-{seed:05d}-{storey.number}.png",
                seed=seed,
                style="brochure",
                degradation="brochure",
                unseen=("brochure",),
                walls_drawn="filled",
                px_from_m=move @ canvas.px_from_m,
                says_scale=True,
                dpi=None,
                storey=storey,
                fittings=fittings,
            )
        )
    return sheet, truths


def _storey(
    storey: Storey, size: Terrace, page: Page, rng: np.random.Generator
) -> tuple[Canvas, tuple[Fitting, ...]]:
    left, bottom, right, top = whole_walls(storey.walls).bounds
    bounds = (left - 0.7, bottom - 1.0, right + 0.7, top + 0.7)
    canvas = Canvas(bounds, page.metres_per_px, (255, 255, 255))
    for room in storey.rooms:
        if page.coloured:
            canvas.fill(Polygon(room.outline_m).buffer(0.06, join_style="mitre"), FLOORS[room.use])
    solid = squared(storey, size)
    canvas.fill(solid, WALL)
    canvas.outline(solid, page.pen_px, INK)
    _breasts(canvas, storey, size, page)
    for opening in storey.openings:
        wall = storey.wall(opening.wall)
        if opening.kind == "window":
            _window(canvas, wall, opening, page)
        elif opening.type == "sliding":
            _glass(canvas, wall, opening, page)
        elif opening.kind == "door":
            _door(canvas, wall, opening, page)
    for flight in storey.stairs:
        _stairs(canvas, flight, page)
    fittings = [one for room in storey.rooms for one in _fittings(canvas, room, page)]
    _labels(canvas, storey, page, rng)
    area = sum(room.area_m2 for room in storey.rooms)
    middle = (left + right) / 2.0
    height = 0.2 / page.metres_per_px
    canvas.text(TITLES[storey.number], (middle, bottom - 0.4), height, "sans", INK, 700)
    total = f"{area:.1f} SQ.M. ({area / FOOT_M**2:.0f} SQ.FT.)"
    canvas.text(total, (middle, bottom - 0.75), 0.7 * height, "sans", INK, 400)
    return canvas, tuple(fittings)


def squared(storey: Storey, size: Terrace) -> BaseGeometry:
    """The walls' material, whose party walls end square, a little before front and back."""
    half = size.party / 2.0
    ends = [
        box(x - half, y - half, x + half, y + half)
        for wall in storey.walls
        if wall.thickness_m == size.party
        for x, y in (wall.start_m, wall.end_m)
    ]
    return unary_union([solid_walls(storey), *ends])


def _breasts(canvas: Canvas, storey: Storey, size: Terrace, page: Page) -> None:
    """On the right party wall of the two main rooms, each with its hearth downstairs."""
    face = size.wide - size.party / 2.0
    for middle in (size.front / 2.0, size.front + size.back / 2.0):
        half = BREAST_M[0] / 2.0
        body = box(face - BREAST_M[1], middle - half, face + 0.02, middle + half)
        canvas.fill(body, WALL)
        canvas.outline(body, page.pen_px, INK)
        if storey.number == 0:
            left = face - BREAST_M[1]
            opening = box(left, middle - 0.35, left + 0.22, middle + 0.35)
            canvas.fill(opening, (255, 255, 255))
            canvas.outline(opening, page.pen_px, INK)
            hearth = box(left - 0.3, middle - 0.5, left, middle + 0.5)
            canvas.outline(hearth, 0.7 * page.pen_px, INK)


def _window(canvas: Canvas, wall: Wall, opening: Opening, page: Page) -> None:
    """Both faces and the glass, and a sill that stands out."""
    place = place_of(wall, opening)
    half, wide = place.half_m, place.width_m
    for side in (-half, 0.0, half):
        canvas.line([place.at(0.0, side), place.at(wide, side)], 0.8 * page.pen_px, INK)
    out = 1.0 if wall.left is None else -1.0
    sill = [
        place.at(-0.06, out * half), place.at(-0.06, out * (half + 0.07)),
        place.at(wide + 0.06, out * (half + 0.07)), place.at(wide + 0.06, out * half),
    ]  # fmt: skip
    canvas.line(sill, 0.7 * page.pen_px, INK)


def _glass(canvas: Canvas, wall: Wall, opening: Opening, page: Page) -> None:
    """Panes that slide past each other: two hair lines, each a little over half."""
    place = place_of(wall, opening)
    wide = place.width_m
    for low, high, side in ((0.0, 0.53, -0.03), (0.47, 1.0, 0.03)):
        ends = [place.at(low * wide, side), place.at(high * wide, side)]
        canvas.line(ends, 0.8 * page.pen_px, INK)
    for along in (0.0, wide):
        canvas.line([place.at(along, -0.06), place.at(along, 0.06)], page.pen_px, INK)


def _door(canvas: Canvas, wall: Wall, opening: Opening, page: Page) -> None:
    """An open leaf as a thin board, and the quarter that it sweeps."""
    place = place_of(wall, opening)
    side = 1.0 if opening.swing == "left" else -1.0
    wide = place.width_m
    hinge, towards = (0.0, 1.0) if opening.hinge == "start" else (wide, -1.0)
    base = side * place.half_m
    leaf = place.box(hinge, hinge + towards * 0.04, base, base + side * wide)
    canvas.fill(leaf, (255, 255, 255))
    canvas.outline(leaf, page.pen_px, INK)
    arc = place.sweep((hinge, base), towards * wide, side, 30)
    canvas.line(arc, 0.7 * page.pen_px, INK)


def _stairs(canvas: Canvas, flight: Stairs, page: Page) -> None:
    """Treads, and an arrow from its foot with a round tail."""
    (left, bottom), (right, top) = flight.outline_m[0], flight.outline_m[2]
    pen = 0.7 * page.pen_px
    for height in np.linspace(bottom, top, flight.treads + 1):
        canvas.line([(left, height), (right, height)], pen, INK)
    canvas.line([(right, bottom), (right, top)], pen, INK)
    middle = (left + right) / 2.0
    foot, head = (bottom + 0.1, top - 0.1)[:: round(flight.up[1])]
    way = math.copysign(1.0, flight.up[1])
    canvas.line([(middle, foot), (middle, head)], page.pen_px, INK)
    tip = [(middle - 0.09, head - way * 0.18), (middle, head), (middle + 0.09, head - way * 0.18)]
    canvas.line(tip, page.pen_px, INK)
    word = "UP" if flight.up[1] > 0 else "DN"
    size = 0.13 / page.metres_per_px
    canvas.text(word, (middle, foot - way * 0.22), size, "sans", INK, 600)


def _fittings(canvas: Canvas, room: Room, page: Page) -> tuple[Fitting, ...]:
    """What is built in, and beds; nothing else stands in a page of an agent."""
    left, bottom, right, top = Polygon(room.outline_m).bounds
    pen = 0.7 * page.pen_px
    if room.use == "kitchen":
        return counter(canvas, (right, bottom + 0.9, top - 1.0), pen, INK)
    if room.use == "bathroom":
        return (
            bath(canvas, (right - 0.75, top - 1.75), pen, INK),
            basin(canvas, (left + 0.02, top - 0.75), pen, INK),
            closet(canvas, (left + 0.02, top - 1.45), pen, INK),
        )
    if room.use == "bedroom":
        return (bed(canvas, (right - 2.9, top - 2.35), pen, INK),)
    return ()


def _labels(canvas: Canvas, storey: Storey, page: Page, rng: np.random.Generator) -> None:
    beds = 0
    for room in storey.rooms:
        names = NAMES[room.use]
        name = names[int(rng.integers(len(names)))]
        if room.use == "bedroom":
            beds += 1
            name = f"BEDROOM {beds}"
        left, bottom, right, top = Polygon(room.outline_m).bounds
        if room.use in ("hall", "corridor"):
            at = ((left + right) / 2.0 + 0.42, top - 0.45)
        elif room.use == "bedroom":
            at = ((left + right) / 2.0, bottom + 0.28 * (top - bottom))
        else:
            at = ((left + right) / 2.0 - 0.15, bottom + 0.42 * (top - bottom))
        height = float(np.clip(0.17 / page.metres_per_px, 10.0, 18.0))
        canvas.text(name, at, height, "sans", INK, 700)
        if room.use in ("living", "dining", "kitchen", "bedroom"):
            _size(canvas, (right - left, top - bottom), at, height, page)


def _size(
    canvas: Canvas, size_m: tuple[float, float], at: tuple[float, float], height: float, page: Page
) -> None:
    """The size beneath a name, in metres, and in feet where the page gives them."""
    lines = [f"{size_m[0]:.2f}m x {size_m[1]:.2f}m"]
    if page.feet:
        lines.append(" x ".join(_feet(one) for one in size_m))
    for number, line in enumerate(lines, 1):
        lower = (at[0], at[1] - number * 1.35 * height * page.metres_per_px)
        canvas.text(line, lower, 0.8 * height, "sans", INK, 400)


def _feet(metres: float) -> str:
    feet, inches = divmod(round(metres / FOOT_M * 12.0), 12)
    return f"{feet}'{inches}\""


def _laid_out(
    drawn: Sequence[Canvas], page: Page, rng: np.random.Generator
) -> tuple[Image, list[tuple[int, int]]]:
    """The page of the storeys, and the upper left corner of each in it, in pixels."""
    pictures = [one.picture() for one in drawn]
    edge, foot = round(0.5 / page.metres_per_px), round(1.1 / page.metres_per_px)
    sizes = [(one.shape[1], one.shape[0]) for one in pictures]
    if page.above:  # the upper storey on top, as it is in the house
        wide = max(size[0] for size in sizes)
        high = sizes[0][1] + sizes[1][1]
        corners = [(edge, edge + sizes[1][1]), (edge, edge)]
    else:
        wide, high = sizes[0][0] + sizes[1][0], max(size[1] for size in sizes)
        corners = [(edge, edge), (edge + sizes[0][0], edge)]
        if rng.random() < 0.3:  # feet of both on one line
            lower = [edge + high - size[1] for size in sizes]
            corners = [(corners[0][0], lower[0]), (corners[1][0], lower[1])]
    sheet = np.full((high + 2 * edge + foot, wide + 2 * edge, 3), 255, np.uint8)
    for picture, (x, y) in zip(pictures, corners, strict=True):
        sheet[y : y + picture.shape[0], x : x + picture.shape[1]] = picture
    _foot(sheet, foot, page)
    return sheet, corners


def _foot(sheet: Image, foot: int, page: Page) -> None:
    """Small print, and a compass at the right."""
    face, size = cv2.FontFace("sans"), max(9, round(0.13 / page.metres_per_px))
    top = sheet.shape[0] - foot
    for number, line in enumerate(SMALL_PRINT):
        at = (size, top + (number + 1) * round(1.6 * size))
        cv2.putText(sheet, line, at, INK, face, size, 400)
    radius = foot // 3
    middle = (sheet.shape[1] - 2 * radius, top + radius + 4)
    cv2.circle(sheet, middle, radius, INK, 1, cv2.LINE_AA)
    tip = (middle[0] + radius // 2, middle[1] - round(0.86 * radius))
    cv2.arrowedLine(sheet, middle, tip, INK, 2, cv2.LINE_AA)
    cv2.putText(sheet, "N", (tip[0] + 4, tip[1] + 4), INK, face, size, 700)
