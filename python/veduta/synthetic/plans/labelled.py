"""A surveyor's quick sheet whose windows are told by words alone: no glass is drawn.

The wall has a gap, or one line runs on through it, or the whole outline is one line on which two
ticks say where a window begins and ends. What it is stands beside it: a number as in a schedule of
windows, or the word in the language of the sheet.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from shapely import unary_union
from shapely.geometry import Polygon
from shapely.geometry.base import BaseGeometry

from veduta.synthetic.plans.bodies import opening_area, solid_walls, whole_walls
from veduta.synthetic.plans.bungalow import Bungalow, bungalow
from veduta.synthetic.plans.canvas import Canvas, Colour, Image
from veduta.synthetic.plans.house import Opening, Storey, Use, Wall
from veduta.synthetic.plans.places import Place, place_of
from veduta.synthetic.plans.truth_file import SheetTruth
from veduta.synthetic.seeds import stream

INK: Colour = (26, 26, 28)
GREY: Colour = (120, 120, 122)
WHITE: Colour = (255, 255, 255)
NAMES: Mapping[str, Mapping[Use, str]] = {
    "de": {"living": "Wohnen", "hall": "Flur", "bedroom": "Zimmer", "study": "Büro",
           "bathroom": "Bad", "garage": "Garage"},
    "en": {"living": "Living Room", "hall": "Hall", "bedroom": "Bedroom", "study": "Study",
           "bathroom": "Bathroom", "garage": "Garage"},
}  # fmt: skip


@dataclass(frozen=True)
class Manner:
    """`glass`: a gap, one line, or ticks on an outline that is a line.

    `label`: numbers, or words with sizes or without.
    """

    px_per_m: float
    pen_px: float
    glass: str
    label: str
    language: str
    ink: Colour


def labelled_sheet(seed: int) -> tuple[Image, list[SheetTruth]]:
    """The sheet (h, w, 3) of a seed, and the truth of its one storey."""
    rng = stream(seed, "labelled sheet")

    def some(*names: str) -> str:
        return names[int(rng.integers(len(names)))]

    manner = Manner(
        float(rng.uniform(52.0, 76.0)), float(rng.uniform(1.1, 1.7)),
        some("gap", "line", "ticks"), some("number", "word", "sized"), some("de", "en"),
        INK if rng.random() < 0.5 else GREY,
    )  # fmt: skip
    storey, size = bungalow(seed, float(rng.choice([0.24, 0.3, 0.36])), 0.12)
    bounds = (-1.8, -2.4, size.wide + size.garage + 1.8, size.deep + 1.8)
    canvas = Canvas(bounds, 1.0 / manner.px_per_m, WHITE)
    sheet = _Sheet(canvas, storey, size, manner, rng)
    sheet.walls()
    numbers = {"window": 0, "door": 0}
    for opening in storey.openings:
        wall = storey.wall(opening.wall)
        place = place_of(wall, opening)
        if opening.kind == "window":
            numbers["window"] += 1
            sheet.window(opening, wall, place, numbers["window"])
        else:
            numbers["door"] += 1
            sheet.door(opening, wall, place)
    sheet.names()
    sheet.whole_width()
    truth = SheetTruth(
        f"labelled-{seed:05d}.png", seed, "labelled", "clean", ("labelled",), "filled",
        canvas.px_from_m, True, None, storey, None,
    )  # fmt: skip
    return canvas.picture(), [truth]


def parts_of(shape: BaseGeometry) -> list[Any]:
    """The single geometries of one that may have several."""
    return list(getattr(shape, "geoms", [shape]))


@dataclass(frozen=True)
class _Sheet:
    """What is drawn on, and what is drawn."""

    canvas: Canvas
    storey: Storey
    size: Bungalow
    manner: Manner
    rng: np.random.Generator

    @property
    def thin(self) -> bool:
        """Whether the outline is a line."""
        return self.manner.glass == "ticks"

    def walls(self) -> None:
        """Filled; an outline that is a line is that of the rooms' faces."""
        solid = solid_walls(self.storey)
        if not self.thin:
            self.canvas.fill(solid, self.manner.ink)
            self.canvas.outline(solid, self.manner.pen_px, INK)
            return
        inner = tuple(one for one in self.storey.walls if not one.outer)
        holes = [
            opening_area(self.storey.wall(one.wall), one)
            for one in self.storey.openings
            if not self.storey.wall(one.wall).outer
        ]
        shell = whole_walls(tuple(one for one in self.storey.walls if one.outer))
        body = whole_walls(inner).difference(unary_union([*holes, shell]))
        self.canvas.fill(body, self.manner.ink)
        self.canvas.outline(body, self.manner.pen_px, INK)
        whole = whole_walls(self.storey.walls)
        within = unary_union([Polygon(one.exterior) for one in parts_of(whole)]).difference(shell)
        doors = [
            opening_area(self.storey.wall(one.wall), one, 0.1)
            for one in self.storey.openings
            if one.kind == "door" and self.storey.wall(one.wall).outer
        ]
        faces = unary_union([one.exterior for one in parts_of(within)])
        for line in parts_of(faces.difference(unary_union(doors))):
            self.canvas.line(list(line.coords), self.manner.pen_px, INK)

    def window(self, opening: Opening, wall: Wall, place: Place, number: int) -> None:
        """One line, two ticks or nothing, and the label beside it."""
        pen, wide, half = self.manner.pen_px, place.width_m, place.half_m
        inside = 1.0 if wall.right is None else -1.0
        if self.manner.glass == "line":
            side = inside * half * float(self.rng.choice([-1.0, 0.0]))
            self.canvas.line([place.at(0.0, side), place.at(wide, side)], pen, INK)
        if self.manner.glass == "ticks":
            face = inside * half
            for along in (0.0, wide):
                ends = [place.at(along, face - 0.1), place.at(along, face + 0.1)]
                self.canvas.line(ends, pen, INK)
        word = {"de": "Fenster", "en": "window"}[self.manner.language]
        text = {
            "number": f"{'F' if self.manner.language == 'de' else 'W'}{number}",
            "word": word,
            "sized": f"{word} {opening.width_m:.2f}",
        }[self.manner.label]
        away = half + 0.3
        spot = place.at(wide / 2.0, (inside if self.rng.random() < 0.5 else -inside) * away)
        upright = abs(place.along[0]) > 0.5
        at = (float(spot[0]), float(spot[1]))
        self.canvas.text(text, at, max(0.17 * self.manner.px_per_m, 9.0), "sans", INK,
                         upright=upright)  # fmt: skip

    def door(self, opening: Opening, wall: Wall, place: Place) -> None:
        """A leaf and its quarter; a garage's door is a line."""
        pen, wide = self.manner.pen_px, place.width_m
        if opening.type == "garage":
            face = (1.0 if wall.right is None else -1.0) * place.half_m if self.thin else 0.0
            self.canvas.line([place.at(0.0, face), place.at(wide, face)], pen, INK)
            return
        side = 1.0 if opening.swing == "left" else -1.0
        base = side * place.half_m
        hinge, towards = (0.0, 1.0) if opening.hinge == "start" else (wide, -1.0)
        self.canvas.line([place.at(hinge, base), place.at(hinge, base + side * wide)], pen, INK)
        self.canvas.line(place.sweep((hinge, base), towards * wide, side, 24), 0.8 * pen, INK)

    def names(self) -> None:
        """The name of each room, its area below."""
        beds = 0
        for room in self.storey.rooms:
            left, bottom, right, top = Polygon(room.outline_m).bounds
            at = ((left + right) / 2.0, bottom + 0.5 * (top - bottom))
            if room.use == "hall":
                at = ((left + right) / 2.0 - 1.4, (self.size.low + self.size.high) / 2.0 + 0.15)
            name = NAMES[self.manner.language][room.use]
            if room.use == "bedroom":
                beds += 1
                name = f"{name} {beds}"
            height = max(0.24 * self.manner.px_per_m, 11.0)
            self.canvas.text(name, at, height, "sans", INK)
            area = f"{room.area_m2:.2f} m²"
            if self.manner.language == "de":
                area = area.replace(".", ",")
            under = (at[0], at[1] - 1.4 * height / self.manner.px_per_m)
            self.canvas.text(area, under, 0.8 * height, "sans", INK)

    def whole_width(self) -> None:
        """The house's whole width as a dimension below it."""
        half = 0.0 if self.thin else self.storey.walls[0].thickness_m / 2.0
        low, high, level = -half, self.size.wide + half, -1.4
        if self.thin:
            inset = max(one.thickness_m for one in self.storey.walls) / 2.0
            low, high = inset, self.size.wide - inset
        self.canvas.line([(low, level), (high, level)], 1.0, INK)
        for x in (low, high):
            self.canvas.line([(x, level - 0.15), (x, level + 0.15)], 1.0, INK)
        text = f"{high - low:.2f} m"
        if self.manner.language == "de":
            text = text.replace(".", ",")
        at = ((low + high) / 2.0, level + 0.25)
        self.canvas.text(text, at, max(0.2 * self.manner.px_per_m, 10.0), "sans", INK)
