"""The working drawing of a flat in a block, as building offices of Germany draw it.

Walls are hatched, grey or black, those of the stairs often otherwise than the rest. Chains of
sizes stand in rows outside and one runs through the rooms: metres from one metre on and
centimetres below, half centimetres raised; under the width of a window or a door stands its height.
The neighbours' walls go on a little beyond the party walls, and end at a break.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from shapely import unary_union
from shapely.geometry import Point, Polygon, box
from shapely.geometry.base import BaseGeometry

from veduta.synthetic.plans.block_flat import BlockFlat, block_flat
from veduta.synthetic.plans.bodies import opening_area, solid_walls
from veduta.synthetic.plans.canvas import Canvas, Colour, Image, text_size_px
from veduta.synthetic.plans.house import Fitting, Opening, Room, Storey, Use, Wall
from veduta.synthetic.plans.places import place_of
from veduta.synthetic.plans.sanitary import basin, bath, bed, closet, counter
from veduta.synthetic.plans.truth_file import SheetTruth
from veduta.synthetic.seeds import stream

INK: Colour = (20, 20, 24)
GREY: Colour = (168, 168, 168)
NAMES: Mapping[Use, tuple[str, ...]] = {
    "living": ("Wohnen", "Wohnzimmer", "Wohnen / Essen"), "bedroom": ("Schlafen", "Kind"),
    "storage": ("Abst.", "AR"), "hall": ("Flur", "Diele"), "kitchen": ("Küche", "Kochen"),
    "bathroom": ("Bad", "Bad / WC"), "stairs": ("Treppenhaus", "TRH"),
}  # fmt: skip
FLOORS = ("Parkett", "Laminat", "Fliesen")
BREAK_M = 0.9


@dataclass(frozen=True)
class Manner:
    """How a sheet is drawn: scale, pens, what fills walls, how numbers are written."""

    metres_per_px: float
    pen_px: float
    filled: str
    stairs_filled: str
    comma: str
    centimetres: bool
    heights: bool
    through: bool


def working_drawing(seed: int) -> tuple[Image, list[SheetTruth]]:
    """The sheet (h, w, 3) of a seed, and the truth of its one storey."""
    rng = stream(seed, "working drawing")
    filled = str(rng.choice(["hatched", "grey", "black"]))
    manner = Manner(
        1.0 / float(rng.uniform(62.0, 90.0)), float(rng.uniform(1.0, 1.6)), filled,
        "black" if rng.random() < 0.4 else filled, str(rng.choice([",", "."])),
        bool(rng.random() < 0.3), bool(rng.random() < 0.7), bool(rng.random() < 0.6),
    )  # fmt: skip
    storey, size = block_flat(seed)
    bounds = (-3.2, -4.3, size.wide + 2.4, size.deep + 2.9)
    canvas = Canvas(bounds, manner.metres_per_px, (255, 255, 255))
    _walls(canvas, storey, size, manner)
    for opening in storey.openings:
        wall = storey.wall(opening.wall)
        (_window if opening.kind == "window" else _door)(canvas, wall, opening, manner)
    _balcony(canvas, storey, manner)
    _stairwell(canvas, storey, manner)
    fittings = [one for room in storey.rooms for one in _fittings(canvas, room, manner)]
    _furniture(canvas, storey, manner)
    _outer_chains(canvas, storey, size, manner)
    if manner.through:
        _inner_chain(canvas, storey, manner)
    _labels(canvas, storey, manner, rng)
    _frame(canvas, bounds, manner, rng)
    truth = SheetTruth(
        f"working-{seed:05d}.png", seed, "working", "clean", ("working",),
        "hatched" if filled == "hatched" else "filled",
        canvas.px_from_m, True, None, storey, tuple(fittings),
    )  # fmt: skip
    return canvas.picture(), [truth]


def _walls(canvas: Canvas, storey: Storey, size: BlockFlat, manner: Manner) -> None:
    """What is cut: the flat's walls, and stubs of the neighbours' fronts."""
    half, party = size.outer / 2.0, size.party / 2.0
    ends = [
        box(x + low, y - half, x + high, y + half)
        for x, low, high in ((0.0, -BREAK_M, party), (size.wide, -party, BREAK_M))
        for y in (0.0, size.deep)
    ]
    solid = unary_union([solid_walls(storey), *ends])
    holes = [opening_area(storey.wall(one.wall), one) for one in storey.openings]
    solid = solid.difference(unary_union(holes))
    stairs = Polygon(next(one for one in storey.rooms if one.use == "stairs").outline_m)
    around = stairs.buffer(size.bearing + 0.02, join_style="mitre").intersection(solid)
    if manner.filled == manner.stairs_filled:
        _filled(canvas, solid, manner.filled, manner)
    else:
        _filled(canvas, solid.difference(around), manner.filled, manner)
        _filled(canvas, around, manner.stairs_filled, manner)
    canvas.outline(solid, 1.5 * manner.pen_px, INK)
    for x in (-BREAK_M, size.wide + BREAK_M):
        for y in (0.0, size.deep):
            zigzag = [(x, y - 0.35), (x, y - 0.08), (x - 0.12, y - 0.04), (x + 0.12, y + 0.04),
                      (x, y + 0.08), (x, y + 0.35)]  # fmt: skip
            canvas.line(zigzag, 0.6 * manner.pen_px, INK)


def _filled(canvas: Canvas, area: BaseGeometry, filled: str, manner: Manner) -> None:
    if filled == "hatched":
        canvas.hatch(area, 0.09, 0.6 * manner.pen_px, INK)
    else:
        canvas.fill(area, GREY if filled == "grey" else INK)


def _window(canvas: Canvas, wall: Wall, opening: Opening, manner: Manner) -> None:
    """The faces thin, the frame with its glass in the middle, a casement's quarter at times."""
    place = place_of(wall, opening)
    half, wide = place.half_m, place.width_m
    for side in (-half, half):
        canvas.line([place.at(0.0, side), place.at(wide, side)], 0.6 * manner.pen_px, INK)
    canvas.outline(place.box(0.0, wide, -0.035, 0.035), manner.pen_px, INK)
    canvas.line([place.at(0.05, 0.0), place.at(wide - 0.05, 0.0)], 0.5 * manner.pen_px, INK)


def _door(canvas: Canvas, wall: Wall, opening: Opening, manner: Manner) -> None:
    """A leaf of two lines standing open, its quarter, and the frame at both jambs."""
    place = place_of(wall, opening)
    side = 1.0 if opening.swing == "left" else -1.0
    wide, base = place.width_m, side * place.half_m
    hinge, towards = (0.0, 1.0) if opening.hinge == "start" else (wide, -1.0)
    leaf = place.box(hinge, hinge + towards * 0.04, base, base + side * wide)
    canvas.outline(leaf, 0.8 * manner.pen_px, INK)
    arc = place.sweep((hinge, base), towards * wide, side, 30)
    canvas.line(arc, 0.5 * manner.pen_px, INK)
    if wall.outer:  # a step of glass to the balcony
        canvas.line([place.at(0.0, -base), place.at(wide, -base)], 0.6 * manner.pen_px, INK)


def _balcony(canvas: Canvas, storey: Storey, manner: Manner) -> None:
    """A slab before the living room with a railing of two lines."""
    left, bottom, right, _ = Polygon(_room(storey, "living").outline_m).bounds
    low, thick = bottom - 1.75, storey.walls[0].thickness_m
    ring = [(left + 0.2, bottom - thick - 0.1), (left + 0.2, low), (right - 0.2, low),
            (right - 0.2, bottom - thick - 0.1)]  # fmt: skip
    canvas.line(ring, manner.pen_px, INK)
    inner = [(left + 0.26, bottom - thick - 0.1), (left + 0.26, low + 0.06),
             (right - 0.26, low + 0.06), (right - 0.26, bottom - thick - 0.1)]  # fmt: skip
    canvas.line(inner, 0.7 * manner.pen_px, INK)
    at = ((left + right) / 2.0, (low + bottom - thick) / 2.0)
    canvas.text("Balkon", at, 0.15 / manner.metres_per_px, "sans", INK)


def _room(storey: Storey, use: Use) -> Room:
    return next(one for one in storey.rooms if one.use == use)


def _stairwell(canvas: Canvas, storey: Storey, manner: Manner) -> None:
    """Two flights with a landing before the window, a cut, and the walking line."""
    left, bottom, right, top = Polygon(_room(storey, "stairs").outline_m).bounds
    low, high, middle = bottom + 1.55, top - 1.2, (left + right) / 2.0
    pen = 0.6 * manner.pen_px
    for level in np.linspace(low, high, round((high - low) / 0.27) + 1):
        canvas.line([(left, level), (middle - 0.05, level)], pen, INK)
        canvas.line([(middle + 0.05, level), (right, level)], pen, INK)
    canvas.outline(box(middle - 0.05, low, middle + 0.05, high), pen, INK)
    first, second = (left + middle) / 2.0, (middle + right) / 2.0
    path = [(second, low - 0.2), (second, high + 0.5), (first, high + 0.5), (first, low + 0.05)]
    canvas.line(path, pen, INK)
    canvas.line([(first - 0.08, low + 0.25), path[-1], (first + 0.08, low + 0.25)], pen, INK)
    cut = low + 0.45 * (high - low)
    for shift in (0.0, 0.07):
        canvas.line([(left, cut + shift), (middle - 0.05, cut + 0.35 + shift)], pen, INK)
    size = 0.12 / manner.metres_per_px
    canvas.text("16 Stg. 17,5 / 27", (middle, low - 0.35), size, "sans", INK)


def _fittings(canvas: Canvas, room: Room, manner: Manner) -> tuple[Fitting, ...]:
    left, _, right, top = Polygon(room.outline_m).bounds
    pen = 0.6 * manner.pen_px
    if room.use == "kitchen":
        bottom = top - 2.7
        return counter(canvas, (right, bottom + 0.25, top - 0.1), pen, INK)
    if room.use == "bathroom":
        return (
            bath(canvas, (right - 0.74, top - 1.72), pen, INK),
            closet(canvas, (left + 0.01, top - 0.62), pen, INK),
            basin(canvas, (left + 0.01, top - 1.5), pen, INK),
        )
    if room.use == "bedroom":
        x = left + 0.15 if right - left < 3.0 else right - 1.55
        return (bed(canvas, (x, top - 2.1), pen, INK),)
    return ()


def _furniture(canvas: Canvas, storey: Storey, manner: Manner) -> None:
    """A sofa, a table with chairs, a wardrobe: what a dwelling shall hold."""
    pen = 0.6 * manner.pen_px
    left, bottom, right, top = Polygon(_room(storey, "living").outline_m).bounds
    canvas.outline(box(left + 0.05, top - 2.6, left + 0.95, top - 0.5), pen, INK)
    canvas.outline(box(left + 0.25, top - 2.4, left + 0.95, top - 0.7), pen, INK)
    middle = (right - 1.2, bottom + 1.5)
    canvas.outline(Point(middle).buffer(0.5), pen, INK)
    for turn in np.linspace(0.0, 2.0 * math.pi, 5)[:-1]:
        x, y = middle[0] + 0.72 * math.cos(turn), middle[1] + 0.72 * math.sin(turn)
        canvas.outline(box(x - 0.2, y - 0.2, x + 0.2, y + 0.2), pen, INK)
    for room in storey.rooms:
        if room.use == "bedroom":
            left, bottom, right, _ = Polygon(room.outline_m).bounds
            narrow = right - left < 3.0
            x = right - 0.57 if narrow else left + 0.02
            robe = box(x, bottom + 1.1, x + 0.55, bottom + (1.5 if narrow else 2.6))
            canvas.outline(robe, pen, INK)
            x, y, xx, yy = robe.bounds
            canvas.line([(x, y), (xx, yy)], pen, INK)


def number(metres: float, manner: Manner) -> tuple[str, str]:
    """A size as it is written, and what is raised behind it: 3,76 and 88 with a raised 5."""
    half = round(metres * 200.0)
    raised = "5" if half % 2 else ""
    whole = half // 2
    if whole < 100 or manner.centimetres:
        return f"{whole}", raised
    return f"{whole // 100}{manner.comma}{whole % 100:02d}", raised


def _written(
    canvas: Canvas, metres: float, at: tuple[float, float], manner: Manner, upright: bool = True
) -> None:
    """A size about a point; what is raised stands smaller, at the upper end."""
    height = float(np.clip(0.15 / manner.metres_per_px, 9.5, 14.0))
    text, raised = number(metres, manner)
    canvas.text(text, at, height, "sans", INK, 400, upright)
    if raised:
        wide = text_size_px(text, height)[0] * manner.metres_per_px / 2.0
        away, up = wide + 0.03, 0.25 * height * manner.metres_per_px
        spot = (at[0] + away, at[1] + up) if upright else (at[0] - up, at[1] + away)
        canvas.text(raised, spot, 0.65 * height, "sans", INK, 400, upright)


def _chain(
    canvas: Canvas, places: Sequence[float], level: float, manner: Manner, upright: bool = True,
    under: Mapping[float, float] | None = None,
) -> None:  # fmt: skip
    """A row of sizes between places, along x (or y, read from the right), with slanted ticks."""

    def at(along: float, across: float) -> tuple[float, float]:
        return (along, across) if upright else (across, along)

    pen = 0.5 * manner.pen_px
    canvas.line([at(places[0] - 0.2, level), at(places[-1] + 0.2, level)], pen, INK)
    for one in places:
        canvas.line([at(one - 0.07, level - 0.07), at(one + 0.07, level + 0.07)], 2.4 * pen, INK)
        canvas.line([at(one, level - 0.12), at(one, level + 0.12)], pen, INK)
    above = 0.13 if upright else -0.13
    for low, high in pairwise(places):
        middle = (low + high) / 2.0
        if high - low > 0.08:
            _written(canvas, high - low, at(middle, level + above), manner, upright)
        tall = next((one for place, one in (under or {}).items() if low < place < high), None)
        if tall is not None:
            _written(canvas, tall, at(middle, level - above), manner, upright)


def _outer_chains(canvas: Canvas, storey: Storey, size: BlockFlat, manner: Manner) -> None:
    """Below and above: openings, rooms, the whole; at the left: rooms, the whole."""
    half, party = size.outer / 2.0, size.party / 2.0
    ends = [-party, size.wide + party]
    for y, away in ((0.0, -1.0), (size.deep, 1.0)):
        holes, tall = list(ends), {}
        for opening in storey.openings:
            wall = storey.wall(opening.wall)
            if wall.outer and wall.start_m[1] == wall.end_m[1] == y:
                place = place_of(wall, opening)
                holes += [float(place.first[0]), float(place.second[0])]
                tall[(holes[-1] + holes[-2]) / 2.0] = 1.385 if opening.kind == "window" else 2.26
        face = y + away * half
        start = face + away * (2.0 if away < 0 else 0.65)
        _chain(canvas, sorted(holes), start, manner, True, tall if manner.heights else None)
        rooms = _faces(storey, 0, y - away * (half + 0.4)) + ends
        _chain(canvas, sorted(rooms), start + away * 0.6, manner)
        _chain(canvas, ends, start + away * 1.15, manner)
    levels = [-half, *_faces(storey, 1, party + 0.4), size.deep + half]
    _chain(canvas, sorted(levels), -1.5, manner, False)
    _chain(canvas, [levels[0], levels[-1]], -2.1, manner, False)


def _faces(storey: Storey, axis: int, level: float) -> list[float]:
    """Where rooms begin and end along a line across the house at a level of the other axis."""
    found: set[float] = set()
    for room in storey.rooms:
        bounds = Polygon(room.outline_m).bounds
        if bounds[1 - axis] < level < bounds[3 - axis]:
            found |= {round(bounds[axis], 4), round(bounds[axis + 2], 4)}
    return sorted(found)


def _inner_chain(canvas: Canvas, storey: Storey, manner: Manner) -> None:
    """Through the rooms along the street, from face to face with the walls between."""
    _, bottom, _, top = Polygon(_room(storey, "living").outline_m).bounds
    level = bottom + 0.13 * (top - bottom)
    _chain(canvas, _faces(storey, 0, level), level, manner)


def _labels(canvas: Canvas, storey: Storey, manner: Manner, rng: np.random.Generator) -> None:
    beds = 0
    for room in storey.rooms:
        names = NAMES[room.use]
        name = names[int(rng.integers(len(names)))]
        if room.use == "bedroom":
            name, beds = names[beds], beds + 1
        left, bottom, right, top = Polygon(room.outline_m).bounds
        share = {"bathroom": 0.2, "stairs": 0.1, "kitchen": 0.2, "bedroom": 0.36}
        up = share.get(room.use, 0.55)
        height = float(np.clip(0.19 / manner.metres_per_px, 11.0, 16.0))
        line = 1.4 * height * manner.metres_per_px
        at = ((left + right) / 2.0, bottom + up * (top - bottom))
        canvas.text(name, at, height, "sans", INK, 600)
        if room.use == "stairs":
            continue
        area = f"{room.area_m2:.2f} m²".replace(".", manner.comma)
        canvas.text(area, (at[0], at[1] - line), 0.85 * height, "sans", INK)
        if room.use in ("living", "bedroom"):
            floor = FLOORS[int(rng.integers(len(FLOORS)))]
            canvas.text(floor, (at[0], at[1] - 1.9 * line), 0.7 * height, "sans", INK)


def _frame(
    canvas: Canvas, bounds: tuple[float, float, float, float], manner: Manner,
    rng: np.random.Generator,
) -> None:  # fmt: skip
    """The edge of the sheet, its title at the lower right, and the arrow to the north."""
    left, bottom, right, top = bounds
    canvas.outline(box(left + 0.25, bottom + 0.25, right - 0.25, top - 0.25), manner.pen_px, INK)
    field = box(right - 4.3, bottom + 0.25, right - 0.25, bottom + 1.05)
    canvas.outline(field, manner.pen_px, INK)
    storey = int(rng.integers(1, 4))
    size = 0.16 / manner.metres_per_px
    for row, line in enumerate((f"Grundriss {storey}. Obergeschoss", "Wohnung 5   M 1:100")):
        at = (right - 2.3, bottom + 0.8 - 0.3 * row)
        canvas.text(line, at, size, "sans", INK, 500)
    turn = math.radians(float(rng.uniform(-60.0, 60.0)))
    x, y = right - 0.9, bottom + 1.9
    canvas.outline(Point(x, y).buffer(0.38), 0.7 * manner.pen_px, INK)
    way = np.array([math.sin(turn), math.cos(turn)])
    side = np.array([way[1], -way[0]])
    middle = np.array([x, y])
    canvas.fill(
        Polygon([middle + 0.5 * way, middle - 0.3 * way + 0.14 * side, middle - 0.3 * way]), INK
    )
    tip = middle + 0.68 * way
    canvas.text("N", (float(tip[0]), float(tip[1])), 0.17 / manner.metres_per_px, "sans", INK, 700)
