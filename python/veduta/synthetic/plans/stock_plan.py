"""A builder's catalogue page: capitals, feet and inches, thin lines for all that is not wall.

Walls are two lines, or filled; a tub fills its alcove from wall to wall, counters, closet rods, a
hearth and an island are as thin as the faces of walls, dashes show trays in ceilings and the eaves.
The upper floor has a railing before what is open to below, which two long dashes cross.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from shapely import unary_union
from shapely.geometry import Polygon, box
from shapely.geometry.base import BaseGeometry

from veduta.synthetic.plans.bodies import opening_area, solid_walls, whole_walls
from veduta.synthetic.plans.canvas import Canvas, Colour, Image
from veduta.synthetic.plans.gallery import VOID, Gallery, gallery
from veduta.synthetic.plans.house import Storey, Use
from veduta.synthetic.plans.network import Thickness
from veduta.synthetic.plans.places import place_of
from veduta.synthetic.plans.ranch import WALK_IN, Ranch, ranch
from veduta.synthetic.plans.stock_doors import DRAWN, Pen
from veduta.synthetic.plans.stock_fittings import fitted
from veduta.synthetic.plans.truth_file import SheetTruth
from veduta.synthetic.seeds import stream

INK: Colour = (22, 22, 24)
WHITE: Colour = (255, 255, 255)
INCH_M = 0.0254
NAMES: Mapping[Use, tuple[str, ...]] = {
    "living": ("GREAT ROOM", "FAMILY ROOM"), "kitchen": ("KITCHEN",), "hall": ("FOYER", "ENTRY"),
    "corridor": ("HALL",), "bathroom": ("BATH",), "bedroom": ("BEDROOM", "BR."),
    "wardrobe": ("CLO.", "CLOSET"), "utility": ("LAUNDRY", "UTILITY"), "garage": ("2 CAR GARAGE",),
}  # fmt: skip


@dataclass(frozen=True)
class Manner:
    """Of a sheet: how `walls` are drawn, which of the dashes it has, how sizes are written."""

    px_per_m: float
    pen_px: float
    walls: str
    eaves: bool
    trays: bool
    sizes: str


def stock_plan(seed: int, floor: str = "ranch") -> tuple[Image, list[SheetTruth]]:
    """The sheet (h, w, 3) of a seed, and the truth of its one storey; `floor` ranch or gallery."""
    rng = stream(seed, f"stock plan {floor}")

    def some(*names: str) -> str:
        return names[int(rng.integers(len(names)))]

    manner = Manner(
        float(rng.uniform(46.0, 68.0)), float(rng.uniform(0.9, 1.4)),
        some("hollow", "hollow", "filled", "grey"), bool(rng.random() < 0.5),
        bool(rng.random() < 0.6), some("dashed", "spaced"),
    )  # fmt: skip
    thick = Thickness(float(rng.choice([0.15, 0.18, 0.2])), float(rng.choice([0.11, 0.12])))
    made = ranch if floor == "ranch" else gallery
    storey, size = made(seed, thick)
    left, bottom, right, top = whole_walls(storey.walls).bounds
    canvas = Canvas(
        (left - 2.0, bottom - 2.4, right + 2.0, top + 2.2), 1.0 / manner.px_per_m, WHITE
    )
    sheet = _Sheet(canvas, storey, size, manner, rng)
    fittings = fitted(sheet.pen, storey, size)
    sheet.dashes()
    sheet.walls()
    sheet.openings()
    if isinstance(size, Ranch):
        sheet.porches(size)
    else:
        sheet.void(size)
    sheet.names()
    sheet.whole_width()
    truth = SheetTruth(
        f"stock-{floor}-{seed:05d}.png", seed, f"stock-{floor}", "clean", ("stock",),
        "hollow" if manner.walls == "hollow" else "filled", canvas.px_from_m, True, None, storey,
        fittings,
    )  # fmt: skip
    return canvas.picture(), [truth]


@dataclass(frozen=True)
class _Sheet:
    """What is drawn on, and what is drawn."""

    canvas: Canvas
    storey: Storey
    size: Ranch | Gallery
    manner: Manner
    rng: np.random.Generator

    @property
    def pen(self) -> Pen:
        """The thin pen of all that is no wall."""
        return Pen(self.canvas, 0.8 * self.manner.pen_px, INK)

    def walls(self) -> None:
        """Two lines, or filled in black or grey."""
        solid = solid_walls(self.storey)
        tint = {"hollow": WHITE, "filled": INK, "grey": (140, 140, 142)}[self.manner.walls]
        self.canvas.fill(solid, tint)
        if self.manner.walls != "filled":
            self.canvas.outline(solid, self.manner.pen_px, INK)

    def openings(self) -> None:
        """Glass between the faces of walls, and doors in their ways."""
        for opening in self.storey.openings:
            wall = self.storey.wall(opening.wall)
            place = place_of(wall, opening)
            self.canvas.fill(opening_area(wall, opening, 0.0), WHITE)
            if opening.kind == "window":
                for side in (-place.half_m, 0.0, place.half_m):
                    ends = [place.at(0.0, side), place.at(place.width_m, side)]
                    self.canvas.line(ends, 0.8 * self.manner.pen_px, INK)
                for along in (0.0, place.width_m):
                    ends = [place.at(along, -place.half_m), place.at(along, place.half_m)]
                    self.canvas.line(ends, self.manner.pen_px, INK)
            else:
                DRAWN[opening.type](self.pen, opening, place, self.manner.walls == "hollow")

    def dashes(self) -> None:
        """The eaves around the house, and a tray in the ceiling of large rooms."""
        pen = 0.7 * self.manner.pen_px
        if self.manner.eaves:
            house = unary_union([Polygon(one.outline_m) for one in self.storey.rooms])
            self._dashed(house.envelope.buffer(0.65, join_style="mitre"), pen)
        for room in self.storey.rooms:
            left, bottom, right, top = Polygon(room.outline_m).bounds
            large = room.use in ("living", "bedroom") and room.area_m2 > 17.0
            if not (self.manner.trays and large):
                continue
            area = box(left + 0.7, bottom + (0.9 if room.use == "bedroom" else 0.8), right - 0.7,
                       top - 0.7)  # fmt: skip
            self._dashed(area, pen)
            if room.use == "bedroom":
                outer = area.bounds
                inner = area.buffer(-0.35, join_style="mitre")
                self._dashed(inner, pen)
                for a, b in ((0, 1), (2, 1), (2, 3), (0, 3)):
                    self.canvas.dashed(
                        (outer[a], outer[b]), (inner.bounds[a], inner.bounds[b]), pen, INK
                    )

    def _dashed(self, area: BaseGeometry, pen: float) -> None:
        ring = list(area.boundary.coords)
        for start, end in zip(ring, ring[1:], strict=False):
            self.canvas.dashed(start, end, pen, INK)

    def porches(self, size: Ranch) -> None:
        """A porch in the corner before the door with its posts, and a patio behind."""
        pen = 0.8 * self.manner.pen_px
        half = self.storey.walls[0].thickness_m
        low = -0.3
        self.canvas.line([(size.suite + 0.1, low), (size.foyer - 0.1, low)], pen, INK)
        for x in (size.suite + 0.28, size.foyer - 0.28):
            self.canvas.fill(box(x - 0.13, -0.13, x + 0.13, 0.13), INK)
        self._text("PORCH", ((size.suite + size.foyer) / 2.0, 0.45 * size.porch), 0.15)
        left, right = size.suite + 0.2, size.great - 0.2
        top = size.deep + 2.0
        foot = size.deep + half / 2.0
        self.canvas.line([(left, foot), (left, top), (right, top), (right, foot)], pen, INK)
        for x in (left + 0.2, right - 0.2):
            self.canvas.outline(box(x - 0.12, top - 0.32, x + 0.12, top - 0.08), pen, INK)
        self._text("COVERED PATIO", ((left + right) / 2.0, foot + 0.95), 0.17)

    def void(self, size: Gallery) -> None:
        """Two long dashes across, a railing of two lines, stairs with an arrow."""
        pen = 0.8 * self.manner.pen_px
        left, _, right, _ = size.flight
        edge = self.storey.walls[-1].thickness_m / 2.0
        ring = (size.left + edge, size.high + 0.06, size.right - edge, size.deep - edge)
        self.canvas.dashed((ring[0], ring[1]), (ring[2], ring[3]), pen, INK)
        self.canvas.dashed((ring[0], ring[3]), (ring[2], ring[1]), pen, INK)
        middle = ((ring[0] + ring[2]) / 2.0, (ring[1] + ring[3]) / 2.0)
        self.canvas.fill(box(middle[0] - 1.1, middle[1] - 0.25, middle[0] + 1.1, middle[1] + 0.25),
                         WHITE)  # fmt: skip
        words = ("OPEN TO BELOW", "VOID", "OPEN TO GREAT ROOM")
        self._text(words[int(self.rng.integers(len(words)))], middle, 0.18)
        for level in (size.high - 0.03, size.high + 0.03):
            self.canvas.line([(size.left + edge, level), (size.right - edge, level)], pen, INK)
        for x in np.arange(size.left + 0.9, size.right - 0.5, 1.2):
            self.canvas.outline(
                box(x - 0.05, size.high - 0.05, x + 0.05, size.high + 0.05), pen, INK
            )
        flight = self.storey.stairs[0]
        low, high = size.flight[1], size.flight[3]
        for x in np.linspace(left, right, flight.treads + 1):
            self.canvas.line([(x, low), (x, high)], pen, INK)
        self.canvas.line([(left, low - 0.03), (right, low - 0.03)], pen, INK)
        level = (low + high) / 2.0
        self.canvas.line([(left + 0.15, level), (right - 0.4, level)], pen, INK)
        self.canvas.line([(right - 0.6, level - 0.1), (right - 0.4, level),
                          (right - 0.6, level + 0.1)], pen, INK)  # fmt: skip
        self._text("DN", (left - 0.25, level), 0.16)

    def names(self) -> None:
        """The name of each room in capitals, its clear size below that of the larger ones."""
        beds, baths = 1, 1
        owners = isinstance(self.size, Ranch)
        for room in self.storey.rooms:
            if room.id == VOID and not owners:
                continue
            area = Polygon(room.outline_m)
            left, bottom, right, top = area.bounds
            names = NAMES[room.use]
            name = names[int(self.rng.integers(len(names)))]
            at = ((left + right) / 2.0, (bottom + top) / 2.0 + 0.1)
            if room.use == "bedroom":
                main = owners and room.area_m2 > 17.0
                beds += not main
                name = "OWNER'S SUITE" if main else f"{name} {beds}"
            elif room.use == "bathroom":
                main = owners and room.id != "r4"
                baths += not main
                name = "MASTER BATH" if main else f"{name} {baths}"
                at = (left + (0.6 if main else 0.66) * (right - left),
                      bottom + (0.62 if main else 0.5) * (top - bottom))  # fmt: skip
            elif room.id == WALK_IN and owners:
                name = "W.I.C."
            elif room.use == "wardrobe":
                at = (left + 0.36 * (right - left), at[1])
            elif room.use == "utility":
                at = (left + 0.55 * (right - left), top - 0.22)
            elif room.use == "hall" and not owners:
                name, at = "LANDING", (left + 0.3 * (right - left), bottom + 0.7)
            small = min(right - left, top - bottom) < 1.3
            self._text(name, at, 0.14 if small else 0.2, upright=right - left > 0.9)
            if room.use in ("living", "bedroom", "kitchen", "garage"):
                under = (at[0], at[1] - 0.36)
                size = f"{self._feet(right - left)} x {self._feet(top - bottom)}"
                if room.use != "kitchen":
                    self._text(size, under, 0.16)

    def _feet(self, metres: float) -> str:
        inches = round(metres / INCH_M)
        feet, rest = divmod(inches, 12)
        return f"{feet}'-{rest}\"" if self.manner.sizes == "dashed" else f"{feet}' {rest}\""

    def whole_width(self) -> None:
        """The house's whole width below it, between ticks."""
        left, bottom, right, _ = whole_walls(self.storey.walls).bounds
        level, pen = bottom - 1.3, 0.8 * self.manner.pen_px
        self.canvas.line([(left, level), (right, level)], pen, INK)
        for x in (left, right):
            self.canvas.line([(x, level - 0.15), (x, level + 0.15)], pen, INK)
            self.canvas.line([(x - 0.08, level - 0.08), (x + 0.08, level + 0.08)], 1.6 * pen, INK)
        self._text(self._feet(right - left), ((left + right) / 2.0, level + 0.22), 0.2)

    def _text(
        self, text: str, at: tuple[float, float], height_m: float, upright: bool = True
    ) -> None:
        height = max(height_m * self.manner.px_per_m, 8.5)
        self.canvas.text(text, at, height, "sans", INK, 450, upright)
