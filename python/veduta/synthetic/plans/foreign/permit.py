"""A German drawing for a permit: walls of two lines, rooms stamped with tables, offices' stamps.

New walls may be pale red. Each room has a boxed table of name, area, perimeter and height; a
section runs through the house; levels stand in triangles; a round seal and a
slanted word lie over it all.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import cv2
import numpy as np
from shapely.geometry import Point, Polygon, box

from veduta.synthetic.plans.bodies import solid_walls, whole_walls
from veduta.synthetic.plans.canvas import Canvas, Colour, Image
from veduta.synthetic.plans.drawing import kept_free
from veduta.synthetic.plans.foreign.floors import chain, floor_of, leaves_of, slanted, width_m
from veduta.synthetic.plans.furniture import draw_things, furnish
from veduta.synthetic.plans.house import Opening, Room, Storey, Wall
from veduta.synthetic.plans.labels import spot_within
from veduta.synthetic.plans.names import FULL
from veduta.synthetic.plans.places import place_of
from veduta.synthetic.plans.stock_doors import DRAWN, Pen
from veduta.synthetic.plans.styles import Style
from veduta.synthetic.plans.truth_file import SheetTruth
from veduta.synthetic.seeds import stream

INK: Colour = (26, 26, 30)
STAMPS: tuple[Colour, ...] = ((190, 40, 44), (40, 60, 150), (30, 120, 80))
WORDS = ("GENEHMIGT", "GEPRÜFT", "EINGEGANGEN")


@dataclass(frozen=True)
class Manner:
    """Of a drawing: its pen, the tint of its walls, whether a room's table has a box."""

    pen_px: float
    tint: Colour
    boxed: bool
    long: bool


def permit_drawing(seed: int) -> tuple[Image, list[SheetTruth]]:
    """The sheet (h, w, 3) of a seed, and the truth of its one storey."""
    rng = stream(seed, "permit drawing")
    manner = Manner(
        float(rng.uniform(1.1, 1.6)), (255, 255, 255) if rng.random() < 0.6 else (244, 196, 190),
        bool(rng.random() < 0.7), bool(rng.random() < 0.6),
    )  # fmt: skip
    storey = floor_of(seed, "permit drawing", "de")
    left, bottom, right, top = whole_walls(storey.walls).bounds
    canvas = Canvas((left - 2.8, bottom - 2.6, right + 1.8, top + 1.6),
                    1.0 / float(rng.uniform(56.0, 78.0)), (255, 255, 255))  # fmt: skip
    solid = solid_walls(storey)
    canvas.fill(solid, manner.tint)
    canvas.outline(solid, manner.pen_px, INK)
    for opening in storey.openings:
        _opening(canvas, storey.wall(opening.wall), opening, manner)
    for flight in storey.stairs:
        for step in flight.steps_m or (flight.outline_m,):
            canvas.line(step, 0.6 * manner.pen_px, INK, closed=True)
    _rooms(canvas, storey, manner, rng)
    _outside(canvas, storey, manner)
    _section(canvas, (left, bottom, right, top), float(rng.uniform(0.25, 0.75)), manner)
    picture = _stamped(canvas, (left, bottom, right, top), rng)
    truth = SheetTruth(
        f"permit-{seed:05d}.png", seed, "permit", "clean", ("permit",), "hollow",
        canvas.px_from_m, True, None, storey,
    )  # fmt: skip
    return picture, [truth]


def _opening(canvas: Canvas, wall: Wall, opening: Opening, manner: Manner) -> None:
    """A frame between reveals, or a leaf of two lines with its arc and a threshold's height."""
    place = place_of(wall, opening)
    wide, half, pen = place.width_m, place.half_m, 0.7 * manner.pen_px
    if opening.kind == "window":
        for side in (-half, half):
            canvas.line([place.at(0.0, side), place.at(wide, side)], pen, INK)
        canvas.outline(place.box(0.0, wide, -0.04, 0.04), pen, INK)
        upright = abs(place.along[0]) > abs(place.along[1])
        at = place.at(wide / 2.0, half + 0.14)
        canvas.text("BRH 90", (float(at[0]), float(at[1])), 9.0, "sans", INK, 400, upright)
        return
    if opening.type not in ("swing", "double", "french"):
        DRAWN[opening.type](Pen(canvas, pen, INK), opening, place, True)
        return
    for hinge, length, side in leaves_of(opening):
        base = side * half
        leaf = place.box(
            hinge, hinge + math.copysign(0.05, length), base, base + side * abs(length)
        )
        canvas.outline(leaf, pen, INK)
        canvas.line(place.sweep((hinge, base), length, side, 24), 0.7 * pen, INK)


def _table(room: Room, name: str, manner: Manner) -> list[str]:
    area = f"{room.area_m2:.2f}".replace(".", ",")
    around = f"{Polygon(room.outline_m).length:.2f}".replace(".", ",")
    lines = [name, f"F: {area} m²", f"U: {around} m", "H: 2,50 m"]
    return lines if manner.long else lines[:2]


def _rooms(canvas: Canvas, storey: Storey, manner: Manner, rng: np.random.Generator) -> None:
    busy, beds = kept_free(storey), 0
    height = float(np.clip(0.16 / canvas.metres_per_px, 10.0, 14.0))
    step = 1.35 * height * canvas.metres_per_px
    for room in storey.rooms:
        beds += room.use == "bedroom"
        names = FULL["de"][room.use]
        name = names[int(rng.integers(len(names)))].format(n=beds)
        for lines in (_table(room, name, manner), _table(room, name, manner)[:2], [name]):
            wide = max(width_m(canvas, line, height) for line in lines) + 0.14
            spot = spot_within(Polygon(room.outline_m).difference(busy), wide, step * len(lines))
            if spot is not None:
                break
        if spot is None:
            continue
        if manner.boxed and len(lines) > 1:
            canvas.outline(box(*spot), 0.6 * manner.pen_px, INK)
            canvas.line([(spot[0], spot[3] - step), (spot[2], spot[3] - step)], 0.6, INK)
        for number, line in enumerate(lines):
            at = ((spot[0] + spot[2]) / 2.0, spot[3] - (number + 0.5) * step)
            canvas.text(line, at, height, "sans", INK, 600 if number == 0 else 400)
        busy = busy.union(box(*spot).buffer(0.05))
    style = Style("permit", "unseen", "de", ink=INK, pen_px=0.8 * manner.pen_px)
    draw_things(canvas, style, furnish(rng, storey, 0.5, busy))


def _outside(canvas: Canvas, storey: Storey, manner: Manner) -> None:
    """Rows below and at the left: the openings of that side, the whole."""
    left, bottom, right, top = whole_walls(storey.walls).bounds
    height = float(np.clip(0.15 / canvas.metres_per_px, 9.5, 13.0))
    for axis, (low, high), edge in ((0, (left, right), bottom), (1, (bottom, top), left)):
        cuts = {low, high}
        for opening in storey.openings:
            wall = storey.wall(opening.wall)
            ends = (wall.start_m[1 - axis], wall.end_m[1 - axis])
            if wall.outer and ends[0] == ends[1] and ends[0] < edge + 0.4:
                place = place_of(wall, opening)
                cuts |= {round(float(end[axis]), 3) for end in (place.first, place.second)}
        for places, away in ((sorted(cuts), 0.8), ([low, high], 1.4)):
            chain(canvas, places, edge - away, axis == 0, 0.6 * manner.pen_px, INK, _metres,
                  height, "tick", 0.3)  # fmt: skip


def _metres(size: float) -> str:
    """Metres with a comma, centimetres below one."""
    return f"{size * 100:.0f}" if size < 1.0 else f"{size:.2f}".replace(".", ",")


def _section(
    canvas: Canvas, bounds: tuple[float, float, float, float], share: float, manner: Manner
) -> None:
    """Dashes and dots through the house with an arrow at either end, and two levels."""
    left, bottom, right, top = bounds
    x = left + share * (right - left)
    level = bottom - 0.5
    while level < top + 0.6:
        canvas.line([(x, level), (x, min(level + 0.5, top + 0.6))], manner.pen_px, INK)
        canvas.line([(x, level + 0.6), (x, level + 0.64)], manner.pen_px, INK)
        level += 0.75
    for y in (bottom - 0.5, top + 0.65):
        canvas.line([(x, y), (x + 0.35, y)], 1.8 * manner.pen_px, INK)
        canvas.fill(Polygon([(x + 0.35, y - 0.1), (x + 0.55, y), (x + 0.35, y + 0.1)]), INK)
        canvas.text("A", (x + 0.2, y + 0.2), 0.2 / canvas.metres_per_px, "sans", INK, 700)
    at = (right + 0.7, (bottom + top) / 2.0)
    for shift, text in ((0.0, "±0,00"), (-0.9, "-0,15")):
        foot = (at[0], at[1] + shift)
        canvas.line([(foot[0] - 0.12, foot[1] + 0.2), foot, (foot[0] + 0.12, foot[1] + 0.2)], 1.0,
                    INK, closed=True)  # fmt: skip
        canvas.text(text, (foot[0] + 0.15, foot[1] + 0.34), 10.0, "sans", INK)


def _stamped(
    canvas: Canvas, bounds: tuple[float, float, float, float], rng: np.random.Generator
) -> Image:
    """A title at the foot, a round seal with a hand's name, and a slanted word over the plan."""
    left, bottom, right, top = bounds
    title = "Bauvorhaben: Neubau Einfamilienhaus   Grundriss EG   M 1:100"
    canvas.text(title, ((left + right) / 2.0, bottom - 2.2), 13.0, "sans", INK, 600)
    seal = STAMPS[int(rng.integers(len(STAMPS)))]
    at = (right - 0.4 - float(rng.uniform(0.0, 2.0)), bottom - 0.1 + float(rng.uniform(0.0, 1.2)))
    for radius in (0.95, 0.9, 0.6):
        canvas.outline(Point(at).buffer(radius), 1.2, seal)
    for turn in np.linspace(0.0, 2.0 * math.pi, 15)[:-1]:
        spot = (at[0] + 0.74 * math.sin(turn), at[1] + 0.74 * math.cos(turn))
        canvas.text("BAUAMTKREISORT"[round(turn / 0.449) % 14], spot, 10.0, "sans", seal)
    share = np.linspace(0.0, 1.0, 60)
    scrawl = np.column_stack(
        [at[0] - 1.0 + 2.0 * share, at[1] + 0.25 * np.sin(26.0 * share) * (1.0 - 0.7 * share)]
    )
    canvas.line(scrawl, 1.6, (40, 50, 130))
    picture = canvas.picture()
    middle = canvas.px_from_m[:2] @ (
        left + float(rng.uniform(0.35, 0.65)) * (right - left),
        bottom + float(rng.uniform(0.3, 0.7)) * (top - bottom), 1.0,
    )  # fmt: skip
    turn_deg = float(rng.uniform(8.0, 24.0))
    word = WORDS[int(rng.integers(len(WORDS)))]
    size = round(0.5 / canvas.metres_per_px)
    spot_px = (float(middle[0]), float(middle[1]))
    picture = slanted(picture, word, spot_px, size, turn_deg, seal, 0.75)
    wide = width_m(canvas, word, size) / canvas.metres_per_px
    frame = cv2.boxPoints((spot_px, (1.25 * wide, 1.6 * size), -turn_deg))
    cv2.polylines(picture, [np.round(frame).astype(np.int32)], True, seal, 2, cv2.LINE_AA)
    return picture
