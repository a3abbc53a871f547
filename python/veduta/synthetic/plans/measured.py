"""A measured survey of an old house on its plot: hatched walls, chains of sizes, trees, a section.

Names are Swedish, Dutch or Italian, each with a line of signs under it that no reader of text
knows. Around the house stand the wall of the plot with its gate, trees, paving, a slope, a car, a
shed; a section line runs through the rooms. None of them is a wall or a room.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import cv2
import numpy as np
from shapely import unary_union
from shapely.geometry import Point, Polygon, box
from shapely.geometry.base import BaseGeometry

from veduta.synthetic.plans.bodies import solid_walls, whole_walls
from veduta.synthetic.plans.canvas import Canvas, Colour, Image
from veduta.synthetic.plans.cottage import Cottage, cottage
from veduta.synthetic.plans.house import Fitting, Opening, Storey, Use, Wall
from veduta.synthetic.plans.places import place_of
from veduta.synthetic.plans.sanitary import basin, bath, bed, closet
from veduta.synthetic.plans.strangers import unread_line
from veduta.synthetic.plans.truth_file import SheetTruth
from veduta.synthetic.seeds import stream

INK: Colour = (30, 30, 30)
PALE: Colour = (150, 150, 150)
USES: tuple[Use, ...] = ("living", "hall", "kitchen", "bedroom", "bathroom")
NAMES: tuple[Mapping[Use, str], ...] = (
    dict(zip(USES, ("Vardagsrum", "Hall", "Kök", "Sovrum", "Bad"), strict=True)),
    dict(zip(USES, ("Woonkamer", "Hal", "Keuken", "Slaapkamer", "Badkamer"), strict=True)),
    dict(zip(USES, ("Soggiorno", "Ingresso", "Cucina", "Camera", "Bagno"), strict=True)),
)
BREAST_M = (1.7, 0.6)


@dataclass(frozen=True)
class Survey:
    """How a sheet is drawn: its scale, its pen, the yard around the house, how walls are filled."""

    metres_per_px: float
    pen_px: float
    yard: tuple[float, float, float, float]
    hatched: bool
    shaded: bool


def measured_sheet(seed: int) -> tuple[Image, list[SheetTruth]]:
    """The scanned sheet (h, w, 3) of a seed, and the truth of its one storey."""
    rng = stream(seed, "measured")
    yard = [float(one) for one in rng.uniform(2.4, 5.0, 4)]
    sheet = Survey(
        1.0 / float(rng.uniform(50.0, 75.0)), float(rng.uniform(1.0, 1.6)),
        (yard[0], yard[1], yard[2], yard[3]), bool(rng.random() < 0.6), bool(rng.random() < 0.6),
    )  # fmt: skip
    storey, size = cottage(seed)
    left, bottom, right, top = whole_walls(storey.walls).bounds
    plot = (left - yard[0], bottom - yard[1], right + yard[2], top + yard[3])
    bounds = (plot[0] - 1.2, plot[1] - 1.6, plot[2] + 1.2, plot[3] + 1.2)
    canvas = Canvas(bounds, sheet.metres_per_px, (252, 251, 247))
    _ground(canvas, plot, storey, sheet, rng)
    fittings = _house(canvas, storey, size, sheet)
    _chains(canvas, storey, size, sheet)
    _section(canvas, storey, sheet)
    words = _words(canvas, storey, sheet, seed)
    picture = canvas.picture()
    for at, height in words:
        x, y = canvas.px_from_m @ np.array([*at, 1.0]) @ np.eye(3)[:, :2]
        unread_line(picture, (round(x - 3.0 * height), round(y)), height, rng, INK)
    truth = SheetTruth(
        f"measured-{seed:05d}.png", seed, "measured", "measured", ("measured",), "hatched",
        canvas.px_from_m, True, None, storey, fittings,
    )  # fmt: skip
    return _scanned(picture, rng), [truth]


def _scanned(picture: Image, rng: np.random.Generator) -> Image:
    """Soft, with the grain of paper."""
    soft = cv2.GaussianBlur(picture, (0, 0), 0.6).astype(np.float32)
    grain = rng.normal(0.0, 3.0, picture.shape[:2])[..., None]
    return np.clip(soft + grain, 0, 255).astype(np.uint8)


def _ground(
    canvas: Canvas, plot: tuple[float, float, float, float], storey: Storey, sheet: Survey,
    rng: np.random.Generator,
) -> None:  # fmt: skip
    """The plot: its wall and gate, trees, paving before the door, a car, a shed, a slope."""
    left, bottom, right, top = plot
    house = whole_walls(storey.walls).bounds
    entrance = place_of(*_front_door(storey))
    middle = float(entrance.first[0] + entrance.second[0]) / 2.0
    gate = box(middle - 1.3, bottom - 0.3, middle + 1.3, bottom + 0.3)
    wall = box(*plot).exterior.buffer(0.13, join_style="mitre").difference(gate)
    canvas.outline(wall, sheet.pen_px, INK)
    if sheet.shaded:
        canvas.fill(wall.buffer(-0.02), PALE)
    path = box(middle - 0.6, bottom + 0.13, middle + 0.6, house[1])
    canvas.outline(path, 0.6 * sheet.pen_px, INK)
    for height in np.arange(bottom + 0.5, house[1], 0.4):
        canvas.line([(middle - 0.6, height), (middle + 0.6, height)], 0.5 * sheet.pen_px, INK)
    free = box(left + 0.2, bottom + 0.2, right - 0.2, top - 0.2).difference(
        unary_union([box(*house).buffer(1.1), path.buffer(0.3)])
    )
    for _ in range(int(rng.integers(3, 7))):
        free = _tree(canvas, free, sheet, rng)
    for size, draw in (((1.8, 4.3), _car), ((2.0, 1.6), _shed)):
        spot = _spot(free, size, rng)
        if spot is not None:
            draw(canvas, spot, sheet)
            free = free.difference(spot.buffer(0.2))
    for start in np.arange(left + 0.4, min(left + 5.0, middle - 1.0), 0.3):
        long = 0.7 if round(start / 0.3) % 2 else 0.35
        canvas.line([(start, top - 0.2), (start, top - 0.2 - long)], 0.5 * sheet.pen_px, INK)


def _front_door(storey: Storey) -> tuple[Wall, Opening]:
    """The door in an outer wall, and its wall."""
    doors = [one for one in storey.openings if one.kind == "door"]
    return next((storey.wall(one.wall), one) for one in doors if storey.wall(one.wall).outer)


def _tree(
    canvas: Canvas, free: BaseGeometry, sheet: Survey, rng: np.random.Generator
) -> BaseGeometry:
    radius = float(rng.uniform(0.6, 1.2))
    spot = _spot(free, (2 * radius, 2 * radius), rng)
    if spot is None:
        return free
    x, y = spot.centroid.coords[0]
    turn = np.linspace(0.0, 2.0 * math.pi, 60)
    reach = radius * (0.9 + 0.1 * np.sin(9.0 * turn))
    crown = np.column_stack([x + reach * np.cos(turn), y + reach * np.sin(turn)])
    canvas.line(crown, 0.8 * sheet.pen_px, INK)
    for one in np.arange(0.0, 2.0 * math.pi, math.pi / 4.0):
        way = np.array([math.cos(one), math.sin(one)])
        canvas.line(np.array([x, y]) + radius * np.outer((0.0, 0.6), way), 0.5 * sheet.pen_px, INK)
    canvas.outline(Point(x, y).buffer(0.08), sheet.pen_px, INK)
    return free.difference(spot)


def _spot(
    free: BaseGeometry, size: tuple[float, float], rng: np.random.Generator
) -> Polygon | None:
    left, bottom, right, top = free.bounds
    for _ in range(40):
        x = float(rng.uniform(left, max(right - size[0], left)))
        y = float(rng.uniform(bottom, max(top - size[1], bottom)))
        body = box(x, y, x + size[0], y + size[1])
        if free.contains(body):
            return body
    return None


def _car(canvas: Canvas, body: Polygon, sheet: Survey) -> None:
    left, bottom, right, top = body.bounds
    canvas.outline(body.buffer(-0.3).buffer(0.3), sheet.pen_px, INK)
    for low, high in ((0.28, 0.4), (0.72, 0.84)):
        ends = (bottom + low * (top - bottom), bottom + high * (top - bottom))
        canvas.outline(box(left + 0.2, ends[0], right - 0.2, ends[1]), 0.7 * sheet.pen_px, INK)


def _shed(canvas: Canvas, body: Polygon, sheet: Survey) -> None:
    left, bottom, right, top = body.bounds
    canvas.outline(body, sheet.pen_px, INK)
    canvas.line([(left, bottom), (right, top)], 0.6 * sheet.pen_px, INK)
    canvas.line([(left, top), (right, bottom)], 0.6 * sheet.pen_px, INK)


def _squared(storey: Storey, size: Cottage) -> BaseGeometry:
    """The walls' material, whose gables end square at the front."""
    half, front = size.gable / 2.0, size.outer / 2.0
    ends = [box(x - half, -front, x + half, half) for x in (0.0, size.wide)]
    outside = [box(x - half - 1.0, -half - 1.0, x + half + 1.0, -front) for x in (0.0, size.wide)]
    return unary_union([solid_walls(storey), *ends]).difference(unary_union(outside))


def _house(canvas: Canvas, storey: Storey, size: Cottage, sheet: Survey) -> tuple[Fitting, ...]:
    solid = _squared(storey, size)
    faces = (size.gable / 2.0, size.wide - size.gable / 2.0)
    middle, half = size.deep / 2.0, BREAST_M[0] / 2.0
    breasts = [
        box(face - side * 0.02, middle - half, face + side * BREAST_M[1], middle + half)
        for face, side in zip(faces, (1.0, -1.0), strict=True)
    ]
    places = [
        box(face + side * 0.2, middle - 0.45, face + side * (BREAST_M[1] + 0.05), middle + 0.45)
        for face, side in zip(faces, (1.0, -1.0), strict=True)
    ]
    body = unary_union([solid, *breasts]).difference(unary_union(places))
    canvas.fill(body, (252, 251, 247) if sheet.hatched else (70, 70, 70))
    if sheet.hatched:
        canvas.hatch(body, 0.12, 0.7 * sheet.pen_px, INK)
    canvas.outline(body, 1.6 * sheet.pen_px, INK)
    for opening in storey.openings:
        wall = storey.wall(opening.wall)
        (_window if opening.kind == "window" else _door)(canvas, wall, opening, sheet)
    return _fittings(canvas, storey, 0.7 * sheet.pen_px)


def _fittings(canvas: Canvas, storey: Storey, pen: float) -> tuple[Fitting, ...]:
    fittings: list[Fitting] = []
    for room in storey.rooms:
        left, _, right, top = Polygon(room.outline_m).bounds
        if room.use == "bathroom":
            fittings += [
                bath(canvas, (right - 0.74, top - 1.74), pen, INK),
                closet(canvas, (left + 0.02, top - 0.6), pen, INK),
                basin(canvas, (left + 0.02, top - 1.3), pen, INK),
            ]
        elif room.use == "bedroom" and right - left > 3.0:
            fittings.append(bed(canvas, (left + 0.1, top - 2.02), pen, INK))
    return tuple(fittings)


def _window(canvas: Canvas, wall: Wall, opening: Opening, sheet: Survey) -> None:
    """The glass near the outer face, the reveal's two faces, and the inner sill."""
    place = place_of(wall, opening)
    out = 1.0 if wall.left is None else -1.0
    half = place.half_m
    for side in (-half, half, out * (half - 0.12), out * (half - 0.17)):
        canvas.line([place.at(0.0, side), place.at(place.width_m, side)], 0.8 * sheet.pen_px, INK)


def _door(canvas: Canvas, wall: Wall, opening: Opening, sheet: Survey) -> None:
    """An open leaf as a line, its arc, and both faces of the wall across the way."""
    place = place_of(wall, opening)
    side = 1.0 if opening.swing == "left" else -1.0
    wide, base = place.width_m, side * place.half_m
    hinge, towards = (0.0, 1.0) if opening.hinge == "start" else (wide, -1.0)
    arc = place.sweep((hinge, base), towards * wide, side, 24)
    canvas.line([place.at(hinge, base), arc[0]], 1.5 * sheet.pen_px, INK)
    canvas.line(arc, 0.6 * sheet.pen_px, INK)
    for face in (-place.half_m, place.half_m):
        canvas.line([place.at(0.0, face), place.at(wide, face)], 0.4 * sheet.pen_px, PALE)


def _chains(canvas: Canvas, storey: Storey, size: Cottage, sheet: Survey) -> None:
    """Sizes in centimetres along the front and the left gable, with slanted ticks."""
    left, bottom, right, _ = whole_walls(storey.walls).bounds
    along = [left, right]
    for opening in storey.openings:
        wall = storey.wall(opening.wall)
        if wall.outer and wall.start_m[1] == wall.end_m[1] == 0.0:
            place = place_of(wall, opening)
            along += [float(place.first[0]), float(place.second[0])]
    height = float(np.clip(0.13 / sheet.metres_per_px, 8.0, 12.0))
    level = bottom - 0.75
    canvas.line([(left - 0.2, level), (right + 0.2, level)], 0.5 * sheet.pen_px, INK)
    ticks = sorted(along)
    for x in ticks:
        canvas.line([(x - 0.08, level - 0.08), (x + 0.08, level + 0.08)], sheet.pen_px, INK)
        canvas.line([(x, level - 0.12), (x, bottom - 0.2)], 0.4 * sheet.pen_px, INK)
    for low, high in zip(ticks, ticks[1:], strict=False):
        if high - low > 0.3:
            text = f"{100.0 * (high - low):.0f}"
            canvas.text(text, ((low + high) / 2.0, level + 0.13), height, "sans", INK)


def _section(canvas: Canvas, storey: Storey, sheet: Survey) -> None:
    """A section line from side to side: long dashes and dots, and an arrow with its letter."""
    left, _, right, top = whole_walls(storey.walls).bounds
    level = 0.14 * top
    for x in np.arange(left - 0.9, right + 0.9, 0.75):
        canvas.line([(x, level), (x + 0.5, level)], 0.7 * sheet.pen_px, INK)
        canvas.outline(Point(x + 0.62, level).buffer(0.012), 0.7 * sheet.pen_px, INK)
    for x, word in ((left - 0.95, "A"), (right + 0.95, "A'")):
        canvas.fill(Polygon([(x - 0.12, level), (x + 0.12, level), (x, level + 0.25)]), INK)
        canvas.text(word, (x, level - 0.2), 0.2 / sheet.metres_per_px, "sans", INK, 600)


def _words(
    canvas: Canvas, storey: Storey, sheet: Survey, seed: int
) -> list[tuple[tuple[float, float], int]]:
    """Names and areas; where the lines of unread signs under them go, and how high they are."""
    names = NAMES[seed % len(NAMES)]
    height = float(np.clip(0.2 / sheet.metres_per_px, 11.0, 17.0))
    below = []
    for room in storey.rooms:
        left, bottom, right, top = Polygon(room.outline_m).bounds
        narrow = room.use in ("hall", "bathroom")
        across, up = (left + right) / 2.0 + 0.1, 0.55 if narrow else 0.58
        if room.use == "bedroom" and right - left > 3.0:
            across = max(across, (left + 1.5 + right) / 2.0)  # beside the bed
        at = (across, bottom + up * (top - bottom))
        canvas.text(names[room.use], at, height, "italic", INK, 500)
        line = height * sheet.metres_per_px
        area = f"{room.area_m2:.1f} m²".replace(".", ",")
        canvas.text(area, (at[0], at[1] - 1.4 * line), 0.9 * height, "italic", INK, 400)
        if not narrow:
            below.append(((at[0], at[1] - 2.3 * line), round(1.3 * height)))
    return below
