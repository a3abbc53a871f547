"""The plan of a flat as agents of Japan print it: panels that slide, mats, rooms in colours.

Two panels that slide past each other are two strokes or two thin boxes on tracks of their own, or
the faces of the wall, a line between them and a tick where they meet. A single panel hangs before
the wall, or slides into it; closets fold or open by a pair of leaves.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from shapely.geometry import Point, Polygon, box

from veduta.synthetic.plans.bodies import opening_area, solid_walls
from veduta.synthetic.plans.canvas import Canvas, Colour, Image
from veduta.synthetic.plans.house import Fitting, Opening, Storey, Use, Wall
from veduta.synthetic.plans.mansion import Mansion, mansion
from veduta.synthetic.plans.network import Thickness
from veduta.synthetic.plans.places import Place, place_of
from veduta.synthetic.plans.sanitary import basin, bath, closet, counter
from veduta.synthetic.plans.truth_file import SheetTruth
from veduta.synthetic.seeds import stream

INK: Colour = (30, 30, 32)
WHITE: Colour = (255, 255, 255)
TINTS: Mapping[Use, Colour] = {
    "living": (255, 246, 224), "kitchen": (255, 246, 224), "bedroom": (250, 232, 210),
    "hall": (246, 240, 228), "utility": (226, 240, 248), "bathroom": (214, 234, 246),
    "toilet": (226, 240, 248), "wardrobe": (240, 240, 240),
}  # fmt: skip
NAMES: Mapping[Use, tuple[str, ...]] = {
    "living": ("LD", "リビング"), "kitchen": ("K", "キッチン"), "bedroom": ("洋室",),
    "hall": ("廊下", "ホール"), "utility": ("洗面室",), "bathroom": ("浴室", "UB"),
    "toilet": ("WC", "トイレ"), "wardrobe": ("CL", "収納"),
}  # fmt: skip
MAT_M2 = 1.62


@dataclass(frozen=True)
class Manner:
    """Of a sheet: `walls` filled, grey or of two lines; how pairs of panels slide, and one alone.

    `tinted`: whether rooms have colours.
    """

    px_per_m: float
    pen_px: float
    walls: str
    pair: str
    single: str
    tinted: bool


def japanese_flat(seed: int) -> tuple[Image, list[SheetTruth]]:
    """The sheet (h, w, 3) of a seed, and the truth of its one storey."""
    rng = stream(seed, "japanese flat")

    def some(*names: str) -> str:
        return names[int(rng.integers(len(names)))]

    manner = Manner(
        float(rng.uniform(46.0, 72.0)), float(rng.uniform(1.0, 1.4)),
        some("filled", "filled", "grey", "hollow"), some("strokes", "boxes", "tick"),
        some("before", "before", "within"), bool(rng.random() < 0.6),
    )  # fmt: skip
    thick = Thickness(float(rng.choice([0.16, 0.2])), float(rng.choice([0.1, 0.12])))
    storey, size = mansion(seed, thick)
    bounds = (-1.2, -2.6, size.wide + 1.2, size.deep + 1.4)
    canvas = Canvas(bounds, 1.0 / manner.px_per_m, WHITE)
    sheet = _Sheet(canvas, storey, size, manner, rng)
    sheet.grounds()
    fittings = sheet.fittings()
    sheet.walls()
    for opening in storey.openings:
        wall = storey.wall(opening.wall)
        sheet.opening(opening, wall, place_of(wall, opening))
    sheet.balcony()
    sheet.names()
    truth = SheetTruth(
        f"japanese-{seed:05d}.png", seed, "japanese", "clean", ("japanese",),
        "hollow" if manner.walls == "hollow" else "filled",
        canvas.px_from_m, True, None, storey, fittings,
    )  # fmt: skip
    return canvas.picture(), [truth]


@dataclass(frozen=True)
class _Sheet:
    """What is drawn on, and what is drawn."""

    canvas: Canvas
    storey: Storey
    size: Mansion
    manner: Manner
    rng: np.random.Generator

    def line(self, *points: object, pen: float = 1.0) -> None:
        """A line through places in metres, so many pens thick."""
        self.canvas.line(list(points), pen * self.manner.pen_px, INK)  # type: ignore[arg-type]

    def grounds(self) -> None:
        """Colours of floors, and the mats of one room."""
        for number, room in enumerate(self.storey.rooms):
            area = Polygon(room.outline_m)
            if self.manner.tinted:
                mats = number == 1
                self.canvas.fill(area, (222, 236, 200) if mats else TINTS[room.use])

    def walls(self) -> None:
        """The material of walls in one of the manners."""
        solid = solid_walls(self.storey)
        if self.manner.walls == "filled":
            self.canvas.fill(solid, INK)
            return
        self.canvas.fill(solid, (150, 150, 152) if self.manner.walls == "grey" else WHITE)
        self.canvas.outline(solid, self.manner.pen_px, INK)

    def opening(self, opening: Opening, wall: Wall, place: Place) -> None:
        """A window or a door."""
        if opening.kind == "gap":
            return
        holes = opening_area(wall, opening, 0.0)
        self.canvas.fill(holes, WHITE)
        if opening.kind == "window":
            self._pair(place, faces=True)
        elif opening.type == "sliding":
            wide = place.width_m > 1.2
            (self._pair if wide else self._single)(place, faces=self.manner.walls == "hollow")
        else:
            draw = {"swing": self._swing, "double": self._double, "pocket": self._pocket,
                    "folding": self._folding}  # fmt: skip
            draw[opening.type](opening, place)

    def _pair(self, place: Place, faces: bool) -> None:
        """Two panels past each other."""
        wide, half = place.width_m, place.half_m
        middle = wide / 2.0
        if faces or self.manner.pair == "tick":
            for side in (-half, half):
                self.line(place.at(0.0, side), place.at(wide, side))
        if self.manner.pair == "tick":
            self.line(place.at(0.0, 0.0), place.at(wide, 0.0))
            reach = half + (0.0 if faces else 0.06)
            self.line(place.at(middle, -reach), place.at(middle, reach))
            return
        track = min(0.025, 0.4 * half)
        for low, high, side in ((0.0, middle + 0.04, track), (middle - 0.04, wide, -track)):
            if self.manner.pair == "strokes":
                self.line(place.at(low, side), place.at(high, side), pen=1.2)
            else:
                deep = max(track, 0.015)
                panel = place.box(low, high, min(0.0, np.sign(side) * deep),
                                  max(0.0, np.sign(side) * deep))  # fmt: skip
                self.canvas.outline(panel, 0.8 * self.manner.pen_px, INK)

    def _single(self, place: Place, faces: bool) -> None:
        """One panel before the wall, half open, or in a slot of the wall."""
        if self.manner.single == "within":
            self._slot(place)
            return
        wide, face = place.width_m, place.half_m
        open_by = float(self.rng.choice([0.15, 0.5]))
        low = -open_by * wide
        self.canvas.outline(
            place.box(low, low + wide + 0.03, face + 0.01, face + 0.05),
            0.8 * self.manner.pen_px, INK,
        )  # fmt: skip

    def _slot(self, place: Place) -> None:
        """A thin box that sticks out of the wall, and a dashed line where it shuts."""
        wide = place.width_m
        deep = min(0.03, 0.5 * place.half_m)
        self.canvas.fill(place.box(-0.8 * wide, 0.0, -deep, deep), WHITE)
        leaf = place.box(-0.75 * wide, 0.25 * wide, -0.5 * deep, 0.5 * deep)
        self.canvas.outline(place.box(-0.8 * wide, 0.0, -deep, deep), 0.7 * self.manner.pen_px, INK)
        self.canvas.outline(leaf, 0.7 * self.manner.pen_px, INK)
        self.canvas.dashed(place.at(0.25 * wide, 0.0), place.at(wide, 0.0), self.manner.pen_px, INK)

    def _pocket(self, _: Opening, place: Place) -> None:
        self._slot(place)

    def _swing(self, opening: Opening, place: Place) -> None:
        side = 1.0 if opening.swing == "left" else -1.0
        hinge, towards = (0.0, 1.0) if opening.hinge == "start" else (place.width_m, -1.0)
        self._leaf(place, hinge, towards * place.width_m, side)

    def _leaf(self, place: Place, hinge: float, length: float, side: float) -> None:
        base = side * place.half_m
        self.line(place.at(hinge, base), place.at(hinge, base + side * abs(length)), pen=1.1)
        self.canvas.line(
            place.sweep((hinge, base), length, side, 24), 0.7 * self.manner.pen_px, INK
        )

    def _double(self, opening: Opening, place: Place) -> None:
        """Two small leaves, as of a closet; its sill is a line."""
        side = 1.0 if opening.swing == "left" else -1.0
        half = place.width_m / 2.0
        self._leaf(place, 0.0, half, side)
        self._leaf(place, place.width_m, -half, side)

    def _folding(self, opening: Opening, place: Place) -> None:
        """A zigzag from each jamb, or from one of a narrow way."""
        side = 1.0 if opening.swing == "left" else -1.0
        wide, base = place.width_m, side * place.half_m
        pairs = ((0.0, 1.0), (wide, -1.0)) if wide > 1.1 else ((0.0, 1.0),)
        leaf = wide / (2.0 * len(pairs))
        for jamb, towards in pairs:
            run = 0.45 * leaf
            rise = float(np.sqrt(leaf**2 - run**2))
            points = [
                place.at(jamb + towards * step * run, base + side * rise * (step % 2))
                for step in range(3)
            ]
            self.line(*points, pen=1.1)

    def fittings(self) -> tuple[Fitting, ...]:
        """A tub along a wall, a counter, a basin, a toilet: at the walls."""
        found: list[Fitting] = []
        pen = 0.8 * self.manner.pen_px
        for room in self.storey.rooms:
            left, bottom, right, top = Polygon(room.outline_m).bounds
            if room.use == "bathroom":
                found.append(bath(self.canvas, (right - 0.72, bottom), pen, INK))
            if room.use == "kitchen":
                found += counter(self.canvas, (right, bottom + 0.02, top), pen, INK)
            if room.use == "utility":
                found.append(basin(self.canvas, (left, top - 0.7), pen, INK))
                area = box(left + 0.05, bottom + 0.05, left + 0.64, bottom + 0.64)
                self.canvas.outline(area, pen, INK)
                self.canvas.outline(Point(*area.centroid.coords[0]).buffer(0.22), pen, INK)
            if room.use == "toilet":
                found.append(closet(self.canvas, (left, bottom + 0.3), pen, INK))
        return tuple(found)

    def balcony(self) -> None:
        """A slab with a rail of two lines before the front."""
        half = self.storey.walls[0].thickness_m
        low, right = -1.5, self.size.wide
        for shift in (0.0, 0.1):
            self.line((shift, -half / 2.0), (shift, low + shift), (right - shift, low + shift),
                      (right - shift, -half / 2.0))  # fmt: skip
        self._text("バルコニー", (right / 2.0, -0.8), 0.24)

    def names(self) -> None:
        """The name of each room, and its size in mats of the larger ones."""
        for number, room in enumerate(self.storey.rooms):
            left, bottom, right, top = Polygon(room.outline_m).bounds
            names = NAMES[room.use]
            name = "和室" if number == 1 else names[int(self.rng.integers(len(names)))]
            at = ((left + right) / 2.0, bottom + 0.55 * (top - bottom))
            if room.use == "bathroom":
                at = (left + 0.4 * (right - left), at[1])
            if room.use == "utility":
                at = (left + 0.62 * (right - left), at[1])
            size = min(0.26, 0.34 * min(right - left, top - bottom))
            self._text(name, at, size)
            if room.use in ("living", "bedroom"):
                mats = f"{room.area_m2 / MAT_M2:.1f}帖"
                self._text(mats, (at[0], at[1] - 0.4), 0.24)

    def _text(self, text: str, at: tuple[float, float], height_m: float) -> None:
        height = max(height_m * self.manner.px_per_m, 10.0)
        self.canvas.text(text, at, height, "uni", INK)
