"""How a builder's catalogue draws doors: leaves, folds, panels past each other, pockets."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from shapely.geometry.base import BaseGeometry

from veduta.synthetic.plans.canvas import Canvas, Colour
from veduta.synthetic.plans.house import Opening
from veduta.synthetic.plans.places import Place


@dataclass(frozen=True)
class Pen:
    """A pen of one width on a sheet."""

    canvas: Canvas
    width_px: float
    ink: Colour

    def line(self, *points: ArrayLike, width: float = 1.0) -> None:
        """A line through places in metres, so many pens thick."""
        self.canvas.line(list(points), width * self.width_px, self.ink)  # type: ignore[arg-type]

    def outline(self, area: BaseGeometry) -> None:
        """The rings of an area."""
        self.canvas.outline(area, self.width_px, self.ink)

    def dashed(self, start: ArrayLike, end: ArrayLike) -> None:
        """A dashed line."""
        self.canvas.dashed(start, end, self.width_px, self.ink)


def _side(opening: Opening) -> float:
    return 1.0 if opening.swing == "left" else -1.0


def _leaf(pen: Pen, place: Place, hinge: float, length: float, side: float) -> None:
    base = side * place.half_m
    pen.line(place.at(hinge, base), place.at(hinge, base + side * abs(length)), width=1.5)
    pen.line(*place.sweep((hinge, base), length, side, 24), width=0.8)


def _swing(pen: Pen, opening: Opening, place: Place, _: bool) -> None:
    hinge, towards = (0.0, 1.0) if opening.hinge == "start" else (place.width_m, -1.0)
    _leaf(pen, place, hinge, towards * place.width_m, _side(opening))


def _double(pen: Pen, opening: Opening, place: Place, _: bool) -> None:
    half = place.width_m / 2.0
    _leaf(pen, place, 0.0, half, _side(opening))
    _leaf(pen, place, place.width_m, -half, _side(opening))


def _folding(pen: Pen, opening: Opening, place: Place, _: bool) -> None:
    """Two pairs of folds, half open."""
    side, wide, base = _side(opening), place.width_m, _side(opening) * place.half_m
    leaf = wide / 4.0
    run = 0.4 * leaf
    rise = float(np.sqrt(leaf**2 - run**2))
    for jamb, towards in ((0.0, 1.0), (wide, -1.0)):
        points = [
            place.at(jamb + towards * step * run, base + side * rise * (step % 2))
            for step in range(3)
        ]
        pen.line(*points, width=1.3)


def _sliding(pen: Pen, _: Opening, place: Place, faces: bool) -> None:
    """Two thin panels that pass each other, within the wall; faces run on where walls are lines."""
    wide, middle = place.width_m, place.width_m / 2.0
    deep = min(0.035, 0.7 * place.half_m)
    pen.outline(place.box(0.0, middle + 0.05, 0.0, deep))
    pen.outline(place.box(middle - 0.05, wide, -deep, 0.0))
    if faces:
        for side in (-place.half_m, place.half_m):
            pen.line(place.at(0.0, side), place.at(wide, side), width=0.6)


def _pocket(pen: Pen, opening: Opening, place: Place, _: bool) -> None:
    """A slot within the wall, and a leaf that stands a quarter out of it."""
    wide = place.width_m
    deep = min(0.025, 0.5 * place.half_m)
    jamb, into = (0.0, -1.0) if opening.hinge == "start" else (wide, 1.0)
    for side in (-deep, deep):
        pen.line(place.at(jamb, side), place.at(jamb + into * wide, side), width=0.8)
    pen.line(place.at(jamb + into * wide, -deep), place.at(jamb + into * wide, deep), width=0.8)
    low, high = sorted((jamb + into * 0.7 * wide, jamb - into * 0.25 * wide))
    pen.outline(place.box(low, high, -0.5 * deep, 0.5 * deep))


def _garage(pen: Pen, _: Opening, place: Place, __: bool) -> None:
    """A door overhead: its closed leaf as a thin box, its open place in dashes."""
    pen.outline(place.box(0.0, place.width_m, -0.03, 0.03))
    for along in (0.0, place.width_m):
        pen.dashed(place.at(along, 0.1), place.at(along, 2.2))
    pen.dashed(place.at(0.0, 2.2), place.at(place.width_m, 2.2))


def _plain(pen: Pen, _: Opening, place: Place, __: bool) -> None:
    """Nothing but the beam over a wide way, in dashes."""
    if place.width_m > 1.4:
        for side in (-place.half_m, place.half_m):
            pen.dashed(place.at(0.0, side), place.at(place.width_m, side))


DRAWN: Mapping[str, Callable[[Pen, Opening, Place, bool], None]] = {
    "swing": _swing, "double": _double, "french": _double, "folding": _folding,
    "sliding": _sliding, "pocket": _pocket, "garage": _garage, "plain": _plain,
}  # fmt: skip
