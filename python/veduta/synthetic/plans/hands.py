"""House plans in six hands: seller, builder, agent, madori, old scan, ink sketch.

Each is drawn from what such sheets look like, and each has a way of its own for walls, windows,
doors and names: two tones of wall, two thicknesses, open leaves as thick as walls, walls of two
thin lines, brown paper with red walls, and a photographed sketch of single strokes.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
from shapely import unary_union
from shapely.geometry import Polygon, box
from shapely.geometry.base import BaseGeometry

from veduta.synthetic.plans.bodies import opening_area, solid_walls, whole_walls
from veduta.synthetic.plans.bungalow import Bungalow, bungalow
from veduta.synthetic.plans.canvas import Canvas, Colour, Image
from veduta.synthetic.plans.hand_papers import as_photo, as_scan, grass, planks
from veduta.synthetic.plans.house import Fitting, Opening, Room, Storey, Use, Wall
from veduta.synthetic.plans.places import Place, place_of
from veduta.synthetic.plans.sanitary import basin, bath, bed, closet, counter
from veduta.synthetic.plans.truth_file import SheetTruth
from veduta.synthetic.seeds import stream

HANDS = ("seller", "builder", "agent", "madori", "scan", "ink")
NAVY: Colour = (18, 22, 58)
GREY: Colour = (108, 108, 110)
INK: Colour = (24, 24, 26)
NAMES: Mapping[str, Mapping[Use, str]] = {
    "builder": {"living": "family / dining", "hall": "entry", "bedroom": "bed", "study": "study",
                "bathroom": "ens", "garage": "garage"},
    "agent": {"living": "Lounge", "hall": "Hall", "bedroom": "Bedroom", "study": "Study",
              "bathroom": "Shower", "garage": "Garage"},
    "madori": {"living": "LDK", "hall": "HALL", "bedroom": "ROOM", "study": "ROOM",
               "bathroom": "BATH", "garage": "GARAGE"},
    "scan": {"living": "Salon", "hall": "Entrée", "bedroom": "Chambre", "study": "Bureau",
             "bathroom": "Bains", "garage": "Garage"},
    "ink": {"living": "Living", "hall": "Hall", "bedroom": "Bedroom", "study": "Office",
            "bathroom": "Bath", "garage": "Garage"},
}  # fmt: skip


@dataclass(frozen=True)
class Hand:
    """What tells hands apart: thickness of walls, resolution, pen, paper."""

    outer_m: float
    inner_m: float
    px_per_m: tuple[float, float]
    pen_px: float
    paper: Colour = (255, 255, 255)


MANNERS: Mapping[str, Hand] = {
    "seller": Hand(0.3, 0.1, (58.0, 76.0), 1.0),
    "builder": Hand(0.24, 0.09, (36.0, 46.0), 0.8),
    "agent": Hand(0.28, 0.16, (44.0, 60.0), 1.3),
    "madori": Hand(0.17, 0.14, (56.0, 72.0), 1.2),
    "scan": Hand(0.46, 0.18, (64.0, 84.0), 1.2, (236, 224, 198)),
    "ink": Hand(0.08, 0.08, (70.0, 90.0), 5.0, (214, 205, 192)),
}


@dataclass(frozen=True)
class Sheet:
    """What a hand draws on, and what it draws."""

    canvas: Canvas
    storey: Storey
    size: Bungalow
    hand: str
    rng: np.random.Generator

    @property
    def manner(self) -> Hand:
        """Of this hand."""
        return MANNERS[self.hand]

    @property
    def pen(self) -> float:
        """Its thin pen, in pixels."""
        return self.manner.pen_px


def hand_drawn(seed: int, hand: str) -> tuple[Image, list[SheetTruth]]:
    """The sheet (h, w, 3) of a seed in a hand, and the truth of its one storey."""
    rng = stream(seed, f"hand {hand}")
    manner = MANNERS[hand]
    storey, size = bungalow(seed, manner.outer_m, manner.inner_m)
    pad = 3.4 if hand == "seller" else 1.8
    bounds = (-pad, -pad, size.wide + size.garage + pad, size.deep + pad)
    canvas = Canvas(bounds, 1.0 / float(rng.uniform(*manner.px_per_m)), manner.paper)
    sheet = Sheet(canvas, storey, size, hand, rng)
    _grounds(sheet)
    fittings = tuple(one for room in storey.rooms for one in _fittings(sheet, room))
    WALLS[hand](sheet)
    for opening in storey.openings:
        place = place_of(storey.wall(opening.wall), opening)
        _opening(sheet, opening, storey.wall(opening.wall), place)
    _names(sheet)
    says = hand in ("scan", "ink")
    if hand == "scan":
        _sizes(sheet)
    picture = canvas.picture()
    if hand == "scan":
        picture = as_scan(picture, rng)
    if hand == "ink":
        picture = as_photo(picture, rng)
    truth = SheetTruth(
        f"{hand}-{seed:05d}.png", seed, hand, "clean", (hand,),
        "single-line" if hand == "ink" else "hollow" if hand == "madori" else "filled",
        canvas.px_from_m, says, None, storey, fittings,
    )  # fmt: skip
    return picture, [truth]


def _two_tones(sheet: Sheet, outer: Colour, inner: Colour) -> None:
    """Outer walls in one tone, inner ones in another, as both are."""
    storey = sheet.storey
    thick = sheet.manner.outer_m - 0.01
    bearing = tuple(one for one in storey.walls if one.thickness_m >= thick)
    holes = [opening_area(storey.wall(one.wall), one) for one in storey.openings]
    shell = whole_walls(bearing).difference(unary_union(holes))
    sheet.canvas.fill(solid_walls(storey).difference(shell), inner)
    sheet.canvas.fill(shell, outer)


def _hollow(sheet: Sheet) -> None:
    sheet.canvas.outline(solid_walls(sheet.storey), sheet.pen, INK)


def _red(sheet: Sheet) -> None:
    solid = solid_walls(sheet.storey)
    sheet.canvas.fill(solid, (176, 84, 74))
    sheet.canvas.outline(solid, sheet.pen, (70, 48, 40))


def _stroked(sheet: Sheet) -> None:
    """One stroke for a wall, ended at openings; strokes overshoot a little at corners."""
    for wall in sheet.storey.walls:
        start, end = np.array(wall.start_m), np.array(wall.end_m)
        way = (end - start) / np.hypot(*(end - start))
        size = float(np.hypot(*(end - start)))
        own = sorted((one for one in sheet.storey.openings if one.wall == wall.id),
                     key=lambda one: one.along_m)  # fmt: skip
        ends = [-0.02, *(v for one in own for v in (one.along_m, one.along_m + one.width_m)),
                size + 0.02]  # fmt: skip
        for low, high in zip(ends[::2], ends[1::2], strict=True):
            sheet.canvas.line([start + low * way, start + high * way], sheet.pen, INK)


def _agent_walls(sheet: Sheet) -> None:
    """One tone, and a chimney breast in the open side's wall."""
    sheet.canvas.fill(solid_walls(sheet.storey), (46, 46, 48))
    if not sheet.size.slant:
        low = 0.62 * sheet.size.deep
        wall = sheet.manner.outer_m / 2.0
        sheet.canvas.fill(box(wall - 0.02, low, wall + 0.42, low + 1.5), (46, 46, 48))


WALLS: Mapping[str, Callable[[Sheet], None]] = {
    "seller": lambda sheet: _two_tones(sheet, NAVY, GREY),
    "builder": lambda sheet: _two_tones(sheet, INK, INK),
    "agent": _agent_walls,
    "madori": _hollow,
    "scan": _red,
    "ink": _stroked,
}


def _opening(sheet: Sheet, opening: Opening, wall: Wall, place: Place) -> None:
    if opening.kind == "window":
        _window(sheet, place)
    elif opening.type == "garage":
        sheet.canvas.outline(place.box(0.0, place.width_m, -0.04, 0.04), sheet.pen, INK)
    else:
        _leaf(sheet, opening, wall, place)


def _window(sheet: Sheet, place: Place) -> None:
    canvas, pen, half = sheet.canvas, sheet.pen, place.half_m
    wide = place.width_m
    area = place.box(0.0, wide, -half, half)
    canvas.fill(area, (228, 228, 228) if sheet.hand == "agent" else sheet.manner.paper)
    if sheet.hand == "ink":
        for side in (-0.05, 0.05):
            canvas.line([place.at(0.0, side), place.at(wide, side)], 2.5, INK)
        return
    for side in (-half, half):
        canvas.line([place.at(0.0, side), place.at(wide, side)], 0.8 * pen, INK)
    if sheet.hand in ("seller", "madori", "scan"):
        middle = wide / 2.0
        canvas.outline(place.box(0.02, middle + 0.05, -0.03, 0.0), 0.7 * pen, INK)
        canvas.outline(place.box(middle - 0.05, wide - 0.02, 0.0, 0.03), 0.7 * pen, INK)
    else:
        canvas.line([place.at(0.0, 0.0), place.at(wide, 0.0)], 0.8 * pen, INK)


def _leaf(sheet: Sheet, opening: Opening, wall: Wall, place: Place) -> None:
    """A door's leaf: at 45 degrees and thick, straight with its quarter, or straight alone."""
    canvas, pen, wide = sheet.canvas, sheet.pen, place.width_m
    side = 1.0 if opening.swing == "left" else -1.0
    base = side * place.half_m
    hinge, towards = (0.0, 1.0) if opening.hinge == "start" else (wide, -1.0)
    if sheet.hand == "agent":
        turn = math.radians(45.0)
        tip = place.at(hinge + towards * wide * math.cos(turn), base + side * wide * math.sin(turn))
        start = place.at(hinge, base)
        canvas.line([start, tip], 0.55 * sheet.manner.inner_m / canvas.metres_per_px, (46, 46, 48))
        return
    tip = place.at(hinge, base + side * wide)
    canvas.line([place.at(hinge, base), tip], (0.6 if sheet.hand == "ink" else 1.0) * pen, INK)
    if sheet.hand == "builder":
        return
    arc = place.sweep((hinge, base), towards * wide, side, 24)
    canvas.line(arc, (0.5 if sheet.hand == "ink" else 0.7) * pen, INK)
    if sheet.hand == "madori" and wall.outer:
        canvas.line([place.at(0.0, -base), place.at(wide, -base)], pen, INK)


def _grounds(sheet: Sheet) -> None:
    """What lies on floors and around the house: planks, tiles, grass, colours by use."""
    canvas, size, storey = sheet.canvas, sheet.size, sheet.storey
    if sheet.hand == "seller":
        lean = float(sheet.rng.uniform(0.4, 1.2))
        plot = Polygon([(-2.6, -2.6), (size.wide + size.garage + 2.6, -2.6),
                        (size.wide + size.garage + 2.6 - lean, size.deep + 2.6),
                        (-2.6, size.deep + 2.6)])  # fmt: skip
        house = unary_union([Polygon(room.outline_m).buffer(0.1) for room in storey.rooms])
        grass(canvas, plot.difference(house), sheet.rng)
        planks(canvas, box(-2.4, 0.3, -0.1, size.deep - 0.3).difference(house), sheet.rng)
        canvas.outline(plot, 1.0, (150, 150, 150))
    tints: Mapping[Use, Colour] = {
        "living": (205, 230, 244), "bedroom": (244, 222, 200), "study": (214, 243, 214),
        "hall": (230, 198, 234),
    }  # fmt: skip
    for room in storey.rooms:
        area = Polygon(room.outline_m)
        if sheet.hand == "madori" and room.use in tints:
            canvas.fill(area, tints[room.use])
        if sheet.hand == "builder" and room.use == "bathroom":
            _tiles(sheet, area)
        if sheet.hand == "builder" and room.use == "garage":
            _car(sheet, room)


def _tiles(sheet: Sheet, area: BaseGeometry) -> None:
    left, bottom, right, top = area.bounds
    sheet.canvas.fill(area, (232, 232, 234))
    for x in np.arange(left, right, 0.3):
        sheet.canvas.line([(x, bottom), (x, top)], 0.5, (176, 176, 180))
    for y in np.arange(bottom, top, 0.3):
        sheet.canvas.line([(left, y), (right, y)], 0.5, (176, 176, 180))


def _car(sheet: Sheet, room: Room) -> None:
    left, bottom, right, top = Polygon(room.outline_m).bounds
    x = left + 0.3 * (right - left)
    low = (bottom + top) / 2.0 - 2.1
    body = box(x + 0.3, low + 0.3, x + 1.3, low + 3.9).buffer(0.3)
    sheet.canvas.fill(body, (188, 188, 190))
    sheet.canvas.fill(box(x + 0.2, low + 1.2, x + 1.4, low + 1.7), (150, 150, 154))


def _fittings(sheet: Sheet, room: Room) -> tuple[Fitting, ...]:
    """Baths, beds, a counter in the open side; an ink sketch has none."""
    if sheet.hand in ("ink", "scan"):
        return ()
    left, _, right, top = Polygon(room.outline_m).bounds
    ink: Colour = (96, 96, 100) if sheet.hand in ("seller", "builder") else INK
    pen = 0.7 * sheet.pen
    if room.use == "bathroom":
        return (
            bath(sheet.canvas, (right - 0.74, top - 1.72), pen, ink),
            closet(sheet.canvas, (left + 0.01, top - 0.62), pen, ink),
            basin(sheet.canvas, (left + 0.01, top - 1.5), pen, ink),
        )
    if room.use == "bedroom" and sheet.hand != "agent":
        return (bed(sheet.canvas, (right - 1.55, top - 2.1), pen, ink),)
    if room.use == "living":
        return counter(sheet.canvas, (right, top - 3.0, top - 0.1), pen, ink)
    return ()


def _names(sheet: Sheet) -> None:
    """Names in rooms; a seller writes in a script of his own, which is too small to be read."""
    canvas, beds = sheet.canvas, 0
    names = NAMES.get(sheet.hand)
    for room in sheet.storey.rooms:
        left, bottom, right, top = Polygon(room.outline_m).bounds
        at = ((left + right) / 2.0, bottom + 0.42 * (top - bottom))
        if room.use == "hall":
            at = ((left + right) / 2.0 - 1.4, (sheet.size.low + sheet.size.high) / 2.0)
        height = max(0.26 / canvas.metres_per_px, 9.0)
        if names is None:
            wide, high = round((right - left) * 100), round((top - bottom) * 100)
            canvas.text(f"{wide} / {high}", at, 6.0, "sans", (90, 90, 96))
            continue
        name = names[room.use]
        if room.use == "bedroom":
            beds += 1
            name = f"{name} {beds}"
        style = "italic" if sheet.hand in ("scan", "ink") else "sans"
        colour = (120, 120, 120) if sheet.hand == "builder" else INK
        canvas.text(name, at, height, style, colour)
        under = (at[0], at[1] - 1.35 * height * canvas.metres_per_px)
        if sheet.hand == "ink" and room.use != "hall":
            size = f"{right - left:.1f} x {top - bottom:.1f}"
            canvas.text(size, under, 0.8 * height, style, INK)
        if sheet.hand == "scan":
            canvas.text(f"{room.area_m2:.2f} m²", under, 0.8 * height, style, INK)


def _sizes(sheet: Sheet) -> None:
    """The whole width of the house between its faces, as a dimension."""
    half = sheet.manner.outer_m / 2.0
    canvas, size = sheet.canvas, sheet.size
    level, low, high = -1.0, -half, size.wide + half
    canvas.line([(low, level), (high, level)], 1.0, INK)
    for x in (low, high):
        canvas.line([(x - 0.1, level - 0.1), (x + 0.1, level + 0.1)], 1.6, INK)
        canvas.line([(x, level - 0.2), (x, level + 0.2)], 1.0, INK)
    at = ((low + high) / 2.0, level + 0.22)
    canvas.text(f"{high - low:.2f}", at, 0.24 / canvas.metres_per_px, "italic", INK)
