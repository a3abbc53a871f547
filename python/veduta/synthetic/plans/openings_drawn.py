"""Symbols of doors and windows within their walls."""

from __future__ import annotations

import math

import numpy as np

from veduta.synthetic.plans import curves
from veduta.synthetic.plans.bodies import opening_area
from veduta.synthetic.plans.canvas import Canvas
from veduta.synthetic.plans.house import Opening, Wall
from veduta.synthetic.plans.places import Place, place_of
from veduta.synthetic.plans.styles import Style

LEAF_M = 0.045


def draw_window(canvas: Canvas, style: Style, wall: Wall, opening: Opening) -> None:
    """One of the paper's four drawings (AV3D, figure 7, of which only the picture tells)."""
    area = opening_area(wall, opening, 0.0)
    size = curves.wall_length(wall)
    low, high = opening.along_m / size, (opening.along_m + opening.width_m) / size
    half = wall.thickness_m / 2
    if opening.type == "filled":
        pale = tuple(
            round(0.75 * p + 0.25 * i) for p, i in zip(style.paper, style.ink, strict=True)
        )
        canvas.fill(area, (pale[0], pale[1], pale[2]))
        canvas.outline(area, style.pen_px, style.ink)
        return
    offsets = {
        "single-line": (0.0,), "double-line": (-half, half), "triple-line": (-half, 0.0, half),
    }.get(opening.type, (-half, -0.03, 0.03, half))  # fmt: skip
    for offset in offsets:
        canvas.line(curves.line(wall, low, high, offset), style.pen_px, style.ink)
    for share in (low, high):
        ends = np.array([share])
        jamb = [
            curves.at(wall.start_m, wall.end_m, wall.bulge, ends, side)[0] for side in (-half, half)
        ]
        canvas.line(jamb, style.pen_px, style.ink)


def draw_door(canvas: Canvas, style: Style, wall: Wall, opening: Opening) -> None:
    """A door of any kind; a plain gap has lines across it in some styles."""
    place = place_of(wall, opening)
    if style.gap_lines and opening.kind == "door":
        canvas.fill(place.box(0, place.width_m, -place.half_m, place.half_m), (255, 255, 255))
        for side in (-place.half_m, place.half_m):
            canvas.line([place.at(0, side), place.at(place.width_m, side)], 1.0, style.ink)
        if opening.type in ("swing", "double", "french"):
            return
    draw = {
        "swing": _swing, "double": _double, "french": _french, "sliding": _sliding,
        "pocket": _pocket, "folding": _folding, "garage": _garage, "plain": _plain,
    }[opening.type]  # fmt: skip
    draw(canvas, style, place, opening)


def _leaf(
    canvas: Canvas, style: Style, place: Place, hinge_m: float, length_m: float, side: float,
    glazed: bool = False,
) -> None:  # fmt: skip
    """A leaf at 90 degrees from a hinge at `hinge_m`, closing by `length_m` (signed) along."""
    base = side * place.half_m if style.hinge_on_face else 0.0
    size = abs(length_m)
    towards = math.copysign(1.0, length_m)
    tip = base + side * size
    if style.leaf == "slab" or glazed:
        thick = towards * LEAF_M * (1.4 if glazed else 1.0)
        slab = place.box(hinge_m, hinge_m + thick, base, tip)
        canvas.outline(slab, style.pen_px, style.ink)
    else:
        canvas.line(
            [place.at(hinge_m, base), place.at(hinge_m, tip)], style.pen_px + 0.5, style.ink
        )
    arc = place.sweep((hinge_m, base), length_m, side, 24)
    if style.arc == "quarter":
        canvas.line(arc, style.pen_px * 0.8, style.ink)
    elif style.arc == "dashed":
        for low in range(0, 23, 4):
            canvas.line(arc[low : low + 3], style.pen_px, style.ink)
    elif style.arc == "chord":
        canvas.line([arc[0], arc[-1]], style.pen_px * 0.8, style.ink)


def _side(opening: Opening) -> float:
    return 1.0 if opening.swing == "left" else -1.0


def _swing(canvas: Canvas, style: Style, place: Place, opening: Opening) -> None:
    if opening.hinge == "start":
        _leaf(canvas, style, place, 0.0, place.width_m, _side(opening))
    else:
        _leaf(canvas, style, place, place.width_m, -place.width_m, _side(opening))


def _double(canvas: Canvas, style: Style, place: Place, opening: Opening) -> None:
    half = place.width_m / 2
    _leaf(canvas, style, place, 0.0, half, _side(opening))
    _leaf(canvas, style, place, place.width_m, -half, _side(opening))


def _french(canvas: Canvas, style: Style, place: Place, opening: Opening) -> None:
    half = place.width_m / 2
    _leaf(canvas, style, place, 0.0, half, _side(opening), glazed=True)
    _leaf(canvas, style, place, place.width_m, -half, _side(opening), glazed=True)


def _sliding(canvas: Canvas, style: Style, place: Place, _: Opening) -> None:
    deep = min(place.half_m * 0.8, 0.06)
    for low, high, right, left in (
        (0.0, 0.55 * place.width_m, 0.0, deep),
        (0.45 * place.width_m, place.width_m, -deep, 0.0),
    ):
        canvas.outline(place.box(low, high, right, left), style.pen_px, style.ink)


def _pocket(canvas: Canvas, style: Style, place: Place, _: Opening) -> None:
    deep = min(place.half_m * 0.5, 0.035)
    size = place.width_m
    slot = place.box(-0.85 * size, 0.0, -deep, deep)
    if style.walls != "single-line":
        canvas.fill(slot, style.paper)
    canvas.outline(place.box(-0.85 * size, 0.12 * size, -deep, deep), style.pen_px, style.ink)
    canvas.dashed(place.at(0.12 * size, 0), place.at(size, 0), style.pen_px, style.ink)


def _folding(canvas: Canvas, style: Style, place: Place, opening: Opening) -> None:
    side, size = _side(opening), place.width_m
    leaves = 4 if size > 1.2 else 2
    run, leaf = 0.45 * size / leaves, size / leaves
    rise = math.sqrt(max(leaf**2 - run**2, 0.0))
    base = side * place.half_m if style.hinge_on_face else 0.0
    points = []
    for index in range(leaves + 1):
        along = index * run if opening.hinge == "start" else size - index * run
        points.append(place.at(along, base + side * rise * (index % 2)))
    canvas.line(points, style.pen_px + 0.4, style.ink)


def _garage(canvas: Canvas, style: Style, place: Place, _: Opening) -> None:
    deep = min(place.half_m, 0.05)
    canvas.outline(place.box(0.0, place.width_m, -deep, deep), style.pen_px, style.ink)


def _plain(canvas: Canvas, style: Style, place: Place, _: Opening) -> None:
    if style.walls == "hatched":
        for side in (-place.half_m, place.half_m):
            canvas.dashed(place.at(0, side), place.at(place.width_m, side), style.pen_px, style.ink)
